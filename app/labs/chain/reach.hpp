// Mode Reach: the root stays and the tip reaches for the target. Settings, and the result of a solve.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <tendril/chain/chain.hpp>
#include <tendril/ik/active_limit.hpp>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/method.hpp>
#include <tendril/ik/options.hpp>
#include <tendril/ik/plane.hpp>
#include <tendril/ik/pole_turn.hpp>
#include <tendril/ik/report.hpp>
#include <tendril/ik/state.hpp>
#include <utility>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/json.hpp"
#include "app/io/solver_text.hpp"
#include "app/labs/kit/library_json.hpp"

namespace tendril::app {

class ChainRuntime;

inline constexpr int max_iterations = 10'000;  ///< keeps the program responsive
inline constexpr int default_restarts = 8;     ///< ik::Options' default; none while the target is dragged

/// The plane that the chain stays in, through its root.
struct ChainPlane {
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    ik::Side bend = ik::Side::Free;
    std::vector<ik::AngleLimit> limits;  ///< one per bone, or empty
    std::vector<ik::Limit> aside{};      ///< limits from before the plane was set, one per bone; or empty

    bool operator==(const ChainPlane&) const = default;
};

struct ReachSettings {
    ik::Method method = ik::Method::Fabrik;
    ik::Options options{};            ///< without plane and limits, which solver_options() adds
    std::optional<ChainPlane> plane;  ///< in every mode; `limits` are then empty, since a plane has its own
    std::vector<ik::Limit> limits;    ///< one per bone, at the joint that it starts from; or empty
    /// The solver's state between solves; no bones before the first solve. Its rotations are maintained only
    /// if there are limits.
    ik::State state;

    bool operator==(const ReachSettings& other) const;
};

/// The result of the last solve.
struct ReachResult {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::optional<ik::ActiveLimit> active_limit;  ///< the limit that keeps the tip from the target, if any
    bool operator==(const ReachResult&) const = default;
};

/// Positions of the segments, head first.
std::vector<glm::vec3> positions(const Chain& chain);
/// Joints relative to the root, as a solver's state stores them.
std::vector<glm::vec3> from_root(const std::vector<glm::vec3>& joints);
/// The shortest rotation from one unit vector to another.
glm::quat least_rotation(glm::vec3 from, glm::vec3 to);
/// Each bone's rotation from rest at `joints`: `rotations` (from the last solve, or empty) followed by the
/// shortest rotation onto the bone's present direction. `rest`: the direction of all bones at rest.
std::vector<glm::quat> rotations_at(const std::vector<glm::vec3>& joints, std::vector<glm::quat> rotations,
                                    glm::vec3 rest);
/// True if the method accepts this chain: two_bone needs exactly two bones.
bool takes(ik::Method method, const Chain& chain);
inline constexpr const char* needs_two_bones = "needs exactly two bones";
/// "Two-bone needs exactly two bones; this chain has 7."
std::string why_not_taken(ik::Method method, const Chain& chain);
/// Throws std::invalid_argument if the method does not accept this chain.
void check_takes(ik::Method method, const Chain& chain);

/// The settings as solver options. `reach` is the chain's; the result refers to `settings`.
ik::Options solver_options(const ReachSettings& settings, float reach);
/// The tolerance in metres.
float reach_tolerance(const ReachSettings& settings, float reach);
/// The settings' state, reset if it does not have `bones` bones.
ik::State& state_for(ReachSettings& settings, std::size_t bones);

/// Solves from the present pose and leaves the solver's state in the settings. Does nothing for fewer than
/// two segments. Throws std::invalid_argument if the solver refuses the input, or if the method does not
/// accept the chain.
std::optional<ReachResult> solve_reach(Chain& chain, ReachSettings& settings, glm::vec3 target,
                                       ChainRuntime& runtime);

/// Heap memory in bytes.
std::size_t bytes_of(const ik::State& state);

/// Renumbers the bones after a segment was inserted before `index`, or removed from it.
void bone_inserted(ReachSettings& settings, std::size_t index, std::size_t segments_now);
void bone_removed(ReachSettings& settings, std::size_t index, std::size_t segments_now);
/// The same for several removed segments: ascending indices from before the removal.
void bones_removed(ReachSettings& settings, const std::vector<std::size_t>& joints, std::size_t segments_now);
/// Removes all limits, the plane's too.
void forget_limits(ReachSettings& settings);
/// True if joints have limits, with or without a plane.
bool is_limited(const ReachSettings& settings);
/// The limit of a bone in the plane; unlimited if none is set.
ik::AngleLimit angle_limit_of(const ChainPlane& plane, std::size_t joint);
/// Projects a point onto the chain's plane; without a plane, returns it unchanged.
glm::vec3 in_plane(const Chain& chain, const ReachSettings& settings, glm::vec3 point);
/// Distance from the plane in metres; 0 without a plane.
float off_plane(const Chain& chain, const ReachSettings& settings, glm::vec3 point);
/// Moves a chain that has left its plane back into it.
void keep_in_plane(Chain& chain, const ReachSettings& settings, ChainRuntime& runtime);
/// The limit of a joint; free if none is set.
ik::Limit limit_of(const ReachSettings& settings, std::size_t joint);
/// A limit of that kind, with usual angles, widened to include the joint's current pose, except for a hinge's
/// twist and swings near half a turn. A new hinge uses the axis and the direction of the joint's current
/// bend.
ik::Limit limit_around_pose(ik::JointKind kind, const ReachSettings& settings, const Chain& chain,
                            std::size_t joint, std::optional<glm::vec3> axis);
/// Throws std::invalid_argument for an invalid limit.
void set_limits(ReachSettings& settings, const std::vector<std::pair<std::size_t, ik::Limit>>& limits,
                const Chain& chain);

/// "joint 2 (hinge) stops at 145 degrees; the target needs 162".
std::string active_limit_text(const ik::ActiveLimit& limit);
/// "162": the angle in that sentence.
std::string needed_degrees(const ik::ActiveLimit& limit);
const char* solver_help(ik::Method method);
inline constexpr EnumNames<ik::AngleFrom, 2> angle_origins{
    "from",
    {{"bone", "bone before", "From the bone before: 0 is straight."},
     {"base", "base", "From a direction that never changes."}}};
inline constexpr EnumNames<ik::JointKind, 7> joint_kinds{"kind of joint",
                                                         {{"free", "free"},
                                                          {"suture", "suture"},
                                                          {"hinge", "hinge"},
                                                          {"gliding", "gliding"},
                                                          {"saddle", "saddle"},
                                                          {"pivot", "pivot"},
                                                          {"ball_and_socket", "ball and socket"}}};

/// Writes member "state" unless the state is empty or of another chain. `joints` is the pose that the state
/// belongs to: pole joints equal to it are omitted.
void save_state(Json& json, const ik::State& state, const std::vector<glm::vec3>& joints);
ik::State load_state(const JsonPlace& owner, const std::vector<glm::vec3>& joints);
/// Throws std::runtime_error with the JSON path of the fault.
ReachSettings load_reach(const JsonPlace& place, const Chain& chain);

}  // namespace tendril::app

/// The settings that are plain values; the others have their own JSON.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ReachSettings>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::ReachSettings>();
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::ik::Limit>();
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::ik::AngleLimit>();
