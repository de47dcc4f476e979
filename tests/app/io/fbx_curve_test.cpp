// Curves of FBX files: each shape of key, layers, and the clips that come of them.
#include <gtest/gtest.h>

#include <cmath>

#include "app/io/character/fbx/curve.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "tests/app/io/fbx_file.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using humanoid::Interpolation;
using Key = test::FbxScene::Key;
using test::FbxRecord;
using test::FbxScene;

constexpr std::int64_t constant = 0x2, constant_next = 0x102, linear = 0x4, user = 0x408;
constexpr std::int64_t automatic = 0x108, time_independent = 0x2108, progressive = 0x6108, tcb = 0x208;
constexpr std::int64_t weighted = 0x3000000;

/// A bone that these keys move along X, in a stack of 2 s.
FbxScene moved_by(const std::vector<Key>& keys) {
    FbxScene scene;
    scene.settings = {FbxScene::property("UnitScaleFactor", {100.0})};
    const std::int64_t bone = scene.model("Bone", 0, {});
    scene.animate(scene.layer(scene.stack("Take", 2.0)), bone, "Lcl Translation", {keys, {}, {}},
                  glm::dvec3(0.0));
    return scene;
}
const humanoid::Track<glm::dvec3>& translation_in(const Character& character) {
    return character.clips.at(0).channels.at(0).translation;
}
double x_at(const Character& character, double time, std::size_t clip = 0) {
    std::vector<rig::Transform> pose = rest_pose(character.skeleton);
    sample(character.clips.at(clip), character.skeleton, time, pose);
    return pose[0].translation.x;
}
Character read(const FbxScene& scene, int way = 0) {
    return parse_fbx(way == 0 ? scene.text() : scene.binary(7500), "it");
}

TEST(FbxCurve, keys_of_each_shape_move_as_written_in_text_and_binary) {
    for (const int way : {0, 1}) {
        SCOPED_TRACE(way);
        const Character steps = read(moved_by({{0.0, 1.0, constant}, {1.0, 3.0, constant}, {2.0, 2.0}}), way);
        EXPECT_EQ(translation_in(steps).interpolation, Interpolation::Step);
        EXPECT_EQ(x_at(steps, 0.999), 1.0);
        EXPECT_EQ(x_at(steps, 1.0), 3.0);
        const Character next =
            read(moved_by({{0.0, 1.0, constant_next}, {1.0, 3.0, constant_next}, {2.0, 2.0}}), way);
        EXPECT_EQ(x_at(next, 0.0), 1.0);
        EXPECT_NEAR(x_at(next, 0.001), 3.0, 1e-9);
        EXPECT_NEAR(x_at(next, 1.5), 2.0, 1e-9);
        const Character mixed = read(moved_by({{0.0, 1.0, constant}, {1.0, 3.0, linear}, {2.0, 2.0}}), way);
        EXPECT_NEAR(x_at(mixed, 0.999), 1.0, 1e-9);
        EXPECT_NEAR(x_at(mixed, 1.0), 3.0, 1e-9);
        EXPECT_NEAR(x_at(mixed, 1.5), 2.5, 1e-6);
        const Character straight = read(moved_by({{0.0, 1.0, linear}, {2.0, 2.0, linear}}), way);
        EXPECT_EQ(translation_in(straight).interpolation, Interpolation::Linear);
        EXPECT_NEAR(x_at(straight, 0.5), 1.25, 1e-12);
        // Hermite's cubic from 0 to 1 within 1 s with these slopes.
        const Character bent =
            read(moved_by({{0.0, 0.0, user, 3.0, -1.0}, {1.0, 1.0, user, 0.0, 0.0}, {2.0, 1.0}}), way);
        EXPECT_EQ(translation_in(bent).interpolation, Interpolation::Cubic);
        for (const double u : {0.1, 0.5, 0.8})
            EXPECT_NEAR(
                x_at(bent, u),
                3.0 * u * u - 2.0 * u * u * u + 3.0 * (u - 2.0 * u * u + u * u * u) + (u * u - u * u * u),
                1e-5);
    }
}

