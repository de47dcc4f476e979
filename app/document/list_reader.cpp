#include "app/document/list_reader.hpp"

#include "app/document/json_complete.hpp"
#include "app/document/json_scan.hpp"

namespace tendril::app {

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
