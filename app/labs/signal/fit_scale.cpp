// scale_bias_clamp: a straight line, a clamp and an interpolation, of which any may be missing.
#include <cmath>
#include <optional>

#include "app/labs/signal/fit_linear.hpp"
#include "app/labs/signal/fit_space.hpp"
#include "app/labs/signal/search.hpp"
#include "app/labs/signal/trial.hpp"

namespace tendril::app {
namespace {

/// A place from 0 to 1 as a factor from -10 to 10, finer around 0.
double wide(double at) {
    const double x = 2.0 * at - 1.0;
    return x * (1.0 + 9.0 * x * x);
}
double place_of_wide(double factor) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (wide(middle) < factor ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// The line through the rows by least squares, as its values at the lowest and the highest input.
struct Line {
    double at_low = 0.0, at_high = 0.0;
};
Line regression(const FitProblem& problem, const FitFacts& facts, double low, double high) {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < problem.samples.size(); ++i) {
        const double in = problem.samples[i].input, out = problem.response[i];
        if (out < low || out > high) continue;
        n += 1.0, x += in, y += out, xx += in * in, xy += in * out;
    }
    const double spread = n * xx - x * x;
    if (n == 0.0) return {low, high};
    const double slope = spread > 1e-12 * n * xx ? (n * xy - x * y) / spread : 0.0;
    const double bias = (y - slope * x) / n;
    return {slope * facts.input_low + bias, slope * facts.input_high + bias};
}

class ScaleFit final : public FitTask {
  public:
    explicit ScaleFit(const FitProblem& problem)
        : problem_(problem),
          facts_(problem),
          trial_(problem),
          kind_(signal::kind_of(signal::ScaleBiasClamp())) {}

    /// One search after the other, the simplest first, until one leaves nothing.
    bool advance() override {
        const bool clamp = fits_.size() % 2 == 1, interp = fits_.size() >= 2;
        if (!minimiser_) minimiser_.emplace(search(clamp, interp));
        if (minimiser_->advance()) return true;
        const Minimum& found = minimiser_->best();
        fits_.push_back({filter_at(found.at, clamp, interp), found.value, found.evaluations});
        minimiser_.reset();
        return fits_.size() < 4 && fits_.back().residual > 10.0 * exact_residual;
    }

    Fit fit() override {
        double best = fits_.front().residual;
        for (const Fit& fit : fits_) best = std::min(best, fit.residual);
        if (fits_.back().residual <= 10.0 * exact_residual) return total(fits_.back());
        for (const Fit& fit : fits_)
            if (fit.residual <= 1.01 * best + 10.0 * exact_residual) return total(fit);
        return total(fits_.back());
    }

    int evaluations() const override {
        int count = minimiser_ ? minimiser_->best().evaluations : 0;
        for (const Fit& fit : fits_) count += fit.evaluations;
        return count;
    }

  private:
    Fit total(Fit best) const {
        best.evaluations = evaluations();
        return best;
    }

    double middle() const { return 0.5 * (facts_.response_low + facts_.response_high); }
    double scale() const { return std::max(facts_.response_range(), 1e-9); }
    double line_value(double at) const { return middle() + scale() * wide(at); }
    double line_place(double value) const { return place_of_wide((value - middle()) / scale()); }
    Dimension clamp_dimension(const char* name) const {
        return dimension(kind_, name, facts_.response_low - 2.0 * scale(),
                         facts_.response_high + 2.0 * scale(), Dimension::Scale::Even);
    }
    Dimension speed_dimension(const char* name) const {
        return dimension(kind_, name, 0.02 / facts_.duration, 1.2 / facts_.shortest, Dimension::Scale::Ratio);
    }

    signal::Filter filter_at(std::span<const double> at, bool clamp, bool interp) const {
        signal::ScaleBiasClamp filter;
        const double low = line_value(at[0]), high = line_value(at[1]);
        const double range = facts_.input_range();
        const double slope = range > 0.0 ? (high - low) / range : 0.0, most = max_magnitude;
        filter.scale = std::clamp(slope, -most, most);
        filter.bias = std::clamp(low - slope * facts_.input_low, -most, most);
        std::size_t next = 2;
        if (clamp) {
            const Dimension ends = clamp_dimension("clamp_min");
            filter.clamp = true;
            filter.clamp_min = ends.value(at[next++]);
            filter.clamp_max = ends.value(at[next++]);
            if (filter.clamp_min > filter.clamp_max) std::swap(filter.clamp_min, filter.clamp_max);
        }
        if (interp) {
            const Dimension speeds = speed_dimension("speed_increasing");
            filter.interp = true;
            filter.speed_increasing = speeds.value(at[next++]);
            filter.speed_decreasing = speeds.value(at[next++]);
        }
        return filter;
    }

    /// Lines through all rows, and through those that no clamp would have cut, each at several speeds.
    std::vector<std::vector<double>> starts(bool clamp, bool interp) const {
        const double margin = 0.02 * scale();
        const Line lines[] = {
            regression(problem_, facts_, facts_.response_low, facts_.response_high),
            regression(problem_, facts_, facts_.response_low + margin, facts_.response_high - margin)};
        std::vector<std::vector<double>> starts;
        for (const Line& line : lines) {
            for (const double speed : {3.0, 10.0, 30.0}) {
                std::vector<double> at{line_place(line.at_low), line_place(line.at_high)};
                if (clamp) {
                    const Dimension ends = clamp_dimension("clamp_min");
                    at.insert(at.end(), {ends.at(facts_.response_low), ends.at(facts_.response_high)});
                }
                if (interp) at.insert(at.end(), 2, speed_dimension("speed_increasing").at(speed));
                starts.push_back(std::move(at));
                if (!interp) break;
            }
        }
        return starts;
    }

    Minimiser search(bool clamp, bool interp) {
        return {[this, clamp, interp](std::span<const double> at) {
                    return trial_.residual_of(filter_at(at, clamp, interp));
                },
                {.dimensions = 2u + (clamp ? 2u : 0u) + (interp ? 2u : 0u),
                 .starts = starts(clamp, interp),
                 .enough = exact_residual}};
    }

    const FitProblem& problem_;
    FitFacts facts_;
    Trial trial_;
    const signal::Kind& kind_;
    std::vector<Fit> fits_;  ///< of the searches that are done
    std::optional<Minimiser> minimiser_;
};

}  // namespace

std::unique_ptr<FitTask> begin_scale_fit(const FitProblem& problem) {
    return std::make_unique<ScaleFit>(problem);
}

}  // namespace tendril::app
