// A file of filters is refused with a std::runtime_error, or the library accepts every filter in it: it is
// written as it was read, and its output is finite.
#include <cmath>

#include "app/io/json_complete.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "tendril/signal/run.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril;
using tendril::fuzz::check;

namespace {

constexpr std::size_t max_filters = 16;

/// A jump, a constant part, a ramp, a spike, with frames of several lengths.
std::vector<signal::Sample> rows() {
    std::vector<signal::Sample> rows;
    for (int i = 0; i < 60; ++i) {
        const double dt = i % 7 == 0 ? 0.1 : i % 5 == 0 ? 0.0 : 1.0 / 60.0;
        rows.push_back({dt, i < 10 ? 0.0 : i < 30 ? 1.0 : i == 40 ? -1e9 : 0.1 * i});
    }
    return rows;
}

}  // namespace

FUZZ_TARGET(filters) {
    static const std::vector<signal::Sample> samples = rows();
    std::vector<signal::Filter> filters;
    try {
        filters = app::filters_from_json({app::parse_json(text), "filters"}, max_filters);
    } catch (const std::runtime_error& error) {
        check(error.what()[0] != '\0', "a refusal says why");
        return;
    }
    check(filters.size() <= max_filters, "no more than may be");
    for (const signal::Filter& filter : filters) {
        check(static_cast<bool>(signal::check(filter)), "the library takes it");
        check(app::filter_from_json({app::filter_json(filter), "filter"}) == filter,
              "it is written as it was read");
        for (const double output : signal::run({&filter, 1}, samples))
            check(!std::isnan(output), "what comes out is a number");
    }
    for (const double output : signal::run(filters, samples))
        check(!std::isnan(output), "what comes out of all of them is a number");
}
