#include "app/labs/signal/fit.hpp"

#include <nlopt.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tendril::app {
namespace {

class KindFit final : public FitTask {
  public:
    KindFit(const signal::Kind& kind, const FitProblem& problem, const signal::Filter* like)
        : kind_(kind),
          trial_(problem),
          space_(fit_space(kind, FitFacts(problem))),
          filter_(kind.blank()),
          minimiser_([this](std::span<const double> at) { return residual(at); }, search(problem, like)) {}

    bool advance() override { return minimiser_.advance(); }

    Fit fit() override {
        std::vector<double> at = minimiser_.best().at;
        for (std::size_t d = 0; d < space_.size(); ++d)
            if (space_[d].stepped) centre(at, d);
        signal::Filter filter = filter_at(at);
        leave_defaults(filter);
        return {filter, trial_.residual_of(filter), evaluations()};
    }

    int evaluations() const override { return minimiser_.best().evaluations + evaluations_; }

  private:
    Search search(const FitProblem& problem, const signal::Filter* like) const {
        Search search{.dimensions = space_.size(), .enough = exact_residual};
        for (std::size_t d = 0; d < space_.size(); ++d)
            if (space_[d].stepped) search.stepped.push_back(d);
        search.starts.push_back(place_of(kind_.blank()));
        if (like != nullptr) search.starts.push_back(place_of(*like));
        for (const signal::Filter& guess : first_guesses(kind_, problem, FitFacts(problem)))
            search.starts.push_back(place_of(guess));
        return search;
    }

    std::vector<double> place_of(signal::Filter filter) const {
        if (auto* damp = std::get_if<signal::SmoothDamp>(&filter)) damp->max_speed *= damp->smooth_time;
        std::vector<double> at;
        for (const Dimension& each : space_)
            at.push_back(each.at(each.field->number(signal::fields_in(filter))));
        return at;
    }

    void set(signal::Filter& filter, std::span<const double> at) const {
        for (std::size_t d = 0; d < space_.size(); ++d)
            space_[d].field->set_number(signal::fields_in(filter), space_[d].value(at[d]));
        if (auto* switching = std::get_if<signal::Hysteresis>(&filter))
            if (switching->low > switching->high) std::swap(switching->low, switching->high);
        // max_speed acts through the distance max_speed * smooth_time, so search for that.
        if (auto* damp = std::get_if<signal::SmoothDamp>(&filter))
            damp->max_speed = std::min(damp->max_speed / std::max(damp->smooth_time, 1e-4), 1e9);
    }

    double residual(std::span<const double> at) {
        set(filter_, at);
        trial_.run(filter_);
        return trial_.residual(shifts() ? trial_.best_shift() : 0.0);
    }

    /// A constant force shifts a spring's output by force / w^2, so it follows from the other parameters.
    bool shifts() const { return std::holds_alternative<signal::Spring<>>(filter_); }

    signal::Filter filter_at(std::span<const double> at) {
        signal::Filter filter = kind_.blank();
        set(filter, at);
        if (auto* spring = std::get_if<signal::Spring<>>(&filter)) {
            trial_.run(filter);
            const double w = 2.0 * std::numbers::pi * spring->strength, most = max_magnitude;
            spring->force = std::clamp(trial_.best_shift() * w * w, -most, most);
        }
        return filter;
    }

    /// Moves a threshold that may be anywhere between two input values to their middle.
    void centre(std::vector<double>& at, std::size_t d) {
        const double enough = residual(at) * (1.0 + 1e-9) + 1e-12;
        const auto edge = [&](double outside) {
            double inside = at[d];
            for (int i = 0; i < 24; ++i) {
                std::vector<double> tried = at;
                tried[d] = i == 0 ? outside : 0.5 * (inside + outside);
                const bool fine = residual(tried) <= enough;
                ++evaluations_;
                if (fine && i == 0) return outside;
                (fine ? inside : outside) = tried[d];
            }
            return inside;
        };
        const double low = edge(0.0), high = edge(1.0);
        const Dimension& dimension = space_[d];
        at[d] = dimension.at(0.5 * (dimension.value(low) + dimension.value(high)));
    }

    /// Resets each parameter without effect to its default.
    void leave_defaults(signal::Filter& filter) {
        const signal::Filter blank = kind_.blank();
        for (const Field& field : kind_.table()) {
            signal::Filter plain = filter;
            field.set(signal::fields_in(plain), field.get(signal::fields_in(blank)));
            if (!signal::check(plain)) continue;
            const double now = trial_.residual_of(filter), then = trial_.residual_of(plain);
            evaluations_ += 2;
            if (then <= now * (1.0 + 1e-4) + exact_residual) filter = std::move(plain);
        }
    }

    const signal::Kind& kind_;
    Trial trial_;
    std::vector<Dimension> space_;
    signal::Filter filter_;
    Minimiser minimiser_;
    int evaluations_ = 0;  ///< in addition to the minimiser's
};

/// The number of parameters that differ from their defaults. Each key of a curve counts two.
std::size_t parameters_set(const signal::Filter& filter) {
    const signal::Kind& kind = signal::kind_of(filter);
    const signal::Filter blank = kind.blank();
    std::size_t count = 0;
    for (const Field& field : kind.table())
        for (int i = 0; field.count == nullptr && i < field.size(); ++i)
            count += field.number(signal::fields_in(filter), i) != field.number(signal::fields_in(blank), i);
    if (const auto* curve = std::get_if<signal::Curve>(&filter)) count += 2 * curve->keys.size();
    return count;
}

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

double range_of(std::span<const double> values) {
    if (values.empty()) return 1.0;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high > *low ? *high - *low : 1.0;
}

double residual_of(const signal::Filter& filter, const FitProblem& problem) {
    return Trial(problem).residual_of(filter);
}

std::unique_ptr<FitTask> begin_fit(const signal::Kind& kind, const FitProblem& problem,
                                   const signal::Filter* like) {
    if (like != nullptr && &signal::kind_of(*like) != &kind) like = nullptr;
    const signal::Filter blank = kind.blank();
    if (std::holds_alternative<signal::Curve>(blank)) return begin_curve_fit(problem);
    if (std::holds_alternative<signal::ScaleBiasClamp>(blank)) return begin_scale_fit(problem);
    return std::make_unique<KindFit>(kind, problem, like);
}

Fit fit_kind(const signal::Kind& kind, const FitProblem& problem, const signal::Filter* like) {
    const std::unique_ptr<FitTask> task = begin_fit(kind, problem, like);
    while (task->advance()) {
    }
    return task->fit();
}

void rank(std::vector<Fit>& fits) {
    std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
        const double left = std::max(a.residual, indistinguishable);
        const double right = std::max(b.residual, indistinguishable);
        if (left != right) return left < right;
        return parameters_set(a.filter) < parameters_set(b.filter);
    });
}

Minimiser::Minimiser(Objective objective, Search search)
    : objective_(std::move(objective)), search_(std::move(search)) {
    best_.value = very_large;
    best_.at.assign(search_.dimensions, 0.5);
}

/// Evaluates points over the whole range, then improves each of the best ones, then refines the best.
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

/// In each stepped dimension in turn, the best of evenly spaced values, then of finer ones around it.
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
    // Ignore the result: value() keeps the best of all evaluations.
    static_cast<void>(nlopt_optimize(optimiser, at.data(), &last));
    nlopt_destroy(optimiser);
}

}  // namespace tendril::app
