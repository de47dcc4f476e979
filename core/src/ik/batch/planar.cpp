// The part of work.cpp for chains in a plane. As plane.cpp does, it solves them in the plane's coordinates,
// where the iterations for chains in space keep them flat. Coordinates and sides, found once per solve, are
// scalar and in double; the iterations are not. With angle limits the scalar solver takes every chain.

#include "ik/batch/work.hpp"
#include "ik/math.hpp"
#include "ik/pole/pole.hpp"
#include "ik/solve/plane.hpp"
#include "ik/solve/validate.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::ik::detail {
namespace {

/// Metres: with a root nearer to the origin than this, relative coordinates stay below max_magnitude.
constexpr float precise_range = 0.25f * max_magnitude;

}  // namespace

JointAccess Work::home(std::size_t chain) const noexcept {
    if (in_.joints != nullptr) return {&in_.joints[chain * (in_.bones + 1)].x, 3, 1};
    return {in_.blocks + chain / block_lanes * Block::chain_floats(in_.bones) + chain % block_lanes,
            3 * block_lanes, block_lanes};
}

/// Converts joints and targets to the plane's coordinates, and chooses the side of each chain.
void Work::project_to_plane(const Block& block, std::size_t first, std::size_t lanes,
                            Scratch& scratch) const noexcept {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const JointAccess joints = home(first + lane);
        const PlaneFrame frame = frame_.at(joints.joint(0));
        for (std::size_t i = 0; i <= in_.bones; ++i) block.set_point(i, lane, frame.local(joints.joint(i)));
        const glm::vec3 local = frame.local(block.target_of(lane));
        block.at(Row::TargetX, lane) = local.x;
        block.at(Row::TargetY, lane) = local.y;
        block.at(Row::TargetZ, lane) = local.z;
        Side side = in_.options.plane->bend;
        block.at(Row::Side, lane) = static_cast<float>(side);
        if (side == Side::Free) side = planar_side(load_problem(block, lane, scratch));
        if (side == Side::Free) side = Side::Left;
        block.at(Row::Side, lane) = static_cast<float>(side);
    }
}

/// Called once lengths are enforced: turns chains within reach to their targets, on their sides.
void Work::rotate_to_targets(const Block& block, std::size_t first, std::size_t lanes,
                             Scratch& scratch) const noexcept {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const glm::vec3 root = home(first + lane).joint(0);
        // So far from the origin, coordinates relative to the root do not show whether all are in range.
        float* const found = block.row(Row::Class) + lane;
        if (!(largest_coordinate(root) <= precise_range) || block.class_of(lane) == Class::Invalid)
            *found = static_cast<float>(Class::Scalar);
        if (block.class_of(lane) != Class::Reachable) continue;
        Problem problem = load_problem(block, lane, scratch);
        transport_to_pole(problem, Unwatched());
        for (std::size_t i = 1; i <= in_.bones; ++i) block.set_point(i, lane, problem.joints[i]);
    }
}

/// Finishes a chain: turns it to its side and writes it back to the caller or the batch. Joints that have not
/// moved keep their bits.
void Work::return_from_plane(const Block& block, std::size_t lane, std::size_t chain,
                             Scratch& scratch) const noexcept {
    if (block.class_of(lane) == Class::Invalid) return;
    Problem problem = load_problem(block, lane, scratch);
    face_pole(problem, Unwatched());
    const JointAccess joints = home(chain);
    const PlaneFrame frame = frame_.at(joints.joint(0));
    for (std::size_t i = 1; i <= in_.bones; ++i)
        joints.set_joint(i, frame.returned(problem.joints[i], joints.joint(i), scratch.scalar.reach));
}

/// Same as Solver::solve in this plane.
void Work::solve_in_plane(std::size_t chain, Scratch& scratch) noexcept {
    Workspace& scalar = scratch.scalar;
    const float* const rows = in_.blocks + chain / block_lanes * Block::chain_floats(in_.bones) +
                              Block::joint_floats(in_.bones) + chain % block_lanes;
    const JointAccess joints = home(chain);
    for (std::size_t i = 0; i <= in_.bones; ++i) scalar.joints[i] = joints.joint(i);
    for (std::size_t i = 0; i < in_.bones; ++i) scalar.lengths[i] = rows[i * block_lanes];
    scalar.reach = rows[in_.bones * block_lanes];
    scalar.longest = rows[(in_.bones + 1) * block_lanes];
    const glm::vec3 target = in_.targets[chain];
    if (!are_points(scalar.joints) || !are_points({&target, 1})) {
        report_invalid(chain);
        return;
    }
    scalar.saved.reset();  // results must not depend on the previous chain
    PlaneProblem problem(scalar, scalar.joints, scalar.saved, target, in_.options);
    const Report answer = problem.solve(Method::Fabrik, nullptr);
    for (std::size_t i = 1; i <= in_.bones; ++i) joints.set_joint(i, scalar.joints[i]);
    report_fallback(chain, answer);
}

void Work::solve_angled_block(std::size_t index, std::size_t lanes, Scratch& scratch) noexcept {
    for (std::size_t lane = 0; lane < lanes; ++lane) solve_in_plane(index * block_lanes + lane, scratch);
}

}  // namespace tendril::ik::detail
