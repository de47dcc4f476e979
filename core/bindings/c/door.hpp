// Calls that take another form in C: they return a Result, and states are bytes.
#pragma once

#include "batch.hpp"
#include "handles.hpp"
#include "rope.hpp"
#include "structs.hpp"
#include "tendril/ik/solver.hpp"
#include "tendril/ik/two_bone.hpp"
#include "tendril/signal/batch.hpp"
#include "tendril/signal/filter.hpp"

namespace tendril::door {

Result solve(ik::Solver& solver, ik::Method method, std::span<glm::vec3> joints, ik::State& state,
             glm::vec3 target, const ik::Options& options, ik::Report& report) noexcept;
Result explain(ik::Solver& solver, std::span<const glm::vec3> joints, const ik::State& state,
               glm::vec3 target, const ik::Options& options, ik::ActiveLimit& limit, int& found);
Result rotations(const ik::State& state, std::span<glm::quat> world, std::span<glm::quat> local) noexcept;
Result two_bone(const ik::TwoBone& limb, glm::vec3 target, const ik::TwoBoneOptions& options,
                ik::TwoBoneResult& result) noexcept;

template <class Filter, class State, class Value>
Result step(const Filter& filter, State& state, const Value& input, double seconds, Value& value) noexcept {
    Result accepted;
    value = signal::step(filter, state, input, seconds, &accepted);
    return accepted;
}

/// A whole list at a steady rate. Changes nothing if it refuses an input.
template <class Filter, class State>
Result filter_all(const Filter& filter, State& state, std::span<const double> inputs, double seconds,
                  std::span<double> outputs) noexcept {
    State checked = state;
    Result accepted;
    for (const double input : inputs)
        if (signal::step(filter, checked, input, seconds, &accepted); !accepted) return accepted;
    for (std::size_t i = 0; i < inputs.size(); ++i)
        outputs[i] = signal::step(filter, state, inputs[i], seconds);
    return {};
}

/// A spring for vectors or rotations, with the numbers of one for numbers.
template <class T>
Result spring_step(const signal::Spring<double>& spring, const glm::dvec3& force,
                   signal::SpringState<T>& state, const T& target, double seconds, T& value) noexcept {
    if (!signal::is_input(force))
        return {ErrorCode::InvalidArgument,
                "signal_spring: force must be finite and at most 1e9 in magnitude along each axis"};
    const signal::Spring<T> of{spring.strength, spring.critical_damping, force,
                               spring.target_velocity_amount};
    return step(of, state, target, seconds, value);
}

/// A moving average and the samples in its window.
struct Window {
    signal::MovingAverage filter;
    signal::MovingAverageState state{};
};
inline Expected<Window> make_window(double seconds) noexcept {
    const signal::MovingAverage filter{seconds};
    if (const Result bad = signal::check(filter); !bad) return bad;
    return Window{filter};
}

/// A state in the caller's bytes. Reading allocates nothing if `state` already has the right size.
std::size_t bytes_of(const ik::State&, std::size_t bones) noexcept;
bool read_bytes(const std::byte* bytes, std::size_t bones, ik::State& state);
void write_bytes(const ik::State& state, std::byte* bytes) noexcept;

template <class Byte, class State>
class StateBytes {
  public:
    template <class Void>
    StateBytes(Call& call, const Place& place, Void* bytes, std::size_t size, std::size_t count,
               State& memory) noexcept
        : state(memory), call_(call), place_(place), bytes_(static_cast<Byte*>(bytes)), count_(count) {
        const std::size_t needed = bytes_of(memory, count);
        if (bytes == nullptr)
            call.refuse(TENDRIL_NULL_ARGUMENT, place, "is NULL");
        else if (size < needed)
            call.refuse(TENDRIL_SHORT_BUFFER, place, "has %zu bytes; it takes %zu", size, needed);
    }
    void read() {
        if (!call_.refused() && !read_bytes(bytes_, count_, state))
            call_.refuse(TENDRIL_INVALID_ARGUMENT, place_, "is not a state of this object");
    }
    void give() noexcept { write_bytes(state, bytes_); }
    State& state;

  private:
    Call& call_;
    Place place_;
    Byte* bytes_;
    std::size_t count_;
};

}  // namespace tendril::door
