#include "app/document/settings.hpp"
#include "app/document/json_complete.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <random>

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

}  // namespace
}  // namespace tendril::app
