// A clip played on another skeleton: limbs point where the source's do, hips move in proportion.
#include <tendril/humanoid/attach.hpp>
#include <tendril/humanoid/lint.hpp>
#include <tendril/humanoid/retarget.hpp>
#include <tendril/humanoid/soles.hpp>
#include <tendril/humanoid/t_pose.hpp>

#include "tests/core/humanoid_walk.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

struct RetargetFigure {
    Skeleton skeleton;
    BoneMap map;

    std::vector<Placement> at(const Clip& clip, double time) const {
        std::vector<rig::Transform> pose(skeleton.size());
        sample(clip, skeleton, time, pose);
        return placed(pose);
    }
    std::vector<Placement> placed(const std::vector<rig::Transform>& pose) const {
        std::vector<Placement> result(skeleton.size());
        place(skeleton, pose, result);
        return result;
    }
    const Placement& of(const std::vector<Placement>& all, Bone bone) const {
        return all[static_cast<std::size_t>(map[bone].node)];
    }
    /// Mean length of the two legs: thigh plus shin.
    double leg() const {
        const auto all = placed(rest_pose(skeleton));
        const auto between = [&](Bone a, Bone b) {
            return glm::distance(of(all, a).position, of(all, b).position);
        };
        return 0.5 * (between(Bone::LeftUpperLeg, Bone::LeftLowerLeg) +
                      between(Bone::LeftLowerLeg, Bone::LeftFoot) +
                      between(Bone::RightUpperLeg, Bone::RightLowerLeg) +
                      between(Bone::RightLowerLeg, Bone::RightFoot));
    }
};

/// A body with limbs of any length, its own rest pose and bone axes, turned about Y, some bones missing.
RetargetFigure random_body(RandomPoses& random, bool has_extras) {
    std::vector<Node> nodes{{"root", -1, {.rotation = random.turn(3.0)}}};
    RetargetFigure body;
    std::vector<Placement> placed{placement(nodes[0].rest)};
    std::map<std::string, std::size_t> index;
    const double size = random.from(0.3, 3.0), angle = random.from(-3.0, 3.0);
    const glm::dquat about = glm::angleAxis(angle, glm::dvec3(0, 1, 0));
    for (const FigureNode& each : figure_nodes()) {
        std::string parent = each.parent;
        const std::string key = each.key;
        const bool extra =
            key == "UpperChest" || key == "LeftShoulder" || key == "RightShoulder" || key == "Neck";
        if (extra && !has_extras) continue;
        const auto pose_of = [&](const std::string& name) {
            for (const FigureNode& other : figure_nodes())
                if (other.key == name) return other;
            return each;
        };
        while (!parent.empty() && !index.contains(parent)) parent = pose_of(parent).parent;
        const std::size_t above = parent.empty() ? 0 : index.at(parent);
        const glm::dvec3 from = parent.empty() ? glm::dvec3(0.0) : pose_of(parent).at;
        glm::dvec3 way = about * (each.at - from) * size;
        if (key.find("Arm") != key.npos || key.find("Leg") != key.npos || key.find("Hand") != key.npos ||
            key.find("Foot") != key.npos)
            way = random.turn(0.3) * way * random.from(0.7, 1.4);
        const glm::dvec3 at = parent.empty() ? way : placed[above].position + way;
        const Placement global = placement({.translation = at, .rotation = random.turn(3.0)});
        nodes.push_back({key, static_cast<std::int32_t>(above), relative(placed[above], global)});
        placed.push_back(global);
        index[key] = nodes.size() - 1;
    }
    body.skeleton = *Skeleton::make(std::move(nodes));
    for (std::size_t i = 0; i < bone_count; ++i)
        if (const auto node = body.skeleton.find(humanoid::name(static_cast<Bone>(i))))
            body.map.bones[i] = {static_cast<std::int32_t>(*node), 1.0, "by name"};
    review(body.map, body.skeleton);
    return body;
}

