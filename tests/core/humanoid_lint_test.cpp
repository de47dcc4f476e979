// Lint checks that need no feet: keys, jumps and scales, on skeletons of any kind.
#include <tendril/humanoid/attach.hpp>
#include <tendril/humanoid/lint.hpp>

#include "humanoid_figure.hpp"
#include "random.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace humanoid;

/// A snake of five nodes, 0.5 m apart.
Skeleton snake() {
    std::vector<Node> nodes;
    for (int i = 0; i < 5; ++i) {
        std::string name = "joint";
        name += std::to_string(i);
        nodes.push_back({name, i - 1, {.translation = {0.0, i > 0 ? 0.5 : 0.0, 0.0}}});
    }
    return *Skeleton::make(std::move(nodes));
}

/// A winding motion: every joint swings on its own sine, and the first one also moves forward.
Clip winding(double rate, int frames, double phase = 0.0) {
    Clip clip{.name = "wind", .duration = (frames - 1) / rate, .channels = {}};
    for (std::size_t node = 0; node < 5; ++node) {
        Channel channel{.node = node};
        for (int i = 0; i < frames; ++i) {
            const double time = std::min(i / rate, clip.duration);
            const double half = 0.4 * std::sin(5.0 * time + 0.7 * static_cast<double>(node) + phase);
            channel.rotation.times.push_back(time);
            channel.rotation.values.push_back({std::cos(half), 0.0, 0.0, std::sin(half)});
            if (node > 0) continue;
            channel.translation.times.push_back(time);
            channel.translation.values.push_back({0.3 * time, 0.0, 0.0});
        }
        clip.channels.push_back(std::move(channel));
    }
    return clip;
}

LintReport lint_of(const Clip& clip) {
    const Skeleton skeleton = snake();
    EXPECT_TRUE(check(clip, skeleton));
    return lint(skeleton, match_bones(skeleton), clip);
}
Clip cured(const Clip& clip, const Finding& finding) {
    const Skeleton skeleton = snake();
    const Expected<Clip> mended = cure(skeleton, match_bones(skeleton), clip, finding);
    EXPECT_TRUE(mended) << mended.message();
    return mended ? *mended : clip;
}
std::string texts(const LintReport& report) {
    std::string all;
    for (const Finding& each : report.findings) all += each.text + '\n';
    return all;
}

TEST(Lint, FindsNothingInACleanClip) {
    for (const double rate : {24.0, 30.0, 60.0, 120.0})
        for (int i = 0; i < 20; ++i) {
            const LintReport report = lint_of(winding(rate, 50 + 7 * i, i));
            EXPECT_TRUE(report.findings.empty()) << rate << ": " << texts(report);
            EXPECT_EQ(report.rate, rate);
            EXPECT_EQ(report.frames, static_cast<std::size_t>(50 + 7 * i));
            EXPECT_FALSE(report.has_floor);
        }
}

TEST(Lint, ReportsTheFrameRateOfTheKeys) {
    EXPECT_EQ(frame_rate(winding(30.0, 40)), 30.0);
    EXPECT_NEAR(frame_rate(winding(29.97, 400)), 29.97, 1e-9);
    EXPECT_EQ(frame_rate({}), 60.0);
    Clip said = winding(120.0, 40);  // reduced keys lie between frames
    said.rate = 30.0;
    EXPECT_EQ(frame_rate(said), 30.0);
    EXPECT_EQ(frame_rate(winding(2.0, 40)), 60.0) << "too slow to be a frame rate";
    for (const double slow : {5.0, 8.0, 12.5, 15.0, 18.0})
        EXPECT_NEAR(frame_rate(winding(slow, 40)), slow, 1e-9);
    Clip rounded = winding(30.0, 100);  // as files with three decimals store it
    for (Channel& channel : rounded.channels)
        for (double& time : channel.rotation.times) time = std::floor(time * 1000.0) / 1000.0;
    EXPECT_NEAR(frame_rate(rounded), 30.0, 0.01);
}

