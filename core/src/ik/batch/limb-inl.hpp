// A register of chains within limits: forward kinematics, linearisation, and one damped step of all joints.
// Not installed; included once per vector unit.
#if defined(TENDRIL_IK_BATCH_LIMB_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_IK_BATCH_LIMB_INL
#undef TENDRIL_IK_BATCH_LIMB_INL
#else
#define TENDRIL_IK_BATCH_LIMB_INL
#endif

#include <span>
#include <utility>

#include "ik/batch/limit-inl.hpp"
#include "ik/batch/vector.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

constexpr float violation = 1.9e-7f;  ///< (half-angle)^2 of 0.05 degrees

/// An array of registers.
class Column {
  public:
    explicit Column(float* first) : first_(first) {}
    Lanes lanes(std::size_t i) const { return load(first_ + i * width()); }
    void set(std::size_t i, Lanes to) const { store(to, first_ + i * width()); }
    float lane(std::size_t i, std::size_t lane) const { return first_[i * width() + lane]; }
    Points points(std::size_t i) const { return {lanes(3 * i), lanes(3 * i + 1), lanes(3 * i + 2)}; }
    void set(std::size_t i, const Points& to) const {
        set(3 * i, to.x), set(3 * i + 1, to.y), set(3 * i + 2, to.z);
    }
    Rotations rotations(std::size_t i) const {
        return {lanes(4 * i), {lanes(4 * i + 1), lanes(4 * i + 2), lanes(4 * i + 3)}};
    }
    void set(std::size_t i, const Rotations& to) const {
        set(4 * i, to.w), set(4 * i + 1, to.v.x), set(4 * i + 2, to.v.y), set(4 * i + 3, to.v.z);
    }
    Column after(std::size_t count) const { return Column(first_ + count * width()); }
    static std::size_t width() { return hn::Lanes(Floats()); }

  private:
    float* first_;
};

/// Each bone's rotation relative to its parent and the limits that it is at, and the resulting joints and
/// world rotations.
struct Pose {
    Column local;
    Column outward;  ///< points: Standing::outward
    Column ends;     ///< 2 a bone: Standing::upper and lower
    Column joints, world;
    Pose(Column at, std::size_t bones)
        : local(at),
          outward(local.after(4 * bones)),
          ends(outward.after(3 * bones)),
          joints(ends.after(2 * bones)),
          world(joints.after(3 * (bones + 1))) {}
    /// The whole pose: full_pose_rows registers, of which the first pose_rows are independent.
    const Column& rows() const { return local; }

    void set(std::size_t bone, const Rotations& turn, const BoundState& bound_state) const {
        local.set(bone, turn), outward.set(bone, bound_state.outward);
        ends.set(2 * bone, bound_state.upper), ends.set(2 * bone + 1, bound_state.lower);
    }
};

/// One register of chains.
struct Limb {
    Block block;
    std::size_t i;  ///< the register's first lane
    std::span<const BatchLimit> limits;
    Pose pose, trial;
    Column arms;     ///< points: from each joint to the tip, in units of the reach
    Column axes;     ///< points: the hinge's axis, or the outward axis of a swing on the rim
    Column bones;    ///< points: unit vectors along the bones
    Column changes;  ///< points: rotation vector of each joint in this step; only x for a hinge
    Column stopped;  ///< 2 per bone: 1 if the swing, and the hinge or twist, is stopped in this step

    Limb(const Block& of, std::size_t lane, const LimitedJob& job)
        : block(of),
          i(lane),
          limits(job.limits),
          pose(Column(job.scratch), count()),
          trial(pose.rows().after(full_pose_rows(count())), count()),
          arms(trial.rows().after(full_pose_rows(count()))),
          axes(arms.after(3 * count())),
          bones(axes.after(3 * count())),
          changes(bones.after(3 * count())),
          stopped(changes.after(3 * count())) {}
    std::size_t count() const { return limits.size(); }
    Points tip(const Pose& of) const { return of.joints.points(count()); }
    Points target() const { return load_points(block.target() + i); }
    float* row(Row which) const { return block.row(which) + i; }
};

