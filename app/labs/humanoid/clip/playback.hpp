// Playback of a clip: its current moment, and how that advances.
//
// A looping clip continues where the previous round ended: each round moves the hips on the ground and turns
// them about the vertical by the difference between the clip's first and last moment. Played in place, the
// hips stay above their starting point. A clip that was recorded in place can be made to travel.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <tendril/rig/transform.hpp>

#include "app/fields/fields.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"

namespace tendril::app {

inline constexpr double fastest_clip = 10.0, longest_playback = 1e6;  ///< seconds
inline constexpr std::int64_t max_rounds = 1'000'000;

struct Workspace;
struct HumanoidPart;

struct Playback {
    std::optional<std::size_t> clip;  ///< in the character's list; none: the rest pose
    bool playing = false;
    double time = 0.0;        ///< seconds into the clip
    std::int64_t rounds = 0;  ///< completed rounds
    double speed = 1.0;       ///< 0 to fastest_clip
    bool loop = true;
    bool in_place = false;
    bool travel = false;         ///< moves a clip that walks in place by `pace`
    bool targets_travel = true;  ///< targets move along with a clip that travels
    glm::dvec3 pace{0.0};        ///< m/s, by measure_pace(); 0 without `travel`
    bool operator==(const Playback&) const = default;
};

/// Whether a tick changes anything.
bool goes_on(const Playback& playback, const LoadedCharacter& character);
/// Advances by `seconds`; a clip that does not loop stops at its end.
void advance(Playback& playback, const LoadedCharacter& character, double seconds);
/// Goes to `seconds` after the start of the first round. Beyond the duration, a looping clip is in a later
/// round, and another one at its end.
void go_to(Playback& playback, const LoadedCharacter& character, double seconds);

/// The clip's local pose at that moment, before anything modifies it. `hips`: the node whose motion carries
/// over from round to round; without it each round restarts at the same position. `unfixed`: before the clip
/// was fixed.
std::vector<rig::Transform> animated_pose(const Playback& playback, const LoadedCharacter& character,
                                          std::optional<std::size_t> hips, bool unfixed = false);

/// How fast a clip that walks in place should travel for its standing feet to stay where they are, m/s; 0 for
/// one that travels, or stands.
glm::dvec3 pace_of(const HumanoidPart& part, std::size_t clip);
/// Call after a change of clip, bone map or Playback::travel.
void measure_pace(HumanoidPart& part);

/// Moves the targets along with the clip since `before`: each at the round's average velocity, turning with
/// it, so that the clip meets them alike in every round.
void carry_targets(HumanoidPart& part, const Playback& before);

/// Whether the strip of the clip has marks of Motion lint.
bool shows_lint_marks(const Workspace& workspace);

/// The hips' ground velocity that playing in place removes at that moment, m/s at the recorded speed; with
/// `travel`, plus the pace.
glm::dvec3 missing_velocity(const Playback& playback, const LoadedCharacter& character,
                            std::optional<std::size_t> hips);

// Clips of other files, played on this character (humanoid::retarget). The result is a clip like its own.

struct PlayedMotion {
    SharedCharacter loaded;  ///< the part's character, with the new clip last
    std::string text;        ///< for the user: the clip's name, and what was not retargeted
};

/// Retargets the clip of that name (empty: the first one) of another character, with the fixes made on it.
/// Throws std::runtime_error that begins with the name of its file.
PlayedMotion with_motion(const HumanoidPart& part, const HumanoidPart& source, const std::string& clip);
/// Chooses the last clip, and plays it.
void play_last_clip(HumanoidPart& part);

/// The motion that made this clip; null for a clip of the character's own.
const LoadedMotion* motion_of(const LoadedCharacter& character, std::size_t clip);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Playback>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::Playback>();
