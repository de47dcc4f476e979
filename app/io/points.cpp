#include "app/io/samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/document/text.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {
namespace {

constexpr double farthest_point = 1e9;  // the limit of all numbers that the program reads

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
    PointReader(std::string_view text, std::size_t most) : text_(text), most_(most) {}

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
    std::string open_;  ///< the open brackets
    std::vector<glm::vec3> points_;
    // the present row
    glm::vec3 row_{0.0f};
    std::array<bool, 3> given_{};
    std::size_t count_ = 0;
    std::optional<std::size_t> axis_;  ///< the named axis whose number is not yet read
    bool named_ = false;
};

}  // namespace

std::vector<glm::vec3> read_points(std::string_view text, std::size_t most) {
    return PointReader(text, most).read();
}

}  // namespace tendril::app