TEST(Lint, FindsAFlippedKeyAndFixesIt) {
    Clip clip = winding(30.0, 60);
    glm::dquat& key = clip.channels[2].rotation.values[17];
    key = -key;
    const LintReport report = lint_of(clip);
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    const Finding& finding = report.findings[0];
    EXPECT_EQ(finding.fault, Fault::SignFlip);
    EXPECT_EQ(finding.node, 2);
    EXPECT_EQ(finding.frame, 17u);
    EXPECT_EQ(finding.last, 17u);
    EXPECT_NEAR(finding.time, 17.0 / 30.0, 1e-9);
    EXPECT_STREQ(finding.unit, "deg");
    EXPECT_GT(finding.amount, 340.0);
    EXPECT_LT(finding.amount, 360.0);
    EXPECT_NE(finding.text.find("joint2"), std::string::npos) << finding.text;
    ASSERT_TRUE(finding.has_cure);
    EXPECT_EQ(cured(clip, finding), winding(30.0, 60));
}

TEST(Lint, ARunOfFlippedKeysIsOneFinding) {
    Clip clip = winding(30.0, 60);
    for (std::size_t i = 20; i < 31; ++i) clip.channels[3].rotation.values[i] *= -1.0;
    const LintReport report = lint_of(clip);
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    EXPECT_EQ(report.findings[0].first, 20u);
    EXPECT_EQ(report.findings[0].last, 30u);
    clip.channels[3].rotation.interpolation = Interpolation::Step;  // no interpolation between its keys
    EXPECT_TRUE(lint_of(clip).findings.empty());
}

TEST(Lint, FlipsOfAllJointsOfAClipAreOneFindingAndOneFix) {
    Random random(5);
    Clip clip = winding(30.0, 200);
    for (const std::size_t node : {0u, 2u, 3u})
        for (std::size_t i = 20; i < 190; ++i)
            if (random.below(2) == 0) clip.channels[node].rotation.values[i] *= -1.0;
    for (const std::size_t i : {20u, 189u})
        clip.channels[3].rotation.values[i] = -winding(30.0, 200).channels[3].rotation.values[i];
    const LintReport report = lint_of(clip);
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    const Finding& finding = report.findings[0];
    EXPECT_EQ(finding.first, 20u);
    EXPECT_EQ(finding.last, 189u);
    EXPECT_TRUE(says(finding.text, "keys times in 3 joints")) << finding.text;
    EXPECT_EQ(cured(clip, finding), winding(30.0, 200));
}

TEST(Lint, FixesTheTangentsOfAFlippedCubicKeyToo) {
    Clip clip{.name = "cubic", .duration = 2.0, .channels = {{.node = 1}}};
    auto& track = clip.channels[0].rotation;
    track.interpolation = Interpolation::Cubic;
    for (int i = 0; i < 3; ++i) {
        const double half = 0.3 * i, sign = i == 1 ? -1.0 : 1.0;
        track.times.push_back(i);
        const glm::dquat tangent(sign * -0.3 * std::sin(half), sign * 0.3 * std::cos(half), 0.0, 0.0);
        track.values.push_back(tangent);
        track.values.push_back({sign * std::cos(half), sign * std::sin(half), 0.0, 0.0});
        track.values.push_back(tangent);
    }
    const LintReport report = lint_of(clip);
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    const Clip whole = cured(clip, report.findings[0]);
    const auto& mended = whole.channels[0].rotation.values;
    EXPECT_GT(mended[4].w, 0.0);
    EXPECT_GT(mended[3].x, 0.0);
    EXPECT_GT(mended[5].x, 0.0);
}

