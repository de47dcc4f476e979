#include "app/io/samples.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "app/document/json.hpp"
#include "app/document/text.hpp"

namespace tendril::app {
namespace {

constexpr double most = 1e9;  // as of every number that the program reads

using Fields = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number_in(std::string_view field) {
    if (field.starts_with('+')) field.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
    return value;
}

/// Rows of fields, and what is wrong with them told by row and column, both counted from 1.
class Table {
  public:
    Table(std::string_view text, std::string name) : name_(std::move(name)) {
        constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
        if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
        const auto last = text.find_last_not_of(" \t\r\n");
        text_ = text.substr(0, last == text.npos ? 0 : last + 1);
    }

    /// The next row's fields, without the blanks around them; false after the last.
    bool next(Fields& fields) {
        if (at_ >= text_.size()) return false;
        const auto end = std::min(text_.find('\n', at_), text_.size());
        std::string_view line = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++row_;
        fields.clear();
        for (;;) {
            const auto comma = line.find(',');
            fields.push_back(trimmed(line.substr(0, comma)));
            if (comma == line.npos) break;
            line.remove_prefix(comma + 1);
        }
        if (fields.size() == 1 && fields[0].empty()) fail(" is empty");
        return true;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error(name_ + ": row " + std::to_string(row_) + what);
    }
    [[noreturn]] void fail_whole(const std::string& what) const {
        throw std::runtime_error(name_ + ": " + what);
    }

    double number(const Fields& fields, std::size_t column, const std::string& title) const {
        const std::string_view field = fields[column];
        const auto value = number_in(field);
        const auto refuse = [&](const std::string& expected) {
            const std::string found =
                field.empty() ? "nothing" : '"' + single_line(std::string(field.substr(0, 40))) + '"';
            fail(", column " + std::to_string(column + 1) + " (" + title + "): expected " + expected +
                 ", found " + found);
        };
        if (!value) refuse("a number");
        if (!(std::abs(*value) <= most)) refuse("a number from -1e9 to 1e9");
        return *value;
    }

    void check_width(const Fields& fields, std::size_t width, const char* what) const {
        if (fields.size() == width) return;
        fail(" has " + std::to_string(fields.size()) + (fields.size() == 1 ? " column" : " columns") +
             ", expected " + std::to_string(width) + what);
    }

  private:
    std::string name_;
    std::string_view text_;
    std::size_t at_ = 0, row_ = 0;
};

/// A row of names: none of its fields is a number, and none is empty.
bool names_columns(const Fields& fields) {
    return std::none_of(fields.begin(), fields.end(),
                        [](std::string_view field) { return field.empty() || number_in(field); });
}

std::optional<std::size_t> column_named(const Fields& names, std::initializer_list<std::string_view> wanted) {
    for (const std::string_view name : wanted) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    }
    return std::nullopt;
}

}  // namespace

std::vector<signal::Sample> parse_samples(std::string_view text, const std::string& name) {
    Table table(text, name);
    Fields fields;
    if (!table.next(fields)) table.fail_whole("has no samples");
    std::size_t time_column = 0, input_column = 1, width = 2;
    bool absolute = false, more = true;
    if (names_columns(fields)) {
        const auto dt = column_named(fields, {"dt"}), time = column_named(fields, {"time"});
        const auto input = column_named(fields, {"input"});
        if (!input || !(dt || time)) table.fail(" names no columns dt and input");
        time_column = dt ? *dt : *time;
        absolute = !dt;
        input_column = *input;
        width = fields.size();
        more = table.next(fields);
    }
    std::vector<signal::Sample> samples;
    double before = 0.0;
    for (; more; more = table.next(fields)) {
        table.check_width(fields, width, width == 2 ? ": dt,input" : ", as the row of names has");
        const double time = table.number(fields, time_column, absolute ? "time" : "dt");
        const double input = table.number(fields, input_column, "input");
        samples.push_back({absolute ? time - before : time, input});
        before = time;
        if (samples.size() > most_samples) table.fail(" is one too many: the most is 1000000 samples");
    }
    if (samples.empty()) table.fail_whole("has no samples");
    return samples;
}

std::vector<signal::Sample> read_samples(const std::filesystem::path& path) {
    return parse_samples(read_text_file(path), path.string());
}

std::vector<double> parse_response(std::string_view text, const std::string& name, std::size_t count) {
    Table table(text, name);
    Fields fields;
    if (!table.next(fields)) table.fail_whole("has no response");
    const std::size_t width = fields.size();
    std::size_t column = width - 1;
    bool more = true;
    if (names_columns(fields)) {
        column = column_named(fields, {"output", "response", "value"}).value_or(column);
        more = table.next(fields);
    }
    std::vector<double> response;
    for (; more; more = table.next(fields)) {
        table.check_width(fields, width, ", as the first row");
        response.push_back(table.number(fields, column, "response"));
    }
    if (response.size() != count) {
        table.fail_whole("has " + std::to_string(response.size()) + " values, expected " +
                         std::to_string(count) + ", one for each sample");
    }
    return response;
}

std::vector<double> read_response(const std::filesystem::path& path, std::size_t count) {
    return parse_response(read_text_file(path), path.string(), count);
}

std::string decimal(double value) {
    char text[32];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value);
    return error == std::errc() ? std::string(text, end) : std::string();
}

}  // namespace tendril::app
