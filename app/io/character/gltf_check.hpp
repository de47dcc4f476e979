// What a glTF file's JSON claims of its bytes. Every buffer, view, accessor, mesh, image and animation is
// checked, used or not, so that what reads them later needs no checks of its own: nothing lies outside its
// buffer, and no file asks for more work than its size allows.
#pragma once

#include <cstdint>
#include <string_view>

namespace tendril::app {

/// Of a glTF file, and of each file beside it, bytes.
inline constexpr std::uint64_t max_gltf_bytes = std::uint64_t{1} << 30;

/// Throws std::runtime_error with the place and the value: "accessors[20].byteOffset: ...". Text that is no
/// JSON passes: tinygltf says where it breaks.
void check_gltf(std::string_view json_text);

}  // namespace tendril::app