TEST(Lint, FindsAJointThatIsDisplacedForOneFrame) {
    Random random(71);
    for (int i = 0; i < 100; ++i) {
        const double rate = i % 2 == 0 ? 30.0 : 60.0;
        Clip clip = winding(rate, 80, i);
        const std::size_t node = random.below(5), frame = 3 + random.below(74);
        const double degrees = 40.0 + static_cast<double>(random.below(100));
        const double half = degrees * 3.14159265358979 / 360.0;
        auto& key = clip.channels[node].rotation.values[frame];
        key = key * glm::dquat(std::cos(half), std::sin(half), 0.0, 0.0);
        if (glm::dot(key, clip.channels[node].rotation.values[frame - 1]) < 0.0) key = -key;
        const LintReport report = lint_of(clip);
        ASSERT_EQ(report.findings.size(), 1u) << i << ": " << texts(report);
        const Finding& finding = report.findings[0];
        EXPECT_EQ(finding.fault, Fault::Jump);
        EXPECT_EQ(finding.node, static_cast<std::int32_t>(node));
        EXPECT_EQ(finding.frame, frame);
        EXPECT_NEAR(finding.amount, degrees, 0.15 * degrees);
        EXPECT_FALSE(finding.goes_on);
        const Clip mended = cured(clip, finding);
        EXPECT_TRUE(lint_of(mended).findings.empty()) << texts(lint_of(mended));
        const glm::dquat was = winding(rate, 80, i).channels[node].rotation.values[frame];
        EXPECT_GT(std::abs(glm::dot(mended.channels[node].rotation.values[frame], was)), 0.999);
    }
}

TEST(Lint, FindsAJumpAfterWhichTheMotionContinues) {
    Clip clip = winding(60.0, 120);
    auto& values = clip.channels[0].translation.values;
    for (std::size_t i = 50; i < values.size(); ++i) values[i] += glm::dvec3(0.0, 0.0, 0.25);
    const LintReport report = lint_of(clip);
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    const Finding& finding = report.findings[0];
    EXPECT_EQ(finding.fault, Fault::Jump);
    EXPECT_EQ(finding.node, 0);
    EXPECT_EQ(finding.frame, 50u);
    EXPECT_STREQ(finding.unit, "mm");
    EXPECT_NEAR(finding.amount, 250.0, 1.0);
    EXPECT_TRUE(finding.goes_on);
    const Clip mended = cured(clip, finding);
    EXPECT_TRUE(lint_of(mended).findings.empty()) << texts(lint_of(mended));
    EXPECT_EQ(mended.channels[0].translation.values[20], values[20]);
    EXPECT_EQ(mended.channels[0].translation.values[90], values[90]);
}

/// The same keys with cubic interpolation, as written by exporters.
void make_cubic(Clip& clip) {
    const auto convert = [](auto& track) {
        const auto keys = track.values;
        track.interpolation = Interpolation::Cubic;
        track.values.clear();
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, keys.size() - 1);
            const auto slope = (keys[after] - keys[before]) / (track.times[after] - track.times[before]);
            track.values.insert(track.values.end(), {slope, keys[i], slope});
        }
    };
    for (Channel& channel : clip.channels) {
        convert(channel.rotation);
        if (!channel.translation.times.empty()) convert(channel.translation);
    }
}

/// The largest turn of a node between samples at eight times a rate, radians.
double largest_turn(const Clip& clip, std::size_t node, double rate) {
    double largest = 0.0;
    std::vector<rig::Transform> last(5), pose(5);
    for (int i = 0; i <= static_cast<int>(clip.duration * 8.0 * rate); ++i) {
        sample(clip, snake(), i / (8.0 * rate), pose);
        if (i > 0) {
            const double cosine = std::abs(glm::dot(pose[node].rotation, last[node].rotation));
            largest = std::max(largest, 2.0 * std::acos(std::min(cosine, 1.0)));
        }
        last = pose;
    }
    return largest;
}

