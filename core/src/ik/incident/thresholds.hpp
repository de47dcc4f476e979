// Thresholds of incidents. Shares are fractions of the reach, unless stated otherwise.
#pragma once

#include <cstddef>

namespace tendril::ik {

constexpr float in_degrees(float radians) noexcept {
    return radians * 57.2957795f;
}

inline constexpr float length_share = 2e-3f;   ///< fraction of the bone
inline constexpr float rounding_steps = 4.0f;  ///< times the resolution: two points, in three coordinates
/// Times the resolution: both ends in three coordinates, now and in the first frame: 4 sqrt(3).
inline constexpr float rounded_lengths = 6.93f;
inline constexpr float unmoved_share = 0.25f;  ///< of a bone's change: outer ends at rest; 60 arms tried
inline constexpr float limit_degrees = 0.5f;   ///< beyond a limit

inline constexpr float side_bend = 0.02f;       ///< below it a chain is straight and has no side
inline constexpr float side_turn = 1.0472f;     ///< radians, 60 degrees; beyond, sides cannot be compared
inline constexpr std::size_t swing_frames = 3;  ///< maximum length of a flip
inline constexpr float swing_degrees = 60.0f, swing_lead = 3.0f;

inline constexpr float roll_degrees = 90.0f;  ///< a bone's roll about itself in one frame

inline constexpr float jump_share = 0.15f;    ///< minimum step of a target that jumps
inline constexpr float jump_factor = 4.0f;    ///< times the steps before and after it
inline constexpr float moving_share = 1e-3f;  ///< a shorter step is not motion

// Measured on the families of ik_incident_test.cpp and trace_test.cpp; "arms" are the chains of the former.

/// Repeated frames are a rest if a step is under this fraction of the previous one, or over this multiple of
/// it per frame. 120 arms that repeat 0 to 5 frames are judged correctly, as with 0.1 to 0.95 and 1 to 4.
inline constexpr float min_resumed_step = 0.6f, max_resumed_step = 1.5f;
/// Minimum cosine between the steps before and after. -0.5 works as well; 0.95 loses some of the 120.
inline constexpr float min_resumed_cosine = 0.5f;

/// Minimum number of runs of repeated frames in a cadence.
inline constexpr std::size_t min_cadence = 4;
/// Swapped frames bend the path by this multiple of the bend with the two put right, and of the distance over
/// six frames. At constant speed, 4 halved steps of second differences over 5 steps: 0.8; put right: 0.
inline constexpr float swap_bend_ratio = 4.0f, swap_distance_ratio = 0.5f;

inline constexpr float missed_share = 0.01f;
inline constexpr std::size_t min_missed_frames = 5;  ///< frames
inline constexpr float approach_ratio = 0.98f;       ///< a tip whose error falls below this part approaches

// 300 arms, half of them late by 1 to 5 frames: 150 are found, none falsely.
inline constexpr double lag_share = 1e-3;        ///< minimum gain in rms; with 1e-2, 147 are found
inline constexpr double max_lag_ratio = 0.5;     ///< share of the squares without a lag; 0.8 fails on planted
                                                 ///< faults
inline constexpr double max_other_ratio = 1.02;  ///< the same for every comparison; with 0.9, 142 are found
/// The tip's path may be 0.5 to 2 times the size of the target's; with 0.999, 149 are found.
inline constexpr double lag_scale = 0.5;
inline constexpr std::size_t min_lag_frames = 8;  ///< minimum number of moving frames
inline constexpr double late_ratio = 0.0625;      ///< the same for a tip that is late for a while

/// A tip leaps if it is off its path by this multiple of the steps around it and this share of the reach.
/// With 6, or with 0.1, some of the 300 planted faults are missed; 1.5 and 0.005 work as well.
inline constexpr float spike_step_ratio = 3.0f, spike_share = 0.025f;

inline constexpr float jitter_share = 2e-4f;
inline constexpr std::size_t fast_jitter_frames = 16;  ///< frames
inline constexpr std::size_t min_jitter_crossings = 4;

}  // namespace tendril::ik