TEST(FbxCurve, weights_lengthen_the_tangents) {
    const std::uint32_t weights = 8000u | 1000u << 16;
    const Character character =
        read(moved_by({{0.0, 0.0, user | weighted, 2.0, 1.0, weights}, {2.0, 1.0, user}}), 1);
    for (int i = 1; i < 20; ++i) {  // the Bezier curve by its parameter
        const double u = 0.05 * i, v = 1.0 - u;
        const double time = 3.0 * v * v * u * 1.6 + 3.0 * v * u * u * 1.8 + 2.0 * u * u * u;
        const double value = 3.0 * v * v * u * 3.2 + 3.0 * v * u * u * 0.8 + u * u * u;
        EXPECT_NEAR(x_at(character, time), value, 1e-4) << u;
    }
    EXPECT_LT(translation_in(character).times.size(), 200u) << "no more keys than it takes";
}

TEST(FbxCurve, automatic_tangents_are_those_of_the_programs_that_write_them) {
    const auto slope = [](std::int64_t flags, double last) {
        const std::string text = moved_by({{0.0, 0.0, flags}, {0.5, 1.0, flags}, {2.0, last, flags}}).text();
        const fbx::File file = fbx::read_records(text);
        for (const fbx::Record& each : file.root.child("Objects")->children)
            if (each.name == "AnimationCurve") return fbx::read_curve(each).keys.at(1).leaving;
        return std::nan("");
    };
    EXPECT_NEAR(slope(automatic, 4.0), 2.0, 1e-9);  // the mean of both secants
    EXPECT_NEAR(slope(automatic, 0.25), 0.75, 1e-9);
    EXPECT_NEAR(slope(time_independent, 4.0), 2.0, 1e-9);  // from neighbour to neighbour
    EXPECT_NEAR(slope(time_independent, 0.25), 0.125, 1e-9);
    EXPECT_NEAR(slope(progressive, 0.25), 0.0, 1e-9);  // no overshoot
    EXPECT_NEAR(slope(progressive, 1.15), 0.3, 1e-9);  // three times the smaller secant
    EXPECT_NEAR(slope(tcb, 4.0), 2.0, 1e-9);
}

TEST(FbxCurve, a_user_s_slope_holds_on_both_sides_unless_it_is_broken) {
    const std::int64_t broken = user | 0x800;
    const auto arriving = [](std::int64_t first, std::int64_t second) {
        const std::string text =
            moved_by({{0.0, 0.0, first, 7.0, 5.0}, {0.5, 1.0, second, 3.0, 0.0}, {2.0, 1.0}}).text();
        const fbx::File file = fbx::read_records(text);
        for (const fbx::Record& each : file.root.child("Objects")->children)
            if (each.name == "AnimationCurve") return fbx::read_curve(each).keys.at(0).arriving;
        return std::nan("");
    };
    EXPECT_EQ(arriving(automatic, user), 3.0);
    EXPECT_EQ(arriving(automatic, broken), 5.0);
    EXPECT_EQ(arriving(user, broken), 5.0);
}

TEST(FbxCurve, an_euler_angle_that_goes_round_is_followed_all_the_way) {
    FbxScene scene;
    const std::int64_t bone = scene.model("Bone", 0, {});
    scene.model("Tip", bone, {FbxScene::vector("Lcl Translation", {100.0, 0.0, 0.0})});
    scene.animate(scene.layer(scene.stack("Spin", 1.0)), bone, "Lcl Rotation",
                  {{}, {}, {{0.0, 0.0}, {1.0, 720.0}}}, glm::dvec3(0.0));
    const Character character = read(scene);
    std::vector<rig::Transform> pose = rest_pose(character.skeleton);
    std::vector<humanoid::Placement> placements(pose.size());
    for (int i = 0; i <= 100; ++i) {
        const double time = 0.01 * i, angle = 4.0 * std::acos(-1.0) * time;
        sample(character.clips.at(0), character.skeleton, time, pose);
        place(character.skeleton, pose, placements);
        EXPECT_LT(glm::length(placements[1].position - glm::dvec3(std::cos(angle), std::sin(angle), 0.0)),
                  1e-4)
            << time;
    }
}