TEST(Lint, AJumpIsMeasuredInMetresBelowAScaledNode) {
    std::vector<Node> nodes = snake().nodes();
    nodes[0].rest.scale = glm::dvec3(0.01);
    for (std::size_t i = 1; i < nodes.size(); ++i) nodes[i].rest.translation *= 100.0;
    const Skeleton centimetres = *Skeleton::make(std::move(nodes));
    const auto found = [&](double units) {
        Clip clip = winding(60.0, 120);
        Track<glm::dvec3>& track = clip.channels[2].translation;
        track.times = clip.channels[2].rotation.times;
        for (std::size_t i = 0; i < track.times.size(); ++i)
            track.values.push_back({50.0, 0.0, i < 50 ? 0.0 : units});
        return lint(centimetres, match_bones(centimetres), clip);
    };
    EXPECT_TRUE(found(0.3).findings.empty()) << texts(found(0.3));
    const LintReport report = found(25.0);
    ASSERT_EQ(report.findings.size(), 1u) << texts(report);
    EXPECT_NEAR(report.findings[0].amount, 250.0, 1.0);
}

TEST(Lint, AFixedJumpLeavesNothingBetweenCubicKeys) {
    for (const auto& [goes_on, frame] :
         {std::pair{false, 50u}, {false, 51u}, {false, 52u}, {false, 90u}, {true, 50u}, {true, 73u}}) {
        Clip clip = winding(60.0, 120);
        const double calm = largest_turn(clip, 2, 60.0);
        auto& keys = clip.channels[2].rotation.values;
        for (double& time : clip.channels[2].rotation.times)
            time = std::min(static_cast<double>(static_cast<float>(time)), clip.duration);
        for (std::size_t i = frame; i < (goes_on ? keys.size() : frame + 1); ++i)
            keys[i] = keys[i] * glm::dquat(std::cos(0.7), std::sin(0.7), 0.0, 0.0);
        make_cubic(clip);
        const LintReport report = lint_of(clip);
        ASSERT_FALSE(report.findings.empty());
        const auto jump = std::ranges::find(report.findings, Fault::Jump, &Finding::fault);
        ASSERT_NE(jump, report.findings.end()) << texts(report);
        EXPECT_GT(largest_turn(clip, 2, 60.0), 5.0 * calm);
        for (const double sign :
             {1.0, -1.0}) {  // -1: the keys after the jump are the other quaternion of the pair
            Clip turned = clip;
            auto& values = turned.channels[2].rotation.values;
            for (std::size_t i = 3 * (frame + 1); i < values.size(); ++i) values[i] = values[i] * sign;
            const Clip mended = cured(turned, *jump);
            EXPECT_LT(largest_turn(mended, 2, 60.0), goes_on ? 8.0 * calm : 1.5 * calm)
                << goes_on << frame << sign;
            for (const double seconds : {0.3, 1.9}) {  // far from the jump, nothing changes
                std::vector<rig::Transform> was(5), now(5);
                sample(turned, snake(), seconds, was);
                sample(mended, snake(), seconds, now);
                EXPECT_NEAR(std::abs(glm::dot(was[2].rotation, now[2].rotation)), 1.0, 1e-12) << seconds;
            }
        }
    }
}

TEST(Lint, KeysHeldOnPurposeDoNotJump) {
    Clip clip = winding(60.0, 60);
    auto& track = clip.channels[1].rotation;
    track.interpolation = Interpolation::Step;
    track.times = {0.0, 0.5};
    track.values = {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}};
    EXPECT_TRUE(lint_of(clip).findings.empty());
}

