// Keys and chords keep their names.
#include "app/window/keys.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace tendril::app {
namespace {

TEST(Keys, EveryKeyHasItsOwnNameAndIsFoundByIt) {
    std::set<std::string> seen;
    for (int i = 1; i < static_cast<int>(Key::Count); ++i) {
        const auto key = static_cast<Key>(i);
        const std::string name(key_name(key));
        EXPECT_FALSE(name.empty()) << i;
        EXPECT_TRUE(seen.insert(name).second) << name;
        EXPECT_EQ(key_from_name(name), key) << name;
    }
    EXPECT_EQ(key_name(Key::Unknown), "");
    EXPECT_EQ(key_name(Key::Count), "");
}

TEST(Keys, NamesAreReadInAnyCase) {
    EXPECT_EQ(key_from_name("Page_Up"), Key::PageUp);
    EXPECT_EQ(key_from_name("ESCAPE"), Key::Escape);
    EXPECT_EQ(key_from_name("."), Key::Period);
    EXPECT_EQ(key_from_name("7"), Key::Num7);
    EXPECT_FALSE(key_from_name("hyper"));
    EXPECT_FALSE(key_from_name(""));
}

TEST(Keys, EveryChordSurvivesItsName) {
    for (int i = 1; i < static_cast<int>(Key::Count); ++i) {
        for (int modifiers = 0; modifiers < 8; ++modifiers) {
            const Chord chord{static_cast<Key>(i), (modifiers & 1) != 0, (modifiers & 2) != 0,
                              (modifiers & 4) != 0};
            EXPECT_EQ(chord_from_name(chord_name(chord)), chord) << chord_name(chord);
        }
    }
}

TEST(Keys, ChordsAreWrittenOneWayAndReadAnyWay) {
    const Chord redo{.key = Key::Z, .ctrl = true, .shift = true};
    EXPECT_EQ(chord_name(redo), "ctrl+shift+z");
    EXPECT_EQ(chord_label(redo), "Ctrl+Shift+Z");
    EXPECT_EQ(chord_from_name("Shift+CTRL+z"), redo);
    EXPECT_EQ(chord_from_name("ctrl"), (Chord{.key = Key::Ctrl}));
    for (const char* bad : {"", "+", "ctrl+", "+z", "ctrl+ctrl+z", "z+ctrl", "ctrl + z", "super+z"}) {
        EXPECT_FALSE(chord_from_name(bad)) << bad;
    }
}

}  // namespace
}  // namespace tendril::app