/// The same body, with a left foot that was a child of the root in its file (attach.hpp).
RetargetFigure with_loose_foot(RetargetFigure body) {
    const std::size_t foot = static_cast<std::size_t>(body.map[Bone::LeftFoot].node);
    std::vector<Node> nodes = body.skeleton.nodes();
    const auto rest = body.placed(rest_pose(body.skeleton));
    const auto leg = static_cast<std::size_t>(nodes[foot].parent);
    nodes[foot].parent = 0;
    nodes[foot].rest = relative(rest[0], rest[foot]);
    body.skeleton = *attached(*Skeleton::make(std::move(nodes)), foot, leg);
    return body;
}

/// A clip high above the ground, so that ground contact does not hold the feet.
Clip random_clip(RandomPoses& random, const RetargetFigure& body) {
    Clip clip{.name = "any", .duration = 1.0, .channels = {}};
    for (std::size_t node = 0; node < body.skeleton.size(); ++node) {
        Channel channel{.node = node};
        const rig::Transform& rest = body.skeleton[node].rest;
        for (const double time : {0.0, 0.31, 1.0}) {
            channel.rotation.times.push_back(time);
            channel.rotation.values.push_back(glm::normalize(rest.rotation * random.turn(0.8)));
            if (body.map[Bone::Hips].node != static_cast<std::int32_t>(node)) continue;
            channel.translation.times.push_back(time);
            const glm::dvec3 way(random.from(-1, 1), random.from(99, 101), random.from(-1, 1));
            const std::int32_t parent = body.skeleton[node].parent;
            const auto all = body.placed(rest_pose(body.skeleton));
            const glm::dquat above =
                parent < 0 ? glm::dquat(1, 0, 0, 0) : all[static_cast<std::size_t>(parent)].rotation();
            channel.translation.values.push_back(rest.translation + glm::inverse(above) * way);
        }
        clip.channels.push_back(std::move(channel));
    }
    return clip;
}

/// Takes x, y, z to the body's left, up and forward.
glm::dmat3 frame_of(const RetargetFigure& body) {
    const Facing at = facing(body.skeleton, body.map);
    return {glm::cross(at.up, at.forward), at.up, at.forward};
}

TEST(HumanoidRetarget, LimbsPointAsTheSourcesAndHipsMoveInProportion) {
    constexpr std::pair<Bone, Bone> limbs[]{
        {Bone::LeftUpperArm, Bone::LeftLowerArm},   {Bone::LeftLowerArm, Bone::LeftHand},
        {Bone::RightUpperArm, Bone::RightLowerArm}, {Bone::RightLowerArm, Bone::RightHand},
        {Bone::LeftUpperLeg, Bone::LeftLowerLeg},   {Bone::LeftLowerLeg, Bone::LeftFoot},
        {Bone::RightUpperLeg, Bone::RightLowerLeg}, {Bone::RightLowerLeg, Bone::RightFoot}};
    RandomPoses random(7);
    for (int i = 0; i < 60; ++i) {
        const RetargetFigure from = random_body(random, i % 2 == 0), plain = random_body(random, i % 3 == 0),
                             to = i % 4 == 1 ? with_loose_foot(plain) : plain;
        const Clip clip = random_clip(random, from);
        ASSERT_TRUE(check(clip, from.skeleton));
        const auto made = retarget({from.skeleton, from.map}, clip, {to.skeleton, to.map});
        ASSERT_TRUE(made) << made.message();
        ASSERT_TRUE(check(made->clip, to.skeleton));
        EXPECT_NEAR(made->scale, to.leg() / from.leg(), 1e-9);
        const glm::dmat3 turn = frame_of(to) * glm::transpose(frame_of(from));
        const auto first_from = from.at(clip, 0.0), first_to = to.at(made->clip, 0.0);
        for (const double time : {0.0, 1.0 / 60.0, 0.31, 0.5, 1.0}) {
            const auto was = from.at(clip, time), now = to.at(made->clip, time);
            for (const std::pair<Bone, Bone>& limb : limbs) {
                const Bone upper = limb.first, lower = limb.second;
                const auto direction = [&](const RetargetFigure& body, const std::vector<Placement>& all) {
                    return glm::normalize(body.of(all, lower).position - body.of(all, upper).position);
                };
                EXPECT_LT(glm::distance(turn * direction(from, was), direction(to, now)), 1e-6)
                    << i << ' ' << humanoid::name(upper) << " at " << time;
            }
            // Relative to the first frame: at rest not all of them are on the ground.
            const auto moved = [](const RetargetFigure& body, const std::vector<Placement>& all,
                                  const std::vector<Placement>& first) {
                return body.of(all, Bone::Hips).position - body.of(first, Bone::Hips).position;
            };
            EXPECT_LT(
                glm::distance(turn * moved(from, was, first_from) * made->scale, moved(to, now, first_to)),
                1e-6);
        }
    }
}

