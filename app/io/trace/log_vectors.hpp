// Vectors in a line of any text, with the words before them. For traces in logs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/io/trace/raw.hpp"

namespace tendril::app {

inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

struct LogToken {
    char kind = 0;        ///< '0' a number, 'a' a word, else the character itself
    bool spaced = false;  ///< from the one before
    std::string_view text{};
    double value = 0.0;

    bool is_whole() const { return text.find_first_not_of("0123456789") == text.npos; }
};

/// Quotes and backslashes count as spaces: JSON in a text.
std::vector<LogToken> tokens_of(std::string_view line);

/// A word before a vector, or a whole number.
struct LogWord {
    std::string text{}, name{};  ///< as written, and in lower case
    bool ends_phrase = false,
         names = false;  ///< a comma or a closing bracket follows; a colon or an equals sign

    bool is_number() const { return is_digit(text[0]) && text.find_first_not_of("0123456789") == text.npos; }
};

/// Three or four numbers, and what stands before them.
struct LogVector {
    std::vector<LogWord> words{};  ///< the last is next to the numbers
    std::vector<double> numbers{};
    bool first = false;   ///< of its line
    bool matrix = false;  ///< of which this is the position
    std::string kind{}, label{}, phrase{};
    Meaning meaning = Meaning::Joint;
    bool is_position = true;

    bool is_joint() const { return is_position && meaning == Meaning::Joint && numbers.size() == 3; }
};

/// (1, 2, 3), X=1 Y=2 Z=3, 1.0 2.0 3.0 behind a name, poses, and the positions of matrices. The engine of the
/// trace is set where the way of writing shows it.
std::vector<LogVector> vectors_in(std::string_view line, RawTrace& trace);

}  // namespace tendril::app
