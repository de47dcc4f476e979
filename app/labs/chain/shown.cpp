#include "app/labs/chain/shown.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_runtime.hpp"

namespace tendril::app {

ShownChain shown_chain(const Workspace& workspace) {
    const ChainPart& part = chain_part(workspace);
    Studied studied = workspace.runtimes.of<ChainRuntime>(chain_lab).studied(part);
    return {part, std::move(studied.trace), std::move(studied.race)};
}

std::vector<glm::vec3> shown_joints(const ShownChain& shown) {
    return shown.trace ? shown.trace->pose(shown.part.study.step) : positions(shown.part.chain);
}

bool shows_end(const ShownChain& shown) {
    return !shown.trace || shown.part.study.step == shown.trace->frames();
}

const ik::ActiveLimit* shown_active_limit(const ShownChain& shown) {
    const auto& result = shown.part.result;
    return result && result->active_limit && shows_end(shown) ? &*result->active_limit : nullptr;
}

ShownSegment shown_segment(const ShownChain& shown, const std::vector<glm::vec3>& joints, std::size_t index) {
    const float length = shown.part.chain.segments()[index].length;
    if (index == 0) return {joints[0], length, 0.0f};
    const float distance = glm::distance(joints[index], joints[index - 1]);
    // Outside a solve a bone has its length, but for rounding, which is the error's to show.
    return {joints[index], shows_end(shown) ? length : distance, std::abs(distance - length)};
}

float worst_error(const ShownChain& shown, const std::vector<glm::vec3>& joints) {
    const auto segments = shown.part.chain.segments();
    float worst = 0.0f;
    for (std::size_t i = 1; i < joints.size(); ++i) {
        worst = std::max(worst, std::abs(glm::distance(joints[i], joints[i - 1]) - segments[i].length));
    }
    return worst;
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