/// This holds also for a file with its nodes in another order.
TEST(HumanoidRetarget, AnEqualFigureGetsTheClipItself) {
    RandomPoses random(3);
    for (int i = 0; i < 10; ++i) {
        RetargetFigure body = random_body(random, i % 2 == 0);
        if (i % 3 == 1) body = with_loose_foot(body);
        Clip clip = random_clip(random, body);
        clip.channels[1].rotation.interpolation = Interpolation::Step;
        clip.channels[2].scale = {Interpolation::Linear, {0.5}, {{1.0, 1.1, 1.0}}};
        const auto made = retarget({body.skeleton, body.map}, clip, {body.skeleton, body.map});
        ASSERT_TRUE(made);
        EXPECT_TRUE(made->clip == clip && made->left_out.empty() && made->at_rest.empty());
        const auto count = static_cast<std::int32_t>(body.skeleton.size());
        std::vector<Node> nodes(body.skeleton.size());
        const auto moved = [&](std::int32_t node) { return node < 0 ? node : count - 1 - node; };
        for (std::int32_t k = 0; k < count; ++k) {
            Node& node = nodes[static_cast<std::size_t>(moved(k))];
            node = body.skeleton[static_cast<std::size_t>(k)];
            node.parent = moved(node.parent);
            if (node.keys) node.keys->parent = moved(node.keys->parent);
        }
        RetargetFigure other{*Skeleton::make(nodes), body.map};
        for (BoneMatch& each : other.map.bones) each.node = moved(each.node);
        const auto there = retarget({body.skeleton, body.map}, clip, {other.skeleton, other.map});
        ASSERT_TRUE(there) << there.message();
        for (std::size_t k = 0; k < clip.channels.size(); ++k) {
            Channel expected = clip.channels[k];
            expected.node = static_cast<std::size_t>(moved(static_cast<std::int32_t>(expected.node)));
            EXPECT_EQ(there->clip.channels.at(k), expected);
        }
        // At another size the steps are longer; with another leg length it is another figure.
        std::vector<Node> large = body.skeleton.nodes();
        for (Node& each : large) {
            each.rest.translation *= 2.0;
            if (each.keys) each.keys->rest.translation *= 2.0;
        }
        const Skeleton twice = *Skeleton::make(large);
        const auto far = retarget({body.skeleton, body.map}, clip, {twice, body.map});
        ASSERT_TRUE(far);
        for (std::size_t k = 0; k < clip.channels.size(); ++k) {
            EXPECT_EQ(far->clip.channels[k].rotation, clip.channels[k].rotation);
            for (std::size_t key = 0; key < clip.channels[k].translation.values.size(); ++key)
                EXPECT_EQ(far->clip.channels[k].translation.values[key],
                          2.0 * clip.channels[k].translation.values[key]);
        }
        nodes[static_cast<std::size_t>(other.map[Bone::LeftFoot].node)].rest.translation *= 1.001;
        other.skeleton = *Skeleton::make(nodes);
        const auto unlike = retarget({body.skeleton, body.map}, clip, {other.skeleton, other.map});
        ASSERT_TRUE(unlike);
        EXPECT_NE(unlike->scale, 1.0);
    }
}

