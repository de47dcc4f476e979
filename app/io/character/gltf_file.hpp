// A glTF file under construction: its JSON, and the single buffer of all its views.
#pragma once

#include <cstdint>
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
    /// An empty file.
    GltfFile();
    /// A copy of another file, bit for bit. Merges its buffers and external pictures into one buffer, so that
    /// it needs no other file. Throws std::runtime_error if the JSON cannot be parsed.
    GltfFile(std::string_view json_text, const tinygltf::Model& model);

    nlohmann::ordered_json json;

    /// Adds rows of `type` ("SCALAR", "VEC3", "VEC4", "MAT4"), as floats. Returns the accessor's index. Rows
    /// identical to earlier ones are not added again.
    std::size_t add_rows(const char* type, const std::vector<float>& numbers);
    /// The same with min and max, which glTF requires for times.
    std::size_t add_times(const std::vector<float>& times);
    /// Positions of vertices, with the min and max that glTF requires of them.
    std::size_t add_positions(const std::vector<float>& numbers);
    std::size_t add_indices(const std::vector<std::uint32_t>& indices);
    /// Four joints for each vertex.
    std::size_t add_joints(const std::vector<std::uint16_t>& joints);

    /// Makes the skin weights of each vertex sum to 1, as the format requires, since not every file observes
    /// it. Changes only floats; weights that already sum to 1 keep their bits.
    void normalise_weights();

    /// The whole file. In text form the buffer is embedded as base64. Throws std::runtime_error above 4 GB.
    std::string bytes(bool binary) const;

  private:
    std::size_t add_view(const void* data, std::size_t size);
    void take_buffers(const tinygltf::Model& model);
    void take_pictures(const tinygltf::Model& model);
    std::optional<std::size_t> row_of_floats(const nlohmann::ordered_json& accessor, std::size_t row) const;
    void normalise_weights_of(const nlohmann::ordered_json& primitive);

    std::string buffer_;
    std::vector<nlohmann::ordered_json> fallbacks_;  // further buffers, without bytes
    std::map<std::pair<std::string, std::vector<float>>, std::size_t> rows_;
};

}  // namespace tendril::app
