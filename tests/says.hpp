// Checks that a message names the field, the value and the range, without fixing its wording.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <sstream>
#include <string>
#include <string_view>

namespace tendril::test {

/// Whether `word` is a whole word at `at`: "1" is not in "-1", "10", "1.5" or "joint1".
inline bool stands_whole(std::string_view message, std::string_view word, std::size_t at) {
    const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const std::string_view digits = word.substr(word.front() == '-' ? 1 : 0);
    const bool number = !digits.empty() && std::isdigit(static_cast<unsigned char>(digits.front())) != 0;
    const std::string_view after = message.substr(at + word.size());
    if (at > 0 && in_word(word.front()) && in_word(message[at - 1])) return false;
    if (at > 0 && number && word.front() != '-' && (message[at - 1] == '-' || message[at - 1] == '.'))
        return false;
    if (after.empty() || !in_word(word.back())) return true;
    return !in_word(after[0]) && !(number && after.size() > 1 && after[0] == '.' && in_word(after[1]));
}

/// `message` contains the words of `names` in this order, each as a whole word, with anything in between:
///   EXPECT_TRUE(says(refused("rope.pin", ...), "rope.pin particle 0 99999 -1"));
inline testing::AssertionResult says(const std::string& message, const std::string& names) {
    std::istringstream words(names);
    std::size_t from = 0;
    std::size_t count = 0;
    for (std::string word; words >> word; ++count) {
        std::size_t at = message.find(word, from);
        while (at != message.npos && !stands_whole(message, word, at)) at = message.find(word, at + 1);
        if (at == message.npos)
            return testing::AssertionFailure()
                   << "\"" << message << "\"\n  does not say " << word
                   << (count > 0 ? " after what comes before it in " : " of ") << "\"" << names << "\"";
        from = at + word.size();
    }
    return count > 0 ? testing::AssertionSuccess() : testing::AssertionFailure() << "names nothing";
}

}  // namespace tendril::test
