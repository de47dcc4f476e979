// Shared by filter tests.
#pragma once

#include <initializer_list>

#include "random.hpp"
#include "tendril/signal/filter.hpp"
#include "tendril/signal/run.hpp"
#include "tests/says.hpp"

namespace tendril::test {

// Not inline: chain_support.hpp has a float infinity, and a program can hold only one of that name.
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double turn = 6.28318530717958647692;

/// A random number from -range to range.
inline double around(Random& random, double range) {
    return range * static_cast<double>(random.around(1.0f));
}
/// A random number from `low` to `high`.
inline double between(Random& random, double low, double high) {
    return low + (high - low) * 0.5 * (1.0 + static_cast<double>(random.around(1.0f)));
}

/// A filter by its name, with some parameters set by name.
inline signal::Filter filter_of(std::string_view kind,
                                std::initializer_list<std::pair<std::string_view, double>> parameters = {}) {
    const signal::Kind* const found = signal::find_kind(kind);
    EXPECT_NE(found, nullptr) << kind;
    signal::Filter filter = found->blank();
    for (const auto& [name, value] : parameters) {
        const Field* const field = find_field(found->table(), name);
        EXPECT_NE(field, nullptr) << kind << " has no " << name;
        if (field != nullptr) field->set(signal::fields_in(filter), {value, value});
    }
    return filter;
}

/// The outputs for a list of inputs with a fixed dt.
inline std::vector<double> outputs(const signal::Filter& filter, double dt, std::vector<double> inputs) {
    signal::FilterState state;
    for (double& each : inputs) each = signal::step(filter, state, each, dt);
    return inputs;
}

/// The output `seconds` after a step from 0 to 1, at a given frame rate.
inline double reached(const signal::Filter& filter, double hz, double seconds) {
    signal::FilterState state;
    signal::step(filter, state, 0.0, 1.0 / hz);
    for (int i = 0; i < static_cast<int>(seconds * hz + 1e-6); ++i)
        signal::step(filter, state, 1.0, 1.0 / hz);
    return signal::value(state);
}

}  // namespace tendril::test
