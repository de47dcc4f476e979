#include "app/labs/chain/reach_drag.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>
#include <tendril/ik/solver.hpp>

#include "app/labs/chain/chain_runtime.hpp"
#include "app/labs/kit/require.hpp"

namespace tendril::app {
namespace {

constexpr float drag_tolerance = 1e-4f;  ///< of the reach to the dragged joint: a fraction of a pixel

/// Some bones of a chain in a row, as a chain of their own that starts where the first one does.
struct Section {
    std::size_t first = 0, count = 0;  ///< bones
    std::vector<float> lengths;        ///< metres, one a bone
    std::vector<glm::vec3> joints;     ///< one more than bones
    std::vector<glm::quat> rotations;  ///< one a bone; only with limits
};

Section section_of(const Chain& chain, const ReachSettings& settings, std::size_t first, std::size_t count) {
    Section section{first, count, {}, {}, {}};
    for (std::size_t i = 0; i <= count; ++i) {
        section.joints.push_back(chain.segments()[first + i].position);
        if (i < count) section.lengths.push_back(chain.segments()[first + i + 1].length);
    }
    if (!settings.limits.empty()) {
        const auto begin = settings.state.rotations.begin() + static_cast<std::ptrdiff_t>(first);
        section.rotations.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    }
    return section;
}

/// Solves the section by itself; its first joint stays.
void solve_section(Section& section, const Chain& chain, const ReachSettings& settings, glm::vec3 target,
                   ik::Options options, ChainRuntime& runtime) {
    ik::State state(section.count);
    if (!section.rotations.empty()) {
        options.limits = std::span(settings.limits).subspan(section.first, section.count);
        state.rotations = section.rotations;
    }
    const bool fits = settings.method != ik::Method::TwoBone || section.count == 2;
    const ik::Method method = fits ? settings.method : ik::Method::Fabrik;
    ik::Solver& solver = runtime.solver(section.lengths, chain.default_direction());
    if (solver.solve(method, section.joints, state, target, options).status == ik::Status::InvalidInput) {
        throw std::invalid_argument("the solver does not take this point");
    }
    if (!section.rotations.empty()) section.rotations = state.rotations;
}

/// What a section that is no whole chain is solved with.
ik::Options section_options(const ReachSettings& settings, float tolerance) {
    ik::Options options;
    options.tolerance = tolerance;
    options.max_iterations = settings.iterations;
    options.damping = settings.damping;
    options.rotations = false;
    options.restarts = 0;  // another start may end elsewhere: what is in the hand does not jump
    return options;
}

/// From a dragged joint on. Its first limit is relative to the bone before it, which is turned by `parent`
/// from rest, so the section is solved in that bone's frame, where that limit is a root's.
void solve_beyond(Section& section, const Chain& chain, const ReachSettings& settings, glm::vec3 target,
                  const ik::Options& options, glm::quat parent, ChainRuntime& runtime) {
    const glm::vec3 root = section.joints.front();
    const glm::quat inverse = glm::conjugate(parent);
    const auto turn = [&](const glm::quat& by) {
        for (glm::vec3& joint : section.joints) joint = by * joint;
        for (glm::quat& rotation : section.rotations) rotation = glm::normalize(by * rotation);
    };
    const auto shift = [&](glm::vec3 by) {
        for (glm::vec3& joint : section.joints) joint += by;
    };
    shift(-root);
    turn(inverse);
    solve_section(section, chain, settings, inverse * (target - root), options, runtime);
    turn(parent);
    shift(root);
    section.joints.front() = root;
}

/// Takes the bones beyond a dragged joint along with it; with limits as one stiff body with the bone before
/// it, so that its own limit goes on holding.
void move_along(Section& beyond, glm::vec3 to, glm::quat by) {
    const glm::vec3 from = beyond.joints.front();
    for (glm::vec3& joint : beyond.joints) joint = to + by * (joint - from);
    for (glm::quat& rotation : beyond.rotations) rotation = glm::normalize(by * rotation);
}

void put_back(const Section& section, std::vector<glm::vec3>& joints, ReachSettings& settings) {
    const auto at = static_cast<std::ptrdiff_t>(section.first);
    std::copy(section.joints.begin(), section.joints.end(), joints.begin() + at);
    if (section.rotations.empty()) return;  // there is nothing to be limited
    std::copy(section.rotations.begin(), section.rotations.end(), settings.state.rotations.begin() + at);
}

void drag_root(Chain& chain, ReachSettings& settings, glm::vec3 to, glm::vec3 target, ChainRuntime& runtime) {
    std::vector<glm::vec3> joints = positions(chain);
    const glm::vec3 by = to - joints.front();
    for (glm::vec3& joint : joints) joint += by;
    joints.front() = to;
    require_ok(chain.set_positions(joints));
    solve_reach(chain, settings, target, runtime);
}

void drag_tip(Chain& chain, ReachSettings& settings, glm::vec3 to, ChainRuntime& runtime) {
    ReachSettings exact = settings;
    exact.tolerance = std::min(drag_tolerance * chain.reach(), reach_tolerance(settings, chain.reach()));
    solve_reach(chain, exact, to, runtime);
    settings.state = exact.state;
}

/// From joint to joint, the root first: each section in its turn.
class SectionDrag {
  public:
    SectionDrag(const Chain& chain, ReachSettings& settings, ChainRuntime& runtime)
        : chain_(chain), settings_(settings), runtime_(runtime), joints_(positions(chain)) {}

