// A small vocabulary for scripts, and random events.
#pragma once

#include <random>

#include "app/script/script.hpp"

namespace tendril::test {

/// Parses lines with the commands chain.add, chain.mode and undo, which do nothing.
app::Script parse(std::string_view text);

/// Any event that is recorded as a line, with any value that the window could produce.
inline app::Event random_event(std::mt19937& random) {
    using namespace app;
    const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
    const auto coin = [&] { return below(2) == 0; };
    const auto number = [&] { return std::uniform_real_distribution<float>(-20000.0f, 20000.0f)(random); };
    const auto key = [&] { return static_cast<Key>(1 + below(static_cast<int>(Key::Count) - 1)); };
    const auto text = [&] {
        std::string made;
        constexpr const char* letters[] = {"a", "\"", "\\",  "\n", "\xC3\xA4", "\xF0\x9F\x8E\xA8",
                                           " ", "[",  "\x01"};
        for (int length = below(6); length > 0; --length) made += letters[below(9)];
        return made;
    };
    switch (below(9)) {
        case 0:
            return MouseMove{{number(), number()}};
        case 1:
            return MousePress{static_cast<MouseButton>(below(3)), coin()};
        case 2:
            return MouseWheel{number(), coin() ? number() : 0.0f};
        case 3:
            return KeyChange{key(), coin()};
        case 4:
            return KeyTap{{key(), coin(), coin(), coin()}};
        case 5:
            return TextInput{text()};
        case 6:
            return Resize{{1 + below(max_window_side), 1 + below(max_window_side)}};
        case 7: {
            Drop drop;
            for (int paths = 1 + below(3); paths > 0; --paths) drop.paths.push_back(text());
            return drop;
        }
        default:
            return Focus{coin()};
    }
}

}  // namespace tendril::test
