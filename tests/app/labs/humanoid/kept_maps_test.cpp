// Bone maps corrected by the user: stored for a character's node names, offered again, never applied unasked.
#include "app/io/character/map_file.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"
#include "tests/app/support/temp_folder.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;

class HumanoidKeptMaps : public HumanoidTest {
  protected:
    HumanoidKeptMaps() {
        workspace.config = config_.path();
        test::write(config_ / "figure.bvh", bvh_figure());
    }
    void load() { run("humanoid.load", {{"path", (config_ / "figure.bvh").string()}}); }
    Json kept() const { return state().at("character").at("kept_map"); }
    std::string left_hand() const { return bones().at("LeftHand").at("node"); }
    fs::path file() const { return kept_map(config_.path(), part().skeleton()); }
    void correct() { run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand end"}}); }

    test::TempFolder config_;
};

TEST_F(HumanoidKeptMaps, AreOfferedForTheSameNamesAndAppliedOnRequest) {
    load();
    correct();
    EXPECT_FALSE(fs::exists(file())) << "nothing is written without being told";
    run("humanoid.map.keep");
    EXPECT_TRUE(fs::exists(file()));
    EXPECT_TRUE(kept().is_null()) << "it is in use";
    load();
    EXPECT_EQ(left_hand(), "LeftHand") << "it is not taken unasked";
    EXPECT_EQ(kept(), Json({{"changes", {{"LeftHand", "LeftHand end"}}}}));
    run("humanoid.load");
    EXPECT_TRUE(kept().is_null()) << "the stick figure has other names";
    load();
    run("humanoid.map.use");
    EXPECT_EQ(left_hand(), "LeftHand end");
    EXPECT_TRUE(kept().is_null());
    run("undo");
    EXPECT_EQ(left_hand(), "LeftHand");
    EXPECT_FALSE(kept().is_null());
    run("humanoid.map.forget");
    EXPECT_TRUE(kept().is_null());
    EXPECT_FALSE(fs::exists(file()));
    expect_refused("humanoid.map.use", {}, {"no map is kept"});
    expect_refused("humanoid.map.forget", {}, {"no map is kept"});
}

TEST_F(HumanoidKeptMaps, AreKeptAutomaticallyInAWindow) {
    workspace.keeps = true;
    load();
    EXPECT_FALSE(fs::exists(file())) << "nothing is corrected";
    correct();
    EXPECT_EQ(find_kept_map(config_.path(), part().skeleton()), saved_map(*part().map, part().skeleton()));
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", "LeftHand"}});
    EXPECT_FALSE(fs::exists(file())) << "it is as it was matched";
    // A read-only folder does not prevent the correction.
    test::write(config_ / "no folder", "");
    workspace.config = config_ / "no folder";
    correct();
    EXPECT_EQ(left_hand(), "LeftHand end");
    EXPECT_TRUE(test::has(workspace.ui.toasts.back().text, "The bone map is not kept: cannot write"));
}

TEST_F(HumanoidKeptMaps, InvalidOnesAreSkippedWithAMessage) {
    load();
    correct();
    run("humanoid.map.keep");
    const std::string good = test::read(file());
    SavedMap other = read_map(file());
    other.bones[3] = "nobody";
    for (const std::string& bad : {std::string("{"), std::string(9000, '['), std::string(), map_text(other),
                                   std::string("{\"tendril\": \"bone map\", \"version\": 2}")}) {
        test::write(file(), bad);
        load();
        EXPECT_EQ(left_hand(), "LeftHand");
        EXPECT_TRUE(test::has(kept().at("refused").get<std::string>(), "the kept bone map is ignored: "));
        EXPECT_EQ(workspace.ui.toasts.back().text, kept().at("refused"));
        expect_refused("humanoid.map.use", {}, {"is ignored"});
    }
    test::write(file(), good);
    load();
    EXPECT_TRUE(kept().contains("changes"));
    workspace.config.clear();
    EXPECT_TRUE(kept().is_null());
    expect_refused("humanoid.map.keep", {}, {"no folder"});
}

}  // namespace
}  // namespace tendril::app
