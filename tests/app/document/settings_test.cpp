#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "app/document/atomic_file.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/settings.hpp"
#include "app/document/units.hpp"
#include "tests/app/support/temp_folder.hpp"

namespace tendril::app {
namespace {

using test::has;

Settings load(const std::string& text, std::vector<std::string>& complaints) {
    return load_settings(parse_json(text), complaints);
}

TEST(Settings, ComeBackAsTheyWereSaved) {
    std::mt19937 random(6);
    const auto coin = [&] { return random() % 2 == 0; };
    std::uniform_real_distribution<float> scale(0.5f, 3.0f), width(180.0f, 520.0f);
    for (int i = 0; i < 200; ++i) {
        const Settings settings{.theme = coin() ? Theme::Dark : Theme::Light,
                                .labels = coin() ? LabelMode::Hover : LabelMode::Always,
                                .text_scale = scale(random),
                                .left_open = coin(),
                                .right_open = coin(),
                                .left_width = width(random),
                                .right_width = width(random),
                                .hint_seen = coin(),
                                .choices = coin() ? std::map<std::string, std::string>{{"segments", "bones"}}
                                                  : std::map<std::string, std::string>{}};
        std::vector<std::string> complaints;
        EXPECT_TRUE(load(json_to_text(save_settings(settings)), complaints) == settings);
        EXPECT_TRUE(complaints.empty());
    }
}

TEST(Settings, AreSavedByName) {
    const Json json = save_settings(Settings{.theme = Theme::Light, .choices = {{"segments", "bones"}}});
    EXPECT_EQ(json["theme"], "light");
    EXPECT_EQ(json["segments"], "bones");
    EXPECT_EQ(json["labels"], "hover");
}

TEST(Settings, InvalidValuesKeepTheirDefaultsAndAreNamed) {
    const std::vector<std::pair<std::string, std::string>> bad{
        {R"({"theme": "purple"})", "theme: unknown value \"purple\""},
        {R"({"theme": 1})", "theme: unknown value 1"},
        {R"({"text_scale": 0.4})", "text_scale: expected a number from 0.5 to 3, found 0.4"},
        {R"({"text_scale": "1"})", "text_scale: expected a number"},
        {R"({"left_width": 521})", "left_width: expected a number from 180 to 520, found 521"},
        {R"({"right_width": -1e308})", "right_width: "},
        {R"({"left_open": 1})", "left_open: expected true or false, found 1"},
        {R"({"hint_seen": {}})", "hint_seen: "},
    };
    for (const auto& [text, complaint] : bad) {
        std::vector<std::string> complaints;
        EXPECT_TRUE(load(text, complaints) == Settings{}) << text;
        ASSERT_EQ(complaints.size(), 1u) << text;
        EXPECT_TRUE(has(complaints[0], complaint));
    }
}

TEST(Settings, OthersAreReadBesideABadOneAndUnknownOnesIgnored) {
    std::vector<std::string> complaints;
    const Settings settings =
        load(R"({"theme": 3, "from_the_future": [1], "segments": null, "text_scale": 2, "hint_seen": true})",
             complaints);
    EXPECT_TRUE(settings == (Settings{.text_scale = 2.0f, .hint_seen = true}));
    EXPECT_EQ(complaints.size(), 1u);
}

TEST(Settings, MayContainAnything) {
    for (const char* text : {"null", "[]", "3", "\"text\"", "true"}) {
        std::vector<std::string> complaints;
        EXPECT_TRUE(load(text, complaints) == Settings{});
        EXPECT_EQ(complaints.size(), 1u) << text;
    }
    std::vector<std::string> complaints;
    EXPECT_TRUE(load("{}", complaints) == Settings{});
    EXPECT_TRUE(complaints.empty());
}

class Environment {
  public:
    explicit Environment(const char* name) : name_(name) {
        if (const char* value = ::getenv(name)) old_ = value, had_ = true;
    }
    ~Environment() { had_ ? ::setenv(name_, old_.c_str(), 1) : ::unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    const char* name_;
    std::string old_;
    bool had_ = false;
};

TEST(Settings, LiveInTheConfigFolder) {
    const Environment xdg("XDG_CONFIG_HOME"), home("HOME");
    ::setenv("XDG_CONFIG_HOME", "/config", 1);
    ::setenv("HOME", "/home/somebody", 1);
    EXPECT_EQ(config_folder(), "/config/tendril");
    ::setenv("XDG_CONFIG_HOME", "relative", 1);
    EXPECT_EQ(config_folder(), "/home/somebody/.config/tendril");
    ::unsetenv("XDG_CONFIG_HOME");
    EXPECT_EQ(config_folder(), "/home/somebody/.config/tendril");
    ::setenv("HOME", "", 1);
    EXPECT_EQ(config_folder(), "");
}

// Paths of files in toasts.

class ShownPath : public testing::Test {
  protected:
    ShownPath() { ::setenv("HOME", "/home/ada", 1); }