    void move_root(glm::vec3 to) {
        at_ = to;
        root_moved_ = true;
    }
    /// As near as comes within a fraction of a pixel.
    void drag(const JointPull& pull) {
        Section section = section_of(chain_, settings_, first_, pull.joint - first_);
        float reach = 0.0f;
        for (const float length : section.lengths) reach += length;
        const float tolerance = std::min(drag_tolerance * reach, whole_tolerance());
        // Without limits what lies between two dragged joints turns along with them, and keeps its shape.
        const bool between = first_ > 0 || root_moved_;
        if (between && section.rotations.empty())
            turned_ = least_rotation(direction(section.joints.front(), section.joints.back()),
                                     direction(at_.value_or(joints_.front()), pull.to));
        solve(section, pull.to, tolerance);
        turned_ = section.rotations.empty() ? glm::quat(1, 0, 0, 0) : turned_;
    }
    void reach(glm::vec3 target) {
        Section section = section_of(chain_, settings_, first_, chain_.size() - 1 - first_);
        solve(section, target, whole_tolerance());
    }
    const std::vector<glm::vec3>& joints() const { return joints_; }

  private:
    glm::vec3 direction(glm::vec3 from, glm::vec3 to) const {
        const float length = glm::distance(from, to);
        return length > 1e-6f ? (to - from) / length : chain_.default_direction();
    }
    float whole_tolerance() const { return reach_tolerance(settings_, chain_.reach()); }

    void solve(Section& section, glm::vec3 to, float tolerance) {
        const ik::Options options = section_options(settings_, tolerance);
        const glm::quat was = section.rotations.empty() ? glm::quat(1, 0, 0, 0) : section.rotations.back();
        if (at_) move_along(section, *at_, turned_);
        if (first_ > 0)
            solve_beyond(section, chain_, settings_, to, options, parent_, runtime_);
        else
            solve_section(section, chain_, settings_, to, options, runtime_);
        if (!section.rotations.empty()) {
            parent_ = section.rotations.back();
            turned_ = glm::normalize(parent_ * glm::conjugate(was));
        }
        at_ = section.joints.back();
        put_back(section, joints_, settings_);
        first_ += section.count;
    }

    const Chain& chain_;
    ReachSettings& settings_;
    ChainRuntime& runtime_;
    std::vector<glm::vec3> joints_;
    std::size_t first_ = 0;        // of the next section
    std::optional<glm::vec3> at_;  // where it begins, once that has moved
    bool root_moved_ = false;
    glm::quat parent_{1, 0, 0, 0}, turned_{1, 0, 0, 0};  // the bone before it, and how that has turned
};

}  // namespace

void drag_joints(Chain& chain, ReachSettings& settings, std::span<const JointPull> pulls, glm::vec3 target,
                 ChainRuntime& runtime) {
    if (!settings.limits.empty()) {  // other modes move a chain and leave its rotations behind
        std::vector<glm::quat>& rotations = state_for(settings, chain.size() - 1).rotations;
        rotations = rotations_at(positions(chain), rotations, chain.default_direction());
    }
    const std::size_t tip = chain.size() - 1;
    if (pulls.size() == 1 && pulls.front().joint == 0)
        return drag_root(chain, settings, pulls.front().to, target, runtime);
    if (pulls.size() == 1 && pulls.front().joint == tip)
        return drag_tip(chain, settings, pulls.front().to, runtime);
    SectionDrag drag(chain, settings, runtime);
    for (const JointPull& pull : pulls) pull.joint == 0 ? drag.move_root(pull.to) : drag.drag(pull);
    if (pulls.back().joint < tip) drag.reach(target);
    require_ok(chain.set_positions(drag.joints()));
}

}  // namespace tendril::app
