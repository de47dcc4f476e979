// Checks what a glTF file's JSON claims about its bytes. Every buffer, view, accessor, mesh, image and
// animation is checked, used or not, so that later readers need no checks: nothing is outside its buffer, and
// no file demands more work than its size justifies.
#pragma once

#include <cstdint>
#include <string_view>

namespace tendril::app {

/// Limit for a glTF file, and for each external file, in bytes.
inline constexpr std::uint64_t max_gltf_bytes = std::uint64_t{1} << 30;

/// Throws std::runtime_error with the path and the value: "accessors[20].byteOffset: ...". Text that is not
/// JSON passes: tinygltf reports where it is wrong.
void check_gltf(std::string_view json_text);

}  // namespace tendril::app