  private:
    const Environment home_{"HOME"};
};

TEST_F(ShownPath, IsWholeAndShortUnderHome) {
    EXPECT_EQ(shown_path("/srv/films/a.mp4"), "/srv/films/a.mp4");
    EXPECT_EQ(shown_path("/home/ada/pictures/a.png"), "~/pictures/a.png");
    EXPECT_EQ(shown_path("/home/adam/a.png"), "/home/adam/a.png");
    EXPECT_EQ(shown_path("a.png"), shown_path(std::filesystem::current_path() / "a.png"));
    EXPECT_EQ(shown_path("/srv/x/../a.png"), "/srv/a.png");
    EXPECT_EQ(written_text("/home/ada/a.png"), "Written: ~/a.png");
}

TEST_F(ShownPath, OmitsTheMiddleOfALongPath) {
    std::string deep = "/srv";
    for (int i = 0; i < 30; ++i) deep += "/folder" + std::to_string(i);
    const std::string shown = shown_path(deep + "/tendril-1.png");
    EXPECT_LE(shown.size(), longest_shown_path);
    EXPECT_EQ(shown.rfind("/srv/.../", 0), 0u) << shown;
    EXPECT_TRUE(shown.ends_with("/folder29/tendril-1.png")) << shown;
    const std::string name(150, 'x');
    EXPECT_TRUE(shown_path("/srv/" + name).ends_with(name)) << "the name is whole";
}

TEST(Units, LengthsOfAMetreAndMoreAreInMetres) {
    EXPECT_EQ(length_text(0.0123), "12.3 mm");
    EXPECT_EQ(length_text(38.0301), "38.03 m");
    EXPECT_EQ(length_text(-0.0), "0.0 mm");
}

struct Shown {
    double value;
    const char *unit, *text;
};

TEST(Units, ThreeDigitsAndAPrefixWithoutExponentOrNegativeZero) {
    for (const auto& [value, unit, text] :
         {Shown{2.3, "m", "2.30 m"}, Shown{0.231, "m", "231 mm"}, Shown{4.1e-6, "s", "4.10 \xc2\xb5s"},
          Shown{1.2e-7, "m", "120 nm"}, Shown{-0.0123, "m", "-12.3 mm"}, Shown{1234.0, "m", "1.23 km"},
          Shown{1e9, "m", "1.00 Gm"},
          // A number that rounds up takes the next prefix.
          Shown{0.99949, "m", "999 mm"}, Shown{0.9996, "m", "1.00 m"}, Shown{999.6, "m", "1.00 km"},
          Shown{9.996, "m", "10.0 m"}, Shown{0.0, "m", "0 m"}, Shown{-0.0, "m", "0 m"},
          Shown{std::nan(""), "m", "-"}, Shown{std::numeric_limits<double>::infinity(), "m", "-"}})
        EXPECT_EQ(si_text(value, unit), text);
    for (double value = 1e-12; value < 1e11; value *= 1.7)
        EXPECT_EQ(si_text(value, "m").find('e'), std::string::npos) << value;
}

TEST(Units, AFixedNumberHasItsDecimalsAndNoSignedZero) {
    EXPECT_EQ(fixed_text(1.005, 1), "1.0");
    EXPECT_EQ(fixed_text(-0.04, 1), "0.0");
    EXPECT_EQ(fixed_text(-0.06, 1), "-0.1");
    EXPECT_EQ(fixed_text(-0.0, 0), "0");
    EXPECT_EQ(without_signed_zero("-0.00 m"), "0.00 m");
    EXPECT_EQ(without_signed_zero("-0.01 m"), "-0.01 m");
    EXPECT_EQ(without_signed_zero("-"), "-");
}

TEST(Units, AxisMarksAreShortWithoutExponent) {
    for (const auto& [value, unit, text] :
         {Shown{2.0, "s", "2 s"}, Shown{1e-3, "m", "1 mm"}, Shown{1.5e-7, "m", "150 nm"},
          Shown{1e-4, "%", "0.0001 %"}, Shown{12.345, "%", "12.3 %"}, Shown{120.0, "", "120"},
          Shown{-0.0, "", "0"}})
        EXPECT_EQ(short_text(value, unit), text);
    for (const char* unit : {"m", "%", ""})
        for (double value = 1e-7; value < 1e9; value *= 1.7)
            EXPECT_EQ(short_text(value, unit).find("e"), std::string::npos) << value;
}

TEST(Units, PluralsAgree) {
    EXPECT_EQ(count_text(0, "joint"), "0 joints");
    EXPECT_EQ(count_text(1, "command"), "1 command");
    EXPECT_EQ(count_text(7, "bone"), "7 bones");
}

}  // namespace
}  // namespace tendril::app
