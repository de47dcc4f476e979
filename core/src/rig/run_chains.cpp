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
    const auto count = [&](const auto& self, const Units& units) -> void {
        for (const Unit& unit : units) {
            if (const auto* constraint = std::get_if<ParentConstraint>(&unit.operation))
                parents = std::max(parents, constraint->parents.size());
            if (const auto* for_each = std::get_if<ForEach>(&unit.operation)) self(self, for_each->body);
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

glm::dvec3 Runner::bone_position(std::size_t bone) noexcept {
    const std::uint32_t element = plan_.layout->units[unit_].bones[bone];
    return state_.elements.get(plan_.layout->ids[element], Space::Global).translation;
}

/// Length in metres, from quantities that do not depend on the pose: the length stays the same to the last
/// bit unless a scale changes, so the chain's solver can be reused.
float Runner::bone_length(std::size_t bone) noexcept {
    const std::vector<std::uint32_t>& elements = plan_.layout->units[unit_].bones;
    const glm::dvec3 scale = state_.elements.get(plan_.layout->ids[elements[bone]], Space::Global).scale;
    const glm::dvec3 along =
        state_.elements.get(plan_.layout->ids[elements[bone + 1]], Space::Local).translation;
    const glm::dvec3 scaled(scale.x * along.x, scale.y * along.y, scale.z * along.z);
    return static_cast<float>(detail::length(scaled));
}

/// Measures joints and bones. True if the lengths are the same as last time.
bool Runner::measure_chain(ChainScratch& chain) {
    const std::size_t bones = plan_.layout->units[unit_].bones.size() - 1;
    const glm::dvec3 origin = bone_position(0);
    chain.joints.resize(bones + 1);
    chain.rotations_before.resize(bones);
    chain.lengths.resize(bones);
    bool same = true;
    chain.joints[0] = glm::vec3(0.0f);
    for (std::size_t i = 0; i < bones; ++i) {
        const float length = bone_length(i);
        same = same && chain.lengths[i] == length;
        chain.lengths[i] = length;
        chain.joints[i + 1] = math::narrow(detail::minus(bone_position(i + 1), origin));
        chain.rotations_before[i] =
            state_.elements.get(plan_.layout->ids[plan_.layout->units[unit_].bones[i]], Space::Local)
                .rotation;
    }
    return same;
}

/// Makes a solver for the current bone lengths at the first solve, and again whenever a length differs at
/// all. Otherwise the result would depend on earlier solves.
bool Runner::prepare_chain(ChainScratch& chain) {
    if (measure_chain(chain) && chain.solver) return true;
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
        const glm::dvec3 current = detail::minus(bone_position(i + 1), bone_position(i));
        const glm::dvec3 solved = math::between(chain.joints[i], chain.joints[i + 1]);
        Transform pose = tree.get(plan_.layout->ids[elements[i]], Space::Global);
        pose.rotation = normalised(math::compose(from_two_vectors(current, solved), pose.rotation));
        tree.put(plan_.layout->ids[elements[i]], Space::Global, pose);
    }
    if (weight_ >= 1.0) return;
    for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
        Transform pose = tree.get(plan_.layout->ids[elements[i]], Space::Local);
        pose.rotation = blend(chain.rotations_before[i], pose.rotation, weight_);
        tree.put(plan_.layout->ids[elements[i]], Space::Local, pose);
    }
}

void Runner::solve_chain(ik::Method method, const Input<glm::dvec3>& target,
                         const std::optional<Input<glm::dvec3>>& pole_target) noexcept {
    const std::size_t bones = plan_.layout->units[unit_].bones.size() - 1;
    const glm::dvec3 to = read(target), origin = bone_position(0);
    if (weight_ > 0.0) {
        ChainScratch& chain = workspace_.chains[unit_];
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
    set_output(0, detail::length(detail::minus(to, bone_position(bones))));
}

/// The bones' initial directions; +X where two coincide.
void Runner::measure_rest_directions(ChainScratch& chain) {
    const std::vector<std::uint32_t>& elements = plan_.layout->units[unit_].bones;
    chain.rest_directions.clear();
    for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
        const auto at = [&](std::size_t k) {
            return state_.elements.get(plan_.layout->ids[elements[k]], Space::Global, Pose::Initial)
                .translation;
        };
        const glm::dvec3 along = detail::minus(at(i + 1), at(i));
        const double length = detail::length(along);
        chain.rest_directions.push_back(
            length > 0.0 ? math::narrow(glm::dvec3(along.x / length, along.y / length, along.z / length))
                         : glm::vec3(1.0f, 0.0f, 0.0f));
    }
}

