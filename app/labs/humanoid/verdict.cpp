#include <algorithm>

#include "app/document/units.hpp"
#include "app/labs/humanoid/ik/chains.hpp"
#include "app/labs/humanoid/panels.hpp"

namespace tendril::app {

Verdict humanoid_verdict(const Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    if (runtime.solvers.body(part) == nullptr)
        return {"Not a whole body", Verdict::Kind::Bad, runtime.solvers.why_no_body(part) + '.'};
    const auto mapped =
        std::ranges::count_if(part.map->bones, [](const auto& each) { return each.node >= 0; });
    const std::string bones =
        std::to_string(mapped) + " of " + std::to_string(humanoid::bone_count) + " bones are known.";
    const ShownPose& shown = runtime.shown(workspace);
    double worst = -1.0;
    for (const humanoid::Effector effector : all_effectors)
        if (part.ik.target(effector)) worst = std::max(worst, shown.residual(effector).value_or(-1.0));
    if (worst < 0.0) return {"A whole body", Verdict::Kind::Good, bones};
    if (worst < 1e-3) return {"Reached", Verdict::Kind::Good, bones};
    const std::string off = worst < 0.1 ? fixed_text(1000.0 * worst, 1) + " mm" : fixed_text(worst, 2) + " m";
    return {off + " short", Verdict::Kind::Bad, bones};
}

}  // namespace tendril::app
