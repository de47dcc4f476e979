#include "tests/app/golden/golden.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <set>
#include <sstream>

#include "app/io/text.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace fs = std::filesystem;

fs::path golden_folder() {
    return source_path("tests/app/golden");
}

std::vector<fs::path> golden_scripts() {
    std::vector<fs::path> scripts;
    for (const auto& entry : fs::directory_iterator(golden_folder())) {
        if (entry.path().extension() == ".jsonl") scripts.push_back(entry.path());
    }
    std::sort(scripts.begin(), scripts.end());
    return scripts;
}

fs::path output_folder() {
    const char* const wanted = std::getenv("TENDRIL_TEST_OUTPUT");
    return wanted != nullptr && *wanted != '\0' ? fs::path(wanted) : fs::path(source_path("tests/output"));
}

namespace {

/// Golden pictures have 64 levels per channel, which halves the files: a level may be off by two of 255, and
/// by one more with another rasteriser.
constexpr int rounding = 3;

/// The picture, with every level that differs only by rounding replaced by the golden one.
app::Image rounded_as(const app::Image& golden, app::Image actual) {
    if (actual.size != golden.size) return actual;
    for (std::size_t i = 0; i < actual.rgba.size(); ++i)
        if (std::abs(actual.rgba[i] - golden.rgba[i]) <= rounding) actual.rgba[i] = golden.rgba[i];
    return actual;
}

const std::set<std::string> whole_windows{"opening",      "opening_rope",      "opening_signal",
                                          "opening_rig",  "opening_humanoid",  "settings",
                                          "text_scale_2", "palette_arguments", "small_1024x640"};

/// The part from `min` to `max` at half the size: each pixel is the mean of four.
app::Image half_size(const app::Image& image, glm::ivec2 min, glm::ivec2 max) {
    app::Image half{(max - min) / 2, {}};
    const auto row = 4 * static_cast<std::size_t>(image.size.x);
    for (int y = 0; y < half.size.y; ++y)
        for (int x = 0; x < half.size.x; ++x) {
            const std::uint8_t* const first = image.rgba.data() +
                                              static_cast<std::size_t>(min.y + 2 * y) * row +
                                              4 * static_cast<std::size_t>(min.x + 2 * x);
            for (std::size_t channel = 0; channel < 4; ++channel) {
                const int sum =
                    first[channel] + first[channel + 4] + first[channel + row] + first[channel + row + 4];
                half.rgba.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
            }
        }
    return half;
}

}  // namespace

app::Image golden_part(const std::string& name, const app::Image& window, const app::Json& state) {
    if (whole_windows.contains(name)) return window;
    glm::vec2 min(window.size), max(0.0f);
    for (const auto& [part, rect] : state.at("layout").items()) {
        const glm::vec2 from(rect["min"][0].get<float>(), rect["min"][1].get<float>());
        const glm::vec2 to(rect["max"][0].get<float>(), rect["max"][1].get<float>());
        if (from.x >= to.x || from.y >= to.y) continue;
        min = glm::min(min, from), max = glm::max(max, to);
    }
    return half_size(window, glm::ivec2(glm::ceil(min)), glm::ivec2(glm::floor(max)));
}

std::string panel_texts(const FrameRecord& frame) {
    std::string lines;
    for (const DrawnText& each : frame.texts) {
        if (each.window == nullptr) continue;  // text on the scene: in the picture
        if (each.text == "Debug") continue;    // title of Dear ImGui's own window, which is never shown
        const app::Rect& box = each.box;
        const bool seen = box.max.x > each.clip.min.x && box.max.y > each.clip.min.y &&
                          box.min.x < each.clip.max.x && box.min.y < each.clip.max.y;
        if (!seen) continue;
        for (const float place : {box.min.x, box.min.y}) lines += std::to_string(std::lround(place)) + ' ';
        lines += app::printable(each.text) + '\n';
    }
    return lines;
}

std::multiset<std::string> without_places(const std::string& panel_texts) {
    std::multiset<std::string> texts;
    std::istringstream in(panel_texts);
    for (std::string x, y, text; in >> x >> y && std::getline(in, text);) texts.insert(text);
    return texts;
}

Difference compare_with_golden(const app::Image& golden, const app::Image& actual) {
    Tolerance tolerance;
    if (!places_are_those_of_goldens) tolerance.max_pixels = golden.size.x * golden.size.y / 100;
    return compare(golden, rounded_as(golden, actual), tolerance);
}

testing::AssertionResult looks_like(const app::Image& actual, const fs::path& golden,
                                    const std::string& name) {
    if (!fs::exists(golden))
        return testing::AssertionFailure() << golden << " is missing; tests/app/golden/renew draws it";
    const app::Image expected = app::read_png(golden);
    const Difference difference = compare_with_golden(expected, actual);
    if (difference.same) return testing::AssertionSuccess();

    const fs::path folder = output_folder();
    fs::create_directories(folder);
    const fs::path actual_path = folder / (name + ".actual.png");
    const fs::path difference_path = folder / (name + ".difference.png");
    app::write_png(actual_path, actual);
    app::write_png(difference_path, difference.picture);
    auto failure = testing::AssertionFailure();
    failure << "expected " << golden.filename();
    if (expected.size != actual.size) {
        failure << ", " << expected.size.x << "x" << expected.size.y << ", found " << actual.size.x << "x"
                << actual.size.y;
    } else {
        failure << ": " << difference.text();
    }
    return failure << "\nsee " << actual_path << "\nand " << difference_path
                   << "\nIf it is meant to look so, tests/app/golden/renew.";
}

Renewal wanted_renewal() {
    const char* const text = std::getenv("TENDRIL_RENEW_GOLDENS");
    const std::string wanted = text != nullptr ? text : "";
    if (wanted.empty() || wanted == "0") return Renewal::None;
    return wanted == "all" ? Renewal::All : Renewal::Failing;
}

void renew_golden(const fs::path& golden, const app::Image& actual) {
    app::Image few_colours = actual;
    for (std::uint8_t& level : few_colours.rgba) {
        const int step = (level * 63 + 127) / 255;
        level = static_cast<std::uint8_t>((step * 255 + 31) / 63);
    }
    app::write_png(golden, few_colours);
}

}  // namespace tendril::test
