// A clip keeps its frames and its rate through any number of exports and retargets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <tendril/humanoid/lint.hpp>
#include <tendril/humanoid/retarget.hpp>
#include <tuple>

#include "app/io/character/bake.hpp"
#include "app/io/character/bvh.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/stick_figure.hpp"
#include "tests/app/io/fbx_file.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app::frame_count {
namespace {

using humanoid::Clip;
using humanoid::frame_rate;
namespace fs = std::filesystem;

constexpr double rates[]{24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 59.94, 60.0, 90.0, 120.0, 240.0};
constexpr std::size_t counts[]{2, 61, 300};

/// The built-in figure's walk as a BVH capture at that rate, whose frame time has `decimals` decimals.
std::string capture(double rate, std::size_t frames, int decimals) {
    const Character figure = stick_figure();
    Clip walk = figure.clips[0];
    walk.duration = static_cast<double>(frames - 1) / rate;
    std::string text = bvh_text(figure.skeleton, walk, rate);
    char step[40];
    std::snprintf(step, sizeof step, "%.*f", decimals, 1.0 / rate);
    const std::size_t at = text.find("Frame Time: ") + 12;
    return text.replace(at, text.find('\n', at) - at, step);
}

/// The built-in figure with shorter legs.
Character other_figure() {
    Character figure = stick_figure();
    std::vector<humanoid::Node> nodes = figure.skeleton.nodes();
    for (const char* name : {"LeftFoot", "RightFoot"})
        nodes[*figure.skeleton.find(name)].rest.translation *= 0.8;
    figure.skeleton = *humanoid::Skeleton::make(std::move(nodes));
    figure.clips.clear();
    return figure;
}

std::size_t keys_of(const Clip& clip) {
    std::size_t keys = 0;
    for (const humanoid::Channel& each : clip.channels)
        keys = std::max({keys, each.translation.times.size(), each.rotation.times.size()});
    return keys;
}

/// Ten times at night, three times by day: reads the file, retargets its clip to a figure, if there is one,
/// and writes it.
void expect_kept(const test::TempFolder& folder, fs::path file, std::size_t frames,
                 const Character* figure = nullptr) {
    double rate = 0.0;
    for (int round = 0; round < std::min(test::rounds(10), 10); ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        Character character = read_character(file);
        Clip clip = character.clips.at(0);
        ASSERT_EQ(keys_of(clip), frames);
        if (round == 0) rate = frame_rate(clip);
        ASSERT_NEAR(frame_rate(clip), rate, 1e-6 * rate);
        if (figure != nullptr) {
            const humanoid::BoneMap from = bone_map(character), to = bone_map(*figure);
            const auto made = humanoid::retarget({character.skeleton, from}, clip, {figure->skeleton, to});
            ASSERT_TRUE(made) << made.message();
            ASSERT_EQ(keys_of(made->clip), frames);
            clip = made->clip;
            character = *figure;
        }
        const std::string to = "round" + std::to_string(round) + (round % 3 == 1 ? ".glb" : ".bvh");
        const std::string own = figure != nullptr ? std::string() : file.string();
        EXPECT_EQ(export_clip({character, own, clip, clip, frame_rate(clip)}, folder / to).frames, frames);
        file = folder / to;
    }
}

TEST(FrameCount, IsKeptThroughManyExportsAndRetargets) {
    const test::TempFolder folder;
    const Character figure = other_figure();
    for (const double rate : rates)
        for (const std::size_t frames : counts)
            for (const int decimals : {4, 6, 17}) {
                // The longest captures drift most and are slow: two rates that no unit of time divides.
                if (frames == 300 && (decimals != 6 || (rate != 29.97 && rate != 120.0))) continue;
                SCOPED_TRACE(std::to_string(frames) + " frames at " + std::to_string(rate) + ", " +
                             std::to_string(decimals) + " decimals");
                test::write(folder / "in.bvh", capture(rate, frames, decimals));
                expect_kept(folder, folder / "in.bvh", frames);
                if (decimals == 6) expect_kept(folder, folder / "in.bvh", frames, &figure);
                if (decimals == 17) {
                    EXPECT_NEAR(frame_rate(read_character(folder / "in.bvh").clips.at(0)), rate, 1e-9);
                }
            }
}

TEST(FrameCount, OfAnFbxIsKeptThroughManyExports) {
    const test::TempFolder folder;
    for (const double rate : rates)
        for (const bool states_rate : {true, false}) {
            SCOPED_TRACE(rate);
            constexpr std::size_t frames = 61;
            test::FbxScene scene;
            if (states_rate)
                scene.settings = {test::FbxScene::property("TimeMode", {std::int64_t{14}}),
                                  test::FbxScene::property("CustomFrameRate", {rate})};
            const std::int64_t hips =
                scene.model("Hips", 0, {test::FbxScene::vector("Lcl Translation", {0.0, 100.0, 0.0})});
            scene.model("Spine", hips, {test::FbxScene::vector("Lcl Translation", {0.0, 50.0, 0.0})});
            std::vector<test::FbxScene::Key> keys;
            for (std::size_t i = 0; i < frames; ++i)
                keys.push_back(
                    {static_cast<double>(i) / rate, 10.0 * std::sin(0.3 * static_cast<double>(i))});
            const std::int64_t layer = scene.layer(scene.stack("sway", keys.back().time));
            scene.animate(layer, hips, "Lcl Rotation", {keys, {}, {}}, glm::dvec3(0.0));
            test::write(folder / "in.fbx", scene.text());
            expect_kept(folder, folder / "in.fbx", frames);
        }
}

/// Keys of one track lie between the frames of the others, the clip ends between two frames, and its feet are
/// put on stairs.
TEST(FrameCount, IsKeptWhereKeysLieBetweenFrames) {
    const test::TempFolder folder;
    const Character figure = other_figure();
    for (const double rate : {29.97, 120.0})
        for (const double end : {0.2, 0.9}) {
            SCOPED_TRACE(std::to_string(rate) + ", ends at " + std::to_string(end) + " of a frame");
            Character from = parse_bvh(capture(rate, 524, 17), "it.bvh");
            Clip& clip = from.clips[0];
            clip.duration += end / rate;
            auto& head = clip.channels.back().rotation;
            const glm::dquat turned = head.values[0];
            head.times = {0.0, 1.4321, clip.duration};
            head.values = {turned, turned, turned};
            const humanoid::BoneMap map = bone_map(figure), from_map = bone_map(from);
            const auto made = humanoid::retarget({from.skeleton, from_map}, clip, {figure.skeleton, map});
            ASSERT_TRUE(made) << made.message();
            const humanoid::Ground stairs = *humanoid::Ground::stairs(0.15, 0.3);
            const Clip up = with_feet_on(stairs, figure.skeleton, map, made->clip, rate);
            Clip next = up;
            Character character = figure;
            for (int round = 0; round < 6; ++round) {
                ASSERT_NEAR(frame_rate(next), rate, 1e-6 * rate) << round;
                const fs::path file = folder / (round % 2 == 0 ? "out.glb" : "out.bvh");
                EXPECT_EQ(export_clip({character, {}, next, next, frame_rate(next)}, file).frames, 524u);
                character = read_character(file);
                next = character.clips.at(0);
            }
        }
}

TEST(FrameCount, OfCapturesWithRoundedFrameTimesIsTheirFiles) {
    const Character figure = other_figure();
    const humanoid::BoneMap map = bone_map(figure);
    for (const auto& [name, frames, rate] :
         {std::tuple{"bvh_walk_60hz_300.bvh", 300u, 60.0}, {"bvh_walk_30hz_61.bvh", 61u, 30.0}}) {
        if (!fs::exists(test::found_path(name))) GTEST_SKIP();
        const Character from = read_character(test::found_path(name));
        const humanoid::BoneMap from_map = bone_map(from);
        const auto made =
            humanoid::retarget({from.skeleton, from_map}, from.clips.at(0), {figure.skeleton, map});
        ASSERT_TRUE(made) << made.message();
        EXPECT_EQ(keys_of(made->clip), frames);
        EXPECT_EQ(frame_rate(made->clip), rate);
        EXPECT_EQ(frames_at(made->clip, rate).count, frames);
    }
}

}  // namespace
}  // namespace tendril::app::frame_count
