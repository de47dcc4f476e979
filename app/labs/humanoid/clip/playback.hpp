// Which moment of which clip is shown, and how it goes on from tick to tick.
//
// A clip that loops goes on from where its last round ended: what moves is the hips, on the ground and about
// the vertical, from the clip's first moment to its last one. Played in place, the hips stay above the point
// where the clip begins.
#pragma once

#include <cstdint>
#include <optional>
#include <tendril/rig/transform.hpp>

#include "app/fields/fields.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"

namespace tendril::app {

inline constexpr double fastest_clip = 10.0;
inline constexpr std::int64_t max_rounds = 1'000'000;

struct Playback {
    std::optional<std::size_t> clip;  ///< in the character's list; none: the rest pose
    bool playing = false;
    double time = 0.0;        ///< seconds into the clip
    std::int64_t rounds = 0;  ///< that it has made before this one
    double speed = 1.0;       ///< 0 to fastest_clip
    bool loop = true;
    bool in_place = false;
    bool operator==(const Playback&) const = default;
};

/// Whether a tick changes anything.
bool goes_on(const Playback& playback, const LoadedCharacter& character);
/// Lets so many seconds pass; a clip that does not loop stops at its end.
void advance(Playback& playback, const LoadedCharacter& character, double seconds);
/// `seconds` from where the first round began: over the duration, a clip that loops is in a later round, and
/// another at its end.
void go_to(Playback& playback, const LoadedCharacter& character, double seconds);

/// The pose of that moment, local, before anything changes it. `hips`: the node whose way is the character's;
/// without one it comes back to where it began in each round.
std::vector<rig::Transform> animated_pose(const Playback& playback, const LoadedCharacter& character,
                                          std::optional<std::size_t> hips);

/// What a clip that is played in place has been taken of just then: the hips' velocity over the ground, m/s.
glm::dvec3 missing_velocity(const Playback& playback, const LoadedCharacter& character,
                            std::optional<std::size_t> hips);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Playback>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::Playback>();
