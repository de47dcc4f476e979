
#include "app/io/character/fbx/record.hpp"

namespace tendril::app::fbx {
namespace {

/// `Name: value, value { records }`. A list begins on a later line, or continues there after a comma, unless
/// a record begins there; it also continues if that line begins with a comma.
class TextRecords final : public RecordReader {
  public:
    explicit TextRecords(std::string_view text) : text_(text) {}

    File read() {
        while (true) {
            skip_lines();
            if (at_ == text_.size()) break;
            if (text_[at_] == '}') {
                if (!inside()) fail("} without a matching {");
                ++at_;
                close();
                continue;
            }
            Record record;
            record.name = name();
            properties(record);
            skip_lines();
            open(std::move(record));
            if (at_ < text_.size() && text_[at_] == '{')
                ++at_;
            else
                close();
        }
        const Record* header = file_.root.child("FBXHeaderExtension");
        const Record* version = header ? header->child("FBXVersion") : nullptr;
        file_.version = version ? static_cast<int>(version->integer(0) % 1'000'000) : version_in_comment();
        return finish();
    }

  private:
    std::string place() const override { return "line " + std::to_string(line_); }
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; }
    void skip_blanks() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }
    /// Skips line ends and comments, too.
    void skip_lines() {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == ';') at_ = std::min(text_.find('\n', at_), text_.size());
            if (at_ == text_.size()) return;
            if (text_[at_] == '\n')
                ++line_;
            else if (!is_blank(text_[at_]))
                return;
        }
    }
    std::string_view word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) &&
               std::string_view("\n:,;{}\"").find(text_[at_]) == std::string_view::npos)
            ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::string_view name() {
        const std::string_view name = word();
        skip_blanks();
        if (name.empty() || at_ == text_.size() || text_[at_] != ':')
            fail("expected a record, \"Name: ...\"");
        ++at_;
        return name;
    }
    /// Whether no value follows: `Name:`, a brace, or the end.
    bool at_record() {
        const std::size_t begin = at_;
        const bool has_word = !word().empty();
        skip_blanks();
        const char next = at_ < text_.size() ? text_[at_] : '}';
        const bool ends = has_word ? next == ':' : next == '{' || next == '}';
        at_ = begin;
        return ends;
    }
    void properties(Record& record) {
        for (bool more = true; more;) {
            skip_lines();
            if (at_record()) return;
            record.properties.push_back(property());
            const std::size_t after = at_, line = line_;
            skip_lines();
            more = at_ < text_.size() && text_[at_] == ',';
            if (more)
                ++at_;
            else
                at_ = after, line_ = line;
        }
        skip_blanks();
        if (at_ < text_.size() && std::string_view("\n;{}").find(text_[at_]) == text_.npos)
            fail("expected a comma or the end of the line");
    }
    Property property() {
        if (at_ == text_.size() || text_[at_] != '"') return {'T', word()};
        const std::size_t begin = ++at_, end = text_.find('"', begin);
        if (end == text_.npos) fail("a string without an end");
        for (; at_ < end; ++at_)
            if (text_[at_] == '\n') ++line_;
        at_ = end + 1;
        return {'S', text_.substr(begin, end - begin)};
    }
    /// "; FBX 6.1.0 project file": 6100.
    int version_in_comment() const {
        const std::size_t at = text_.substr(0, 4096).find("; FBX ");
        if (at == text_.npos || at + 8 >= text_.size()) return 0;
        const char major = text_[at + 6], minor = text_[at + 8];
        const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
        return is_digit(major) && is_digit(minor) ? 1000 * (major - '0') + 100 * (minor - '0') : 0;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

}  // namespace

File read_text(std::string_view text) {
    return TextRecords(text).read();
}

}  // namespace tendril::app::fbx
