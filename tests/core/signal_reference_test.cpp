// Numeric cases from an independent implementation in double precision. Skipped if the files are missing; the
// other tests do not need them.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "signal_support.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

using Json = nlohmann::json;
using signal::Filter;
using signal::FilterState;

Json reference(const char* name) {
    std::ifstream file(reference_path(name));
    return file ? Json::parse(file) : Json();
}

/// The filter of a case; each parameter must be in the kind's table.
Filter filter_of(const std::string& kind, const Json& parameters) {
    const signal::Kind* const found = signal::find_kind(kind);
    EXPECT_NE(found, nullptr) << kind;
    Filter filter = found->blank();
    std::size_t read = 0;
    for (const Field& field : found->fields) {
        const auto given = parameters.find(field.name);
        if (given == parameters.end()) continue;
        ++read;
        for (int i = 0; i < field.size(); ++i) {
            const Json& value = given->is_array() ? given->at(static_cast<std::size_t>(i)) : *given;
            field.set_number(signal::fields_in(filter),
                             value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.get<double>(), i);
        }
    }
    EXPECT_EQ(read, parameters.size());
    EXPECT_TRUE(signal::check(filter)) << signal::check(filter).message();
    return filter;
}

/// Returns the maximum deviation.
double play(const Json& example, const std::string& kind) {
    SCOPED_TRACE(example.at("name").get<std::string>());
    const Filter filter = filter_of(kind, example.at("params"));
    FilterState state;
    double worst = 0.0;
    for (std::size_t i = 0; i < example.at("steps").size(); ++i) {
        const Json& row = example["steps"][i];
        const double output =
            signal::step(filter, state, row.at("input").get<double>(), row.at("dt").get<double>());
        const double off = std::abs(output - row.at("expect").get<double>());
        EXPECT_LE(off, example.at("tolerance").get<double>()) << "row " << i;
        worst = std::max(worst, off);
    }
    return worst;
}

TEST(SignalReference, Filters) {
    const Json cases = reference("filters.json");
    if (cases.empty()) GTEST_SKIP() << "filters.json is not there";
    double worst = 0.0;
    for (const Json& example : cases)
        worst = std::max(worst, play(example, example.at("kind").get<std::string>()));
    std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
}

TEST(SignalReference, ScaleBiasClamp) {
    const Json cases = reference("scale_bias_clamp.json");
    if (cases.empty()) GTEST_SKIP() << "scale_bias_clamp.json is not there";
    double worst = 0.0;
    for (const Json& example : cases) worst = std::max(worst, play(example, "scale_bias_clamp"));
    std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
}

TEST(SignalReference, Spring) {
    const Json cases = reference("spring.json");
    if (cases.empty()) GTEST_SKIP() << "spring.json is not there";
    double worst = 0.0;
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        const auto spring = std::get<signal::Spring<>>(filter_of("spring", example.at("params")));
        signal::SpringState<> state;
        for (std::size_t i = 0; i < example.at("steps").size(); ++i) {
            const Json& row = example["steps"][i];
            signal::step(spring, state, row.at("target").get<double>(), row.at("dt").get<double>());
            const double off = std::abs(state.value - row.at("expect").at("value").get<double>());
            const double velocity_off =
                std::abs(state.velocity - row.at("expect").at("velocity").get<double>());
            EXPECT_LE(off, example.at("tolerance").get<double>()) << "row " << i;
            EXPECT_LE(velocity_off, example.at("tolerance").get<double>()) << "row " << i;
            worst = std::max({worst, off, velocity_off});
        }
    }
    std::printf("%zu cases, worst deviation %.2g\n", cases.size(), worst);
}

}  // namespace
}  // namespace tendril::test
