// Reads numbers from a glTF file's buffers, checking every index and size: tinygltf checks the JSON's form,
// but not the consistency of its numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

/// Rows of `components` numbers. Normalised integers are converted to 0 to 1, or -1 to 1 if signed; sparse
/// values are applied. `what` is for messages: "animations[2].samplers[0].input". Throws std::runtime_error
/// for an invalid index, a different type, or a buffer that is too short.
std::vector<double> accessor_rows(const tinygltf::Model& model, int accessor, int components,
                                  const std::string& what);

/// The extension that compresses an accessor's bytes, if there is no plain copy of them; else null. Rows of
/// such an accessor cannot be read.
const char* compression(const tinygltf::Model& model, int accessor);

/// The number of rows. Throws as above.
std::size_t accessor_count(const tinygltf::Model& model, int accessor, const std::string& what);

}  // namespace tendril::app
