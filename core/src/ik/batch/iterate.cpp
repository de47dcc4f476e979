// The iterations of solve_many, block by block: FABRIK's two passes, the step of shape-inl.hpp, and the
// decision on how each chain continues, by the rules of solve/loop.cpp and solve/convergence.hpp.
#include <array>

#include "ik/batch/vector.hpp"

#define HWY_TARGET_INCLUDE "ik/batch/iterate.cpp"
#include "math/each_target-inl.hpp"

#include "ik/batch/shape-inl.hpp"
#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

using namespace tune::chain;

HWY_INLINE Lanes all(int value) {
    return all(static_cast<float>(value));
}

/// The registers of a block with active chains; `all` is true if all their lanes are active.
struct Registers {
    std::array<std::uint16_t, block_lanes> first;
    std::size_t count = 0;
    bool whole = true;
};

HWY_INLINE Mask active_lanes(const Block& block, std::size_t i) {
    return equals(block.row(Row::Activity) + i, Activity::Active);
}

HWY_INLINE Registers active_registers(const Block& block, std::size_t lanes) {
    const Floats d;
    Registers registers;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const Mask active = active_lanes(block, i);
        if (!any(active)) continue;
        registers.first[registers.count++] = static_cast<std::uint16_t>(i);
        registers.whole = registers.whole && hn::AllTrue(d, active);
    }
    return registers;
}

/// Forward reaching, then backward reaching. All registers take each step side by side, so that none waits
/// for its own square root.
template <bool some>
HWY_INLINE void reach_both_ways(const Block& block, const Registers& registers) {
    const std::size_t bones = block.bones();
    const float* const activity = block.row(Row::Activity);
    for (std::size_t k = 0; k < registers.count; ++k) {
        const std::size_t i = registers.first[k];
        float* const tip = block.joint(bones) + i;
        const Points target = load_points(block.target() + i);
        store_points(some ? select(active_lanes(block, i), target, load_points(tip)) : target, tip);
    }
    // Forward reaching skips the root: it stays.
    for (std::size_t bone = bones; bone-- > 1;) {
        const StepRows rows{block.joint(bone + 1), block.joint(bone), block.length(bone)};
        for (std::size_t k = 0; k < registers.count; ++k) step<some>(rows, activity, registers.first[k]);
    }
    for (std::size_t bone = 0; bone < bones; ++bone) {
        const StepRows rows{block.joint(bone), block.joint(bone + 1), block.length(bone)};
        for (std::size_t k = 0; k < registers.count; ++k) step<some>(rows, activity, registers.first[k]);
    }
}

/// Lanes that take the accelerated step in this iteration: with few bones it costs more than the passes, so
/// every other iteration skips it.
HWY_INLINE Mask is_accelerated(const Block& block, std::size_t i) {
    if (block.bones() >= few_bones) return hn::Not(none());
    const Lanes iteration = hn::Add(load(block.row(Row::Iterations) + i), all(1.0f));
    const Lanes half = hn::Mul(iteration, all(0.5f));
    return hn::Eq(hn::Floor(half), half);
}

/// Some lanes of a block, side by side in another block.
struct Gathered {
    Block block;
    LaneList home;  ///< original lane of each

    explicit Gathered(const Block& in) : block(in) {}

    /// Adds the input of the accelerated step. `home_of` maps each lane to its original lane.
    template <class JointAccess>
    void add(const Block& from, const LaneList& lanes, JointAccess home_of) {
        const std::size_t bones = from.bones(), at = home.count;
        gather_lanes(from.joint(0), lanes.span(), block.joint(0) + at, Block::joint_rows(bones));
        gather_lanes(from.length(0), lanes.span(), block.length(0) + at, Block::length_rows(bones));
        gather_lanes(from.target(), lanes.span(), block.target() + at,
                     1 + static_cast<std::size_t>(Row::Residual));
        for (const std::size_t lane : lanes.span()) home.add(home_of(lane));
    }
    void put_back(std::size_t index, const Block& to) const {
        copy_lane(block.joint(1) + index, to.joint(1) + home.lanes[index], 3 * to.bones());
    }
};