/// Curves that alternate between held and interpolated become one track, with two keys at each step. No frame
/// lies between the two.
TEST(Lint, TwoKeysAtOneTimeAreAnIntendedStep) {
    for (const bool turns : {true, false})
        for (const double rate : {24.0, 60.0}) {
            Clip clip = winding(rate, 60);
            Channel& channel = clip.channels[0];
            const auto step_at = [&](auto& track, const auto& change) {
                const double time = track.times[20];
                const auto before = track.values[20];
                for (std::size_t i = 20; i < track.values.size(); ++i)
                    track.values[i] = change(track.values[i]);
                track.times.insert(track.times.begin() + 20, time - 1e-7);
                track.values.insert(track.values.begin() + 20, before);
            };
            if (turns)
                step_at(channel.rotation, [](const glm::dquat& q) {
                    return q * glm::dquat(std::cos(0.5), std::sin(0.5), 0.0, 0.0);
                });
            else
                step_at(channel.translation, [](const glm::dvec3& v) { return v + glm::dvec3(0, 0.4, 0); });
            EXPECT_TRUE(lint_of(clip).findings.empty()) << texts(lint_of(clip));
            // Without the second key the jump takes a whole frame and is not intended.
            const auto erase = [](auto& track) {
                track.times.erase(track.times.begin() + 20);
                track.values.erase(track.values.begin() + 20);
            };
            if (turns)
                erase(channel.rotation);
            else
                erase(channel.translation);
            ASSERT_EQ(lint_of(clip).findings.size(), 1u) << texts(lint_of(clip));
            EXPECT_EQ(lint_of(clip).findings[0].fault, Fault::Jump);
            EXPECT_EQ(lint_of(clip).findings[0].frame, 20u);
        }
}

TEST(Lint, FindsAClipOfAnotherSize) {
    Clip clip = winding(30.0, 30);
    const Skeleton skeleton = snake();
    for (std::size_t node = 1; node < 5; ++node) {
        clip.channels[node].translation.times = {0.0};
        clip.channels[node].translation.values = {skeleton[node].rest.translation};
    }
    EXPECT_TRUE(lint_of(clip).findings.empty());
    std::vector<Node> nodes = skeleton.nodes();
    nodes.push_back({"joint5", 4, {.translation = {0.0, 0.5, 0.0}}});
    const Skeleton longer = *Skeleton::make(nodes);
    clip.channels.push_back({.node = 5, .translation = {Interpolation::Linear, {0.0}, {{0.0, 0.5, 0.0}}}});
    for (Channel& channel : clip.channels)
        for (glm::dvec3& value : channel.translation.values) value *= 100.0;
    const BoneMap map = match_bones(longer);
    const LintReport report = lint(longer, map, clip);
    ASSERT_FALSE(report.findings.empty());
    EXPECT_EQ(report.findings[0].fault, Fault::Scale);
    EXPECT_NEAR(report.findings[0].amount, 100.0, 1e-6);
    const Expected<Clip> mended = cure(longer, map, clip, report.findings[0]);
    ASSERT_TRUE(mended);
    EXPECT_TRUE(lint(longer, map, *mended).findings.empty());
}

TEST(Lint, FindsZeroAndNegativeScales) {
    for (const double by : {0.0, -1.0}) {
        Clip clip = winding(30.0, 30);
        clip.channels[2].scale = {Interpolation::Linear, {0.0, 0.5}, {glm::dvec3(1.0), {1.0, by, 1.0}}};
        const LintReport report = lint_of(clip);
        ASSERT_EQ(report.findings.size(), 1u) << texts(report);
        EXPECT_EQ(report.findings[0].fault, Fault::Scale);
        EXPECT_EQ(report.findings[0].frame, 15u);
        EXPECT_EQ(report.findings[0].amount, by);
        EXPECT_FALSE(report.findings[0].has_cure);
        const Skeleton skeleton = snake();
        EXPECT_EQ(cure(skeleton, match_bones(skeleton), clip, report.findings[0]).code(),
                  ErrorCode::InvalidArgument);
    }
}

