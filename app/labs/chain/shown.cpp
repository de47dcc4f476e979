#include "app/labs/chain/shown.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace tendril::app {

std::vector<glm::vec3> shown_joints(const ChainPart& part) {
    return part.study.trace ? part.study.trace->pose(part.study.step) : positions(part.chain);
}

bool shows_end(const ChainPart& part) {
    return !part.study.trace || part.study.step == part.study.trace->frames();
}

const ik::ActiveLimit* shown_active_limit(const ChainPart& part) {
    return part.result && part.result->hold && shows_end(part) ? &*part.result->hold : nullptr;
}

ShownSegment shown_segment(const ChainPart& part, const std::vector<glm::vec3>& joints, std::size_t index) {
    const float length = part.chain.segments()[index].length;
    if (index == 0) return {joints[0], length, 0.0f};
    const float distance = glm::distance(joints[index], joints[index - 1]);
    // Outside a solve a bone has its length, but for rounding, which is the error's to show.
    return {joints[index], shows_end(part) ? length : distance, std::abs(distance - length)};
}

const char* end_name(const ChainPart& part, std::size_t index) {
    const bool reaches = part.mode == ChainMode::Reach;
    if (index == 0) return reaches ? "root" : "head";
    if (index + 1 == part.chain.size()) return reaches ? "tip" : "tail";
    return "";
}

float shown_residual(const ChainPart& part, const std::vector<glm::vec3>& joints) {
    return joints.empty() ? 0.0f : glm::distance(joints.back(), part.target);
}

}  // namespace tendril::app
