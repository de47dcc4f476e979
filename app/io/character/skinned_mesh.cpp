#include "app/io/character/skinned_mesh.hpp"

#include <glm/geometric.hpp>

namespace tendril::app {

void apply_morphs(const SkinnedMesh& mesh, std::span<const float> weights, std::vector<glm::vec3>& positions,
                  std::vector<glm::vec3>& normals) {
    positions = mesh.positions;
    normals = mesh.normals;
    for (std::size_t i = 0; i < mesh.morphs.size(); ++i) {
        const MorphTarget& morph = mesh.morphs[i];
        const float weight = i < weights.size() ? weights[i] : morph.weight;
        if (weight == 0.0f) continue;
        for (std::size_t k = 0; k < morph.positions.size(); ++k)
            positions[morph.first + k] += weight * morph.positions[k];
        for (std::size_t k = 0; k < morph.normals.size(); ++k)
            normals[morph.first + k] += weight * morph.normals[k];
    }
}

glm::vec3 skinned(const SkinDraw& draw, std::size_t corner) {
    const JointWeights& by = (draw.weights ? *draw.weights : draw.mesh->weights)[corner];
    const glm::vec4 p(draw.mesh->positions[corner], 1.0f);
    glm::vec3 at(0.0f);
    for (std::size_t i = 0; i < 4; ++i) {
        const AffineRows& rows = draw.matrices[by.joints[i]];
        at += by.weights[i] * glm::vec3(glm::dot(rows[0], p), glm::dot(rows[1], p), glm::dot(rows[2], p));
    }
    return at;
}

}  // namespace tendril::app
