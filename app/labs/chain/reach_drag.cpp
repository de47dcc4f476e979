#include "app/labs/chain/reach_drag.hpp"

#include <algorithm>
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

/// From the root to the dragged joint.
void solve_before(Section& section, const Chain& chain, const ReachSettings& settings, glm::vec3 to,
                  ChainRuntime& runtime) {
    float reach = 0.0f;
    for (const float length : section.lengths) reach += length;
    const float tolerance = std::min(drag_tolerance * reach, reach_tolerance(settings, chain.reach()));
    solve_section(section, chain, settings, to, section_options(settings, tolerance), runtime);
}

/// From the dragged joint to the tip. Its first limit is relative to the bone before it, which is turned by
/// `parent` from rest, so the section is solved in that bone's frame, where that limit is a root's.
void solve_beyond(Section& section, const Chain& chain, const ReachSettings& settings, glm::vec3 target,
                  glm::quat parent, ChainRuntime& runtime) {
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
    solve_section(section, chain, settings, inverse * (target - root),
                  section_options(settings, reach_tolerance(settings, chain.reach())), runtime);
    turn(parent);
    shift(root);
    section.joints.front() = root;
}

/// Takes the bones beyond the dragged joint along with it; with limits as one stiff body with the bone
/// before it, so that its own limit goes on holding.
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

void drag_middle(Chain& chain, ReachSettings& settings, std::size_t index, glm::vec3 to, glm::vec3 target,
                 ChainRuntime& runtime) {
    const std::size_t bones = chain.size() - 1;
    Section before = section_of(chain, settings, 0, index);
    Section beyond = section_of(chain, settings, index, bones - index);
    glm::quat turned(1, 0, 0, 0), parent(1, 0, 0, 0);
    if (!before.rotations.empty()) turned = glm::conjugate(before.rotations.back());
    solve_before(before, chain, settings, to, runtime);
    if (!before.rotations.empty()) {
        parent = before.rotations.back();
        turned = glm::normalize(parent * turned);
    }
    move_along(beyond, before.joints.back(), turned);
    solve_beyond(beyond, chain, settings, target, parent, runtime);
    std::vector<glm::vec3> joints = positions(chain);
    put_back(before, joints, settings);
    put_back(beyond, joints, settings);
    require_ok(chain.set_positions(joints));
}

}  // namespace

void drag_joint(Chain& chain, ReachSettings& settings, std::size_t index, glm::vec3 to, glm::vec3 target,
                ChainRuntime& runtime) {
    if (index >= chain.size()) {
        throw std::out_of_range("index " + std::to_string(index) + " is out of range, the chain has " +
                                std::to_string(chain.size()) + " segments");
    }
    if (!settings.limits.empty()) {  // other modes move a chain and leave its rotations behind
        std::vector<glm::quat>& rotations = state_for(settings, chain.size() - 1).rotations;
        rotations = rotations_at(positions(chain), rotations, chain.default_direction());
    }
    if (index == 0) {
        drag_root(chain, settings, to, target, runtime);
    } else if (index + 1 == chain.size()) {
        drag_tip(chain, settings, to, runtime);
    } else {
        drag_middle(chain, settings, index, to, target, runtime);
    }
}

}  // namespace tendril::app
