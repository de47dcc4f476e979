// A glTF or GLB file as tinygltf has it, after what tinygltf does not check: how deep its JSON nests, which
// it goes down by recursion, and what it may open beside the file.
#pragma once

#include <filesystem>
#include <string_view>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

/// External buffers and images are looked for in `folder`. Images hold the bytes of their files, not pixels.
/// Throws std::runtime_error: what tinygltf refuses, and files that are missing, images' too.
tinygltf::Model gltf_model(std::string_view bytes, const std::filesystem::path& folder);

/// The text of a file's JSON: its first chunk where it is binary, or all of it.
std::string_view gltf_json(std::string_view bytes);

/// Which nodes of the file are those of the skeleton that parse_gltf() makes of it, in its order. Throws
/// std::runtime_error where it has none.
std::vector<std::size_t> gltf_nodes(const tinygltf::Model& model);

}  // namespace tendril::app
