// Motions from real files on characters from real files: each of the shared walks on each of the shared
// humanoids. Feet stand and land on the ground as the source's do, no knee pops, the root moves along, and
// arms, hands and heads point as the source's do. Exceptions are stated in numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <tendril/humanoid/lint.hpp>
#include <tendril/humanoid/retarget.hpp>
#include <tendril/humanoid/soles.hpp>
#include <tendril/humanoid/t_pose.hpp>

#include "app/io/character/character.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using namespace humanoid;

constexpr double to_degrees = 57.29577951308232;

/// A figure in the poses of a clip.
class Walker {
  public:
    Walker(const Skeleton& skeleton, const BoneMap& map, const Clip& clip)
        : skeleton_(skeleton), map_(map), clip_(clip), facing_(facing(skeleton, map)) {
        place_at(0.0);
        rest_ = test_posed::placed_as(skeleton, rest_pose(skeleton));
        t_ = test_posed::placed_as(skeleton, t_pose(skeleton, map));
    }
    void place_at(double time) { placed_ = test_posed::placed_in(skeleton_, clip_, time); }
    bool has(Bone bone) const { return map_[bone].node >= 0; }
    std::size_t node(Bone bone) const { return static_cast<std::size_t>(map_[bone].node); }
    const glm::dvec3& at(Bone bone) const { return placed_[node(bone)].position; }
    /// In the figure's axes: left, up and forward.
    glm::dvec3 seen(const glm::dvec3& v) const {
        return {glm::dot(v, glm::cross(facing_.up, facing_.forward)), glm::dot(v, facing_.up),
                glm::dot(v, facing_.forward)};
    }
    glm::dvec3 way(Bone from, Bone to) const { return seen(glm::normalize(at(to) - at(from))); }
    /// A direction of the T-pose, rotated with the bone.
    glm::dvec3 turned(Bone bone, const glm::dvec3& direction) const {
        return seen(placed_[node(bone)].rotation() * (glm::inverse(t_[node(bone)].rotation()) * direction));
    }
    const Facing& directions() const { return facing_; }
    /// The direction from the wrist to the middle finger, or to the middle of the hand's other nodes.
    std::optional<glm::dvec3> hand(Bone bone) const {
        glm::dvec3 sum(0.0);
        int best = 0;
        for (std::size_t i = 0; i < skeleton_.size(); ++i) {
            if (!skeleton_.is_below(i, node(bone)) || i == node(bone)) continue;
            const glm::dvec3 away = placed_[i].position - at(bone);
            // Rigid on the hand: nodes between them are at the wrist or in the palm.
            bool rigid = glm::length(away) > 1e-4 * size() && !is_palm(i);
            for (std::size_t above = parent(i); above != node(bone); above = parent(above))
                rigid &= is_palm(above) || glm::distance(placed_[above].position, at(bone)) < 1e-4 * size();
            if (!rigid) continue;
            const auto named = [&](const char* word) { return says(i, word); };
            const int rank = named("mid") || named("finger2")     ? 3
                             : named("thumb") || named("finger0") ? 1
                                                                  : 2;
            if (rank < best) continue;
            if (rank > best) sum = glm::dvec3(0.0), best = rank;
            sum += glm::normalize(away);
        }
        if (best == 0) return std::nullopt;
        return seen(glm::normalize(sum));
    }
    /// The root's distance on the ground from its rest position below the hips.
    double root_behind() const {
        std::size_t root = node(Bone::Hips);
        while (skeleton_[root].parent >= 0) root = parent(root);
        const glm::dvec3 off = (placed_[root].position - at(Bone::Hips)) -
                               (rest_[root].position - rest_[node(Bone::Hips)].position);
        return root == node(Bone::Hips) ? 0.0 : std::hypot(off.x, off.z);
    }
    double size() const {
        return glm::distance(rest_[node(Bone::LeftUpperLeg)].position,
                             rest_[node(Bone::LeftLowerLeg)].position) +
               glm::distance(rest_[node(Bone::LeftLowerLeg)].position, rest_[node(Bone::LeftFoot)].position);
    }
    /// The sole's heel, ball and toe tip.
    std::array<glm::dvec3, 3> sole(const Soles& soles, std::size_t foot) const {
        const SolePoints points = sole_points(soles, placed_)[foot];
        const std::size_t toes = soles.feet[foot].toes;
        std::size_t tip = toes;
        double far = 0.0;
        for (std::size_t i = 0; i < skeleton_.size(); ++i)
            if (skeleton_.is_below(i, toes))
                if (const glm::dvec3 way = t_[i].position - t_[soles.feet[foot].foot].position;
                    std::hypot(way.x, way.z) > far)
                    far = std::hypot(way.x, way.z), tip = i;
        const glm::dvec3 ball = t_[toes].apply(soles.feet[foot].toe),
                         end(t_[tip].position.x, ball.y, t_[tip].position.z);
        const glm::dvec3 ankle = t_[soles.feet[foot].foot].position;
        if (std::hypot(ball.x - ankle.x, ball.z - ankle.z) > far)
            return {points.heel, points.toe, points.toe};
        // Toes that point up at rest do not show a sole: the figure stands on their joints.
        const glm::dvec3 &base = placed_[toes].position, &top = placed_[tip].position;
        if (t_[tip].position.y - t_[toes].position.y > 0.7 * glm::distance(base, top))
            return {base, base, top};
        return {points.heel, points.toe,
                placed_[toes].apply(glm::inverse(t_[toes].axes) * (end - t_[toes].position))};
    }

