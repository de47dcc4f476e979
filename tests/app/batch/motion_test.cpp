// `tendril lint` and `tendril bake`: the built program with valid and invalid files.
#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/stick_figure.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

namespace fs = std::filesystem;

using app::Json;
using Strings = std::vector<std::string>;

class MotionProgram : public testing::Test {
  protected:
    Outcome run(const Strings& arguments) const {
        return run_program(arguments, {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }
    /// The built-in figure and its walk.
    std::string figure(const char* name, bool flipped = false) const {
        const app::Character character = app::stick_figure();
        humanoid::Clip clip = character.clips[0];
        app::export_clip({character, {}, clip, clip, 60.0}, folder_ / name);
        if (flipped) flip_a_key(name);
        return path(name);
    }
    TempFolder folder_;

  private:
    /// Flips the sign bits of the right knee's key in frame 12.
    void flip_a_key(const char* name) const {
        std::string bytes = read(folder_ / name);
        const auto text = static_cast<std::size_t>(static_cast<unsigned char>(bytes[12])) +
                          256u * static_cast<unsigned char>(bytes[13]);
        const Json json = app::parse_json(bytes.substr(20, text));
        std::size_t sampler = 0;
        for (const Json& channel : json["animations"][0]["channels"])
            if (json["nodes"][channel["target"]["node"].get<std::size_t>()]["name"] == "RightLowerLeg")
                sampler = channel["sampler"].get<std::size_t>();
        const Json& output = json["animations"][0]["samplers"][sampler]["output"];
        const Json& accessor = json["accessors"][output.get<std::size_t>()];
        const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::size_t at = 28 + text + view["byteOffset"].get<std::size_t>() + 12 * 16;
        for (std::size_t i = 0; i < 4; ++i)
            bytes[at + 4 * i + 3] = static_cast<char>(bytes[at + 4 * i + 3] ^ 0x80);
        write(folder_ / name, bytes);
    }
};

TEST_F(MotionProgram, LintPrintsWhatItFindsAndExitsWith1) {
    const std::string file = figure("flipped.glb", true);
    const Outcome lines = run({"lint", file});
    EXPECT_EQ(lines.exit_code, 1);
    EXPECT_TRUE(says(lines.out, "walk sign_flip 12 67 60 0.200 RightLowerLeg")) << lines.out;
    EXPECT_TRUE(says(lines.out, "1 finding 1 clip")) << lines.out;

    const Outcome outcome = run({"lint", file, "--json"});
    EXPECT_EQ(outcome.exit_code, 1);
    const Json json = app::parse_json(outcome.out);
    EXPECT_EQ(json["findings"], 1);
    const Json& clip = json["clips"].at(0);
    EXPECT_EQ(clip["name"], "walk");
    EXPECT_EQ(clip["frame_rate"], 60.0);
    EXPECT_EQ(clip["frames"], 67);
    const Json& finding = clip["findings"].at(0);
    EXPECT_EQ(finding["kind"], "sign_flip");
    EXPECT_EQ(finding["frame"], 12);
    EXPECT_NEAR(finding["time"].get<double>(), 0.2, 1e-6);
    EXPECT_EQ(finding["unit"], "deg");
    EXPECT_EQ(finding["cure"], true);
}

TEST_F(MotionProgram, PrintsWhatItGuessedAboutAFile) {
    // A BVH states no unit.
    const std::string file = figure("walk.bvh");
    EXPECT_TRUE(says(run({"lint", file}).out, "Note unit 0 findings"));
    const Outcome baked = run({"bake", file, "--out", path("out.glb")});
    EXPECT_TRUE(says(baked.out, "Note unit out.glb 67 frames"));
    const Json json = app::parse_json(run({"lint", file, "--json"}).out);
    ASSERT_EQ(json["notes"].size(), 1u);
    EXPECT_TRUE(says(json["notes"][0].get<std::string>(), "unit"));
    // A glTF file states both.
    EXPECT_EQ(run({"lint", figure("walk.glb")}).out, "0 findings in 1 clip\n");
    EXPECT_EQ(app::parse_json(run({"lint", path("walk.glb"), "--json"}).out)["notes"], Json::array());
}

TEST_F(MotionProgram, BakeWritesTheClipAndPrintsTheDifference) {
    const std::string file = figure("walk.glb");
    for (const char* ground : {"none", "flat", "slope", "stairs", "terrain"})
        for (const char* name : {"out.glb", "out.gltf", "out.bvh"}) {
            const Outcome outcome = run({"bake", file, "--ground", ground, "--out", path(name), "--force"});
            EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
            EXPECT_NE(outcome.out.find("67 frames at 60 fps; read back within "), std::string::npos)
                << outcome.out;
            EXPECT_NE(outcome.out.find("; feet skate "), std::string::npos) << outcome.out;
            const app::Character read = app::read_character(folder_ / name);
            EXPECT_NEAR(read.clips.at(0).duration, 1.1, 1e-6);
        }
    // On stairs, the figure climbs.
    run({"bake", file, "--ground", "stairs", "--out", path("up.bvh")});
    const app::Character up = app::read_character(folder_ / "up.bvh");
    const auto& hips = up.clips.at(0).channels.at(0).translation.values;
    EXPECT_GT(hips.back().y, hips.front().y + 0.2);
}

TEST_F(MotionProgram, BakeTakesAClipNameAndAFrameRateAndWritesBesideTheFile) {
    const std::string file = figure("walk.bvh");
    EXPECT_EQ(run({"bake", file, "--clip", "motion", "--fps", "30"}).exit_code, 0);
    EXPECT_NE(read(folder_ / "walk_baked.bvh").find("Frames: 34\n"), std::string::npos);
    const Outcome unknown = run({"bake", file, "--clip", "run"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_TRUE(says(unknown.err, "walk.bvh run motion"));
}

TEST_F(MotionProgram, BakeSaysWhichOfManyClipsItWroteAndWritesThemAll) {
    // The built-in figure's walk and punch, in one file.
    const app::Character character = app::stick_figure();
    humanoid::Clip walk = character.clips[0];
    app::export_clip({character, {}, walk, walk, 60.0}, folder_ / "two.gltf");
    Json json = app::parse_json(read(folder_ / "two.gltf"));
    json["animations"].push_back(json["animations"][0]);
    json["animations"][1]["name"] = "walk/2";
    write(folder_ / "two.gltf", json.dump());
    const Outcome one = run({"bake", path("two.gltf"), "--out", path("one.glb")});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_TRUE(says(one.out, "one.glb 1 of 2 clips: walk 67 frames")) << one.out;
    const Outcome all = run({"bake", path("two.gltf"), "--all", "--out", path("all.bvh")});
    EXPECT_EQ(all.exit_code, 0) << all.err;
    EXPECT_TRUE(says(all.out, "all_walk.bvh walk 67 frames all_walk_2.bvh walk/2 67 frames")) << all.out;
    EXPECT_NEAR(app::read_character(folder_ / "all_walk_2.bvh").clips.at(0).duration, 1.1, 1e-6);
    EXPECT_EQ(run({"bake", path("two.gltf"), "--all", "--clip", "walk"}).exit_code, 2);
}

TEST_F(MotionProgram, LintAndBakeTakeAnotherCharactersMotionAndPrintTheirGuesses) {
    // The figure's own walk, as a BVH has it: without a unit.
    const std::string body = figure("body.glb"), walk = figure("walk.bvh");
    const Outcome judged = run({"lint", body, "--motion", walk});
    EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
    EXPECT_TRUE(says(judged.out, "Note: walk.bvh hips scaled 1.00 unit 0 findings 1 clip")) << judged.out;
    const Json json = app::parse_json(run({"lint", body, "--motion", walk, "--json"}).out);
    EXPECT_EQ(json["clips"].at(0)["name"], "motion");
    EXPECT_TRUE(says(json["notes"].dump(), "hips scaled unit"));
    EXPECT_TRUE(says(run({"lint", walk}).out, "Note: unit 0 findings")) << "of a file alone, too";

    const Outcome baked = run(
        {"bake", body, "--motion", walk, "--clip", "motion", "--ground", "flat", "--out", path("out.glb")});
    EXPECT_EQ(baked.exit_code, 0) << baked.err;
    EXPECT_TRUE(says(baked.out, "Note: walk.bvh hips scaled unit out.glb: motion")) << baked.out;
    const app::Character written = app::read_character(path("out.glb"));
    ASSERT_EQ(written.clips.size(), 1u);
    EXPECT_EQ(written.clips[0].name, "motion");
    for (const std::string& input : {body, walk})
        EXPECT_TRUE(complained(run({"bake", body, "--motion", walk, "--force", "--out", input}), 2,
                               {"in use as input"}));
    const Outcome unknown = run({"bake", body, "--motion", walk, "--clip", "run"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_TRUE(says(unknown.err, "walk.bvh no clip run motion")) << unknown.err;
}

TEST_F(MotionProgram, APoseIsAMotionToo) {
    const std::string walk = figure("walk.bvh"), body = figure("body.glb");
    std::string text = read(folder_ / "walk.bvh");
    const std::size_t count = text.find("Frames: "), time = text.find("\nFrame Time"),
                      rows = text.find('\n', time + 1) + 1;
    const std::string row = text.substr(rows, text.find('\n', rows) + 1 - rows);
    for (const int frames : {1, 2, 3}) {
        std::string pose =
            text.substr(0, count) + "Frames: " + std::to_string(frames) + text.substr(time, rows - time);
        for (int i = 0; i < frames; ++i) pose += row;
        write(folder_ / "pose.bvh", pose);
        ASSERT_EQ(run({"bake", path("pose.bvh"), "--force", "--out", path("pose.gltf")}).exit_code, 0);
        fs::rename(path("pose.gltf"), path("pose.vrma"));
        for (const char* motion : {"pose.bvh", "pose.vrma"})
            for (const Strings& arguments :
                 {Strings{"lint", body},
                  {"bake", body, "--force", "--out", path("out.bvh")},
                  {"bake", body, "--force", "--ground", "stairs", "--travel", "--out", path("out.glb")}}) {
                Strings all = arguments;
                all.insert(all.end(), {"--motion", path(motion)});
                const Outcome outcome = run(all);
                EXPECT_EQ(outcome.exit_code, 0) << motion << ", " << frames << outcome.out << outcome.err;
            }
        EXPECT_EQ(app::read_character(path("out.bvh")).clips.at(0).channels[0].rotation.times.size(), frames);
    }
}

TEST_F(MotionProgram, BakeTravelMovesAClipThatWalksInPlace) {
    const app::Character character = app::stick_figure();
    humanoid::Clip walk = character.clips[0];
    for (glm::dvec3& at : walk.channels.at(0).translation.values) at.z = 0.0;
    app::export_clip({character, {}, walk, walk, 60.0}, folder_ / "still.glb");
    for (const bool travels : {false, true}) {
        Strings arguments{"bake",  path("still.glb"), "--ground", "stairs",
                          "--out", path("up.bvh"),    "--force"};
        if (travels) arguments.push_back("--travel");
        EXPECT_EQ(run(arguments).exit_code, 0);
        const app::Character read = app::read_character(folder_ / "up.bvh");
        const auto& hips = read.clips.at(0).channels.at(0).translation.values;
        EXPECT_NEAR(hips.back().z - hips.front().z, travels ? 1.1 : 0.0, 0.1);
        EXPECT_EQ(hips.back().y > hips.front().y + 0.2, travels);
    }
}

TEST_F(MotionProgram, UnreadableOrUnwritableFilesExitWith2) {
    const std::string file = figure("walk.glb");
    write(folder_ / "text.glb", "no character");
    write(folder_ / "other.bvh", "HIERARCHY");
    std::filesystem::create_hard_link(file, folder_ / "link.glb");
    const std::vector<Strings> bad{{"lint"},
                                   {"lint", path("nothing.glb")},
                                   {"lint", path("text.glb")},
                                   {"bake", path("nothing.glb")},
                                   {"bake", file, "--ground", "lava"},
                                   {"bake", file, "--fps", "0"},
                                   {"bake", file, "--fps", "nan"},
                                   {"bake", file, "--fps", "1001"},
                                   {"bake", file, "--out", path("walk.fbx")},
                                   {"bake", file, "--out", path("nowhere/walk.glb")},
                                   {"bake", file, "--out", path("other.bvh")},
                                   {"bake", file, "--out", file, "--force"},
                                   {"bake", file, "--out", path("link.glb"), "--force"},
                                   {"bake", file, "--out", path("text.glb"), "--force"}};
    for (const Strings& arguments : bad) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << arguments.back() << ": " << outcome.out;
        EXPECT_EQ(outcome.out, "") << arguments.back();
        EXPECT_EQ(outcome.err.find("tendril: "), 0u) << outcome.err;
    }
    EXPECT_EQ(folder_.names(), (Strings{"link.glb", "other.bvh", "text.glb", "walk.glb"}));
    EXPECT_EQ(read(folder_ / "text.glb"), "no character");
    EXPECT_EQ(read(folder_ / "other.bvh"), "HIERARCHY");
    EXPECT_EQ(run({"bake", file, "--out", path("other.bvh"), "--force"}).exit_code, 0);
}

TEST_F(MotionProgram, ASignalEndsABakeAtOnceAndLeavesNothing) {
    const app::Character character = app::stick_figure();
    humanoid::Clip clip = character.clips[0];
    const double times = 900.0 / clip.duration;
    clip.duration *= times;
    for (humanoid::Channel& channel : clip.channels)
        for (auto* list : {&channel.translation.times, &channel.rotation.times, &channel.scale.times})
            for (double& time : *list) time *= times;
    app::export_clip({character, {}, clip, clip, 1.0}, folder_ / "long.glb");
    for (const int number : {SIGINT, SIGTERM})
        for (const Strings& arguments :
             {Strings{"bake", path("long.glb"), "--ground", "stairs", "--fps", "1000"},
              Strings{"lint", path("long.glb")}}) {
            Process process(program_command(arguments));
            while (process.running() && process.cpu_seconds() < 0.1)
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            process.signal(number);
            const Outcome outcome = process.wait();
            EXPECT_TRUE(outcome.exit_code == 128 + number || arguments[0] == "lint")
                << arguments[0] << ' ' << outcome.exit_code << outcome.err;
        }
    EXPECT_EQ(folder_.names(), Strings{"long.glb"});
}

TEST_F(MotionProgram, ASkeletonWithoutLegsIsLintedButGetsNoGround) {
    write(folder_ / "snake.bvh",
          "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT b\n{\nOFFSET "
          "0 1 0\n"
          "CHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n}\nMOTION\nFrames: 2\n"
          "Frame Time: 0.1\n0 0 0 0 0 0\n10 0 0 5 0 0\n");
    EXPECT_EQ(run({"lint", path("snake.bvh")}).exit_code, 0);
    EXPECT_EQ(run({"bake", path("snake.bvh"), "--out", path("a.glb")}).exit_code, 0);
    const Outcome outcome = run({"bake", path("snake.bvh"), "--ground", "flat", "--out", path("b.glb")});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err.find("tendril: snake.bvh: "), 0u) << outcome.err;
}

}  // namespace
}  // namespace tendril::test