TEST(FbxCurve, layers_add_and_override_by_their_weight) {
    FbxScene scene;
    scene.settings = {FbxScene::property("UnitScaleFactor", {100.0})};
    const std::int64_t bone = scene.model("Bone", 0, {});
    const std::int64_t stack = scene.stack("Take", 2.0);
    const auto layer = [&](double value, std::int64_t blend, double weight) {
        scene.animate(scene.layer(stack, {FbxScene::property("BlendMode", {blend}),
                                          FbxScene::property("Weight", {weight})}),
                      bone, "Lcl Translation", {{{0.0, value}, {2.0, 2.0 * value}}, {}, {}}, glm::dvec3(0.0));
    };
    layer(1.0, 0, 100.0);
    layer(10.0, 0, 50.0);
    EXPECT_NEAR(x_at(read(scene), 1.0), 1.5 + 0.5 * 15.0, 1e-9);
    layer(20.0, 1, 25.0);
    EXPECT_NEAR(x_at(read(scene), 1.0), 0.75 * 9.0 + 0.25 * 30.0, 1e-9);
}

TEST(FbxCurve, a_stack_begins_at_its_start_and_hides_what_is_outside) {
    FbxScene scene = moved_by({{-1.0, 0.0}, {3.0, 4.0}});
    const Character character = read(scene);
    EXPECT_EQ(character.clips.at(0).duration, 2.0);
    EXPECT_EQ(translation_in(character).times, (std::vector<double>{0.0, 2.0}));
    EXPECT_NEAR(x_at(character, 0.0), 1.0, 1e-9);
}

TEST(FbxCurve, keys_that_go_back_in_time_are_left_out_and_said) {
    const Character character = read(moved_by({{0.0, 1.0}, {1.0, 2.0}, {0.5, 9.0}, {2.0, 3.0}}));
    EXPECT_NEAR(x_at(character, 1.5), 2.5, 1e-9);
    ASSERT_EQ(character.notes.size(), 1u);
    EXPECT_NE(character.notes[0].find("keys out of order"), std::string::npos);
}

TEST(FbxCurve, what_is_not_evaluated_is_said_once) {
    const auto switched = [](const char* name) { return FbxScene::property(name, {std::int64_t{1}}); };
    const auto notes_with = [](const std::vector<FbxRecord>& node, const std::vector<FbxRecord>& of_layer) {
        FbxScene scene;
        const std::int64_t bone = scene.model("Bone", scene.model("Root", 0, node), node);
        for (int i = 0; i < 2; ++i)
            scene.animate(scene.layer(scene.stack("Take", 2.0), of_layer), bone, "Lcl Translation",
                          {{{0.0, 0.0}, {2.0, 1.0}}, {}, {}}, glm::dvec3(0.0));
        return read(scene).notes;
    };
    const FbxRecord maximum = FbxScene::vector("RotationMax", {0.0, 90.0, 0.0});
    EXPECT_EQ(notes_with({switched("RotationActive"), maximum}, {}), std::vector<std::string>());
    EXPECT_EQ(notes_with({switched("RotationMaxY"), maximum}, {}), std::vector<std::string>())
        << "without RotationActive it has no effect";
    for (const char* limit : {"RotationMinX", "RotationMaxY", "RotationMaxZ"}) {
        const auto notes = notes_with({switched("RotationActive"), switched(limit), maximum}, {});
        ASSERT_EQ(notes.size(), 1u) << limit;
        EXPECT_TRUE(test::says(notes[0], "limits nodes not evaluated"));
    }
    EXPECT_EQ(notes_with({switched("TranslationActive"), switched("TranslationMinZ")}, {}).size(), 1u);
    const auto notes = notes_with({}, {switched("Solo")});
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(test::says(notes[0], "Layers on solo are evaluated with the others"));
}

// ------------------------------------------------------------------------------------------- version 6.1

