// Reach mode: the head stays and the tail solves for the target. What a person chooses for it, and what came
// of it.
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
#include <tendril/ik/pole_turn.hpp>
#include <tendril/ik/report.hpp>
#include <tendril/ik/state.hpp>
#include <utility>
#include <vector>

#include "app/document/json.hpp"
#include "app/fields/fields.hpp"
#include "app/io/solver_text.hpp"
#include "app/labs/kit/library_json.hpp"

namespace tendril::ik {
struct Options;
}

namespace tendril::app {

class ChainRuntime;

inline constexpr int max_iterations = 10'000, max_restarts = 1000;
inline constexpr float min_damping = 1e-4f, max_damping = 10.0f;
inline constexpr int default_restarts = 8;  ///< as ik::Options has it, but none while the target is dragged

struct ReachSettings {
    ik::Method method = ik::Method::Fabrik;
    int iterations = 100;
    std::optional<float> tolerance;  ///< metres; 1e-3 of the reach where there is none
    float snap_back = 0.0f;          ///< 0 to 1
    float soft_zone = 0.0f;          ///< part of the reach
    float damping = 0.1f;            ///< part of the reach
    float twist_deg = 0.0f;          ///< two-bone
    std::optional<int> restarts;     ///< within limits, 0 to max_restarts; the library's own where left out
    std::optional<glm::vec3> pole;   ///< metres
    ik::PoleTurn pole_turn = ik::PoleTurn::WholeChain;
    std::vector<ik::Limit> limits;  ///< one a bone, at the joint that it starts from; or none at all
    /// What the solver remembers from solve to solve; of no bones before the first. Its rotations are kept up
    /// with limits only, which are what needs them.
    ik::State state;

    bool operator==(const ReachSettings&) const = default;
};

/// What the last solve said; not saved, for the chain may have been moved since.
struct ReachResult {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::optional<ik::ActiveLimit> active_limit;  ///< the active limit that keeps the tip back, if any
    bool operator==(const ReachResult&) const = default;
};

/// Where the segments are, head first.
std::vector<glm::vec3> positions(const Chain& chain);
/// Where the joints are from the root, as a solver's memory counts it.
std::vector<glm::vec3> from_root(const std::vector<glm::vec3>& joints);
/// The least rotation from one unit vector to another.
glm::quat least_rotation(glm::vec3 from, glm::vec3 to);
/// How each bone is turned from rest, where the joints are now: as the last solve left it (`rotations`, or
/// none), turned on by as little as brings it to where the bone points. `rest`: where bones point at rest.
std::vector<glm::quat> rotations_at(const std::vector<glm::vec3>& joints, std::vector<glm::quat> rotations,
                                    glm::vec3 rest);
/// Whether a method takes this chain: two_bone only where there are two bones.
bool takes(ik::Method method, const Chain& chain);
inline constexpr const char* needs_two_bones = "needs exactly two bones";
/// "Two-bone needs exactly two bones; this chain has 7."
std::string why_not_taken(ik::Method method, const Chain& chain);
/// Throws std::invalid_argument for a method that does not take this chain.
void check_takes(ik::Method method, const Chain& chain);

/// As the solver takes them, with `reach` the chain's; points into `settings`.
ik::Options solver_options(const ReachSettings& settings, float reach);
/// Metres.
float reach_tolerance(const ReachSettings& settings, float reach);
/// The state for a solver of so many bones: the settings' own, or where that is another chain's, a new one.
ik::State& state_for(ReachSettings& settings, std::size_t bones);

/// Solves from where the chain is, and leaves what there is to remember in the settings. Nothing for a chain
/// of fewer than two segments. Throws std::invalid_argument where the solver refuses: two_bone and a chain
/// that has not two bones.
std::optional<ReachResult> solve_reach(Chain& chain, ReachSettings& settings, glm::vec3 target,
                                       ChainRuntime& runtime);

/// Of memory.
std::size_t bytes_of(const ik::State& state);

/// Bones are counted anew: a segment came before `index`, or went from there.
void bone_inserted(ReachSettings& settings, std::size_t index, std::size_t segments_now);
void bone_removed(ReachSettings& settings, std::size_t index, std::size_t segments_now);
/// Several segments went, ascending as they were counted before.
void bones_removed(ReachSettings& settings, const std::vector<std::size_t>& joints, std::size_t segments_now);
void forget_limits(ReachSettings& settings);
/// The limit of a joint; free where none is set.
ik::Limit limit_of(const ReachSettings& settings, std::size_t joint);
/// Throws std::invalid_argument for a limit with a fault.
void set_limit(ReachSettings& settings, std::size_t joint, const ik::Limit& limit, const Chain& chain);
void set_limits(ReachSettings& settings, const std::vector<std::pair<std::size_t, ik::Limit>>& limits,
                const Chain& chain);

/// "joint 2 (hinge) stops at 145 degrees; the target needs 162".
std::string active_limit_text(const ik::ActiveLimit& limit);
/// "162": as that sentence has it.
std::string needed_degrees(const ik::ActiveLimit& limit);
const char* solver_help(ik::Method method);
/// What a status means, in a sentence.
const char* status_help(ik::Status status);
const char* kind_title(ik::JointKind kind);
inline constexpr std::array all_joint_kinds{
    ik::JointKind::Free,   ik::JointKind::Suture, ik::JointKind::Hinge,        ik::JointKind::Gliding,
    ik::JointKind::Saddle, ik::JointKind::Pivot,  ik::JointKind::BallAndSocket};

/// As "state", where there is one. `joints` is where the chain is that the state belongs to: what the pole's
/// memory has in common with it is not written twice.
void save_state(Json& json, const ik::State& state, const std::vector<glm::vec3>& joints);
ik::State load_state(const JsonPlace& owner, const std::vector<glm::vec3>& joints);
Json save_reach(const ReachSettings& settings, const Chain& chain);
/// Throws std::runtime_error naming the place.
ReachSettings load_reach(const JsonPlace& place, const Chain& chain);

}  // namespace tendril::app

/// Of what is a number or a choice; the others have shapes of their own.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ReachSettings>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::ReachSettings>();