HWY_INLINE Lanes fit_tolerance(const Block& block, std::size_t i) {
    return hn::Max(hn::Mul(all(0.25f), load(block.row(Row::Tolerance) + i)),
                   hn::Mul(all(1e-6f), load(block.reach() + i)));
}

HWY_INLINE Family whole_family(const Block& block, std::size_t i, Points& span) {
    const Points root = load_points(block.joint(0) + i);
    span = minus(load_points(block.joint(block.bones()) + i), root);
    return blend_of(span, minus(load_points(block.target() + i), root), load(block.reach() + i));
}

/// Applies the accelerated step to the `lanes` where it brings the tip nearer. If the first family of shapes
/// is not good enough, adds the unchanged chain to `second`. `home` maps a lane to its original lane.
template <class JointAccess>
HWY_INLINE void reshape(const Block& block, std::size_t i, Mask lanes, float* shapes, Gathered& second,
                        JointAccess home) {
    const Lanes residual = load(block.row(Row::Residual) + i);
    const Shape one(shapes), two(shapes + Shape::floats(block.bones()));
    Points span;
    const Family family = whole_family(block, i, span);
    const BestShape best = fit_shape<false>(block, i, family, fit_tolerance(block, i), lanes, one, two);
    const Mask falls_short = hn::Or(hn::Not(best.found), hn::Gt(best.error, hn::Mul(all(0.5f), residual)));
    if (const Mask other = hn::And(lanes, falls_short); any(other)) {
        HWY_ALIGN float errors[16];
        store(best.error, errors);
        LaneList to_second;
        for_each_lane(other, [&](std::size_t lane) {
            second.block.at(Row::Best, second.home.count + to_second.count) = errors[lane];
            to_second.add(i + lane);
        });
        second.add(block, to_second, home);
    }
    place_shape<false>(block, i, hn::And(lanes, hn::Lt(best.error, residual)), family, best, one, two);
}

/// Applies the second family where it is better than the first.
HWY_INLINE void reshape_around_longest(const Gathered& second, const Block& to, float* shapes) {
    const Block& block = second.block;
    const Shape one(shapes), two(shapes + Shape::floats(block.bones()));
    for (std::size_t i = 0; i < second.home.count; i += hn::Lanes(Floats())) {
        const Mask lanes = hn::FirstN(Floats(), second.home.count - i);
        Points span;
        const Family whole = whole_family(block, i, span);
        const Family family = family_around_longest(block, i, span, whole);
        const BestShape best = fit_shape<true>(block, i, family, fit_tolerance(block, i), lanes, one, two);
        const Lanes bound = hn::Min(load(block.row(Row::Best) + i), load(block.row(Row::Residual) + i));
        const Mask better = hn::And(lanes, hn::Lt(best.error, bound));
        place_shape<true>(block, i, better, family, best, one, two);
        for_each_lane(better, [&](std::size_t lane) { second.put_back(i + lane, to); });
    }
}

/// The chains of a block that take the accelerated step in this iteration.
struct StepLanes {
    std::array<Mask, block_lanes> lanes;  ///< one per active register
    std::size_t count = 0, registers = 0;
};

HWY_INLINE StepLanes find_step_lanes(const Block& block, const Registers& registers) {
    StepLanes step_lanes;
    for (std::size_t k = 0; k < registers.count; ++k) {
        const std::size_t i = registers.first[k];
        const Mask active = active_lanes(block, i);
        const Lanes residual = residual_of(block, i);
        float* const row = block.row(Row::Residual) + i;
        store(hn::IfThenElse(active, residual, load(row)), row);
        const Mask falls_short = hn::AndNot(hn::Le(residual, load(block.row(Row::Tolerance) + i)), active);
        step_lanes.lanes[k] = hn::And(falls_short, is_accelerated(block, i));
        const std::size_t count = hn::CountTrue(Floats(), step_lanes.lanes[k]);
        step_lanes.count += count;
        step_lanes.registers += count > 0 ? 1 : 0;
    }
    return step_lanes;
}

