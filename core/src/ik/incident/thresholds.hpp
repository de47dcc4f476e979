// Thresholds of incidents. Shares are fractions of the reach, unless noted.
#pragma once

#include <cstddef>

namespace tendril::ik {

constexpr float in_degrees(float radians) noexcept {
    return radians * 57.2957795f;
}

inline constexpr float length_share = 2e-3f;   ///< of the bone
inline constexpr float rounding_steps = 4.0f;  ///< of the resolution: two points, in three coordinates
/// Of the resolution: both ends in three coordinates, now and in the first frame: 4 times the root of 3.
inline constexpr float rounded_lengths = 6.93f;
inline constexpr float unmoved_share = 0.25f;  ///< of a bone's change: outer ends that stay; 60 arms tried
inline constexpr float limit_degrees = 0.5f;   ///< beyond a limit

inline constexpr float side_bend = 0.02f;       ///< less is straight, and has no side
inline constexpr float side_turn = 1.0472f;     ///< radians, 60 degrees: further, sides cannot be compared
inline constexpr std::size_t swing_frames = 3;  ///< a flip may take so many
inline constexpr float swing_degrees = 60.0f, swing_lead = 3.0f;

inline constexpr float roll_degrees = 90.0f;  ///< of a bone about itself, in a frame

inline constexpr float jump_share = 0.15f;    ///< a target's step
inline constexpr float jump_factor = 4.0f;    ///< times the steps before and after it
inline constexpr float moving_share = 1e-3f;  ///< a step of less is still

// Measured on the families of ik_incident_test.cpp and trace_test.cpp. "Arms" are the chains of the first.

/// Fractions of the step before: shorter is slowing down or starting anew; several frames may be caught up at
/// once. 120 arms that repeat 0 to 5 frames are all right, as with 0.1 to 0.95 and 1 to 4.
inline constexpr float resumed_share = 0.6f, resumed_faster = 1.5f;
/// Between the steps before and after: likewise with -0.5; some of the 120 are lost with 0.95.
inline constexpr float resumed_cosine = 0.5f;

/// Minimum number of runs of repeated frames in a cadence.
inline constexpr std::size_t min_cadence = 4;
/// Frames in swapped order: times the bends of the path with the two put right, and of the way of six frames.
/// At constant speed 4 steps of second differences, halved, over 5 steps of way: 0.8; put right: 0.
inline constexpr float swapped_bends = 4.0f, swapped_way = 0.5f;

inline constexpr float missed_share = 0.01f;
inline constexpr std::size_t missed_run = 5;  ///< frames
inline constexpr float approach = 0.98f;      ///< a tip that comes closer by more a frame is under way

// 300 arms, half of them late by 1 to 5 frames: 150 are found, none falsely.
inline constexpr double lag_share = 1e-3;   ///< rms by which a lag fits better; with 1e-2, 147 are found
inline constexpr double lag_better = 0.5;   ///< of the squares without a lag; 0.8 fails on planted faults
inline constexpr double lag_agrees = 1.02;  ///< likewise, of each way to compare; with 0.9, 142 are found
/// The tip's path may be 0.5 to 2 times the size of the target's; with 0.999, 149 are found.
inline constexpr double lag_scale = 0.5;
inline constexpr std::size_t lag_frames = 8;  ///< moving ones, at least

/// A tip leaps if its step is longer than so many of the target's and so much of the reach. With 6, or with
/// 0.1, some of the 300 planted faults are missed; 1.5 and 0.005 do as well.
inline constexpr float spike_steps = 3.0f, spike_share = 0.025f;

inline constexpr float jitter_share = 2e-4f;
inline constexpr std::size_t fast_jitter = 16;  ///< frames
inline constexpr std::size_t jitter_crossings = 4;

}  // namespace tendril::ik
