// Reads a glTF file safely: checks the claims of its JSON, parses it with tinygltf, and reads its bytes and
// numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

// The bytes that a glTF file's buffers and images refer to: the BIN chunk, data URIs, and files beside it.
// tinygltf sees placeholders instead, since it refuses a whole file because of an unreadable picture, an
// empty BIN chunk, a compressed mesh, or a file that is longer than its buffer.

/// Replaces buffers by placeholders and removes images and the indices of Draco primitives. `file` is JSON
/// that check_gltf() accepts.
void take_out_bytes(nlohmann::json& file);

/// Fills in buffers and images. `file` is as before take_out_bytes(); `binary` is the BIN chunk. A buffer
/// whose only bytes are a compressed copy (EXT_meshopt_compression's fallback) and an image that is missing
/// stay empty. Throws std::runtime_error with the path and the URI for a buffer that is missing or shorter
/// than it claims, for any URI outside `folder`, which is not opened, and if the files beside it are larger
/// than max_gltf_bytes in total.
void put_in_bytes(const nlohmann::json& file, std::string_view binary, const std::filesystem::path& folder,
                  tinygltf::Model& model);

/// The bytes of an image's file, in its buffer or its own; empty if there are none.
std::string_view picture_bytes(const tinygltf::Model& model, const tinygltf::Image& image);
/// "PNG", "JPEG", "KTX2", "WebP"; empty for any other.
std::string_view picture_kind(std::string_view bytes);

// Checks what a glTF file's JSON claims about its bytes. Every buffer, view, accessor, mesh, image and
// animation is checked, used or not, so later readers need no checks: nothing is outside its buffer, and no
// file demands more work than its size justifies.

/// Limit for a glTF file, and for each external file, in bytes.
inline constexpr std::uint64_t max_gltf_bytes = std::uint64_t{1} << 30;

/// `file` is an object. Throws std::runtime_error with the path and the value:
/// "accessors[20].byteOffset: ...".
void check_gltf(const nlohmann::json& file);

// Parses a glTF or GLB file with tinygltf, after checks that tinygltf omits: the JSON's nesting depth, since
// it recurses, and what its numbers claim.

/// Reads external buffers and images from `folder`. Images hold the bytes of their files, not pixels; missing
/// ones are empty. Throws std::runtime_error for files that tinygltf refuses, for missing buffers, and for
/// URIs outside `folder`.
tinygltf::Model gltf_model(std::string_view bytes, const std::filesystem::path& folder);

/// The JSON text of a file: the first chunk of a binary file, or all of a text file.
std::string_view gltf_json(std::string_view bytes);

/// The file's node for each node of the skeleton that parse_gltf() returns. Throws std::runtime_error if
/// there is no skeleton.
std::vector<std::size_t> gltf_nodes(const tinygltf::Model& model);

// Reads numbers from a glTF file's buffers, checking every index and size: tinygltf checks the form of the
// JSON, but not the consistency of its numbers.

/// Rows of `components` numbers. Normalised integers are converted to 0 to 1, or -1 to 1 if signed; sparse
/// values are applied. `what` is for messages: "animations[2].samplers[0].input". Throws std::runtime_error
/// for an invalid index, a different type, or a buffer that is too short.
std::vector<double> accessor_rows(const tinygltf::Model& model, int accessor, int components,
                                  const std::string& what);

/// The extension that compresses an accessor's bytes if there is no plain copy of them; else null. The rows
/// of such an accessor cannot be read.
const char* compression(const tinygltf::Model& model, int accessor);

/// The number of rows. Throws as above.
std::size_t accessor_count(const tinygltf::Model& model, int accessor, const std::string& what);

}  // namespace tendril::app