  private:
    std::size_t parent(std::size_t node) const { return static_cast<std::size_t>(skeleton_[node].parent); }
    bool says(std::size_t node, const char* word) const {
        std::string name;
        for (const char c : skeleton_[node].name) name += static_cast<char>(std::tolower(c));
        return name.find(word) != name.npos;
    }
    bool is_palm(std::size_t node) const { return says(node, "palm") || says(node, "carpal"); }

    const Skeleton& skeleton_;
    const BoneMap& map_;
    const Clip& clip_;
    Facing facing_;
    std::vector<Placement> placed_, rest_, t_;
};

struct Measured {
    double arms = 0.0, hands = 0.0, head = 0.0;  // degrees from the source's directions
    double off_ground = 0.0, slide = 0.0;        // metres for a person, while the source's foot stands
    double landing = 0.0;      // metres between the soles' heights in the last 0.1 s before the foot stands
    double left_behind = 0.0;  // metres between the root and its rest position below the hips
    std::map<std::string, int> faults{};    // lint's findings that are not in the source
    std::map<std::string, double> worst{};  // amount of the worst finding on the target, by fault
};

class Comparison {
  public:
    Comparison(const Character& from, const BoneMap& from_map, const Clip& clip, const Character& to,
               const BoneMap& to_map, const Clip& made)
        : was_(from.skeleton, from_map, clip), now_(to.skeleton, to_map, made) {
        const Soles soles = clip_soles(from.skeleton, from_map, *find_soles(from.skeleton, from_map), clip),
                    own = clip_soles(to.skeleton, to_map, *find_soles(to.skeleton, to_map), made);
        const double rate = frame_rate(clip), floor = clip_floor(from.skeleton, soles, clip);
        for (double i = 0.0; i <= std::floor(clip.duration * rate + 1e-6); ++i) {
            const double time = std::min(i / rate, clip.duration);
            was_.place_at(time), now_.place_at(time);
            compare_directions();
            found.left_behind = std::max(found.left_behind, now_.root_behind());
            for (std::size_t foot = 0; foot < 2; ++foot)
                compare_feet(foot, was_.sole(soles, foot), now_.sole(own, foot), floor, rate);
        }
        compare_landings(static_cast<std::size_t>(0.1 * rate));
        for (const Finding& each : lint(from.skeleton, from_map, clip).findings)
            --found.faults[name(each.fault)];
        for (const Finding& each : lint(to.skeleton, to_map, made).findings) {
            ++found.faults[name(each.fault)];
            double& worst = found.worst[name(each.fault)];
            worst = std::max(worst, each.amount);
        }
    }
    Measured found{};

  private:
    using Points = std::array<glm::dvec3, 3>;

