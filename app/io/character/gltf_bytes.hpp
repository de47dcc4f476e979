// The bytes that a glTF file's buffers and images refer to: the BIN chunk, data URIs, and files beside it.
// tinygltf sees placeholders instead, since it refuses a whole file for a picture that it cannot read, an
// empty BIN chunk, a compressed mesh, or a file that is longer than its buffer.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

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
/// "PNG", "JPEG", "KTX2", "WebP"; empty: none of these.
std::string_view picture_kind(std::string_view bytes);

}  // namespace tendril::app
