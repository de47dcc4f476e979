// Curves of FBX files: each shape of key, layers, and the resulting clips.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "app/io/character/fbx/animation.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "tests/app/io/fbx_file.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using humanoid::Interpolation;
using Key = test::FbxScene::Key;
using test::FbxRecord;
using test::FbxScene;

constexpr std::int64_t constant = 0x2, constant_next = 0x102, linear = 0x4, user = 0x408;
constexpr std::int64_t automatic = 0x108, tcb = 0x208;

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

TEST(FbxCurve, KeysOfEachShapeMoveAsWrittenInTextAndBinary) {
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
        // The Hermite cubic from 0 to 1 within 1 s with these slopes.
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

/// The curve as control points of Bezier curves, halved until they are at `time`.
double naive_at(const std::vector<Key>& keys, double time) {
    std::size_t i = 0;
    while (i + 2 < keys.size() && keys[i + 1].time <= time) ++i;
    const Key &from = keys[i], &to = keys[i + 1];
    if ((from.flags & linear) != 0)
        return glm::mix(from.value, to.value, (time - from.time) / (to.time - from.time));
    const auto weight = [&](std::size_t key, bool next) {
        if ((keys[key].flags & 0x1000000 << (next ? 1 : 0)) == 0) return 1.0 / 3.0;
        return 1e-4 * (next ? keys[key].weights >> 16 : keys[key].weights & 0xffff);
    };
    const auto slope = [&](std::size_t k, bool leaving) {
        const Key& key = keys[k];
        const double next = k > 0 ? keys[k - 1].second : 0.0;
        if ((key.flags & linear) != 0) return next;
        if ((key.flags & 0x400) != 0) return leaving ? key.first : next;
        const bool is_even = (key.flags & 0x2000) != 0, is_clamped = (key.flags & 0x1000) != 0,
                   is_progressive = (key.flags & 0x4000) != 0;
        const double bias = leaving ? key.first : -next;
        if (k == 0 || k + 1 == keys.size()) {
            const Key &a = keys[k == 0 ? 0 : k - 1], &b = keys[k == 0 ? 1 : k];
            const double beyond = is_even ? 0.0 : std::max(std::abs(bias) / 100.0 - 5.0, 0.0);
            if (is_progressive) return 0.0;
            return (b.value - a.value) / (b.time - a.time) + (bias > 0.0 ? 40.0 : -40.0) * beyond * beyond;
        }
        const Key &a = keys[k - 1], &b = keys[k + 1];
        if (is_clamped && (a.value == key.value || b.value == key.value)) return 0.0;
        const double left = (key.value - a.value) / (key.time - a.time),
                     right = (b.value - key.value) / (b.time - key.time);
        double result = (b.value - a.value) / (b.time - a.time);
        if (!is_even) {
            // Half way from that slope to the parabola's through the three keys.
            const double part = (key.time - a.time) / (b.time - a.time);
            result = 0.5 * (result + left * (1.0 - part) + right * part);
            const double way = (bias > 0.0 ? right : left) - result,
                         beyond = std::max(std::abs(bias) / 100.0 - 5.0, 0.0);
            result += way * std::abs(bias) / 100.0 +
                      ((std::abs(way) > 1e-5 ? way : bias) > 0.0 ? 40.0 : -40.0) * beyond * beyond;
        }
        if (!is_progressive) return result;
        // Control points stay within the neighbours' values.
        const double before = weight(k - 1, true) * (key.time - a.time),
                     after = weight(k, false) * (b.time - key.time);
        const auto within = [](double value, double one, double other) {
            return std::clamp(value, std::min(one, other), std::max(one, other));
        };
        const double down = (key.value - within(key.value - result * before, key.value, a.value)) / before,
                     up = (within(key.value + result * after, key.value, b.value) - key.value) / after;
        return std::abs(down) < std::abs(up) ? down : up;
    };
    const double span = to.time - from.time, first = weight(i, false) * span, second = weight(i, true) * span;
    std::array<glm::dvec2, 4> p{{{from.time, from.value},
                                 {from.time + first, from.value + first * slope(i, true)},
                                 {to.time - second, to.value - second * slope(i + 1, false)},
                                 {to.time, to.value}}};
    for (int halving = 0; halving < 60; ++halving) {
        const glm::dvec2 a = 0.5 * (p[0] + p[1]), b = 0.5 * (p[1] + p[2]), c = 0.5 * (p[2] + p[3]),
                         d = 0.5 * (a + b), e = 0.5 * (b + c), middle = 0.5 * (d + e);
        if (time < middle.x)
            p = {p[0], a, d, middle};
        else
            p = {middle, e, c, p[3]};
    }
    return p[0].y;
}

TEST(FbxCurve, RandomTangentsOfEveryKindMatchANaiveEvaluator) {
    constexpr std::int64_t kinds[] = {0x108, 0x1108, 0x2108, 0x3108, 0x4108, 0x6108,
                                      0x908, 0x2908, 0x7108, 0x408,  0xc08,  linear};
    std::mt19937 random(53);
    const auto any = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < 1000; ++round) {
        SCOPED_TRACE(round);
        std::vector<Key> keys;
        const std::size_t count = 2 + random() % 5;
        const bool is_biased = random() % 2 == 0;
        for (std::size_t i = 0; i < count; ++i) {
            Key key{.time = static_cast<double>(i) + any(-0.3, 0.3), .value = std::round(any(-3.0, 3.0))};
            key.flags = kinds[random() % std::size(kinds)];
            if ((key.flags & linear) == 0) key.flags |= static_cast<std::int64_t>(random() % 4) << 24;
            const auto weight = [&] { return static_cast<std::uint32_t>(500 + random() % 9000); };
            key.weights = weight() | weight() << 16;
            // A slope or, in percent, a bias; right, and left at the next key. One slope without a break.
            if (is_biased || (key.flags & 0x400) != 0) key.first = static_cast<float>(any(-700.0, 700.0));
            if (i > 0 && (is_biased || (key.flags & 0x400) != 0))
                keys.back().second = key.flags == 0xc08 || (key.flags & 0x100) != 0
                                         ? static_cast<float>(any(-700.0, 700.0))
                                         : key.first;
            keys.push_back(key);
        }
        const std::string text = moved_by(keys).text();
        const fbx::File file = fbx::read_records(text);
        for (const fbx::Record& each : file.root.child("Objects")->children) {
            if (each.name != "AnimationCurve") continue;
            const fbx::Curve curve = fbx::read_curve(each);
            for (const Key& key : keys)
                for (const double later : {0.0, 0.1, 0.37, 0.6}) {
                    const double time = std::min(key.time + later, keys.back().time);
                    const double known = naive_at(keys, time);
                    EXPECT_NEAR(curve.at(time), known, 1e-6 * (1.0 + std::abs(known))) << time;
                }
        }
    }
}

