// Finds vectors in any text, with the words before them, for traces in logs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/io/trace/raw.hpp"

namespace tendril::app {

struct LogToken {
    char kind = 0;        ///< '0' for a number, 'a' for a word, '\n' for a line's end, else the character
    bool spaced = false;  ///< follows white space
    std::string_view text{};
    double value = 0.0;

    bool is_whole() const { return text.find_first_not_of("0123456789") == text.npos; }
};

/// Appends the tokens of a line. Quotes and backslashes count as spaces, for JSON inside text.
void add_tokens(std::vector<LogToken>& tokens, std::string_view line);

/// A word before a vector, or a whole number.
struct LogWord {
    std::string text{}, name{};  ///< as written; in lower case
    bool ends_phrase = false,
         names = false;  ///< followed by a comma or closing bracket; by a colon or equals sign

    bool is_number() const { return is_digit(text[0]) && text.find_first_not_of("0123456789") == text.npos; }
};

/// Separates a vector from the one before. Line breaks outweigh brackets.
enum Gap : unsigned {
    SameLine = 0,
    NextLine = 64,
    TextBetween = 128,
    BlankBetween = 192,
    RuleBetween = 256,
    NameAgain = 1024  ///< not a gap: a repeated name begins a frame
};

/// Three or four numbers, and the words before them.
struct LogVector {
    std::vector<LogWord> words{};  ///< the last one is next to the numbers
    std::vector<double> numbers{};
    bool first = false;       ///< the first of its line
    bool matrix = false;      ///< the position of a matrix
    bool missing = false;     ///< empty cells: a joint is NaN, a target absent
    unsigned gap = SameLine;  ///< plus the number of brackets closed in the gap
    std::size_t line = 0;
    std::optional<double> stamp{}, dt{};  ///< seconds
    std::string chain{};                  ///< from a table's column
    // Learned from the whole start of the file.
    std::string kind{}, label{}, phrase{};
    Meaning meaning = Meaning::Joint;
    bool is_position = true;

    bool is_joint() const { return is_position && meaning == Meaning::Joint && numbers.size() == 3; }
};

/// Appends the words of a name: arm.elbow has two, hand.R one.
void add_words(std::vector<LogWord>& words, std::string_view text);

class VectorLines {
  public:
    virtual ~VectorLines() = default;
    /// The vectors of the next line that has any; false at the end.
    virtual bool next(std::vector<LogVector>& found) = 0;
};
/// Reads CSV, or cells copied from a spreadsheet. Null if the first lines have no column names.
std::unique_ptr<VectorLines> open_table(Lines& lines, RawTrace& trace);

/// Finds (1, 2, 3), X=1 Y=2 Z=3, 1.0 2.0 3.0 after a name or on a line of their own, poses, and positions of
/// matrices, on one or several lines. Sets the trace's engine if the notation shows it.
class LogScanner final : public VectorLines {
  public:
    LogScanner(Lines& lines, RawTrace& trace) : lines_(lines), trace_(trace) {}

    bool next(std::vector<LogVector>& found) override;
    bool components() const { return components_; }  ///< x, y and z were on separate lines

  private:
    using Numbers = std::vector<double>;

    bool is(std::size_t at, char kind) const { return at < tokens_.size() && tokens_[at].kind == kind; }
    bool is_any(std::size_t at, std::string_view kinds) const {
        return at < tokens_.size() && kinds.find(tokens_[at].kind) != kinds.npos;
    }
    bool pull();
    void skip_breaks(std::size_t& at);
    std::size_t scan_line(std::vector<LogVector>& found);
    void pass_line(std::size_t end);
    void add(std::vector<LogVector>& found, LogVector vector, Numbers numbers, std::size_t row,
             std::size_t& end);
    bool next_row(std::size_t& at, std::size_t width, Numbers& numbers);
    void read_stamp(std::size_t end);
    std::vector<LogWord> words_before(std::size_t at) const;
    std::optional<double> number_at(std::size_t& at) const;
    bool list_at(std::size_t& at, Numbers& numbers, std::size_t& row);
    bool named(std::size_t at, std::size_t& end, Numbers& numbers, std::size_t& row, std::string_view& name);
    bool bracketed(std::size_t at, std::size_t& end, Numbers& numbers, std::size_t& row);
    bool bare(std::size_t& at, std::size_t& end, Numbers& numbers);
    bool column(std::size_t at, std::size_t& end, Numbers& numbers);

    Lines& lines_;
    RawTrace& trace_;
    std::vector<LogToken> tokens_;  ///< tokens of the lines that pull() added
    std::size_t pulled_ = 0, from_ = 0,
                bullets_ = 0;       ///< lines; the token after the last vector; - - at the start of a line
    std::vector<LogWord> heading_;  ///< words of earlier lines, for the next vector
    bool loose_ = false;            ///< the heading is plain text
    std::optional<double> stamp_{};
    double scale_ = 1.0;  ///< for the following rows, from MATLAB's 1.0e+03 *
    unsigned gap_ = SameLine, opened_ = 0, closed_ = 0;
    std::size_t unread_ = 0, first_unread_ = 0;  ///< lines without vectors: how many, and the first
    bool components_ = false, scaled_ = false, lone_ = false, axes_ = false;
};

}  // namespace tendril::app