/// Rows of the components of a glm::quat, in its memory order.
#ifdef GLM_FORCE_QUAT_DATA_WXYZ
constexpr std::size_t row_of_w = 0, row_of_v = block_lanes;
#else
constexpr std::size_t row_of_w = 3 * block_lanes, row_of_v = 0;
#endif
HWY_INLINE Rotations load_rotations(const float* rows) {
    return {load(rows + row_of_w), load_points(rows + row_of_v)};
}
HWY_INLINE void store_rotations(const Rotations& q, float* rows) {
    store(q.w, rows + row_of_w), store_points(q.v, rows + row_of_v);
}

HWY_INLINE Rotations no_rotation() {
    return {all(1.0f), {zero(), zero(), zero()}};
}

/// Joints and world rotations from the local rotations.
HWY_INLINE void forward_kinematics(const Limb& limb, const Pose& pose) {
    Rotations world = no_rotation();
    Points at = load_points(limb.block.joint(0) + limb.i);
    pose.joints.set(0, at);
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        world = compose(world, pose.local.rotations(bone));
        pose.world.set(bone, world);
        at = moved(at, rotated(world, all(limb.limits[bone].bone)), load(limb.block.length(bone) + limb.i));
        pose.joints.set(bone + 1, at);
    }
}

/// The minimal rotation from one unit vector to another; half a turn about some axis if they are opposite.
HWY_INLINE Rotations smallest_rotation(const Points& from, const Points& to) {
    const Lanes w = hn::Add(all(1.0f), dot(from, to));
    const Mask opposite = hn::Lt(w, all(1e-6f));
    const Mask along_x = hn::Gt(hn::Abs(from.x), all(0.7f));
    const Points away{hn::IfThenZeroElse(along_x, all(1.0f)), hn::IfThenElseZero(along_x, all(1.0f)), zero()};
    return normalized(select(opposite, Rotations{zero(), cross(from, away)}, Rotations{w, cross(from, to)}));
}

/// A bone's world rotation, transported by the minimal rotation to where the joints are. `turned`: lanes in
/// which that is more than rounding.
HWY_INLINE Rotations transported(const Limb& limb, std::size_t bone, const float* rotations, Mask& turned) {
    const Rotations world = load_rotations(rotations + 4 * bone * block_lanes + limb.i);
    const Points apart =
        minus(load_points(limb.block.joint(bone + 1) + limb.i), load_points(limb.block.joint(bone) + limb.i));
    const Lanes squared = dot(apart, apart);
    const Mask shows = hn::Ge(squared, all(math::coincidence));
    const Lanes scale = hn::Div(all(1.0f), hn::Sqrt(hn::Max(squared, all(math::coincidence))));
    const Points before = rotated(world, all(limb.limits[bone].bone)), along = times(apart, scale);
    const Points off = minus(along, before);
    turned = hn::And(shows, hn::Gt(dot(off, off), all(1e-10f)));
    return select(turned, normalized(compose(smallest_rotation(before, along), world)), world);
}

/// For chains that do not move: updates only their rotations.
HWY_INLINE void transport(const Limb& limb, Mask lanes, float* rotations) {
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        Mask turned = none();
        const Rotations world = transported(limb, bone, rotations, turned);
        turned = hn::And(turned, lanes);
        if (!any(turned)) continue;
        float* const rows = rotations + 4 * bone * block_lanes + limb.i;
        store_rotations(select(turned, world, load_rotations(rows)), rows);
    }
}

/// Transports the rotations to the joints and clamps them into limb.pose. Returns the lanes in which a limit
/// was violated.
HWY_INLINE Mask load_clamped_pose(const Limb& limb, const float* rotations) {
    Mask violated = none(), turned = none();
    Rotations parent = no_rotation();
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        const Rotations world = transported(limb, bone, rotations, turned);
        const Rotations turn = normalized(compose(conjugate(parent), world));
        BoundState bound_state;
        const Rotations within = clamp(limb.limits[bone], turn, bound_state);
        // A quaternion and its negative are one rotation.
        const Lanes cosine = hn::Add(hn::Mul(turn.w, within.w), dot(turn.v, within.v));
        const Lanes sign = hn::CopySign(all(1.0f), cosine), w = hn::Sub(turn.w, hn::Mul(within.w, sign));
        const Points v = minus(turn.v, times(within.v, sign));
        violated = hn::Or(violated, hn::Gt(hn::Add(hn::Mul(w, w), dot(v, v)), all(violation)));
        limb.pose.set(bone, within, bound_state);
        parent = compose(parent, within);
    }
    forward_kinematics(limb, limb.pose);
    return violated;
}

