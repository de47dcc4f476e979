#include "app/labs/signal/search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tendril::app {
namespace {

constexpr double very_large = 1e60;

/// The digits of `number` in base `base`, mirrored at the radix point. With a different prime base for each
/// dimension these are the points of Halton (1960).
double radical_inverse(unsigned number, unsigned base) {
    double digit = 1.0, result = 0.0;
    for (; number > 0; number /= base) {
        digit /= base;
        result += digit * (number % base);
    }
    return result;
}

constexpr std::size_t rounds = 2;

}  // namespace

Minimiser::Minimiser(Objective objective, Search search)
    : objective_(std::move(objective)), search_(std::move(search)) {
    best_.value = very_large;
    best_.at.assign(search_.dimensions, 0.5);
}

/// Evaluates points over the whole range, then improves each of the best, then refines the best of all.
bool Minimiser::advance() {
    const std::size_t share = shares_++;
    if (dimensions() == 0) {
        value({});
        return false;
    }
    if (share == 0) {
        spread();
    } else if (share <= candidates_.size()) {
        Point at = candidates_[share - 1];
        if (!search_.stepped.empty()) at = scan(std::move(at));
        improve(NLOPT_LN_SBPLX, std::move(at), dimensions() == 1 ? 1.0 / 48.0 : 0.08, 60);
    } else if ((share - candidates_.size()) % 2 == 1) {
        improve(NLOPT_LN_SBPLX, best_.at, 0.03, 250);
    } else {
        improve(NLOPT_LN_NELDERMEAD, best_.at, 0.003, 250);
    }
    return !enough() && shares_ < 1 + candidates_.size() + 2 * rounds;
}

/// The number of initial points.
std::size_t Minimiser::point_count() const {
    return dimensions() == 1 ? 48 : std::max<std::size_t>(48 * dimensions() + 48, 288);
}

double Minimiser::value(std::span<const double> at) {
    const double found = objective_(at);
    const double result = std::isfinite(found) ? std::min(found, very_large) : very_large;
    ++best_.evaluations;
    if (result < best_.value) {
        best_.value = result;
        best_.at.assign(at.begin(), at.end());
    }
    return result;
}

void Minimiser::spread() {
    static constexpr std::array<unsigned, 8> primes{2, 3, 5, 7, 11, 13, 17, 19};
    struct Candidate {
        double value;
        Point at;
    };
    std::vector<Candidate> all;
    const auto add = [&](Point at) { all.push_back({value(at), std::move(at)}); };
    for (const Point& start : search_.starts) add(start);
    const std::size_t count = point_count();
    for (std::size_t i = 1; i <= count; ++i) {
        Point at(dimensions());
        for (std::size_t d = 0; d < at.size(); ++d)
            at[d] = at.size() == 1 ? (static_cast<double>(i) - 0.5) / static_cast<double>(count)
                                   : radical_inverse(static_cast<unsigned>(i), primes[d % primes.size()]);
        add(std::move(at));
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Candidate& a, const Candidate& b) { return a.value < b.value; });
    // Initial guesses lie close together, so more candidates are improved.
    const std::size_t improved = dimensions() == 1 ? 3 : search_.starts.size() > 16 ? 24 : 8;
    all.resize(std::min(all.size(), improved));
    for (Candidate& each : all) candidates_.push_back(std::move(each.at));
}

/// The best of evenly spaced values in each stepped dimension in turn, then of finer ones around it.
Minimiser::Point Minimiser::scan(Point at) {
    constexpr int cells = 48;
    double here = value(at);
    for (const double reach : {1.0, 1.0, 1.0 / cells}) {
        for (const std::size_t d : search_.stepped) {
            const double low = reach == 1.0 ? 0.0 : at[d] - reach;
            const double high = reach == 1.0 ? 1.0 : at[d] + reach;
            double best = at[d];
            for (int i = 0; i <= cells; ++i) {
                Point tried = at;
                tried[d] = std::clamp(low + (high - low) * i / cells, 0.0, 1.0);
                const double there = value(tried);
                if (there < here) here = there, best = tried[d];
            }
            at[d] = best;
        }
    }
    return at;
}

void Minimiser::improve(int algorithm, Point at, double step, std::size_t evaluations_each) {
    const auto n = static_cast<unsigned>(dimensions());
    nlopt_opt optimiser = nlopt_create(static_cast<nlopt_algorithm>(algorithm), n);
    if (optimiser == nullptr) return;
    const auto call = [](unsigned count, const double* x, double*, void* self) {
        return static_cast<Minimiser*>(self)->value({x, count});
    };
    nlopt_set_min_objective(optimiser, call, this);
    nlopt_set_lower_bounds1(optimiser, 0.0);
    nlopt_set_upper_bounds1(optimiser, 1.0);
    nlopt_set_maxeval(optimiser, static_cast<int>(evaluations_each * dimensions()));
    nlopt_set_initial_step1(optimiser, step);
    nlopt_set_xtol_rel(optimiser, 1e-10);
    nlopt_set_stopval(optimiser, search_.enough);
    double last = 0.0;
    // The result does not matter: value() keeps the best of all evaluations.
    static_cast<void>(nlopt_optimize(optimiser, at.data(), &last));
    nlopt_destroy(optimiser);
}

}  // namespace tendril::app