TEST(HumanoidRetarget, TheRootTravelsAndHelpersFollowTheirBones) {
    RandomPoses random(11);
    for (int i = 0; i < 20; ++i) {
        const RetargetFigure from = random_body(random, true);
        RetargetFigure to = random_body(random, false);
        std::vector<Node> nodes = to.skeleton.nodes();
        const auto rest_of_body = to.placed(rest_pose(to.skeleton));
        const auto add = [&](const char* name, std::int32_t parent, const glm::dvec3& at) {
            const Placement above = parent < 0 ? Placement() : rest_of_body[static_cast<std::size_t>(parent)];
            const Placement own = placement({.translation = at, .rotation = random.turn(3.0)});
            nodes.push_back({name, parent, relative(above, own)});
            return nodes.size() - 1;
        };
        const auto stood = [&](Bone bone) { return to.of(rest_of_body, bone).position; };
        const glm::dvec3 far(0.0, 0.0, 2.0 * to.leg());
        const std::size_t foot =
                              add("ik_foot_l", 0, stood(Bone::LeftFoot) + glm::dvec3(0, -0.05, 0) * to.leg()),
                          knee = add("pole_l", 0, stood(Bone::LeftLowerLeg) + far),
                          rig = add("rig", -1, -far), camera = add("camera", -1, 2.0 * far);
        nodes.push_back(
            {"ik_hand_r", static_cast<std::int32_t>(rig),
             relative(placement(nodes[rig].rest), placement({.translation = stood(Bone::RightHand)}))});
        const std::size_t hand = nodes.size() - 1;
        to.skeleton = *Skeleton::make(std::move(nodes));
        const Clip clip = random_clip(random, from);
        const auto made = retarget({from.skeleton, from.map}, clip, {to.skeleton, to.map});
        ASSERT_TRUE(made) << made.message();
        EXPECT_EQ(made->helpers, (std::vector<std::size_t>{knee, rig, camera}));
        const auto rest = to.placed(rest_pose(to.skeleton));
        const auto seen = [](const std::vector<Placement>& all, std::size_t node, std::size_t by) {
            return glm::inverse(all[by].rotation()) * (all[node].position - all[by].position);
        };
        const auto node_of = [&](Bone bone) { return static_cast<std::size_t>(to.map[bone].node); };
        for (const double time : {0.0, 0.31, 0.6, 1.0}) {
            const auto now = to.at(made->clip, time);
            const glm::dvec3 way = to.of(now, Bone::Hips).position - to.of(rest, Bone::Hips).position;
            for (const std::size_t each : {std::size_t{0}, knee, rig})
                EXPECT_LT(glm::distance(now[each].position - rest[each].position, {way.x, 0.0, way.z}), 1e-6);
            EXPECT_EQ(now[camera].position, rest[camera].position);
            const bool is_key = time != 0.6;
            for (const auto& [helper, bone] :
                 {std::pair{foot, node_of(Bone::LeftFoot)}, {hand, node_of(Bone::RightHand)}})
                EXPECT_LT(glm::distance(seen(now, helper, bone), seen(rest, helper, bone)),
                          is_key ? 1e-6 : 1e-3 * to.leg());
        }
    }
}

/// The figure with other proportions, arms hanging at rest, toes turned out, and hands rotated.
RetargetFigure other_figure(double legs, double feet, double hips) {
    RetargetFigure body{make_figure({}), {}};
    std::vector<Node> nodes = body.skeleton.nodes();
    const auto stretch = [&](const char* name, double by) {
        Node& node = nodes[*body.skeleton.find(name)];
        node.rest.translation = node.rest.translation * by;
    };
    const auto about = [](const glm::dvec3& axis, double degrees) {
        return glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
    };
    double fall = 0.0;
    for (const std::string side : {"Left", "Right"}) {
        const double out = side == "Left" ? 1.0 : -1.0;
        const auto named = [&](const char* bone) -> Node& { return nodes[*body.skeleton.find(side + bone)]; };
        fall = (1.0 - legs) * (glm::length(named("LowerLeg").rest.translation) +
                               glm::length(named("Foot").rest.translation));
        named("UpperLeg").rest.translation.x *= hips;
        for (const char* bone : {"LowerLeg", "Foot"}) stretch((side + bone).c_str(), legs);
        for (const char* bone : {"Toes", "Toes end"}) named(bone).rest.translation.z *= feet;
        named("Foot").rest.rotation = about({0, 1, 0}, 15.0 * out);
        named("UpperArm").rest.rotation = about({0, 0, 1}, -50.0 * out);
        named("Hand").rest.rotation = about({0.3, 1, 0.5}, 25.0 * out);
    }
    nodes[*body.skeleton.find("Hips")].rest.translation.y -= fall;
    body.skeleton = *Skeleton::make(std::move(nodes));
    body.map = match_bones(body.skeleton);
    return body;
}