const std::string old_text = R"(; FBX 6.1.0 project file
FBXHeaderExtension:  {
    FBXHeaderVersion: 1003
    FBXVersion: 6100
}
Definitions:  {
    Version: 100
}
Objects:  {
    Model: "Model::Hips", "LimbNode" {
        Version: 232
        Properties60:  {
            Property: "RotationActive", "bool", "",1
            Property: "RotationOrder", "enum", "",5
            Property: "Lcl Translation", "Lcl Translation", "A+",0,1,0
            Property: "Lcl Rotation", "Lcl Rotation", "A+",0,0,90
            Property: "Lcl Scaling", "Lcl Scaling", "A+",1,1,1
        }
    }
    Model: "Model::Knee", "LimbNode" {
        Properties60:  {
            Property: "Lcl Translation", "Lcl Translation", "A+",0.5,0,0
        }
    }
    Model: "Model::Body", "Mesh" {
        Vertices: 0,1,0,0,1.5,0
        ,0.5,1,0
        PolygonVertexIndex: 0,1,-3
    }
    Deformer: "Deformer::Skin Body", "Skin" {
    }
    Deformer: "SubDeformer::Cluster Knee", "Cluster" {
        Indexes: 0,1,2
        Weights: 1,1,1
        Transform: 1,0,0,0,0,1,0,0,0,0,1,0,0,-1.5,0,1
    }
    GlobalSettings:  {
        Properties60:  {
            Property: "UpAxis", "int", "",1
            Property: "UnitScaleFactor", "double", "",100
        }
    }
}
Connections:  {
    Connect: "OO", "Model::Hips", "Model::Scene"
    Connect: "OO", "Model::Knee", "Model::Hips"
    Connect: "OO", "Model::Body", "Model::Scene"
    Connect: "OO", "Deformer::Skin Body", "Model::Body"
    Connect: "OO", "SubDeformer::Cluster Knee", "Deformer::Skin Body"
    Connect: "OO", "Model::Knee", "SubDeformer::Cluster Knee"
}
Takes:  {
    Current: "Walk"
    Take: "Walk" {
        FileName: "Walk.tak"
        LocalTime: 0,92372316000
        Model: "Model::Hips" {
            Version: 1.1
            Channel: "Transform" {
                Channel: "T" {
                    Channel: "X" {
                        Default: 0
                        KeyVer: 4005
                        KeyCount: 2
                        Key: 0,0,C,s,46186158000,1,L
                    }
                    Channel: "Y" {
                        Default: 1
                    }
                    Channel: "Z" {
                        Default: 0
                        KeyVer: 4005
                        KeyCount: 3
                        Key: 0,0,L
                        ,46186158000,2,U,s,3,-1,n,92372316000,3,U,a,n
                    }
                    LayerType: 1
                }
                Channel: "R" {
                    Channel: "Z" {
                        Default: 90
                        KeyVer: 4005
                        KeyCount: 1
                        Key: 0,90,U,b,0,0,r,0.5,n
                    }
                }
            }
        }
    }
}
)";

TEST(FbxCurve, version_6_is_read_with_its_takes_and_its_skin) {
    const Character character = parse_fbx(old_text, "it");
    EXPECT_EQ(character.notes, std::vector<std::string>());
    ASSERT_EQ(character.skeleton.size(), 2u);
    EXPECT_EQ(character.skeleton[1].name, "Knee");
    std::vector<humanoid::Placement> placements(2);
    place(character.skeleton, rest_pose(character.skeleton), placements);
    EXPECT_LT(glm::length(placements[1].position - glm::dvec3(0.0, 1.5, 0.0)), 1e-9);
    ASSERT_EQ(character.clips.size(), 1u);
    EXPECT_EQ(character.clips[0].name, "Walk");
    EXPECT_EQ(character.clips[0].duration, 2.0);
    std::vector<rig::Transform> pose = rest_pose(character.skeleton);
    sample(character.clips[0], character.skeleton, 0.5, pose);
    EXPECT_LT(glm::length(pose[0].translation - glm::dvec3(0.0, 1.0, 1.0)), 1e-5);
    sample(character.clips[0], character.skeleton, 1.5, pose);
    EXPECT_NEAR(pose[0].translation.x, 1.0, 1e-9);
    EXPECT_NEAR(pose[0].translation.z, 2.0 + 0.5 + 0.125 * (3.0 + 1.0), 1e-5);
    ASSERT_TRUE(character.skin.mesh);
    EXPECT_EQ(character.skin.mesh->positions.size(), 3u);
    EXPECT_EQ(character.skin.joints.at(0).node, 1u);
}

TEST(FbxCurve, keys_of_version_6_that_are_not_understood_are_said) {
    std::string text = old_text;
    text.replace(text.find("U,b,0,0,r"), 9, "Q,b,0,0,r");
    EXPECT_EQ(parse_fbx(text, "it").notes.size(), 1u);
}

TEST(FbxCurve, versions_before_6_are_refused_by_number) {
    std::string text = old_text;
    text.replace(text.find("6100"), 4, "5800");
    EXPECT_THROW(parse_fbx(text, "it"), std::runtime_error);
}

}  // namespace
}  // namespace tendril::app
