#include "app/io/character/gltf_skin.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <stdexcept>
#include <string>

#include "app/io/character/gltf_bytes.hpp"
#include "app/io/json.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_vertices = 2'000'000;

glm::dmat4 local_of(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    if (node.rotation.size() == 4)
        matrix = glm::mat4_cast(
            glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
    if (node.scale.size() == 3)
        for (int i = 0; i < 3; ++i) matrix[i] *= node.scale[static_cast<std::size_t>(i)];
    if (node.translation.size() == 3)
        matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
    return matrix;
}

class Collector {
  public:
    explicit Collector(const tinygltf::Model& model) : model_(model), seen_(model.nodes.size()) {}

    TriangleMesh run() {
        std::vector<bool> below(model_.nodes.size());
        for (const tinygltf::Node& node : model_.nodes)
            for (const int child : node.children) below.at(static_cast<std::size_t>(child)) = true;
        for (std::size_t i = 0; i < below.size(); ++i)
            if (!below[i]) waiting_.push_back({i, glm::dmat4(1.0)});
        while (!waiting_.empty()) {
            const auto [node, above] = waiting_.back();
            waiting_.pop_back();
            take(node, above);
        }
        if (found_.triangles.empty()) throw std::runtime_error("it has no triangles");
        return std::move(found_);
    }

  private:
    void take(std::size_t index, const glm::dmat4& above) {
        if (seen_.at(index)) throw std::runtime_error("its nodes form a cycle");
        seen_[index] = true;
        const tinygltf::Node& node = model_.nodes[index];
        const glm::dmat4 placed = above * local_of(node);
        for (const int child : node.children) waiting_.push_back({static_cast<std::size_t>(child), placed});
        if (node.mesh < 0) return;
        for (const tinygltf::Primitive& each :
             model_.meshes.at(static_cast<std::size_t>(node.mesh)).primitives)
            if (each.mode == TINYGLTF_MODE_TRIANGLES || each.mode < 0) take(each, placed);
    }
    void take(const tinygltf::Primitive& primitive, const glm::dmat4& placed) {
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) return;
        if (primitive.extensions.count("KHR_draco_mesh_compression") &&
            model_.accessors.at(static_cast<std::size_t>(position->second)).bufferView < 0)
            throw std::runtime_error("is compressed with KHR_draco_mesh_compression, which cannot be read");
        const std::size_t first = found_.vertices.size();
        const std::size_t count = accessor_count(model_, position->second, "POSITION");
        if (count > max_vertices - first)
            throw std::runtime_error("it has more than " + std::to_string(max_vertices) + " vertices");
        const std::vector<double> rows = accessor_rows(model_, position->second, 3, "POSITION");
        for (std::size_t i = 0; i + 2 < rows.size(); i += 3)
            found_.vertices.emplace_back(placed * glm::dvec4(rows[i], rows[i + 1], rows[i + 2], 1.0));
        if (primitive.indices < 0) {
            for (std::size_t i = 0; i + 2 < count; i += 3)
                for (std::size_t k = 0; k < 3; ++k)
                    found_.triangles.push_back(static_cast<std::uint32_t>(first + i + k));
            return;
        }
        if (accessor_count(model_, primitive.indices, "indices") > 3 * max_vertices)
            throw std::runtime_error("it has more than " + std::to_string(max_vertices) + " triangles");
        const std::vector<double> indices = accessor_rows(model_, primitive.indices, 1, "indices");
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (!(indices[i + k] < static_cast<double>(count)))
                    throw std::runtime_error("indices: one is beyond the last vertex");
                found_.triangles.push_back(
                    static_cast<std::uint32_t>(first + static_cast<std::size_t>(indices[i + k])));
            }
        }
    }

    struct Waiting {
        std::size_t node;
        glm::dmat4 above;
    };
    const tinygltf::Model& model_;
    std::vector<bool> seen_;
    std::vector<Waiting> waiting_;
    TriangleMesh found_;
};

}  // namespace

TriangleMesh read_triangles(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    const std::string ending = path.extension().string();
    if (ending != ".gltf" && ending != ".glb")
        throw std::runtime_error(name + ": expected a file that ends in .gltf or .glb");
    if (!std::filesystem::is_regular_file(path)) throw std::runtime_error(name + ": there is no such file");
    try {
        const std::string bytes = read_text_file(path);
        const tinygltf::Model model = gltf_model(bytes, path.parent_path());
        return Collector(model).run();
    } catch (const std::exception& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

}  // namespace tendril::app