    static double angle(const glm::dvec3& a, const glm::dvec3& b) {
        return to_degrees * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    }
    static std::size_t lowest(const Points& points) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
            if (points[i].y < points[best].y) best = i;
        return best;
    }
    void compare_directions() {
        constexpr std::pair<Bone, Bone> arms[]{{Bone::LeftUpperArm, Bone::LeftLowerArm},
                                               {Bone::LeftLowerArm, Bone::LeftHand},
                                               {Bone::RightUpperArm, Bone::RightLowerArm},
                                               {Bone::RightLowerArm, Bone::RightHand}};
        for (const auto& [upper, lower] : arms)
            found.arms = std::max(found.arms, angle(was_.way(upper, lower), now_.way(upper, lower)));
        for (const Bone hand : {Bone::LeftHand, Bone::RightHand}) {
            const auto before = was_.hand(hand), after = now_.hand(hand);
            if (before && after) found.hands = std::max(found.hands, angle(*before, *after));
        }
        const auto turned = [](const Walker& each, bool up) {
            return each.turned(Bone::Head, up ? each.directions().up : each.directions().forward);
        };
        for (const bool up : {false, true})
            found.head = std::max(found.head, angle(turned(was_, up), turned(now_, up)));
    }
    /// Compares feet less than 5 cm above the ground that will stand within 0.1 s.
    void compare_landings(std::size_t within) {
        for (const std::vector<Height>& all : heights_)
            for (std::size_t i = within; i + within < all.size(); ++i) {
                bool stood = false, will_stand = false;
                for (std::size_t k = i - within; k <= i; ++k) stood = stood || all[k].stands;
                for (std::size_t k = i + 1; k <= i + within; ++k) will_stand = will_stand || all[k].stands;
                if (stood || !will_stand || all[i].before > 0.05) continue;
                found.landing =
                    std::max(found.landing, std::abs(std::max(all[i].before, 0.0) - all[i].after));
            }
    }
    void compare_feet(std::size_t foot, const Points& before, const Points& after, double floor,
                      double rate) {
        const double size = was_.size() / person_leg, own_size = now_.size() / person_leg;
        const std::size_t low = lowest(before), own_low = lowest(after);
        Last& last = last_[foot];
        const bool stands = last.known && std::abs(before[low].y - floor) < 0.005 * size &&
                            glm::length(before[low] - last.before[low]) * rate < 0.2 * size;
        heights_[foot].push_back({(before[low].y - floor) / size, after[own_low].y / own_size, stands});
        if (stands) {
            found.off_ground = std::max(found.off_ground, std::abs(after[own_low].y) / own_size);
            const glm::dvec3 step = after[own_low] - last.after[own_low];
            if (last.stood) last.slid += glm::dvec2(step.x, step.z);
            found.slide = std::max(found.slide, glm::length(last.slid) / own_size);
        } else {
            last.slid = glm::dvec2(0.0);
        }
        last = {true, stands, before, after, last.slid};
    }

    static constexpr double person_leg = 0.85;
    struct Last {
        bool known = false, stood = false;
        Points before{}, after{};
        glm::dvec2 slid{0.0};
    };
    struct Height {
        double before = 0.0, after = 0.0;  // height of the soles above the ground, metres for a person
        bool stands = false;
    };
    Walker was_, now_;
    std::array<Last, 2> last_{};
    std::array<std::vector<Height>, 2> heights_{};
};

/// A walk, and the lint's tolerance for feet below its floor in millimetres: the lint lowers the ankle
/// without rotating it, which is too much for a heel that lands at 30 degrees.
struct Source {
    const char* file;
    const char* clip;
    double sinking = 0.0;
    double knee = 0.0;     ///< degrees that a knee snaps, by the lint
    double slide = 0.015;  ///< metres
};
const std::vector<Source>& retargeted_sources() {
    static const std::vector<Source> sources{
        Source{"characters/cmu_01_01.bvh", ""}, Source{"characters/cmu_12_01_walk.bvh", ""},
        Source{"characters/pab_walk.fbx", ""}, Source{"characters/cmu_91_48.fbx", ""},
        Source{"characters/cmu_91_50.fbx", "", 0.0, 0.0, 0.02}, Source{"characters/human_clip.glb", ""},
        Source{"characters/rigify_names.glb", ""}, Source{"characters/robot.glb", "Robot_Walking"},
        Source{"characters/robot.glb", "Robot_Running"}, Source{"characters/robot.glb", "Robot_Dance"},
        Source{"characters/robot.glb", "Robot_Jump"}, Source{"characters/robot.glb", "Robot_Sitting"},
        // Walks on the spot, with feet that always slide.
        Source{"characters/cesium_man.gltf", "", 64.0}, Source{"characters/mixed_orders.bvh", ""},
        Source{"characters/pab_skeleton.fbx", ""}, Source{"found/fbx_motionbuilder_jog.fbx", ""},
        // Two keys at one time hid a knee that snaps.
        Source{"found/bvh_z_up.bvh", "", 0.0, 19.0}, Source{"found/fbx_inherit_scale_human.fbx", ""}};
    return sources;
}
/// Tolerances, metres for a person. Larger if the rest pose does not show the soles: the lint then uses the
/// lowest joints, retarget() the points that find_soles() finds below them, up to 66 mm for feet without
/// toes. mixed_orders rests with its toes 60 degrees up, which the lint takes for their standing pose.
struct Target {
    const char* file;
    double off_ground = 0.005, landing = 0.015;
    double sinking = 0.0, skating = 0.0;  ///< by the lint, millimetres
    double knee = 0.0;                    ///< degrees that a knee snaps, by the lint
};
constexpr Target retargeted_targets[]{
    {"characters/human_male.glb"},
    {.file = "characters/robot.glb", .off_ground = 0.007, .landing = 0.017, .skating = 27},
    {"characters/zombie.glb"},
    {"characters/rigify_names.glb"},
    {"characters/pab_skeleton.fbx"},
    {.file = "characters/cesium_man.gltf", .off_ground = 0.006, .landing = 0.03},
    {.file = "characters/cmu_12_01_walk.bvh", .skating = 36},
    {.file = "found/fbx_motionbuilder_jog.fbx", .off_ground = 0.007},
    {.file = "found/fbx_inherit_scale_human.fbx", .landing = 0.022},
    {.file = "characters/cmu_01_01.bvh", .off_ground = 0.027, .landing = 0.026, .sinking = 60},
    {.file = "characters/mixed_orders.bvh",
     .off_ground = 0.028,
     .landing = 0.041,
     .sinking = 116,
     .knee = 6.5},
    {.file = "characters/cmu_91_48.fbx", .off_ground = 0.066, .landing = 0.074},
    {.file = "characters/cmu_91_50.fbx", .off_ground = 0.066, .landing = 0.074},
    {.file = "characters/pab_walk.fbx", .off_ground = 0.014, .landing = 0.026, .sinking = 60},
    {"characters/human_clip.glb"},
    {"found/bvh_z_up.bvh"}};

