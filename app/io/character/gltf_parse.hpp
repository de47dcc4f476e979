// Parses a glTF or GLB file with tinygltf, after checks that tinygltf omits: the JSON's nesting depth, since
// it recurses, and what its numbers claim. Buffers and images are read by gltf_bytes.hpp.
#pragma once

#include <filesystem>
#include <string_view>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

/// Reads external buffers and images from `folder`. Images hold the bytes of their files, not pixels; missing
/// ones are empty. Throws std::runtime_error for files that tinygltf refuses, for missing buffers, and for
/// URIs outside `folder`.
tinygltf::Model gltf_model(std::string_view bytes, const std::filesystem::path& folder);

/// The JSON text of a file: the first chunk of a binary file, or all of a text file.
std::string_view gltf_json(std::string_view bytes);

/// The file's node for each node of the skeleton that parse_gltf() returns. Throws std::runtime_error if
/// there is no skeleton.
std::vector<std::size_t> gltf_nodes(const tinygltf::Model& model);

}  // namespace tendril::app