/// True if gathering the chains side by side costs less than using their registers as they are. Moving a
/// chain there and back takes about as long as a register's step for one bone in eight.
HWY_INLINE bool should_gather(const StepLanes& step_lanes) {
    const std::size_t width = hn::Lanes(Floats());
    const std::size_t saved = step_lanes.registers - (step_lanes.count + width - 1) / width;
    return 8 * saved > step_lanes.count;
}

/// Takes the step. Also sets Row::Residual of active chains, after the passes and before this step.
HWY_INLINE StepLanes take_step(const Block& block, const Registers& registers, const StepScratch& scratch) {
    const StepLanes step_lanes = find_step_lanes(block, registers);
    if (step_lanes.count == 0) return step_lanes;
    Gathered second(scratch.second);
    const auto own = [](std::size_t lane) { return lane; };
    if (should_gather(step_lanes)) {
        LaneList stepping;
        for (std::size_t k = 0; k < registers.count; ++k) {
            const std::size_t i = registers.first[k];
            for_each_lane(step_lanes.lanes[k], [&](std::size_t lane) { stepping.add(i + lane); });
        }
        Gathered gathered(scratch.gathered);
        gathered.add(block, stepping, own);
        const auto home = [&](std::size_t lane) { return gathered.home.lanes[lane]; };
        for (std::size_t i = 0; i < stepping.count; i += hn::Lanes(Floats())) {
            const Mask lanes = hn::FirstN(Floats(), stepping.count - i);
            reshape(gathered.block, i, lanes, scratch.shapes, second, home);
        }
        scatter_lanes(gathered.block.joint(1), stepping.span(), block.joint(1), 3 * block.bones());
    } else {
        for (std::size_t k = 0; k < registers.count; ++k) {
            if (!any(step_lanes.lanes[k])) continue;
            reshape(block, registers.first[k], step_lanes.lanes[k], scratch.shapes, second, own);
        }
    }
    reshape_around_longest(second, block, scratch.shapes);
    return step_lanes;
}

/// Saves the best poses of active chains before the joints change.
HWY_INLINE void save_best(const Block& block, std::size_t i) {
    float* const saved = block.row(Row::Saved) + i;
    const Mask lanes = hn::And(active_lanes(block, i), hn::Eq(load(saved), zero()));
    if (!any(lanes)) return;
    for (std::size_t joint = 1; joint <= block.bones(); ++joint) {
        copy_points(lanes, block.joint(joint) + i, block.best(joint) + i);
    }
    store(hn::IfThenElse(lanes, all(1.0f), load(saved)), saved);
}

/// Decides how the chains of a register continue after an iteration.
struct Decision {
    Mask continues, perturb;
};

