// The version of Tendril. Configuring fails if it differs from the project's version in CMake.
#pragma once

namespace tendril {

inline constexpr int version_major = 0;
inline constexpr int version_minor = 1;
inline constexpr int version_patch = 0;
inline constexpr const char* version_string = "0.1.0";

}  // namespace tendril
