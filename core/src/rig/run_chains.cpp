// The units that solve a chain of bones.
#include <algorithm>

#include "rig/math.hpp"
#include "rig/runner.hpp"
#include "rig/workspace.hpp"
#include "tendril/rig/transform_units.hpp"

namespace tendril::rig {

Workspace::Workspace(const Rig& rig) : parts_(std::make_unique<Parts>()) {
    parts_->chains.resize(rig.unit_names().size());
    std::size_t parents = 0;
    const auto count = [&](const auto& self, const std::vector<Unit>& units) -> void {
        for (const Unit& unit : units) {
            if (const auto* constraint = std::get_if<ParentConstraint>(&unit.operation))
                parents = std::max(parents, constraint->parents.size());
            if (const auto* for_each = std::get_if<ForEach>(&unit.operation))
                self(self, for_each->body.units());
        }
    };
    count(count, rig.definition().units);
    parts_->parents.reserve(parents);
}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

void Runner::operator()(const TwoBone& op) noexcept {
    solve_chain(ik::Method::TwoBone, op.target, op.pole_target);
}
void Runner::operator()(const Fabrik& op) noexcept {
    solve_chain(ik::Method::Fabrik, op.target, op.pole_target);
}

glm::dvec3 Runner::bone_place(std::size_t bone) noexcept {
    const std::uint32_t element = plan_.layout->units[unit_].bones[bone];
    return state_.elements.get(plan_.layout->ids[element], Space::Global).translation;
}

/// In metres. From quantities that do not change with the pose: unless a scale changes, the length keeps its
/// bits, and the solver made for it can be reused.
float Runner::bone_length(std::size_t bone) noexcept {
    const std::vector<std::uint32_t>& elements = plan_.layout->units[unit_].bones;
    const glm::dvec3 scale = state_.elements.get(plan_.layout->ids[elements[bone]], Space::Global).scale;
    const glm::dvec3 along =
        state_.elements.get(plan_.layout->ids[elements[bone + 1]], Space::Local).translation;
    const glm::dvec3 scaled(scale.x * along.x, scale.y * along.y, scale.z * along.z);
    return static_cast<float>(detail::length(scaled));
}

/// A solver for the current bone lengths: made at the first solve, and again whenever a length differs at
/// all. Otherwise the result would depend on earlier solvers.
bool Runner::prepare_chain(ChainScratch& chain) {
    const std::size_t bones = plan_.layout->units[unit_].bones.size() - 1;
    const glm::dvec3 origin = bone_place(0);
    chain.joints.resize(bones + 1);
    chain.before.resize(bones);
    chain.lengths.resize(bones);
    bool same = chain.solver.has_value();
    chain.joints[0] = glm::vec3(0.0f);
    for (std::size_t i = 0; i < bones; ++i) {
        const float length = bone_length(i);
        same = same && chain.lengths[i] == length;
        chain.lengths[i] = length;
        chain.joints[i + 1] = math::narrow(detail::minus(bone_place(i + 1), origin));
        chain.before[i] =
            state_.elements.get(plan_.layout->ids[plan_.layout->units[unit_].bones[i]], Space::Local)
                .rotation;
    }
    if (same) return true;
    chain.solver.reset();
    auto solver = ik::Solver::make(chain.lengths);
    if (solver) chain.solver.emplace(std::move(*solver));
    return chain.solver.has_value();
}

/// Turns each bone, root first, by the shortest arc from its current direction to the solved one.
void Runner::turn_bones(const ChainScratch& chain) noexcept {
    Hierarchy& tree = state_.elements;
    const std::vector<std::uint32_t>& elements = plan_.layout->units[unit_].bones;
    for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
        const glm::dvec3 is = detail::minus(bone_place(i + 1), bone_place(i));
        const glm::dvec3 should = math::between(chain.joints[i], chain.joints[i + 1]);
        Transform pose = tree.get(plan_.layout->ids[elements[i]], Space::Global);
        pose.rotation = normalised(math::compose(from_two_vectors(is, should), pose.rotation));
        tree.put(plan_.layout->ids[elements[i]], Space::Global, pose);
    }
    if (weight_ >= 1.0) return;
    for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
        Transform pose = tree.get(plan_.layout->ids[elements[i]], Space::Local);
        pose.rotation = blend(chain.before[i], pose.rotation, weight_);
        tree.put(plan_.layout->ids[elements[i]], Space::Local, pose);
    }
}

void Runner::solve_chain(ik::Method method, const Input<glm::dvec3>& target,
                         const std::optional<Input<glm::dvec3>>& pole_target) noexcept {
    const std::size_t bones = plan_.layout->units[unit_].bones.size() - 1;
    const glm::dvec3 to = read(target), origin = bone_place(0);
    if (weight_ > 0.0) {
        ChainScratch& chain = workspace_.parts().chains[unit_];
        if (!prepare_chain(chain)) {
            warn(Warning::CannotSolve);
        } else {
            const auto* remembered = std::get_if<ik::State>(&memory().held);
            if (!remembered || remembered->bones() != bones) memory().held = chain.solver->initial_state();
            ik::Options options;
            if (pole_target) options.pole = math::narrow(detail::minus(read(*pole_target), origin));
            const ik::Report report =
                chain.solver->solve(method, chain.joints, std::get<ik::State>(memory().held),
                                    math::narrow(detail::minus(to, origin)), options);
            if (report.status == ik::Status::InvalidInput)
                warn(Warning::CannotSolve);
            else
                turn_bones(chain);
        }
    }
    hand_out(0, detail::length(detail::minus(to, bone_place(bones))));
}

}  // namespace tendril::rig
