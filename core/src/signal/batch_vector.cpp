// Springs and interp_to for a register of values at a time.
#include "signal/batch_vector.hpp"

#include <algorithm>
#include <array>

#include "tendril/signal/input.hpp"
#include "tendril/signal/spring.hpp"

#define HWY_TARGET_INCLUDE "signal/batch_vector.cpp"
#include "math/each_target-inl.hpp"

#include "signal/elementary-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::signal::detail {
namespace HWY_NAMESPACE {

constexpr float two_pi = 6.28318531f;
constexpr float min_spring_strength = static_cast<float>(no_strength);
constexpr float max_state = static_cast<float>(max_output);
constexpr float min_state = 1e-25f;  ///< smaller counts as 0: denormal numbers take a hundred times longer

HWY_INLINE Mask both(Mask a, Mask b) {
    return hn::And(a, b);
}
/// False for NaN.
HWY_INLINE Mask is_within(Lanes x, float limit) {
    return hn::Le(hn::Abs(x), all(limit));
}
HWY_INLINE Mask is_between(Lanes x, float low, float high) {
    return both(hn::Ge(x, all(low)), hn::Le(x, all(high)));
}
HWY_INLINE Lanes bounded(Lanes x) {
    const Lanes high = all(max_state), low = all(-max_state);
    x = hn::IfThenElse(hn::Gt(x, high), high, x);
    x = hn::IfThenElse(hn::Lt(x, low), low, x);
    return hn::IfThenElseZero(hn::Ge(hn::Abs(x), all(min_state)), x);
}

/// C and S / t as in motion.hpp.
struct Swing {
    Lanes c, s;
};
/// `cycles` is strength * dt. Each kind of damping is only computed if some lane needs it.
HWY_INLINE Swing swing_of(Lanes cycles, Lanes damping) {
    const Lanes one = all(1.0f);
    const Lanes below = hn::Mul(hn::Sub(one, damping), hn::Add(one, damping));
    const Lanes root = hn::Sqrt(hn::Abs(below));
    const Lanes radians = times(cycles, two_pi), angle = hn::Mul(radians, root);
    const Mask over = hn::Lt(below, all(0.0f)), far = both(over, hn::Ge(angle, all(0.5f)));
    Lanes exponent = hn::Mul(damping, radians), c = one, s = one;
    if (!hn::AllTrue(Floats(), over)) {
        const SineCosine swing = sine_cosine(hn::Mul(cycles, root));
        const Mask turns = hn::Gt(angle, all(1e-20f));
        c = swing.cosine;
        s = hn::IfThenElse(turns, hn::Div(swing.sine, hn::IfThenElse(turns, angle, one)), one);
    }
    if (any(over)) {
        const Lanes square = hn::Mul(angle, angle);
        c = hn::IfThenElse(over, polynomial(square, 1.0f, 1.0f / 2, 1.0f / 24, 1.0f / 720, 1.0f / 40320), c);
        s = hn::IfThenElse(over, polynomial(square, 1.0f, 1.0f / 6, 1.0f / 120, 1.0f / 5040), s);
    }
    if (any(far)) {
        const Lanes fast = decay(hn::Add(angle, angle)), half = all(0.5f);
        exponent = hn::IfThenElse(far, hn::Div(radians, hn::Add(damping, root)), exponent);
        c = hn::IfThenElse(far, hn::Mul(half, hn::Add(one, fast)), c);
        const Lanes divisor = hn::IfThenElse(far, angle, one);
        s = hn::IfThenElse(far, hn::Div(hn::Mul(half, hn::Sub(one, fast)), divisor), s);
    }
    const Lanes left = decay(exponent);
    return {hn::Mul(left, c), hn::Mul(left, s)};
}

/// Steps one register of springs from index `i`, like step() in spring.cpp.
HWY_INLINE void step_register(const SpringRows& rows, std::size_t i, Lanes dt, Lanes rate) {
    const Floats d;
    const auto load = [&](const float* row) { return hn::LoadU(d, row + i); };
    const Lanes zero = all(0.0f);
    const Lanes strength = load(rows.strength), damping = load(rows.critical_damping);
    const Lanes target = load(rows.target), previous = load(rows.previous_target);
    const Lanes value = load(rows.value), velocity = load(rows.velocity);
    const Lanes force = rows.force ? load(rows.force) : zero;
    const Lanes amount = rows.target_velocity_amount ? load(rows.target_velocity_amount) : zero;

    Mask valid = both(is_between(strength, 0.0f, static_cast<float>(max_strength)),
                      is_between(damping, 0.0f, static_cast<float>(max_damping)));
    valid = both(valid, both(is_within(force, max_magnitude), is_between(amount, 0.0f, 1.0f)));
    valid = both(valid, both(is_within(target, max_magnitude), is_within(previous, max_magnitude)));
    valid = both(valid, both(is_within(value, max_state), is_within(velocity, max_state)));

    const Mask is_spring = hn::Ge(strength, all(min_spring_strength));
    const Lanes hz = hn::IfThenElseZero(is_spring, strength), w = times(hz, two_pi);
    const Lanes divisor = hn::IfThenElse(is_spring, w, all(1.0f));
    // The target's shift by force and target velocity; without a spring the force accelerates.
    const Lanes target_velocity = hn::Mul(hn::Sub(target, previous), hn::Mul(amount, rate));
    const Lanes ahead = hn::Mul(target_velocity, hn::Add(damping, damping));
    const Lanes shift = hn::Div(hn::Add(hn::Div(force, divisor), ahead), divisor);
    const Lanes goal = hn::Add(target, hn::IfThenElseZero(is_spring, shift));
    const Lanes push = hn::IfThenElse(is_spring, zero, hn::Mul(force, dt));
    const Lanes from = hn::Add(velocity, push), error = hn::Sub(value, goal);

    const Swing swing = swing_of(hn::Mul(hz, dt), damping);
    const Lanes s = hn::Mul(swing.s, dt), ws = hn::Mul(w, s), drag = hn::Mul(damping, ws);
    const Lanes position = hn::Add(goal, hn::Add(hn::Mul(hn::Add(swing.c, drag), error), hn::Mul(s, from)));
    const Lanes speed = hn::Sub(hn::Mul(hn::Sub(swing.c, drag), from), hn::Mul(hn::Mul(w, ws), error));
    hn::StoreU(hn::IfThenElse(valid, bounded(position), value), d, rows.value + i);
    hn::StoreU(hn::IfThenElse(valid, bounded(speed), velocity), d, rows.velocity + i);
    hn::StoreU(hn::IfThenElse(valid, target, previous), d, rows.previous_target + i);
}

template <bool exact>
HWY_INLINE void interp_register(const InterpRows& rows, std::size_t i, Lanes dt) {
    const Floats d;
    const Lanes current = hn::LoadU(d, rows.current + i), target = hn::LoadU(d, rows.target + i);
    const Lanes speed = hn::LoadU(d, rows.speed + i), way = hn::Sub(target, current);
    const Lanes time = hn::Mul(speed, dt);
    Mask moves = both(hn::Gt(speed, all(0.0f)), is_within(current, max_magnitude));
    Lanes next;
    if constexpr (exact) {
        next = hn::Sub(target, hn::Mul(way, decay(hn::IfThenElseZero(moves, time))));
    } else {
        moves = both(both(moves, hn::Lt(time, all(1.0f))), hn::Ge(hn::Mul(way, way), all(1e-8f)));
        next = hn::Add(current, hn::Mul(way, time));
    }
    const Lanes reached = hn::IfThenElse(moves, next, target);
    hn::StoreU(hn::IfThenElse(is_within(target, max_magnitude), reached, current), d, rows.current + i);
}

/// A list's last, incomplete register, padded with 0; null if the list is omitted.
constexpr std::size_t max_lanes = 16;
struct Row {
    HWY_ALIGN float lanes[max_lanes] = {};
    const float* copy(const float* from, std::size_t i, std::size_t count) {
        if (from) std::copy_n(from + i, count, lanes);
        return from ? lanes : nullptr;
    }
};

void step_springs(const SpringRows& rows, std::size_t count, float dt) {
    const std::size_t lanes = hn::Lanes(Floats());
    const Lanes time = all(dt), rate = all(1.0f / dt);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) step_register(rows, i, time, rate);
    if (i == count) return;
    const std::size_t rest = count - i;
    Row strength, damping, force, amount, target, value, velocity, previous;
    value.copy(rows.value, i, rest), velocity.copy(rows.velocity, i, rest);
    previous.copy(rows.previous_target, i, rest);
    step_register({strength.copy(rows.strength, i, rest), damping.copy(rows.critical_damping, i, rest),
                   force.copy(rows.force, i, rest), amount.copy(rows.target_velocity_amount, i, rest),
                   target.copy(rows.target, i, rest), value.lanes, velocity.lanes, previous.lanes},
                  0, time, rate);
    std::copy_n(value.lanes, rest, rows.value + i);
    std::copy_n(velocity.lanes, rest, rows.velocity + i);
    std::copy_n(previous.lanes, rest, rows.previous_target + i);
}