/// Counts the iteration and updates the state that convergence.hpp keeps.
HWY_INLINE Decision record_iteration(const Block& block, std::size_t i, Mask active, Lanes residual,
                                     const IterateJob& job) {
    const auto row = [&](Row which) { return block.row(which) + i; };
    const auto update = [&](Row which, Lanes value) {
        store(hn::IfThenElse(active, value, load(row(which))), row(which));
    };
    const Lanes one = all(1.0f), last = load(row(Row::Last)), nearest = load(row(Row::Nearest)),
                best = load(row(Row::Best)), done = hn::Add(load(row(Row::Iterations)), one);
    const Mask moves =
        hn::Gt(hn::Abs(hn::Sub(residual, last)), hn::Mul(all(stall_moves), load(block.reach() + i)));
    const Mask progresses = hn::Or(moves, hn::Lt(residual, nearest));
    const Lanes idle = hn::IfThenZeroElse(progresses, hn::Add(load(row(Row::Idle)), one));
    const Mask is_slow = hn::Gt(residual, hn::Mul(all(slow_part), last));
    const Lanes slow = hn::IfThenElseZero(is_slow, hn::Add(load(row(Row::Slow)), one));
    const Mask converged = hn::Le(residual, load(row(Row::Tolerance)));
    const Mask nearer = hn::And(active, hn::Lt(residual, best));
    update(Row::Idle, idle), update(Row::Slow, slow);
    update(Row::Nearest, hn::Min(nearest, residual));
    update(Row::Last, residual), update(Row::Residual, residual), update(Row::Iterations, done);
    store(hn::IfThenElse(nearer, residual, best), row(Row::Best));
    store(hn::IfThenZeroElse(nearer, load(row(Row::Saved))), row(Row::Saved));

    const Mask left = hn::And(active, hn::Lt(done, all(static_cast<float>(job.max_iterations))));
    const Mask stalled = hn::Ge(idle, all(stall_window));
    const Mask stuck = hn::Or(stalled, hn::Ge(slow, all(slow_window)));
    const Mask may = hn::Lt(load(row(Row::Perturbations)), all(max_perturbations));
    Decision decision;
    decision.perturb = hn::And(hn::AndNot(converged, left), hn::And(stuck, may));
    decision.continues = left;
    if (!job.every) {
        decision.continues = hn::AndNot(hn::AndNot(decision.perturb, hn::Or(converged, stalled)), left);
    }
    return decision;
}

/// Restores the best pose of chains that are done without having arrived.
HWY_INLINE void restore_best(const Block& block, std::size_t i, Mask done) {
    float* const residual = block.row(Row::Residual) + i;
    const Lanes now = load(residual), best = load(block.row(Row::Best) + i);
    const Mask converged = hn::Le(now, load(block.row(Row::Tolerance) + i));
    const Mask worse = hn::AndNot(converged, hn::And(done, hn::Lt(best, now)));
    if (!any(worse)) return;
    for (std::size_t joint = 1; joint <= block.bones(); ++joint) {
        copy_points(worse, block.best(joint) + i, block.joint(joint) + i);
    }
    store(hn::IfThenElse(worse, best, now), residual);
}

/// Completes an iteration after passes and step, for one register.
HWY_INLINE void finish_iteration(const Block& block, std::size_t i, bool stepped, const IterateJob& job,
                                 Remaining& left) {
    const Mask active = active_lanes(block, i);
    const Lanes residual = stepped ? residual_of(block, i) : load(block.row(Row::Residual) + i);
    const Decision decision = record_iteration(block, i, active, residual, job);
    restore_best(block, i, hn::AndNot(decision.continues, active));
    const auto code = [](Activity value) { return all(static_cast<float>(value)); };
    const Lanes continues = hn::IfThenElse(decision.perturb, code(Activity::Perturb), code(Activity::Active));
    float* const activity = block.row(Row::Activity) + i;
    store(hn::IfThenElse(active, hn::IfThenElseZero(decision.continues, continues), load(activity)),
          activity);
    left.active += hn::CountTrue(Floats(), decision.continues);
    left.perturb = left.perturb || any(decision.perturb);
}

Remaining iterate(const Block& block, std::size_t lanes, const IterateJob& job) {
    Remaining left;
    for (int iteration = 0; iteration < job.iterations && !left.perturb; ++iteration) {
        const Registers registers = active_registers(block, lanes);
        left.active = 0;
        if (registers.count == 0) break;
        for (std::size_t k = 0; k < registers.count; ++k) save_best(block, registers.first[k]);
        if (registers.whole) {
            reach_both_ways<false>(block, registers);
        } else {
            reach_both_ways<true>(block, registers);
        }
        const StepLanes step_lanes = take_step(block, registers, job.step);
        for (std::size_t k = 0; k < registers.count; ++k) {
            finish_iteration(block, registers.first[k], any(step_lanes.lanes[k]), job, left);
        }
    }
    return left;
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(iterate);
}

Iterate* iterate_with(std::int64_t target) noexcept {
    return TENDRIL_COMPILED_FOR(iterate, target);
}

}  // namespace tendril::ik::detail
#endif
