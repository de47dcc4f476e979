// A glTF file in the making: its JSON, and the one buffer that all its views are of.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

class GltfFile {
  public:
    /// An empty one.
    GltfFile();
    /// What another has, number for number. Its buffers become one, and pictures that lie beside it go into
    /// that too, so that the file needs no other. Throws std::runtime_error where the JSON is none.
    GltfFile(std::string_view json_text, const tinygltf::Model& model);

    nlohmann::ordered_json json;

    /// Rows of `type` ("SCALAR", "VEC3", "VEC4"), as floats. Returns the accessor's place. Those that are
    /// there already, to the bit, are not put in again.
    std::size_t add_rows(const char* type, const std::vector<float>& numbers);
    /// The same with the range that times must have.
    std::size_t add_times(const std::vector<float>& times);

    /// Skin weights of each vertex add up to 1, as the format wants it and not every file has it. Only floats
    /// are touched; what has been added up already stays to the bit.
    void normalise_weights();

    /// The whole file. Text has its buffer in it, in base 64. Throws std::runtime_error over 4 GB.
    std::string bytes(bool binary) const;

  private:
    std::size_t add_view(const void* data, std::size_t size);
    void take_buffers(const tinygltf::Model& model);
    void take_pictures(const tinygltf::Model& model);
    std::optional<std::size_t> row_of_floats(const nlohmann::ordered_json& accessor, std::size_t row) const;
    void normalise_weights_of(const nlohmann::ordered_json& primitive);

    std::string buffer_;
    std::map<std::pair<std::string, std::vector<float>>, std::size_t> rows_;
};

}  // namespace tendril::app
