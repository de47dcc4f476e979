#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "app/document/settings.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/outputs.hpp"
#include "app/io/text.hpp"
#include "app/system/atomic_file.hpp"
#include "app/system/environment.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

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

namespace fs = std::filesystem;
using test::message_of;
using test::TempFolder;

struct Sample {
    OutputKind kind;
    std::string bytes;
};

std::vector<Sample> samples() {
    const std::string png = "\x89PNG\r\n\x1a\n", header = std::string(25, '0') + "0000";
    return {{OutputKind::Scene, R"({"tendril_scene": 2, "labs": {"chain": {"handles": 1, "layout": 2}}})"},
            {OutputKind::Recording, R"({"recording":1,"scene":{"tendril_scene":2}})"},
            {OutputKind::State, "{\"mode\": \"reach\",\n \"handles\": \"" + std::string(300'000, '1') +
                                    "\",\n \"layout\": {\"strip\": {}}}"},
            {OutputKind::Picture, png + header + "IDAT"},
            {OutputKind::Video, png + header + "sRGB0acTL"},
            {OutputKind::Video, std::string("\0\0\0\x20", 4) + "ftypisom"},
            {OutputKind::Motion, "glTF binary"},
            {OutputKind::Motion, "{\n  \"asset\": {\"version\": \"2.0\"}}"},
            {OutputKind::Motion, "HIERARCHY\nROOT Hips\n"},
            {OutputKind::BoneMap, R"({"tendril": "bone map", "version": 1})"},
            {OutputKind::Csv, "tick,error\n0,1\n"},
            {OutputKind::Trace, "{\"tendril\":\"trace\",\"up\":\"y\"}\n{\"joints\":[]}\n"}};
}

std::string refusal(Outputs outputs, const fs::path& path, OutputKind kind, bool redraws = false) {
    return message_of([&] { outputs.check({path}, kind, redraws); });
}

/// Every kind over every kind: the same kind needs --force, another kind is refused even with it.
TEST(Outputs, ReplaceOnlyTheirOwnKind) {
    const TempFolder folder;
    const fs::path file = folder / "file.any";
    std::vector<Sample> there = samples();
    for (const char* other :
         {"Dear diary", "\xff\xd8\xff\xe0 JPEG", "{}", "[1, 2]", "{\"command\": \"undo\"}\n"})
        there.push_back({OutputKind{-1}, other});
    for (const Sample& old : there) {
        test::write(file, old.bytes);
        for (const Sample& fresh : samples()) {
            const bool own = old.kind == fresh.kind;
            const std::string why = refusal({}, file, fresh.kind);
            EXPECT_TRUE(test::says(why, own ? "already exists --force" : "is not replaced it is not"))
                << why << ": " << old.bytes.substr(0, 30) << " by " << fresh.bytes.substr(0, 30);
            Outputs outputs;
            outputs.force = true;
            EXPECT_EQ(refusal(outputs, file, fresh.kind).empty(), own);
            EXPECT_EQ(refusal({}, file, fresh.kind, true).empty(), own);
        }
    }
}

TEST(Outputs, AreNeverInputsByAnyName) {
    const TempFolder folder;
    test::write(folder / "walk.glb", "glTF");
    fs::create_directories(folder / "sub/a b");
    for (const char* name : {"skin.png", "sub/a b/\xC3\xA4.png", "sub/in_binary.png", "other.png"})
        test::write(folder / name, samples()[3].bytes);
    test::write(folder / "hero.gltf", R"({"asset": {}, "buffers": [{"uri": "data:,other.png"}],
        "images": [{"name": "other.png", "uri": "skin.png"}, {"uri": "sub/a%20b/%C3%a4.png"}, {"uri": 7}]})");
    const std::string json = R"({"images": [{"uri": "sub\\in_binary.png"}]})";
    test::write(folder / "hero.vrm", "glTF" + std::string(8, '\2') + static_cast<char>(json.size()) +
                                         std::string(3, '\0') + "JSON" + json + std::string(9, '\1'));
    fs::create_symlink(folder / "walk.glb", folder / "symbolic.glb");
    fs::create_hard_link(folder / "walk.glb", folder / "hard.glb");
    Outputs outputs;
    outputs.force = true;
    outputs.inputs = {folder / "walk.glb"};
    outputs.in_use = {folder / "hero.gltf", folder / "hero.vrm"};
    for (const char* name : {"walk.glb", "sub/../walk.glb", "symbolic.glb", "hard.glb", "hero.gltf"})
        EXPECT_TRUE(test::says(refusal(outputs, folder / name, OutputKind::Motion), "in use as input"))
            << name;
    for (const char* name : {"skin.png", "sub/a b/\xC3\xA4.png", "sub/in_binary.png"})
        EXPECT_TRUE(test::says(refusal(outputs, folder / name, OutputKind::Picture, true), "in use as input"))
            << name;
    EXPECT_EQ(refusal(outputs, folder / "other.png", OutputKind::Picture, true), "");
    EXPECT_EQ(refusal(outputs, folder / "new.glb", OutputKind::Motion), "");
}

TEST(Outputs, AreReplacedUnaskedIfOnlyThisSessionWroteThem) {
    const TempFolder folder;
    const fs::path file = folder / "a.csv";
    Outputs outputs;
    const auto write = [&](const std::string& bytes) {
        return message_of([&] { outputs.write(file, OutputKind::Csv, bytes); });
    };
    for (const char* bytes : {"a,b\n1,2\n", "a,b\n3,4\n"}) EXPECT_EQ(write(bytes), "");
    test::write(file, "another,program\n");
    EXPECT_TRUE(test::says(write("a,b\n"), "was changed by another program"));
    EXPECT_EQ(test::read(file), "another,program\n");
    EXPECT_EQ(write("another,program\n"), "") << "it holds that already";
    test::write(file, "another,again\n");
    outputs.in_window = true;
    EXPECT_TRUE(test::says(write("a,b\n"), "Do the same again to replace it"));
    EXPECT_EQ(write("a,b\n"), "");
    EXPECT_EQ(test::read(file), "a,b\n");
    test::write(file, "");
    EXPECT_EQ(write("a,b\n"), "") << "an empty file has nothing to lose";
}

/// Long work is not lost if another program has written the file in the meantime.
TEST(Outputs, TakeAnotherNameAtTheEndOfLongWork) {
    const TempFolder folder;
    Outputs outputs;
    const auto place = [&] { return outputs.place_at_end(folder / "a.mp4", OutputKind::Video); };
    EXPECT_EQ(place().path, folder / "a.mp4");
    test::write(folder / "a.mp4", "Dear diary");
    test::write(folder / "a-1.mp4", "");
    EXPECT_EQ(place().path, folder / "a-2.mp4");
    EXPECT_TRUE(test::says(place().refusal, "a.mp4 is not replaced it is not a video"));
}

TEST(Outputs, AreAskedAboutTogether) {
    const TempFolder folder;
    std::vector<fs::path> files;
    for (const char* name : {"a.bvh", "b.bvh", "c.bvh", "new.bvh"}) files.push_back(folder / name);
    for (std::size_t i = 0; i < 3; ++i) test::write(files[i], "HIERARCHY");
    Outputs outputs;
    const auto check = [&] { return message_of([&] { outputs.check(files, OutputKind::Motion); }); };
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(test::says(check(), "a.bvh and 2 more already exist --force"));
    outputs.in_window = true;
    test::write(files[1], "HIERARCHY again");
    EXPECT_TRUE(test::says(check(), "again to replace it")) << "it has changed since";
    EXPECT_EQ(check(), "");
}

}  // namespace
}  // namespace tendril::app