TEST(HumanoidRetarget, AWalkFitsOtherLegsAndHandsKeepTheirDirection) {
    const RetargetFigure from{make_figure({}), match_bones(make_figure({}))};
    const Clip walk = FigureWalk(from.skeleton, 3).clip();
    for (const auto& [legs, feet, hips] : {std::array{0.6, 1.0, 1.0}, {1.4, 0.6, 1.5}, {1.0, 1.4, 0.7}}) {
        const RetargetFigure to = other_figure(legs, feet, hips);
        const auto made = retarget({from.skeleton, from.map}, walk, {to.skeleton, to.map});
        ASSERT_TRUE(made) << made.message();
        EXPECT_NEAR(made->scale, legs, 1e-3);
        const Soles soles_from = *find_soles(from.skeleton, from.map),
                    soles_to = *find_soles(to.skeleton, to.map);
        std::array<SolePoints, 2> last{};
        std::array<glm::dvec2, 2> slid{};
        std::array<bool, 2> stood{};
        int stands = 0;
        for (int i = 0; i <= 360; ++i) {
            const double time = std::min(i / 120.0, walk.duration);
            const auto was = from.at(walk, time), now = to.at(made->clip, time);
            for (const auto& [hand, end] :
                 {std::pair{"LeftHand", "LeftHand end"}, {"RightHand", "RightHand end"}}) {
                const auto way = [&, a = std::string(hand), b = std::string(end)](const RetargetFigure& body,
                                                                                  const auto& all) {
                    return glm::normalize(all[*body.skeleton.find(b)].position -
                                          all[*body.skeleton.find(a)].position);
                };
                EXPECT_LT(glm::distance(way(from, was), way(to, now)), 1e-6);
            }
            const auto before = sole_points(soles_from, was), after = sole_points(soles_to, now);
            for (std::size_t foot = 0; foot < 2; ++foot) {
                const bool flat =
                    std::abs(before[foot].heel.y) < 0.001 && std::abs(before[foot].toe.y) < 0.001;
                if (flat) {
                    ++stands;
                    EXPECT_NEAR(after[foot].heel.y, 0.0, 0.005) << legs << " at " << time;
                    EXPECT_NEAR(after[foot].toe.y, 0.0, 0.005) << legs << " at " << time;
                    const glm::dvec3 step = after[foot].toe - last[foot].toe;
                    slid[foot] = stood[foot] ? slid[foot] + glm::dvec2(step.x, step.z) : glm::dvec2(0.0);
                    EXPECT_LT(glm::length(slid[foot]), 0.01) << legs << " at " << time;
                }
                stood[foot] = flat;
                last[foot] = after[foot];
            }
        }
        EXPECT_GT(stands, 100);
        for (const Finding& each : lint(to.skeleton, to.map, made->clip).findings)
            ADD_FAILURE() << legs << ": " << each.text;
    }
}

