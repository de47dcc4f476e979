// Checks what a glTF file's JSON claims about its bytes. Every buffer, view, accessor, mesh, image and
// animation is checked, used or not, so that later readers need no checks: nothing is outside its buffer, and
// no file demands more work than its size justifies.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

namespace tendril::app {

/// Limit for a glTF file, and for each external file, in bytes.
inline constexpr std::uint64_t max_gltf_bytes = std::uint64_t{1} << 30;

/// `file` is an object. Throws std::runtime_error with the path and the value:
/// "accessors[20].byteOffset: ...".
void check_gltf(const nlohmann::json& file);

}  // namespace tendril::app