/// Keys of an attached node stay in its old parent's space, and so do the sizes they are compared with.
TEST(Lint, ComparesKeysOfAnAttachedNodeInTheirOwnSpace) {
    std::vector<Node> nodes = snake().nodes();
    nodes.push_back({"side", 0, {.translation = {0.0, 0.5, 0.0}, .scale = {-0.01, 0.01, 0.01}}});
    Skeleton skeleton = *Skeleton::make(nodes);
    Clip clip = winding(30.0, 30);
    for (const char* name : {"joint4", "joint3", "joint2"}) {
        const std::size_t node = *skeleton.find(name);
        const auto moved = attached(skeleton, node, *skeleton.find("side"));
        ASSERT_TRUE(moved) << moved.message();
        Channel& channel = clip.channels[node];
        channel.scale = {Interpolation::Linear, {0.0, 0.5}, {glm::dvec3(1.0), glm::dvec3(1.0)}};
        channel.translation = {Interpolation::Linear, {0.0}, {skeleton[node].rest.translation}};
        const LintReport report = lint(*moved, match_bones(*moved), clip);
        EXPECT_TRUE(report.findings.empty()) << texts(report);
        channel.scale.values[1].y = -1.0;
        EXPECT_EQ(lint(*moved, match_bones(*moved), clip).findings.size(), 1u) << name;
        channel.scale = {};
    }
    // A clip a hundred times as large is found.
    for (const char* name : {"joint1", "joint2", "joint3", "joint4"})
        clip.channels[*skeleton.find(name)].translation = {
            Interpolation::Linear, {0.0}, {skeleton[*skeleton.find(name)].rest.translation}};
    clip.channels.push_back(
        {.node = 5, .translation = {Interpolation::Linear, {0.0}, {skeleton[5].rest.translation}}});
    skeleton = *attached(skeleton, 4, 5);
    EXPECT_TRUE(lint(skeleton, match_bones(skeleton), clip).findings.empty());
    for (Channel& channel : clip.channels)
        for (glm::dvec3& value : channel.translation.values) value *= 100.0;
    const LintReport report = lint(skeleton, match_bones(skeleton), clip);
    ASSERT_FALSE(report.findings.empty());
    EXPECT_EQ(report.findings[0].fault, Fault::Scale);
}

/// As attach.hpp says: below a bone that is scaled unevenly, a node keeps its position but not its axes.
TEST(Lint, AnAttachedNodeKeepsItsPositionBelowAnUnevenScale) {
    std::vector<Node> nodes = snake().nodes();
    nodes.push_back({"side", 0, {.translation = {0.3, 0.5, 0.0}}});
    const Skeleton before = *Skeleton::make(nodes), after = *attached(before, 4, 5);
    Clip clip = winding(30.0, 30);
    for (const bool even : {true, false}) {
        const glm::dvec3 scale = even ? glm::dvec3(2.0) : glm::dvec3(1.0, 3.0, 1.0);
        clip.channels.resize(5);
        clip.channels.push_back({.node = 5, .scale = {Interpolation::Linear, {0.0}, {scale}}});
        bool same = true;
        for (double time = 0.0; time < 0.9; time += 0.05) {
            std::vector<rig::Transform> pose(6);
            std::vector<Placement> was(6), is(6);
            sample(clip, before, time, pose);
            place(before, pose, was);
            sample(clip, after, time, pose);
            place(after, pose, is);
            EXPECT_LT(glm::distance(was[4].position, is[4].position), 1e-12);
            same = same && is_same_place(was[4], is[4]);
        }
        EXPECT_EQ(same, even);
    }
}

