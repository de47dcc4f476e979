// The direct solver on a block, for a register of any width. Not installed; included once per vector unit.
//
// Let q_k be the direction in which the tension of link k acts, n_k the direction of the link, and w_k the
// inverse mass of node k. To first order link k gets shorter by
//
//     -w_k (n_k q_{k-1}) t_{k-1} + (w_k + w_{k+1}) (n_k q_k) t_k - w_{k+1} (n_k q_{k+1}) t_{k+1}
//
// for Lagrange multipliers t: one tridiagonal system per chain. No operation is fused, so every lane has the
// same bits with every vector unit.
#if defined(TENDRIL_ROPE_DIRECT_STEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_ROPE_DIRECT_STEP_INL
#undef TENDRIL_ROPE_DIRECT_STEP_INL
#else
#define TENDRIL_ROPE_DIRECT_STEP_INL
#endif

#include <hwy/highway.h>

#include "rope/direct_block.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::rope::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
struct Vector3 {
    hn::Vec<D> x, y, z;
};

template <class D>
class BlockSolver {
    using V = hn::Vec<D>;
    using V3 = Vector3<D>;

  public:
    explicit BlockSolver(const Block& block) : block_(block) {}

    void run(SolveJob& job) {
        store_old_directions();
        if (job.implicit) apply_implicit_tension(job);
        // The first pass is unconditional: checking whether it is needed costs half as much as doing it.
        const V max_passes = hn::LoadU(d_, job.passes);
        V worst = set(1e300);
        job.passes_taken = 0;
        for (;; ++job.passes_taken) {
            const auto open =
                hn::And(hn::Gt(worst, set(job.tolerance)), hn::Lt(set(job.passes_taken), max_passes));
            if (hn::AllFalse(d_, open)) break;
            correct_lengths(open, job);
            worst = max_error();
        }
        HWY_ALIGN double lanes[max_lanes] = {};
        hn::Store(worst, d_, lanes);
        for (std::size_t i = 0; i < block_.lanes; ++i) job.worst[i] = lanes[i];
    }

  private:
    V load(std::size_t node, std::size_t row) const { return hn::Load(d_, block_.at(node, row)); }
    V3 load3(std::size_t node, std::size_t row) const {
        return {load(node, row), load(node, row + 1), load(node, row + 2)};
    }
    void store(V value, std::size_t node, std::size_t row) const {
        hn::Store(value, d_, block_.at(node, row));
    }
    void store3(const V3& value, std::size_t node, std::size_t row) const {
        store(value.x, node, row), store(value.y, node, row + 1), store(value.z, node, row + 2);
    }
    V set(double value) const { return hn::Set(d_, value); }
    // Return the second if either is NaN, in every vector unit. Highway's Max and Min leave NaN to the
    // machine; x86's instructions do exactly this, and are faster.
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
    static V larger(V a, V b) {
        return hn::Max(a, b);
    }
    static V smaller(V a, V b) {
        return hn::Min(a, b);
    }
#else
    static V larger(V a, V b) {
        return hn::IfThenElse(hn::Gt(a, b), a, b);
    }
    static V smaller(V a, V b) {
        return hn::IfThenElse(hn::Lt(a, b), a, b);
    }
#endif
    static V3 plus(const V3& a, const V3& b) {
        return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
    }
    static V3 minus(const V3& a, const V3& b) {
        return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
    }
    static V3 times(V by, const V3& a) {
        return {hn::Mul(by, a.x), hn::Mul(by, a.y), hn::Mul(by, a.z)};
    }
    static V dot(const V3& a, const V3& b) {
        return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
    }
    /// The unit vector and the length; +X if the length is about zero.
    V3 unit(const V3& a, V& length) const {
        length = hn::Sqrt(dot(a, a));
        const auto none = hn::Lt(length, set(1e-30));
        const V inverse = hn::Div(set(1.0), larger(length, set(1e-30)));
        const V3 along = times(inverse, a);
        return {hn::IfThenElse(none, set(1.0), along.x), hn::IfThenZeroElse(none, along.y),
                hn::IfThenZeroElse(none, along.z)};
    }