template <bool exact>
HWY_INLINE void interp(const InterpRows& rows, std::size_t count, float dt) {
    const std::size_t lanes = hn::Lanes(Floats());
    const Lanes time = all(dt);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) interp_register<exact>(rows, i, time);
    if (i == count) return;
    const std::size_t rest = count - i;
    Row current, target, speed;
    current.copy(rows.current, i, rest);
    interp_register<exact>(
        {current.lanes, target.copy(rows.target, i, rest), speed.copy(rows.speed, i, rest)}, 0, time);
    std::copy_n(current.lanes, rest, rows.current + i);
}
void interp_to(const InterpRows& rows, std::size_t count, float dt) {
    interp<false>(rows, count, dt);
}
void interp_to_exact(const InterpRows& rows, std::size_t count, float dt) {
    interp<true>(rows, count, dt);
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::signal::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::signal::detail {
namespace {

HWY_EXPORT(step_springs);
HWY_EXPORT(interp_to);
HWY_EXPORT(interp_to_exact);

/// The vector units of this machine, widest first. Asking the processor takes microseconds: done once.
struct Units {
    std::array<VectorUnit, 16> units{};
    std::array<std::string_view, 16> names{};
    std::size_t count = 0;

    Units() noexcept {
        tendril::detail::for_each_target([&](std::int64_t target) {
            if (count == names.size()) return;
            names[count] = hwy::TargetName(target);
            units[count++] = {TENDRIL_COMPILED_FOR(step_springs, target),
                              TENDRIL_COMPILED_FOR(interp_to, target),
                              TENDRIL_COMPILED_FOR(interp_to_exact, target)};
        });
    }
};

}  // namespace

VectorUnit vector_unit(std::string_view name) noexcept {
    static const Units found;
    for (std::size_t i = 0; i < found.count; ++i)
        if (name.empty() || name == found.names[i]) return found.units[i];
    return {};
}

}  // namespace tendril::signal::detail
#endif