/// Clips of the walk's first frames: 0 (no keys) to 5.
TEST(HumanoidRetarget, AClipMayHaveAnyNumberOfFrames) {
    const RetargetFigure from{make_figure({}), match_bones(make_figure({}))}, to = other_figure(0.8, 1, 1);
    for (std::size_t frames = 0; frames < 6; ++frames)
        for (const Bone missing : {Bone::Head, Bone::LeftFoot, Bone::RightLowerLeg}) {
            SCOPED_TRACE(std::to_string(frames) + " frames, without " + humanoid::name(missing));
            Clip clip = FigureWalk(from.skeleton, 3).clip();
            const auto cut = [&](auto& track) {
                track.times.resize(std::min(frames, track.times.size()));
                track.values.resize(track.times.size(), {});
            };
            for (Channel& each : clip.channels) cut(each.rotation), cut(each.translation);
            clip.duration = frames < 2 ? 0.0 : clip.channels[0].translation.times.back();
            BoneMap map = from.map;
            map[missing].node = -1;
            review(map, from.skeleton);
            const auto made = retarget({from.skeleton, map}, clip, {to.skeleton, to.map});
            ASSERT_TRUE(made) << made.message();
            ASSERT_TRUE(check(made->clip, to.skeleton));
            for (const Channel& each : made->clip.channels)
                EXPECT_EQ(each.rotation.times.size(), std::max<std::size_t>(frames, 1));
            for (const double rate : {0.0, 30.0, 1000.0})
                for (const Finding& each : lint(to.skeleton, to.map, made->clip, {.rate = rate}).findings)
                    EXPECT_TRUE(!each.has_cure || cure(to.skeleton, to.map, made->clip, each, {.rate = rate}))
                        << each.text;
        }
}

/// A figure that stands for a second and then lies down on its back.
TEST(HumanoidRetarget, LyingDownDoesNotChangeHowItStands) {
    const RetargetFigure from{make_figure({}), match_bones(make_figure({}))}, to = other_figure(0.7, 1, 1);
    const auto clip = [&](int frames) {
        Clip made{.name = "lie", .duration = (frames - 1) / 30.0, .channels = {{.node = 0}}};
        Channel& hips = made.channels[0];
        hips.node = static_cast<std::size_t>(from.map[Bone::Hips].node);
        for (int i = 0; i < frames; ++i) {
            const double lies = std::clamp((i - 30) / 20.0, 0.0, 1.0);
            hips.rotation.times.push_back(i == frames - 1 ? made.duration : i / 30.0);
            hips.rotation.values.push_back(glm::angleAxis(-glm::radians(90.0 * lies), glm::dvec3(1, 0, 0)));
            hips.translation.values.push_back({0.0, 1.0 - 0.9 * lies, 0.0});
        }
        hips.translation.times = hips.rotation.times;
        return made;
    };
    const auto at_first = [&](int frames) {
        const auto made = retarget({from.skeleton, from.map}, clip(frames), {to.skeleton, to.map});
        EXPECT_TRUE(made) << made.message();
        return to.at(made->clip, 0.0);
    };
    const auto whole = at_first(300);
    for (const int frames : {1, 2, 4, 30, 60}) {
        const auto cut = at_first(frames);
        for (std::size_t i = 0; i < cut.size(); ++i)
            EXPECT_LT(glm::distance(cut[i].position, whole[i].position), 0.005)
                << frames << ' ' << to.skeleton[i].name;
    }
}

TEST(HumanoidRetarget, FeetStandLevelOnLegsOfUnequalLength) {
    const RetargetFigure from{make_figure({}), match_bones(make_figure({}))};
    RetargetFigure to = from;
    std::vector<Node> nodes = to.skeleton.nodes();
    nodes[*to.skeleton.find("LeftFoot")].rest.translation *= 0.95;
    to.skeleton = *Skeleton::make(std::move(nodes));
    const Clip walk = FigureWalk(from.skeleton, 3).clip();
    const auto made = retarget({from.skeleton, from.map}, walk, {to.skeleton, to.map});
    ASSERT_TRUE(made) << made.message();
    const Soles soles = *find_soles(from.skeleton, from.map);
    std::array<double, 2> sum{};
    std::array<int, 2> count{};
    for (int i = 0; i <= 360; ++i) {
        const double time = std::min(i / 120.0, walk.duration);
        const auto before = sole_points(soles, from.at(walk, time));
        const auto now = to.at(made->clip, time);
        for (std::size_t foot = 0; foot < 2; ++foot) {
            if (std::abs(before[foot].heel.y) > 0.001 || std::abs(before[foot].toe.y) > 0.001) continue;
            sum[foot] += to.of(now, foot == 0 ? Bone::LeftFoot : Bone::RightFoot).position.y;
            ++count[foot];
        }
    }
    ASSERT_GT(std::min(count[0], count[1]), 30);
    EXPECT_NEAR(sum[0] / count[0], sum[1] / count[1], 0.003);
}

