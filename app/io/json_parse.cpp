// Parses JSON from untrusted files: bounded depth, time that depends only on the text's size, and errors with
// line numbers.
#include <algorithm>
#include <numeric>
#include <vector>

#include "app/io/json_complete.hpp"
#include "app/io/json_scan.hpp"

namespace tendril::app {
namespace {

void check_depth(std::string_view text) {
    int depth = 0;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (depth > max_json_depth)
            throw ParseError(line_at(text, at), "nested deeper than " + std::to_string(max_json_depth));
        at = c == '"' ? string_end(text, at) : at + 1;
    }
}

/// Rewords the parser's message, which mentions literals and the last read. One line of printable ASCII.
std::string parse_reason(std::string_view what, std::string_view token) {
    constexpr std::size_t longest = 60;
    what = what.substr(0, what.find("; last read"));  // omit the file's own text
    const auto says = [&](std::string_view part) { return what.find(part) != what.npos; };
    const std::string_view unexpected = "unexpected ";
    std::string reason;
    if (says("empty input")) return "unexpected end of input";
    if (says("number overflow"))
        reason = "number too large: ";
    else if (says("invalid literal"))
        reason = "expected a value, found ";
    else if (says("invalid number"))
        reason = "not a number: ";
    else if (says("UTF-8"))
        return "a text has bytes that are not UTF-8";
    else if (says("control character"))
        return "a text has a line break or control character in it";
    else if (says("missing closing quote"))
        return "a text has no closing quote";
    else if (says("invalid string"))
        reason = "a text has an unknown escape: ";
    else if (const auto at = what.find(unexpected); at != what.npos) {
        const std::string_view found = what.substr(at, what.find(';', at) - at);
        if (found.ends_with("string literal")) return "unexpected text";
        if (found.ends_with(" literal"))
            return std::string(found.substr(0, found.size() - std::string_view(" literal").size()));
        return std::string(found);
    } else {
        return "not JSON";
    }
    reason += '\'';
    // The token shows control characters as <U+000A>, and may begin before the mistake.
    token = says("invalid string") ? token.substr(0, token.find("<U+"))
                                   : token.substr(token.find_last_of(" >{}[],:\"") + 1);
    for (const char c : token.substr(0, longest)) reason += c >= ' ' && c <= '~' ? c : '?';
    return reason + (token.size() > longest ? "...'" : "'");
}

using Members = std::vector<std::pair<std::string, Json>>;

/// Builds an object. The library searches all earlier members for each new one, which takes hours for a file
/// that is all keys.
Json object_of(Members& members) {
    std::vector<std::size_t> order(members.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return members[a].first < members[b].first; });
    std::vector<bool> replaced(members.size());
    for (std::size_t i = 1; i < order.size(); ++i)
        replaced[order[i - 1]] = members[order[i - 1]].first == members[order[i]].first;

    Json::object_t object;
    object.reserve(members.size());
    for (std::size_t i = 0; i < members.size(); ++i)
        if (!replaced[i]) object.emplace_back(std::move(members[i].first), std::move(members[i].second));
    return object;
}

/// Builds the value from the parser's events.
class Builder : public nlohmann::json_sax<Json> {
  public:
    explicit Builder(std::string_view text) : text_(text) {}
    Json take() { return std::move(result_); }

    bool null() override { return value(nullptr); }
    bool boolean(bool b) override { return value(b); }
    bool number_integer(number_integer_t n) override { return value(n); }
    bool number_unsigned(number_unsigned_t n) override { return value(n); }
    bool number_float(number_float_t x, const string_t&) override { return value(x); }
    bool string(string_t& s) override { return value(std::move(s)); }
    bool binary(binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open_.emplace_back(), true; }
    bool start_array(std::size_t) override { return open_.emplace_back(), true; }
    bool key(string_t& name) override {
        open_.back().members.emplace_back(std::move(name), nullptr);
        open_.back().is_object = true;
        return true;
    }
    bool end_object() override {
        Json object = object_of(open_.back().members);
        open_.pop_back();
        return value(std::move(object));
    }
    bool end_array() override {
        Json array = std::move(open_.back().items);
        open_.pop_back();
        return value(std::move(array));
    }
    bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) override {
        throw ParseError(line_at(text_, position == 0 ? 0 : position - 1), parse_reason(error.what(), token));
    }

  private:
    struct Open {
        bool is_object = false;
        Members members;
        Json::array_t items;
    };

    bool value(Json json) {
        if (open_.empty())
            result_ = std::move(json);
        else if (open_.back().is_object)
            open_.back().members.back().second = std::move(json);
        else
            open_.back().items.push_back(std::move(json));
        return true;
    }

    std::string_view text_;
    std::vector<Open> open_;
    Json result_;
};

