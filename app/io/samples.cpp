#include "app/io/samples.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/io/json.hpp"
#include "app/io/text.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {
namespace {

constexpr double most = 1e9;  // limit of every number that the program reads

using Fields = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The end of a line's first field; a comma between quotes is part of the field.
std::size_t field_end(std::string_view line) {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') quoted = !quoted;
        if (line[i] == ',' && !quoted) return i;
    }
    return line.npos;
}

std::string_view unquoted(std::string_view field) {
    const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
    return quoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

std::optional<double> number_in(std::string_view field) {
    if (field.starts_with('+')) field.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = read_double(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
    return value;
}

/// Reads rows of fields. Errors give the row and column, from 1.
class Table {
  public:
    Table(std::string_view text, std::string name) : name_(std::move(name)) {
        constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
        if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
        const auto last = text.find_last_not_of(" \t\r\n");
        text_ = text.substr(0, last == text.npos ? 0 : last + 1);
    }

    /// The next row's fields without surrounding blanks; false after the last row.
    bool next(Fields& fields) {
        if (at_ >= text_.size()) return false;
        const auto end = std::min(text_.find('\n', at_), text_.size());
        std::string_view line = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++row_;
        fields.clear();
        for (;;) {
            const auto comma = field_end(line);
            const std::string_view field = trimmed(line.substr(0, comma));
            if (row_ == 1) check_separator(field);
            fields.push_back(unquoted(field));
            if (comma == line.npos) break;
            line.remove_prefix(comma + 1);
        }
        if (fields.size() == 1 && fields[0].empty()) fail(" is empty");
        return true;
    }

    /// Detects a wrong separator in the first row.
    void check_separator(std::string_view field) const {
        const auto other = field.starts_with('"') ? field.npos : field.find_first_of(";\t");
        if (other == field.npos) return;
        fail(std::string(": columns are separated by commas, found a ") +
             (field[other] == ';' ? "semicolon" : "tab"));
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
        const std::string found = field.empty() ? "nothing" : '"' + printable(field.substr(0, 40)) + '"';
        if (!value) fail(column, title, "a number", found);
        if (!(std::abs(*value) <= most)) fail(column, title, "a number from -1e9 to 1e9", found);
        return *value;
    }

    [[noreturn]] void fail(std::size_t column, const std::string& title, const std::string& expected,
                           const std::string& found) const {
        fail(", column " + std::to_string(column + 1) + " (" + title + "): expected " + expected +
             ", found " + found);
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

/// "it has frame, left, right", or how many if they have no names.
std::string columns_text(const Fields& names, bool named) {
    if (!named) return "it has columns 1 to " + std::to_string(names.size());
    std::string text;
    constexpr std::size_t longest = 200;
    for (const std::string_view name : names) {
        if (text.size() > longest) return "it has " + text + ", ...";
        text += (text.empty() ? "" : ", ") + printable(name.substr(0, 40));
    }
    return "it has " + text;
}

/// A column name in the form that comparisons use: "Time (s)" is "time".
std::string plain_name(std::string_view name) {
    return lower_case(trimmed(name.substr(0, name.find_first_of("(["))));
}

/// The column that the user chose by its name, or by its number from 1.
std::size_t chosen_column(const Table& table, const Fields& names, bool named, const std::string& wanted) {
    if (named) {
        const auto exact = std::find(names.begin(), names.end(), wanted);
        if (exact != names.end()) return static_cast<std::size_t>(exact - names.begin());
        const auto alike = [&](std::string_view name) { return plain_name(name) == plain_name(wanted); };
        const auto count = std::count_if(names.begin(), names.end(), alike);
        if (count == 1)
            return static_cast<std::size_t>(std::find_if(names.begin(), names.end(), alike) - names.begin());
        if (count > 1)
            table.fail(" has " + std::to_string(count) + " columns called \"" +
                       printable(wanted.substr(0, 40)) + "\"; " + columns_text(names, named));
    }
    const auto number = number_in(wanted);
    if (number && *number >= 1.0 && *number <= static_cast<double>(names.size()) &&
        *number == std::floor(*number))
        return static_cast<std::size_t>(*number) - 1;
    table.fail(" has no column \"" + printable(wanted.substr(0, 40)) + "\"; " + columns_text(names, named));
}

/// Seconds in the unit that a column's name gives in brackets: 1e-3 for "Time (ms)", 1 if it gives none.
double unit_of_time(const Table& table, std::string_view name) {
    const std::size_t open = name.find_first_of("([");
    if (open == name.npos) return 1.0;
    const std::string_view rest = name.substr(open + 1);
    const std::string unit = lower_case(trimmed(rest.substr(0, rest.find_first_of(")]"))));
    if (unit == "ms") return 1e-3;
    if (unit == "us" || unit == "\u00b5s") return 1e-6;
    if (unit == "s" || unit == "sec" || unit == "seconds") return 1.0;
    table.fail(": its time is in \"" + printable(unit.substr(0, 20)) + "\"; it must be in s, ms or us");
}

std::optional<std::size_t> usual_column(const Fields& names, std::initializer_list<std::string_view> usual) {
    for (const std::string_view name : usual)
        for (std::size_t i = 0; i < names.size(); ++i)
            if (plain_name(names[i]) == name) return i;
    return std::nullopt;
}

/// Which columns hold the samples.
struct Columns {
    std::size_t time = 0, input = 1, width = 2;
    bool absolute = false;  ///< time is absolute, not the time since the previous row
    double seconds = 1.0;   ///< the unit of time
};

/// Throws with a list of the columns if it is unclear which to read.
Columns columns_of(const Table& table, const Fields& names, bool named, const ColumnChoice& choice) {
    if (!named && names.size() == 2 && choice.time.empty() && choice.value.empty()) return {};
    std::optional<std::size_t> time, value, dt;
    if (named) dt = usual_column(names, {"dt"});
    if (named && !dt) time = usual_column(names, {"time", "t", "seconds", "sec", "s", "timestamp"});
    if (!choice.time.empty()) {
        time = chosen_column(table, names, named, choice.time);
        dt.reset();
        if (named && plain_name(names[*time]) == "dt") dt = std::exchange(time, std::nullopt);
    }
    if (named) value = usual_column(names, {"input", "value", "x", "y", "z", "position"});
    if (!choice.value.empty()) value = chosen_column(table, names, named, choice.value);
    const auto passes = dt ? dt : time;
    if (!value && passes && names.size() == 2) value = 1 - *passes;  // the other one
    if (!passes)
        table.fail(": cannot tell which column is the time; name it as time. " + columns_text(names, named));
    if (!value)
        table.fail(": cannot tell which column is the value; name it as value. " +
                   columns_text(names, named));
    if (*passes == *value) table.fail(": time and value are the same column");
    return {.time = *passes,
            .input = *value,
            .width = names.size(),
            .absolute = !dt,
            .seconds = named ? unit_of_time(table, names[*passes]) : 1.0};
}

void check_order(const Table& table, const Columns& columns, double time, double before) {
    if (time < before)
        table.fail(columns.time, "time", "at least " + decimal(before) + ", the time of the previous row",
                   decimal(time));
    if (time - before > most)
        table.fail(columns.time, "time", "at most 1e9 s after " + decimal(before), decimal(time));
}

/// Computes dt from absolute times. The first sample has no previous time: its dt is set to the second one's.
void difference(TimedSamples& rows) {
    for (std::size_t i = 1; i < rows.times.size(); ++i) {
        rows.samples[i].dt = rows.times[i] - rows.times[i - 1];
        double& first = rows.samples[0].dt;
        if (first <= 0.0) first = rows.samples[i].dt;
    }
    rows.samples[0].dt = std::max(rows.samples[0].dt, signal::min_dt);
}

constexpr double farthest_point = 1e9;  // limit of every number that the program reads

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool separates(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ';';
}
char closing(char open) {
    return open == '(' ? ')' : open == '[' ? ']' : '}';
}

class PointReader {
  public:
    PointReader(std::string_view text, std::size_t points) : text_(text), most_(points) {}

    std::vector<glm::vec3> read() {
        skip_header();
        while (at_ < text_.size()) take(text_[at_]);
        if (!open_.empty()) fail(std::string("\"") + open_.back() + "\" is not closed");
        if (count_ > 0 || axis_) finish_row();
        if (points_.empty()) fail("expected three numbers, found nothing");
        return std::move(points_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
    }
    /// The text at the current position, for a message.
    std::string found() const {
        std::size_t end = at_ + 1;
        while (end < text_.size() && end - at_ < 40 && text_[end] != '\n' && !separates(text_[end])) ++end;
        return '"' + printable(text_.substr(at_, end - at_)) + '"';
    }

    void skip_header() {
        constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
        if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
        std::string names;
        std::size_t end = at_;
        for (; end < text_.size() && text_[end] != '\n' && names.size() < 4; ++end)
            if (!separates(text_[end]) && text_[end] != '"') names += text_[end];
        if (lower_case(names) == "xyz") at_ = end;
    }

    void take(char c) {
        if (c == '\n') return end_line();
        if (separates(c)) {
            ++at_;
        } else if (c == '(' || c == '[' || c == '{') {
            if (count_ > 0 || axis_) fail("expected a number, found " + found());
            open_.push_back(c);
            ++at_;
        } else if (c == ')' || c == ']' || c == '}') {
            close(c);
        } else if (is_letter(c) || c == '"') {
            take_word();
        } else {
            take_number();
        }
    }

    /// Inside brackets a row may continue on the next line.
    void end_line() {
        if (count_ == 3 || (open_.empty() && (count_ > 0 || axis_))) finish_row();
        ++line_;
        ++at_;
    }

    void close(char c) {
        if (open_.empty() || closing(open_.back()) != c) fail(std::string("found \"") + c + "\" too many");
        if (count_ > 0 || axis_) finish_row();
        open_.pop_back();
        ++at_;
    }

    /// The name of a coordinate, of a constructor, or "new".
    void take_word() {
        std::size_t end = at_;
        const bool quoted = text_[end] == '"';
        if (quoted) ++end;
        const std::size_t begin = end;
        while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]) ||
                                      (text_[end] == ':' && text_.substr(end).starts_with("::")) ||
                                      (text_[end] == ':' && end > begin && text_[end - 1] == ':')))
            ++end;
        const std::string word = lower_case(text_.substr(begin, std::min<std::size_t>(end - begin, 64)));
        if (quoted && (end >= text_.size() || text_[end] != '"')) fail("expected a number, found " + found());
        if (quoted) ++end;
        std::size_t next = end;
        while (next < text_.size() && (text_[next] == ' ' || text_[next] == '\t')) ++next;
        const char after = next < text_.size() ? text_[next] : '\n';
        const bool opens = after == '(' || after == '{';
        const bool vector = word.find("vec") != word.npos || word == "float3" || word == "double3";
        if (word.size() == 1 && word[0] >= 'x' && word[0] <= 'z' && (after == '=' || after == ':')) {
            if (axis_) fail("expected a number, found " + found());
            axis_ = static_cast<std::size_t>(word[0] - 'x');
            at_ = next + 1;
        } else if (!quoted && ((word == "new" && is_letter(after)) || (vector && opens))) {
            at_ = next;
        } else {
            fail("expected a number, found " + found());
        }
    }

    void take_number() {
        std::string_view rest = text_.substr(at_);
        const auto value = app::take_number(rest);
        const std::size_t end = text_.size() - rest.size();
        const bool whole = end >= text_.size() || text_[end] == '\n' || separates(text_[end]) ||
                           text_[end] == ')' || text_[end] == ']' || text_[end] == '}';
        if (!value || !whole || !(std::abs(*value) <= farthest_point))
            fail("expected a number from -1e9 to 1e9, found " + found());
        add(*value);
        at_ = end;
    }

    void add(double value) {
        if (count_ == 3) fail("expected three numbers, found a fourth: " + found());
        if (count_ > 0 && axis_.has_value() != named_) fail("some numbers have names, others have none");
        named_ = axis_.has_value();
        const std::size_t axis = axis_.value_or(count_);
        if (given_[axis]) fail(std::string("found ") + "xyz"[axis] + " twice");
        row_[static_cast<glm::length_t>(axis)] = static_cast<float>(value);
        given_[axis] = true;
        axis_.reset();
        ++count_;
    }

    void finish_row() {
        if (count_ != 3 || axis_) {
            constexpr std::array<const char*, 4> words{"none", "one", "two", "three"};
            fail(std::string("expected three numbers, found ") + words[count_]);
        }
        if (points_.size() == most_)
            fail("found more than " + std::to_string(most_) + " points, which is the maximum");
        points_.push_back(row_);
        given_ = {};
        count_ = 0;
    }

    std::string_view text_;
    std::size_t most_, at_ = 0, line_ = 1;
    std::string open_;  ///< brackets opened so far
    std::vector<glm::vec3> points_;
    // the present row
    glm::vec3 row_{0.0f};
    std::array<bool, 3> given_{};
    std::size_t count_ = 0;
    std::optional<std::size_t> axis_;  ///< the named axis whose number is not yet read
    bool named_ = false;
};

}  // namespace