    void store_old_directions() const {
        V length;
        V3 from = load3(0, OldX);
        for (std::size_t k = 0; k < block_.links; ++k) {
            const V3 to = load3(k + 1, OldX);
            store3(unit(minus(to, from), length), k, OldX);
            from = to;
        }
    }

    /// The length of a link under its current tension.
    V loaded_length(std::size_t k) const {
        const V longer = hn::Mul(load(k, Compliance), larger(load(k, Multiplier), hn::Zero(d_)));
        return larger(hn::Add(load(k, Rest), longer), set(1e-9));
    }

    /// Half of the current tension over the length: the force per metre between the nodes. It is bounded: in
    /// a rope that cannot be as short as its pins require it would drown all other digits.
    V stiffness(std::size_t k) const {
        const V both = hn::Add(load(k, Weight), load(k + 1, Weight));
        const V half =
            hn::Div(hn::Mul(set(0.5), larger(load(k, Multiplier), hn::Zero(d_))), loaded_length(k));
        return smaller(half, hn::Div(set(1e8), larger(both, set(1e-30))));
    }

    /// Nodes move from their base by tensions along the old and the new directions. Tension never acts
    /// sideways here: all three coordinates share one tridiagonal matrix.
    void apply_implicit_tension(const SolveJob& job) const {
        const V backward = hn::LoadU(d_, job.backward);
        const V ahead = hn::Add(set(1.0), backward), behind = hn::Sub(set(1.0), backward);
        V stiff_before = hn::Zero(d_), upper = hn::Zero(d_);
        V3 old_before{hn::Zero(d_), hn::Zero(d_), hn::Zero(d_)}, right = old_before;
        for (std::size_t k = 0; k <= block_.links; ++k) {
            const bool last = k == block_.links;
            const V weight = load(k, Weight);
            const V stiff = last ? hn::Zero(d_) : stiffness(k),
                    length = last ? hn::Zero(d_) : loaded_length(k);
            const V3 old = last ? V3{hn::Zero(d_), hn::Zero(d_), hn::Zero(d_)}
                                : times(hn::Mul(stiff, length), load3(k, OldX));
            const V up = hn::Mul(hn::Mul(weight, ahead), stiff);
            const V down = hn::Mul(hn::Mul(weight, ahead), stiff_before);
            const V pivot = hn::Add(hn::Add(hn::Add(set(1.0), up), down), hn::Mul(down, upper));
            const V inverse = hn::Div(set(1.0), pivot);
            const V3 moved = times(hn::Mul(weight, behind), minus(old, old_before));
            right = times(inverse, plus(plus(load3(k, BaseX), moved), times(down, right)));
            upper = hn::Neg(hn::Mul(up, inverse));
            store(upper, k, Upper);
            store3(right, k, X);
            if (!last) {
                store(hn::Mul(ahead, stiff), k, Right);
                store(hn::Mul(hn::Mul(behind, stiff), length), k, Multiplier);
            }
            stiff_before = stiff;
            old_before = old;
        }
        V3 next_x = right;
        for (std::size_t k = block_.links; k-- > 0;) {
            const V3 to = next_x;
            next_x = minus(load3(k, X), times(load(k, Upper), to));
            store3(next_x, k, X);
            // From here on only the applied tension counts: large old and new pulls may cancel.
            const V3 pull = plus(times(load(k, Multiplier), load3(k, OldX)),
                                 times(load(k, Right), minus(to, next_x)));
            store(hn::Sqrt(dot(pull, pull)), k, Multiplier);
        }
    }

    V max_error() const {
        V worst = hn::Zero(d_);
        V3 from = load3(0, X);
        for (std::size_t k = 0; k < block_.links; ++k) {
            const V3 to = load3(k + 1, X), by = minus(to, from);
            const V rest = load(k, Rest);
            const V error = hn::Sub(hn::Sub(hn::Sqrt(dot(by, by)), rest),
                                    hn::Mul(load(k, Compliance), load(k, Multiplier)));
            // NaN counts as failed.
            const V part = hn::Div(hn::Abs(error), larger(rest, set(1e-9)));
            worst = larger(worst, smaller(part, set(1e300)));
            from = to;
        }
        return worst;
    }