/// The offset of the child `name` (a key, or an index) of the container at `at`; npos if there is none.
std::size_t find_child(std::string_view text, std::size_t at, std::string_view name) {
    if (at >= text.size() || (text[at] != '{' && text[at] != '[')) return text.npos;
    const bool object = text[at] == '{';
    const std::string quoted = '"' + std::string(name) + '"';
    at = skip_space(text, at + 1);
    for (std::size_t index = 0; at < text.size() && text[at] != ']' && text[at] != '}'; ++index) {
        bool here = !object && std::to_string(index) == name;
        if (object) {
            const std::size_t end = string_end(text, at);
            here = text.substr(at, end - at) == quoted;
            at = skip_space(text, skip_space(text, end) + 1);
        }
        if (here) return at;
        at = skip_value(text, at);
        if (at < text.size() && text[at] == ',') at = skip_space(text, at + 1);
    }
    return text.npos;
}

}  // namespace

Json parse_json(std::string_view text) {
    check_depth(text);
    Builder builder(text);
    Json::sax_parse(text, &builder);
    return builder.take();
}

int json_line(std::string_view text, std::string_view path) {
    std::size_t at = skip_space(text, 0);
    bool found = false;
    while (!path.empty()) {
        const auto dot = path.find('.');
        const std::size_t child = find_child(text, at, path.substr(0, dot));
        if (child == text.npos) break;
        found = true;
        at = child;
        path = dot == path.npos ? std::string_view() : path.substr(dot + 1);
    }
    return found ? line_at(text, at) : 0;
}

ListReader::ListReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
    at_ = skip_space(text_, at_);
    if (at_ >= text_.size() || text_[at_] != '[') {
        const Json other = parse_json(text_);
        throw std::runtime_error(name_ + ": expected a list, found " + json_summary(other));
    }
    at_ = skip_space(text_, at_ + 1);
}

void ListReader::fail(std::size_t offset, const std::string& why) const {
    throw ParseError(line_at(text_, offset), why);
}

void ListReader::end_of_list() {
    const std::size_t rest = skip_space(text_, at_ + 1);
    if (rest < text_.size()) fail(rest, "expected nothing after the list");
    done_ = true;
    at_ = text_.size();
}

bool ListReader::next(Json& value) {
    if (done_) return false;
    if (first_ && at_ < text_.size() && text_[at_] == ']') return end_of_list(), false;

    const std::size_t end = skip_value(text_, at_);
    if (end >= text_.size()) fail(text_.size(), "the text ends inside the list");
    if (text_[end] == '}') fail(end, "unexpected '}'");
    if (end == at_) fail(at_, "expected a value");
    start_ = at_;
    value_ = text_.substr(start_, end - start_);
    try {
        value = parse_json(value_);
    } catch (const ParseError& error) {
        throw ParseError(line_at(text_, start_) + error.line - 1, error.reason);
    }
    index_ = first_ ? 0 : index_ + 1;
    first_ = false;
    at_ = end;
    if (text_[end] == ',')
        at_ = skip_space(text_, end + 1);
    else
        end_of_list();
    return true;
}

int ListReader::line_of(std::string_view place) const {
    const int first = line_at(text_, start_);
    const std::string here = this->place() + ".";
    if (!place.starts_with(here)) return first;
    return first + std::max(1, json_line(value_, place.substr(here.size()))) - 1;
}

double ListReader::progress() const {
    return text_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(text_.size());
}

}  // namespace tendril::app