/// Symmetric 3x3 matrix.
struct Matrix {
    Lanes xx, yy, zz, xy, xz, yz;
    explicit Matrix(Lanes diagonal)
        : xx(diagonal), yy(diagonal), zz(diagonal), xy(zero()), xz(zero()), yz(zero()) {}

    void add_square(const Points& c, Lanes by) {
        const Points scaled = times(c, by);
        xx = hn::Add(xx, hn::Mul(c.x, scaled.x)), yy = hn::Add(yy, hn::Mul(c.y, scaled.y));
        zz = hn::Add(zz, hn::Mul(c.z, scaled.z)), xy = hn::Add(xy, hn::Mul(c.x, scaled.y));
        xz = hn::Add(xz, hn::Mul(c.x, scaled.z)), yz = hn::Add(yz, hn::Mul(c.y, scaled.z));
    }
    void add_diagonal(Lanes by) { xx = hn::Add(xx, by), yy = hn::Add(yy, by), zz = hn::Add(zz, by); }
    /// Solves (this) x = of.
    Points solved(const Points& of) const {
        const auto minor = [](Lanes a, Lanes b, Lanes c, Lanes d) {
            return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
        };
        const Lanes a = minor(yy, zz, yz, yz), b = minor(xz, yz, xy, zz), c = minor(xy, yz, xz, yy),
                    e = minor(xx, zz, xz, xz), f = minor(xy, xz, xx, yz), g = minor(xx, yy, xy, xy);
        const Lanes determinant = dot({xx, xy, xz}, {a, b, c});
        const Lanes inverse = hn::Div(all(1.0f), determinant);
        return times({dot({a, b, c}, of), dot({b, e, f}, of), dot({c, f, g}, of)}, inverse);
    }
};

/// Computes arms, axes and stopped bounds of the pose.
HWY_INLINE void linearize(const Limb& limb) {
    const Lanes unit = hn::Div(all(1.0f), load(limb.block.reach() + limb.i));
    const Points tip = limb.tip(limb.pose);
    Rotations parent = no_rotation();
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        const BatchLimit& limit = limb.limits[bone];
        limb.arms.set(bone, times(minus(tip, limb.pose.joints.points(bone)), unit));
        const bool hinge = limit.kind == BatchLimit::Kind::Hinge;
        const Points axis = hinge ? all(limit.axis) : limb.pose.outward.points(bone);
        const Rotations world = limb.pose.world.rotations(bone);
        limb.axes.set(bone, rotated(parent, axis));
        if (!hinge) limb.bones.set(bone, rotated(world, all(limit.bone)));
        limb.stopped.set(2 * bone, zero());
        // A bone without any range is stopped both ways.
        limb.stopped.set(2 * bone + 1,
                         hn::Mul(limb.pose.ends.lanes(2 * bone), limb.pose.ends.lanes(2 * bone + 1)));
        parent = world;
    }
}

HWY_INLINE Matrix matrix_of(const Limb& limb, Lanes damping) {
    Matrix matrix(damping);
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        const Points arm = limb.arms.points(bone), axis = limb.axes.points(bone);
        const Lanes swing = limb.stopped.lanes(2 * bone), turn = limb.stopped.lanes(2 * bone + 1);
        if (limb.limits[bone].kind == BatchLimit::Kind::Hinge) {
            matrix.add_square(cross(axis, arm), hn::Sub(all(1.0f), turn));
            continue;
        }
        matrix.add_diagonal(dot(arm, arm));
        matrix.add_square(arm, all(-1.0f));
        if (limb.limits[bone].kind == BatchLimit::Kind::Free) continue;
        if (any(hn::Gt(swing, zero()))) matrix.add_square(cross(axis, arm), hn::Neg(swing));
        if (any(hn::Gt(turn, zero()))) {
            matrix.add_square(cross(limb.bones.points(bone), arm), hn::Neg(turn));
        }
    }
    return matrix;
}