    /// One pass: corrects the lengths to first order in the lanes `open`.
    template <class M>
    void correct_lengths(M open, const SolveJob& job) const {
        eliminate(job);
        const V zero = hn::Zero(d_);
        V change_after = zero;
        V3 impulse_after = {zero, zero, zero};  // the change times its direction
        for (std::size_t k = block_.links; k-- > 0;) {
            change_after = hn::Sub(load(k, Right), hn::Mul(load(k, Upper), change_after));
            const V change = hn::IfThenElseZero(open, change_after);
            store(hn::Add(load(k, Multiplier), change), k, Multiplier);
            const V3 impulse = times(change, load3(k, DirectionX));
            move(k + 1, minus(impulse_after, impulse));
            impulse_after = impulse;
        }
        move(0, impulse_after);
    }

    void move(std::size_t k, const V3& by) const {
        store3(plus(load3(k, X), times(load(k, Weight), by)), k, X);
    }

    void eliminate(const SolveJob& job) const {
        const V zero = hn::Zero(d_), half = set(0.5), backward = hn::LoadU(d_, job.backward);
        const V after = hn::Add(half, hn::Mul(half, backward)),
                before = hn::Sub(half, hn::Mul(half, backward));
        V upper_before = zero, right_before = zero;
        V3 q_before{zero, zero, zero}, n_before = q_before;
        V3 from = load3(0, X);
        for (std::size_t k = 0; k < block_.links; ++k) {
            const V3 to = load3(k + 1, X);
            V length;
            const V3 n = unit(minus(to, from), length), old = load3(k, OldX);
            // Over a right angle in two substeps is too fast for the mean to be useful.
            const auto slow = hn::Gt(dot(n, old), zero);
            const V3 mean = plus(times(after, n), times(before, old));
            const V3 q{hn::IfThenElse(slow, mean.x, n.x), hn::IfThenElse(slow, mean.y, n.y),
                       hn::IfThenElse(slow, mean.z, n.z)};
            store3(q, k, DirectionX);
            const V compliance = load(k, Compliance);
            const V error = hn::Sub(hn::Sub(length, load(k, Rest)), hn::Mul(compliance, load(k, Multiplier)));
            const V weight = load(k, Weight), both = hn::Add(weight, load(k + 1, Weight));
            const V diagonal = hn::Add(hn::Mul(both, dot(n, q)), compliance);
            const V lower = hn::Neg(hn::Mul(weight, dot(n, q_before)));
            const V up_before = hn::Neg(hn::Mul(weight, dot(n_before, q)));  // of row k - 1
            // The previous row can be finished only now that its upper entry is known.
            V upper_ready = zero;
            if (k > 0) {
                upper_ready = hn::Mul(up_before, upper_before);
                store(upper_ready, k - 1, Upper);
            }
            const V pivot =
                hn::Sub(hn::Add(diagonal, hn::Mul(set(job.damping), both)), hn::Mul(lower, upper_ready));
            const V inverse = hn::Div(set(1.0), larger(pivot, larger(hn::Mul(set(1e-10), both), set(1e-30))));
            // Nothing to solve between two pinned nodes.
            const auto fixed = hn::Le(both, zero);
            right_before =
                hn::IfThenZeroElse(fixed, hn::Mul(inverse, hn::Sub(error, hn::Mul(lower, right_before))));
            upper_before = hn::IfThenZeroElse(fixed, inverse);
            store(right_before, k, Right);
            q_before = q;
            n_before = n;
            from = to;
        }
        store(zero, block_.links - 1, Upper);
    }

    D d_;
    Block block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tendril::rope::detail
HWY_AFTER_NAMESPACE();

#endif