TEST(HumanoidRetarget, ToesThatPointUpInAZeroPoseLieFlatOnTheGround) {
    const RetargetFigure from{make_figure({}), match_bones(make_figure({}))};
    RetargetFigure to = from;
    std::vector<Node> nodes = to.skeleton.nodes();
    for (const char* name : {"LeftToes", "RightToes"})
        nodes[*to.skeleton.find(name)].rest.rotation =
            glm::angleAxis(glm::radians(-60.0), glm::dvec3(1, 0, 0));
    to.skeleton = *Skeleton::make(std::move(nodes));
    const Clip walk = FigureWalk(from.skeleton, 3).clip();
    const auto made = retarget({from.skeleton, from.map}, walk, {to.skeleton, to.map});
    ASSERT_TRUE(made) << made.message();
    const auto pitch = [](const RetargetFigure& body, const std::vector<Placement>& all) {
        const glm::dvec3 way =
            all[*body.skeleton.find("LeftToes end")].position - all[*body.skeleton.find("LeftToes")].position;
        return way.y / glm::length(way);
    };
    const double level = pitch(from, from.placed(rest_pose(from.skeleton)));
    for (const double time : {0.0, 0.4, 0.8, 1.2}) {
        const double before = pitch(from, from.at(walk, time)) - level,
                     after = pitch(to, to.at(made->clip, time));
        EXPECT_NEAR(before, after, 0.1) << "at " << time;
    }
}

TEST(HumanoidRetarget, PalmBonesBesideTheHandTurnWithIt) {
    RandomPoses random(13);
    const RetargetFigure from{make_figure({}), match_bones(make_figure({}))};
    RetargetFigure to = from;
    std::vector<Node> nodes = to.skeleton.nodes();
    const std::size_t hand = *to.skeleton.find("LeftHand"), palm = nodes.size();
    nodes.push_back({"palm.02.L", nodes[hand].parent, nodes[hand].rest});
    nodes.back().rest.translation += glm::dvec3(0.0, 0.0, 0.02);
    to.skeleton = *Skeleton::make(std::move(nodes));
    const auto rest = to.placed(rest_pose(to.skeleton));
    const Clip clip = random_clip(random, from);
    const auto made = retarget({from.skeleton, from.map}, clip, {to.skeleton, to.map});
    ASSERT_TRUE(made) << made.message();
    const auto seen = [&](const std::vector<Placement>& all) {
        return glm::inverse(all[hand].rotation()) * (all[palm].position - all[hand].position);
    };
    for (const double time : {0.0, 0.31, 1.0}) {
        const auto now = to.at(made->clip, time);
        EXPECT_LT(glm::distance(seen(now), seen(rest)), 1e-6);
    }
}