TEST(FbxCurve, ATcbKeyWithoutTensionAtAnEndHasTheSlopeOfItsChord) {
    const auto at = [](double time) {
        return x_at(
            read(moved_by(
                {{0.0, 0.0, tcb, 0.0, 0.0, 0}, {0.5, 1.0, tcb, 0.0, 0.0, 0}, {2.0, 4.0, tcb, 0.0, 0.0, 0}})),
            time);
    };
    EXPECT_NEAR(at(0.25), 0.5, 1e-5);
    EXPECT_NEAR(at(1.0), 2.0, 1e-5);
}

TEST(FbxCurve, AUserSlopeHoldsOnBothSidesUnlessBroken) {
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

TEST(FbxCurve, AnEulerAngleOfSeveralTurnsIsFollowedAllTheWay) {
    FbxScene scene;
    const std::int64_t bone = scene.model("Bone", 0, {});
    scene.model("Tip", bone, {FbxScene::vector("Lcl Translation", {100.0, 0.0, 0.0})});
    scene.animate(scene.layer(scene.stack("Spin", 1.0)), bone, "Lcl Rotation",
                  {{}, {}, {{0.0, 0.0}, {1.0, 720.0}}}, glm::dvec3(0.0));
    const Character character = read(scene);
    for (int i = 0; i <= 100; ++i) {
        const double time = 0.01 * i, angle = 4.0 * std::acos(-1.0) * time;
        EXPECT_LT(
            glm::distance(test_posed::at(character, "Tip", 0, time), {std::cos(angle), std::sin(angle), 0.0}),
            1e-4)
            << time;
    }
}

TEST(FbxCurve, LayersAddAndOverrideByTheirWeight) {
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

TEST(FbxCurve, AStackBeginsAtItsStartAndHidesKeysOutside) {
    FbxScene scene = moved_by({{-1.0, 0.0}, {3.0, 4.0}});
    const Character character = read(scene);
    EXPECT_EQ(character.clips.at(0).duration, 2.0);
    EXPECT_EQ(translation_in(character).times, (std::vector<double>{0.0, 2.0}));
    EXPECT_NEAR(x_at(character, 0.0), 1.0, 1e-9);
}

TEST(FbxCurve, KeysThatGoBackInTimeAreDroppedWithANote) {
    const Character character = read(moved_by({{0.0, 1.0}, {1.0, 2.0}, {0.5, 9.0}, {2.0, 3.0}}));
    EXPECT_NEAR(x_at(character, 1.5), 2.5, 1e-9);
    EXPECT_TRUE(test::says(test_posed::lines(character.notes), "keys out of order"));
}

TEST(FbxCurve, UnevaluatedContentsAreReportedOnce) {
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

std::string old_text() {
    return test::read(test::source_path("tests/app/data/version_6.fbx"));
}

TEST(FbxCurve, Version6IsReadWithItsTakesAndItsSkin) {
    const Character character = parse_fbx(old_text(), "it");
    EXPECT_EQ(character.notes, std::vector<std::string>());
    ASSERT_EQ(character.skeleton.size(), 2u);
    EXPECT_EQ(character.skeleton[1].name, "Knee");
    EXPECT_LT(glm::length(test_posed::at(character, "Knee", -1) - glm::dvec3(0.0, 1.5, 0.0)), 1e-9);
    ASSERT_EQ(character.clips.size(), 1u);
    EXPECT_EQ(character.clips[0].name, "Walk");
    EXPECT_EQ(character.clips[0].duration, 2.0);
    EXPECT_LT(glm::length(test_posed::at(character, "Hips", 0, 0.5) - glm::dvec3(0.0, 1.0, 1.0)), 1e-5);
    const glm::dvec3 later = test_posed::at(character, "Hips", 0, 1.5);
    EXPECT_NEAR(later.x, 1.0, 1e-9);
    EXPECT_NEAR(later.z, 2.0 + 0.5 + 0.125 * (3.0 - 1.0), 1e-5);  // the automatic key's slope is 1
    ASSERT_TRUE(character.skin.mesh);
    EXPECT_EQ(character.skin.mesh->positions.size(), 3u);
    EXPECT_EQ(character.skin.joints.at(0).node, 1u);
}

TEST(FbxCurve, ListsOfTextFilesMayBeginAndEndTheirLinesAnywhere) {
    for (const char* written : {"Key: \n\t0,90,U,b,0,0,r,0.5,n", "Key: 0,90,\n\n\tU,b,\n0,0,r,0.5,n,",
                                "Key:\n;values\n\t0\n,90,U,b\n,0,0,r,0.5,n,\n;end"}) {
        std::string text = old_text();
        const std::string key = "Key: 0,90,U,b,0,0,r,0.5,n";
        text.replace(text.find(key), key.size(), written);
        const Character character = parse_fbx(text, "it");
        EXPECT_EQ(character.clips, parse_fbx(old_text(), "it").clips) << written;
        EXPECT_EQ(character.notes, std::vector<std::string>());
    }
}

TEST(FbxCurve, UnknownVersion6KeysAreReported) {
    std::string text = old_text();
    text.replace(text.find("U,b,0,0,r"), 9, "Q,b,0,0,r");
    EXPECT_EQ(parse_fbx(text, "it").notes.size(), 1u);
}

TEST(FbxCurve, VersionsBefore6AreRefusedByNumber) {
    std::string text = old_text();
    text.replace(text.find("6100"), 4, "5800");
    EXPECT_THROW(parse_fbx(text, "it"), std::runtime_error);
}

}  // namespace
}  // namespace tendril::app