/// The feet stand still while the hips rise until the legs are straight, and then stop abruptly.
Clip snapping_legs(const Skeleton& skeleton) {
    Clip clip{.name = "rise", .duration = 1.5, .channels = {}};
    for (const char* name :
         {"Hips", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "RightUpperLeg", "RightLowerLeg", "RightFoot"})
        clip.channels.push_back({.node = *skeleton.find(name)});
    const glm::dvec3 thigh(0, -0.42, 0.01), shin(0, -0.43, -0.01);
    const double a = glm::length(thigh), b = glm::length(shin);
    for (int i = 0; i <= 90; ++i) {
        const double degrees = i < 44 ? 12.0 : i == 44 ? 11.0 : i == 45 ? 8.0 : 1.0, time = i / 60.0;
        const double d = std::sqrt(a * a + b * b + 2.0 * a * b * std::cos(degrees * std::acos(-1.0) / 180.0));
        const double far = (d * d + a * a - b * b) / (2.0 * d);
        const glm::dvec3 knee(0, -far, std::sqrt(a * a - far * far)), ankle(0, -d, 0);
        const glm::dquat upper(glm::normalize(thigh), glm::normalize(knee)),
            lower(glm::normalize(shin), glm::normalize(ankle - knee));
        clip.channels[0].translation.times.push_back(time);
        clip.channels[0].translation.values.push_back({0, 0.09 + d + 0.06, 0});
        for (const std::size_t leg : {1u, 4u}) {
            const glm::dquat turns[]{upper, glm::inverse(upper) * lower, glm::inverse(lower)};
            for (std::size_t k = 0; k < 3; ++k) {
                clip.channels[leg + k].rotation.times.push_back(time);
                clip.channels[leg + k].rotation.values.push_back(turns[k]);
            }
        }
    }
    return clip;
}

TEST(Lint, SoftensALegThatSnapsStraightWithin5MmOfItsFoot) {
    const Skeleton skeleton = make_figure({});
    const BoneMap map = match_bones(skeleton);
    const Clip clip = snapping_legs(skeleton);
    const auto knees = [&](const Clip& judged) {
        std::vector<Finding> found = lint(skeleton, map, judged).findings;
        std::erase_if(found, [](const Finding& each) { return each.fault != Fault::KneePop; });
        return found;
    };
    const std::vector<Finding> found = knees(clip);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_TRUE(found[0].snaps && found[0].has_cure) << found[0].text;
    const Clip both = *cure(skeleton, map, clip, found[0]);
    EXPECT_TRUE(knees(both).empty()) << "the hips are lowered, and the other leg snaps no more";
    std::vector<rig::Transform> was(skeleton.size()), is(skeleton.size());
    double most = 0.0, straightest = 1e9;
    for (double time = 0.0; time < clip.duration; time += 1.0 / 240.0) {
        sample(clip, skeleton, time, was);
        sample(both, skeleton, time, is);
        const auto before = positions_of(skeleton, was), after = positions_of(skeleton, is);
        for (const char* foot : {"LeftFoot", "RightFoot"})
            most = std::max(most, glm::distance(before[*skeleton.find(foot)], after[*skeleton.find(foot)]));
        const glm::dvec3 hip = after[*skeleton.find("LeftUpperLeg")],
                         knee = after[*skeleton.find("LeftLowerLeg")],
                         ankle = after[*skeleton.find("LeftFoot")];
        if (time > 0.75 && time < 0.85)
            straightest = std::min(straightest, glm::distance(hip, knee) + glm::distance(knee, ankle) -
                                                    glm::distance(hip, ankle));
    }
    EXPECT_LT(most, 0.005 + 1e-4);
    EXPECT_GT(straightest, 0.003) << "no longer straight where it snapped";
    Finding other = found[0];
    other.node = map[Bone::Head].node;
    EXPECT_FALSE(cure(skeleton, map, clip, other));
}

TEST(Lint, AcceptsEmptySingleFrameAndVeryLongClips) {
    EXPECT_TRUE(lint_of({}).findings.empty());
    EXPECT_TRUE(lint_of(winding(30.0, 1)).findings.empty());
    EXPECT_TRUE(lint_of(winding(30.0, 2)).findings.empty());
    Clip age{.name = "age", .duration = 1e9, .channels = {{.node = 1}}};
    age.channels[0].rotation = {Interpolation::Linear, {0.0, 1e9}, {{1, 0, 0, 0}, {0, 1, 0, 0}}};
    const LintReport report = lint_of(age);
    EXPECT_EQ(report.frames, max_lint_frames);
    EXPECT_TRUE(report.findings.empty());
    EXPECT_EQ(lint(Skeleton(), BoneMap(), Clip()).frames, 1u);
}

}  // namespace
}  // namespace tendril::test