/// Computes the rotation of each joint in a step. Stops those that would leave their limits; true if there
/// were any.
HWY_INLINE bool change_joints(const Limb& limb, const Points& by, Mask lanes) {
    Mask found = none();
    const auto stop = [&](std::size_t which, Mask here) {
        found = hn::Or(found, hn::And(here, lanes));
        limb.stopped.set(which, hn::IfThenElse(here, all(1.0f), limb.stopped.lanes(which)));
    };
    const auto pushes = [&](std::size_t bone, Lanes turn) {
        const Mask up = hn::Gt(hn::Mul(turn, limb.pose.ends.lanes(2 * bone)), all(1e-6f));
        const Mask down = hn::Lt(hn::Mul(turn, limb.pose.ends.lanes(2 * bone + 1)), all(-1e-6f));
        return hn::Or(up, down);
    };
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        const Points arm = limb.arms.points(bone), axis = limb.axes.points(bone);
        Points turn = cross(arm, by);
        const Lanes stopped = limb.stopped.lanes(2 * bone + 1);
        if (limb.limits[bone].kind == BatchLimit::Kind::Hinge) {
            const Lanes angle = hn::Mul(dot(axis, turn), hn::Sub(all(1.0f), stopped));
            stop(2 * bone + 1, pushes(bone, angle));
            turn = {angle, zero(), zero()};
        } else if (limb.limits[bone].kind == BatchLimit::Kind::Cone) {
            const Points along = limb.bones.points(bone);
            const Lanes swing = limb.stopped.lanes(2 * bone);
            turn = minus(turn, times(axis, hn::Mul(swing, dot(axis, turn))));
            turn = minus(turn, times(along, hn::Mul(stopped, dot(along, turn))));
            stop(2 * bone, hn::AndNot(hn::Gt(swing, zero()), hn::Gt(dot(axis, turn), all(1e-6f))));
            stop(2 * bone + 1, hn::AndNot(hn::Gt(stopped, zero()), pushes(bone, dot(along, turn))));
        }
        limb.changes.set(bone, turn);
    }
    return any(found);
}

/// Computes the trial pose: each joint rotated by its change, scaled to at most a radian, and clamped.
HWY_INLINE void turn_joints(const Limb& limb) {
    Lanes most = all(1.0f);
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        const Points change = limb.changes.points(bone);
        most = hn::Max(most, dot(change, change));
    }
    const Lanes half = hn::Div(all(0.5f), hn::Sqrt(most));
    Rotations parent = no_rotation();
    for (std::size_t bone = 0; bone < limb.count(); ++bone) {
        const BatchLimit& limit = limb.limits[bone];
        const Points change = times(limb.changes.points(bone), half);
        const Rotations local = limb.pose.local.rotations(bone);
        Rotations turned;
        if (limit.kind == BatchLimit::Kind::Hinge) {
            const Points axis = all(limit.axis);
            turned = {hn::Sub(local.w, hn::Mul(change.x, dot(axis, local.v))),
                      plus(local.v, times(axis, hn::Mul(change.x, local.w)))};
        } else {
            // Normalised here, because the clamp normalises only hinges.
            const Lanes squared = hn::Add(all(1.0f), dot(change, change));
            const Lanes scale = hn::Div(all(1.0f), hn::Sqrt(squared));
            turned = compose(Rotations{scale, times(rotated(conjugate(parent), change), scale)}, local);
        }
        BoundState bound_state;
        const Rotations within = clamp(limit, turned, bound_state);
        limb.trial.set(bone, within, bound_state);
        parent = limb.pose.world.rotations(bone);
    }
    forward_kinematics(limb, limb.trial);
}

/// Replaces the pose with the trial.
HWY_INLINE void accept(Limb& limb, Mask lanes) {
    if (hn::AllTrue(Floats(), lanes)) return std::swap(limb.pose, limb.trial);
    const Column pose = limb.pose.rows(), trial = limb.trial.rows();
    for (std::size_t row = 0; row < full_pose_rows(limb.count()); ++row) {
        pose.set(row, hn::IfThenElse(lanes, trial.lanes(row), pose.lanes(row)));
    }
}

HWY_INLINE Lanes error_of(const Limb& limb, const Pose& pose) {
    return length(minus(limb.target(), limb.tip(pose)));
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#endif