class RetargetedWalks : public testing::TestWithParam<Source> {
  protected:
    /// The character, in a plausible unit.
    static const Character& character(const std::string& file) {
        static std::map<std::string, Character> read;
        if (const auto found = read.find(file); found != read.end()) return found->second;
        Character& made = read[file] = read_character(test::characters_folder().parent_path() / file);
        const std::vector<Placement> rest = test_posed::placed(made, -1);
        const auto doubt = doubted_unit(bounds_at_rest(made, rest).height(), made.scale, bone_map(made));
        if (doubt && doubt->height > 10.0) read_as(made, doubt->unit.metres, made.space);
        return made;
    }
};

TEST_P(RetargetedWalks, FeetStandAndHandsPointAsInTheSource) {
    const Source& source = GetParam();
    if (!std::filesystem::exists(test::characters_folder().parent_path() / source.file)) GTEST_SKIP();
    const Character& from = character(source.file);
    const BoneMap from_map = bone_map(from);
    const Clip* clip = &from.clips.front();
    for (const Clip& each : from.clips)
        if (each.name == source.clip) clip = &each;
    const Clip walk = test_posed::first_seconds(*clip, 4.0);
    for (const Target& target : retargeted_targets) {
        SCOPED_TRACE(target.file);
        const Character& to = character(target.file);
        const BoneMap to_map = bone_map(to);
        const auto made = retarget({from.skeleton, from_map}, walk, {to.skeleton, to_map});
        ASSERT_TRUE(made) << made.message();
        ASSERT_TRUE(check(made->clip, to.skeleton));
        if (std::string(target.file) == source.file) {
            EXPECT_EQ(made->clip, walk);
            continue;
        }
        const Measured found = Comparison(from, from_map, walk, to, to_map, made->clip).found;
        EXPECT_LT(found.arms, 1.0);
        EXPECT_LT(found.hands, 5.0);
        EXPECT_LT(found.head, 5.0);
        EXPECT_LT(found.off_ground, target.off_ground);
        EXPECT_LT(found.slide, source.slide);
        EXPECT_LT(found.landing, target.landing);
        EXPECT_LT(found.left_behind, 1e-6);
        for (const auto& [fault, count] : found.faults) {
            const double most = fault == "skating"    ? target.skating
                                : fault == "knee_pop" ? std::max(target.knee, source.knee)
                                : fault == "sinking"  ? std::max(target.sinking, source.sinking)
                                                      : 0.0;
            if (count <= 0 || found.worst.at(fault) <= most) continue;
            const bool matters =
                fault == "knee_pop" || fault == "skating" || fault == "floating" || fault == "sinking";
            EXPECT_FALSE(matters) << count << " more " << fault << ", up to " << found.worst.at(fault);
        }
    }
}

TEST(RetargetedWalk, AFigureWithoutAPersonsBonesIsRefused) {
    const auto folder = test::characters_folder();
    if (!std::filesystem::exists(folder / "huesitos.fbx")) GTEST_SKIP();
    const Character from = read_character(folder / "cmu_12_01_walk.bvh"),
                    to = read_character(folder / "huesitos.fbx");
    const BoneMap from_map = bone_map(from), to_map = bone_map(to);
    const auto made = retarget({from.skeleton, from_map}, from.clips.front(), {to.skeleton, to_map});
    EXPECT_TRUE(test::says(made.message(), "retarget to.map Hips")) << made.message();
}

INSTANTIATE_TEST_SUITE_P(Shared, RetargetedWalks, testing::ValuesIn(retargeted_sources()),
                         [](const testing::TestParamInfo<Source>& each) {
                             std::string name;
                             for (const char c : std::string(each.param.file) + each.param.clip)
                                 if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                             return name;
                         });

}  // namespace
}  // namespace tendril::app