/// Moves the root to the first joint, turns the bones from their initial poses, and scales their lengths by
/// the factor, each blended by the weight.
void Runner::pose_spline_chain(const ChainScratch& chain, const glm::dvec3& first, double factor) noexcept {
    Hierarchy& tree = state_.elements;
    const std::vector<std::uint32_t>& elements = plan_.layout->units[unit_].bones;
    Transform root = tree.get(plan_.layout->ids[elements[0]], Space::Global);
    root.translation = weight_ >= 1.0 ? first : detail::mix(root.translation, first, weight_);
    place(plan_.layout->ids[elements[0]], Space::Global, root, true);
    for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
        const ElementId id = plan_.layout->ids[elements[i]], next = plan_.layout->ids[elements[i + 1]];
        Transform pose = tree.get(id, Space::Global);
        pose.rotation = normalised(math::compose(glm::dquat(chain.placed.rotations[i]),
                                                 tree.get(id, Space::Global, Pose::Initial).rotation));
        tree.put(id, Space::Global, pose);
        if (factor == 1.0) continue;
        pose = tree.get(next, Space::Local);
        pose.translation = detail::times(pose.translation, 1.0 + weight_ * (factor - 1.0));
        place(next, Space::Local, pose, true);
    }
    turn_bones(chain);  // corrects bones whose tip has moved within its parent since the initial pose
}

void Runner::operator()(const Spline& op) noexcept {
    const detail::UnitPlan& unit = plan_.layout->units[unit_];
    const auto point = [&](std::size_t i) {
        return state_.elements.get(plan_.layout->ids[unit.points[i]], Space::Global).translation;
    };
    const std::size_t bones = unit.bones.size() - 1;
    const glm::dvec3 origin = point(0), end = point(unit.points.size() - 1);
    ik::CurveReport report;
    if (weight_ > 0.0) {
        ChainScratch& chain = workspace_.chains[unit_];
        measure_chain(chain);
        measure_rest_directions(chain);
        chain.points.clear();
        for (std::size_t i = 0; i < unit.points.size(); ++i)
            chain.points.push_back(math::narrow(detail::minus(point(i), origin)));
        if (chain.placed.bones() != bones) chain.placed = ik::State(bones);
        constexpr double radian = math::pi / 180.0;
        const auto max_factor = static_cast<float>(parameter(op.max_factor, 100.0));
        const ik::CurveOptions options{
            .kind = read(op.b_spline) ? ik::CurveKind::BSpline : ik::CurveKind::Hermite,
            .fit = read(op.fit) && max_factor > 1.0f,
            .max_factor = max_factor > 1.0f ? max_factor : 2.0f,
            .up = math::narrow(read(op.up)),
            .roll_start = static_cast<float>(read(op.roll_start_deg) * radian),
            .roll_end = static_cast<float>(read(op.roll_end_deg) * radian)};
        report = ik::place_along(chain.points, {chain.lengths, chain.rest_directions}, chain.joints,
                                 chain.placed, chain.curve_memory, options);
        if (report.status == ik::Status::InvalidInput)
            warn(Warning::CannotSolve);
        else
            pose_spline_chain(chain, origin, static_cast<double>(report.factor));
    }
    set_output(0, detail::length(detail::minus(end, bone_position(bones))));
    const bool stretched =
        report.status == ik::Status::Stretched;  // otherwise only rounding puts the tip past the end
    set_output(1, stretched ? static_cast<double>(report.bones_past_end) : 0.0);
    set_output(2, stretched ? static_cast<double>(report.past_end) : 0.0);
    set_output(3, static_cast<double>(report.factor));
}

}  // namespace tendril::rig
