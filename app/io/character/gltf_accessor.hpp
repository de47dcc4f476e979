// Numbers out of a glTF file's buffers, every index and size checked: tinygltf checks that the JSON is what
// it should be, and not that its numbers fit each other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

/// Rows of `components` numbers. Integers that are normalised come out from -1 or 0 to 1; sparse values are
/// put in. `what` is for messages: "animations[2].samplers[0].input". Throws std::runtime_error where an
/// index points nowhere, the type is another, or the buffer ends before the rows do.
std::vector<double> accessor_rows(const tinygltf::Model& model, int accessor, int components,
                                  const std::string& what);

/// Rows in it. Throws as above.
std::size_t accessor_count(const tinygltf::Model& model, int accessor, const std::string& what);

}  // namespace tendril::app
