// The chain as the picture has it: where it is or, under the microscope, where a step of the solve has it.
// Picture, inspector and --state all ask here, so that they show the same step.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {

/// The lab's part of a workspace, with what its study came to. Refers to the workspace: not to be kept.
struct ShownChain {
    const ChainPart& part;
    std::shared_ptr<const Trace> trace;  ///< of the solve under the microscope, else null
    std::shared_ptr<const Race> race;    ///< null while there is none
};
ShownChain shown_chain(const Workspace& workspace);

/// One a joint, metres.
std::vector<glm::vec3> shown_joints(const ShownChain& shown);

/// Whether it is where the last solve ended, and not a step on the way there.
bool shows_end(const ShownChain& shown);

/// The joint that stops the chain, while the chain is shown where it was stopped; null where there is none.
const ik::ActiveLimit* shown_active_limit(const ShownChain& shown);

/// What one reads of a segment that is shown at `joints`.
struct ShownSegment {
    glm::vec3 position{0.0f};
    float length = 0.0f;  ///< metres: of its bone as it is shown, which inside a solve may be off; the root
                          ///< has no bone and shows the length that it has stored
    float error = 0.0f;   ///< metres, from the length that the segment should have
};
ShownSegment shown_segment(const ShownChain& shown, const std::vector<glm::vec3>& joints, std::size_t index);

/// The largest error of all, metres.
float worst_error(const ShownChain& shown, const std::vector<glm::vec3>& joints);

/// "root" and "tip" of a chain that reaches, "head" and "tail" of one that trails; empty between the two.
const char* end_name(const ChainPart& part, std::size_t index);

/// Metres from the tip to the target; 0 for an empty chain.
float shown_residual(const ChainPart& part, const std::vector<glm::vec3>& joints);

}  // namespace tendril::app