TEST(HumanoidRetarget, FingersAreMatchedByName) {
    const auto with_fingers = [](const std::vector<std::string>& names, double bent) {
        const Skeleton figure = make_figure({});
        std::vector<Node> nodes = figure.nodes();
        auto above = static_cast<std::int32_t>(*figure.find("LeftHand"));
        for (std::size_t i = 0; i < names.size(); ++i) {
            nodes.push_back({names[i], above, {.translation = {i == 0 ? 0.09 : 0.03, 0, 0}}});
            nodes.back().rest.rotation = glm::angleAxis(bent, glm::dvec3(0, 0, 1));
            above = static_cast<std::int32_t>(nodes.size() - 1);
        }
        RetargetFigure body{*Skeleton::make(std::move(nodes)), {}};
        body.map = match_bones(body.skeleton);
        return body;
    };
    // The target's fingers are bent at rest, and it has a palm bone.
    const RetargetFigure from = with_fingers({"LeftHandMiddle1", "LeftHandMiddle2", "LeftHandMiddle3"}, 0.0),
                         to = with_fingers(
                             {"middle_metacarpal_l", "middle_01_l", "middle_02_l", "middle_03_l"}, -0.2);
    Clip clip{.name = "fist", .duration = 1.0, .channels = {}};
    for (const char* name : {"LeftHandMiddle1", "LeftHandMiddle2", "LeftHandMiddle3"}) {
        Channel channel{.node = *from.skeleton.find(name)};
        channel.rotation.times = {0.0, 1.0};
        channel.rotation.values = {glm::dquat(1, 0, 0, 0), glm::angleAxis(-0.7, glm::dvec3(0, 0, 1))};
        clip.channels.push_back(std::move(channel));
    }
    const auto made = retarget({from.skeleton, from.map}, clip, {to.skeleton, to.map});
    ASSERT_TRUE(made) << made.message();
    for (const double time : {0.0, 0.5, 1.0}) {
        const auto was = from.at(clip, time), now = to.at(made->clip, time);
        const auto way = [](const RetargetFigure& body, const auto& all, const char* a, const char* b) {
            return glm::normalize(all[*body.skeleton.find(b)].position -
                                  all[*body.skeleton.find(a)].position);
        };
        EXPECT_LT(glm::distance(way(from, was, "LeftHandMiddle1", "LeftHandMiddle2"),
                                way(to, now, "middle_01_l", "middle_02_l")),
                  1e-6);
        EXPECT_LT(glm::distance(way(from, was, "LeftHandMiddle2", "LeftHandMiddle3"),
                                way(to, now, "middle_02_l", "middle_03_l")),
                  1e-6);
    }
}

TEST(HumanoidRetarget, ListsTheBonesThatOnlyOneOfThemHas) {
    RandomPoses random(5);
    const RetargetFigure full = random_body(random, true), plain = random_body(random, false);
    const Clip clip = random_clip(random, full);
    const std::vector<Bone> extras{Bone::UpperChest, Bone::Neck, Bone::LeftShoulder, Bone::RightShoulder};
    EXPECT_EQ(retarget({full.skeleton, full.map}, clip, {plain.skeleton, plain.map})->left_out, extras);
    const Clip back = random_clip(random, plain);
    const auto made = retarget({plain.skeleton, plain.map}, back, {full.skeleton, full.map});
    EXPECT_EQ(made->at_rest, extras);
    for (const Channel& each : made->clip.channels) EXPECT_NE(full.skeleton[each.node].name, "Neck");
}

TEST(HumanoidRetarget, UnsuitableInputIsRefused) {
    RandomPoses random(9);
    const RetargetFigure body = random_body(random, true);
    const Clip clip = random_clip(random, body);
    BoneMap none;
    const auto said = [&](const BoneMap& from, const Clip& of, const BoneMap& to) {
        return std::string(retarget({body.skeleton, from}, of, {body.skeleton, to}).message());
    };
    EXPECT_TRUE(says(said(none, clip, body.map), "retarget from.map Hips"));
    EXPECT_TRUE(says(said(body.map, clip, none), "retarget to.map Hips"));
    BoneMap twice = body.map;
    twice[Bone::Spine].node = twice[Bone::Head].node;
    EXPECT_NE(said(twice, clip, body.map), "");
    Clip bad = clip;
    bad.channels[0].node = 1000;
    EXPECT_NE(said(body.map, bad, body.map), "");
    Clip endless = clip;
    endless.duration = 1e6;
    const RetargetFigure other = random_body(random, true);
    EXPECT_TRUE(says(retarget({body.skeleton, body.map}, endless, {other.skeleton, other.map}).message(),
                     "retarget clip 100000"));
}

}  // namespace
}  // namespace tendril::test