TimedSamples parse_samples(std::string_view text, const std::string& name, const ColumnChoice& choice) {
    Table table(text, name);
    Fields fields;
    if (!table.next(fields)) table.fail_whole("has no samples");
    const bool named = names_columns(fields);
    const Columns columns = columns_of(table, fields, named, choice);
    bool more = !named || table.next(fields);
    const std::size_t width = columns.width;
    TimedSamples rows;
    for (; more; more = table.next(fields)) {
        table.check_width(fields, width,
                          named        ? ", as in the row of names"
                          : width == 2 ? ": dt,input"
                                       : ", as in the first row");
        const double time =
            columns.seconds * table.number(fields, columns.time, columns.absolute ? "time" : "dt");
        const double input = table.number(fields, columns.input, "input");
        if (columns.absolute) {
            if (!rows.times.empty()) check_order(table, columns, time, rows.times.back());
            rows.times.push_back(time);
        }
        rows.samples.push_back({columns.absolute ? 0.0 : time, input});
        if (rows.samples.size() > max_samples) table.fail(" is one too many: the maximum is 1000000 samples");
    }
    if (rows.samples.empty()) table.fail_whole("has no samples");
    if (columns.absolute)
        difference(rows);
    else
        rows.times = signal::times_of(rows.samples);
    return rows;
}

TimedSamples read_samples(const std::filesystem::path& path, const ColumnChoice& choice) {
    return parse_samples(read_text_file(path), path.string(), choice);
}

std::vector<double> parse_response(std::string_view text, const std::string& name, std::size_t count) {
    Table table(text, name);
    Fields fields;
    if (!table.next(fields)) table.fail_whole("has no response");
    const std::size_t width = fields.size();
    std::size_t column = width - 1;
    std::string title = "response";
    bool more = true;
    if (names_columns(fields)) {
        column = column_named(fields, {"output", "response", "value"}).value_or(column);
        title = printable(fields[column].substr(0, 40));
        more = table.next(fields);
    }
    std::vector<double> response;
    for (; more; more = table.next(fields)) {
        table.check_width(fields, width, ", as in the first row");
        response.push_back(table.number(fields, column, title));
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

std::vector<glm::vec3> read_points(std::string_view text, std::size_t most) {
    return PointReader(text, most).read();
}

}  // namespace tendril::app
