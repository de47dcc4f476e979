// Compares the pictures with the golden ones, by the backends that need no display (EGL in .ci/nightly).
#include "tests/app/golden/golden.hpp"

#include <map>

#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

namespace fs = std::filesystem;

/// Why a backend is unavailable; empty if it is available.
std::string missing(const std::string& backend) {
    static std::map<std::string, std::string> known;
    const auto [found, is_new] = known.try_emplace(backend);
    if (is_new) {
        const Outcome outcome = run_here({"--headless", "--backend", backend, "--frames", "0"});
        found->second = outcome.exit_code == 0 ? "" : outcome.err;
    }
    return found->second;
}

struct Drawn {
    app::Image picture;
    std::string panels;
};

Drawn draw(const fs::path& script, const std::string& backend) {
    const FrameRecorder recorder;
    const TempFolder folder;
    const fs::path picture = folder / "picture.png", state = folder / "state.json";
    // Files that the script names are beside it.
    const Outcome outcome = run_here({"--headless", "--backend", backend, "--script", script.string(),
                                      "--screenshot", picture.string(), "--state", state.string()},
                                     script.parent_path());
    // Refusals that a script expects are still reported.
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    if (outcome.exit_code != 0) return {};
    return {golden_part(script.stem().string(), app::read_png(picture), app::parse_json(read(state))),
            panel_texts(recorder.frame())};
}

class Golden : public testing::TestWithParam<fs::path> {
  protected:
    fs::path picture() const { return fs::path(GetParam()).replace_extension(".png"); }
    std::string name() const { return GetParam().stem().string(); }
};

LABEL(pictures, "*/Golden.*");
LABEL(nightly, "*/Golden.EglDraws/*");

TEST_P(Golden, OsmesaDraws) {
    if (const std::string why = missing("osmesa"); !why.empty()) GTEST_SKIP() << why;
    const Drawn actual = draw(GetParam(), "osmesa");
    ASSERT_FALSE(actual.picture.rgba.empty()) << GetParam() << " did not lead where it should";
    const fs::path texts = fs::path(GetParam()).replace_extension(".txt");
    const Renewal renewal = wanted_renewal();
    const bool keep = renewal == Renewal::Failing && fs::exists(picture()) &&
                      compare_with_golden(app::read_png(picture()), actual.picture).same;
    if (renewal != Renewal::None && !keep) renew_golden(picture(), actual.picture);
    if (renewal != Renewal::None) write(texts, actual.panels);
    EXPECT_TRUE(looks_like(actual.picture, picture(), name() + ".osmesa"));
    if (places_are_those_of_goldens)
        EXPECT_EQ(read(texts), actual.panels) << "the panels' texts; tests/app/golden/renew";
    else
        EXPECT_EQ(without_places(read(texts)), without_places(actual.panels));
}

TEST_P(Golden, EglDraws) {
    if (const std::string why = missing("egl"); !why.empty()) GTEST_SKIP() << why;
    if (wanted_renewal() != Renewal::None) GTEST_SKIP() << "OSMesa draws the golden pictures";
    EXPECT_TRUE(looks_like(draw(GetParam(), "egl").picture, picture(), name() + ".egl"));
}

INSTANTIATE_TEST_SUITE_P(Pictures, Golden, testing::ValuesIn(golden_scripts()),
                         [](const auto& script) { return script.param.stem().string(); });

TEST(GoldenPictures, OneOfTheBackendsDraws) {
    EXPECT_TRUE(missing("osmesa").empty() || missing("egl").empty());
}

TEST(GoldenPictures, NoneLacksItsScript) {
    for (const auto& entry : fs::directory_iterator(golden_folder())) {
        if (entry.path().extension() != ".png") continue;
        EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".jsonl"))) << entry.path();
    }
}

TEST(GoldenPictures, ShowDifferentThings) {
    std::vector<app::Image> pictures;
    const auto scripts = golden_scripts();
    ASSERT_GE(scripts.size(), 16u);
    for (const fs::path& script : scripts) {
        app::Image picture = app::read_png(fs::path(script).replace_extension(".png"));
        for (std::size_t i = 0; i < pictures.size(); ++i)
            EXPECT_FALSE(picture.rgba == pictures[i].rgba) << script.stem() << " and " << scripts[i].stem();
        pictures.push_back(std::move(picture));
    }
}

}  // namespace
}  // namespace tendril::test
