// scale_bias_clamp: a straight line, a clamp and an interpolation, of which any may be missing.
#include <algorithm>
#include <cmath>
#include <iterator>
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

/// What is searched: which of the stages are on, and whether the levels at both ends of a clamp follow from
/// the rest by least squares.
struct BentPart {
    bool clamp = false, interp = false, levels_follow = false;
};
constexpr BentPart parts[] = {{false, false, false}, {true, false, true}, {true, false, false},
                              {false, true, false},  {true, true, true},  {true, true, false}};

/// A clamped line by its bends: up to the input `at` it is `low`, from at + width on `high`. A slope and an
/// offset say the same, but where a steep line is cut short they lie far beyond what the response shows.
struct Bends {
    double at = 0.0, width = 1.0, low = 0.0, high = 1.0;
    double share(double input) const { return std::clamp((input - at) / width, 0.0, 1.0); }
};

class ScaleFit final : public FitTask {
  public:
    explicit ScaleFit(const FitProblem& problem)
        : problem_(problem),
          facts_(problem),
          trial_(problem),
          kind_(signal::kind_of(signal::ScaleBiasClamp())) {}

    /// One search after the other, the simplest first, until one leaves nothing.
    bool advance() override {
        const BentPart& part = parts[part_];
        if (!minimiser_) minimiser_.emplace(search(part));
        if (minimiser_->advance()) return true;
        const Minimum& found = minimiser_->best();
        if (part.levels_follow) {
            const Bends bends = bends_at(found.at, part);
            bends_start_ = place_of(bends);
            bends_start_.insert(bends_start_.end(), found.at.begin() + 2, found.at.end());
            evaluations_ += found.evaluations;
        } else {
            fits_.push_back({filter_at(found.at, part), found.value, found.evaluations});
        }
        minimiser_.reset();
        ++part_;
        return part.levels_follow ||
               (part_ < std::size(parts) && fits_.back().residual > 10.0 * exact_residual);
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
        int count = evaluations_ + (minimiser_ ? minimiser_->best().evaluations : 0);
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
    double input_range() const { return std::max(facts_.input_range(), 1e-9); }
    double line_value(double at) const { return middle() + scale() * wide(at); }
    double line_place(double value) const { return place_of_wide((value - middle()) / scale()); }
    Dimension bend_dimension() const {
        return {.low = facts_.input_low - input_range(), .high = facts_.input_high};
    }
    Dimension width_dimension() const {
        return {.low = 1e-3 * input_range(), .high = 4.0 * input_range(), .scale = Dimension::Scale::Ratio};
    }
    Dimension level_dimension() const {
        return {.low = facts_.response_low - 12.0 * scale(), .high = facts_.response_high + 12.0 * scale()};
    }
    Dimension speed_dimension() const {
        return dimension(kind_, "speed_increasing", 0.02 / facts_.duration, 1.2 / facts_.shortest,
                         Dimension::Scale::Ratio);
    }

    std::vector<double> place_of(const Bends& bends) const {
        const Dimension level = level_dimension();
        return {bend_dimension().at(bends.at), width_dimension().at(bends.width), level.at(bends.low),
                level.at(bends.high)};
    }
    Bends bends_at(std::span<const double> at, const BentPart& part) const {
        Bends bends{.at = bend_dimension().value(at[0]), .width = width_dimension().value(at[1])};
        if (part.levels_follow) {
            set_levels(bends, at.subspan(2));
        } else {
            const Dimension level = level_dimension();
            bends.low = level.value(at[2]), bends.high = level.value(at[3]);
        }
        return bends;
    }

    /// With levels 0 and 1 the output is the part that `high` has in it, and `low` has the rest: given the
    /// direction in which the response moves, and so its speed, both follow by linear least squares.
    void set_levels(Bends& bends, std::span<const double> speeds) const {
        const Dimension dimension = speed_dimension();
        const double rising = speeds.empty() ? 0.0 : dimension.value(speeds[0]);
        const double falling = speeds.empty() ? 0.0 : dimension.value(speeds[1]);
        double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, part = 0.0, last = 0.0;
        for (std::size_t i = 0; i < problem_.samples.size(); ++i) {
            const double response = problem_.response[i], dt = problem_.samples[i].dt;
            if (dt > 0.0) {
                const double share = bends.share(problem_.samples[i].input);
                const double speed = response >= last ? rising : falling;
                const double follows = n == 0.0 || speeds.empty() ? 1.0 : std::min(dt * speed, 1.0);
                part += follows * (share - part);
                last = response;
            }
            n += 1.0, x += part, y += response, xx += part * part, xy += part * response;
        }
        const double spread = n * xx - x * x;
        const double slope = spread > 1e-12 * n * xx ? (n * xy - x * y) / spread : 0.0;
        const Dimension level = level_dimension();
        bends.low = std::clamp((y - slope * x) / std::max(n, 1.0), level.low, level.high);
        bends.high = std::clamp(bends.low + slope, level.low, level.high);
    }

    signal::Filter filter_at(std::span<const double> at, const BentPart& part) const {
        signal::ScaleBiasClamp filter;
        const double most = max_magnitude;
        std::size_t speeds = 2;
        if (part.clamp) {
            const Bends bends = bends_at(at, part);
            filter.clamp = true;
            filter.clamp_min = std::min(bends.low, bends.high);
            filter.clamp_max = std::max(bends.low, bends.high);
            filter.scale = std::clamp((bends.high - bends.low) / bends.width, -most, most);
            filter.bias = std::clamp(bends.low - filter.scale * bends.at, -most, most);
            speeds = part.levels_follow ? 2 : 4;
        } else {
            const double low = line_value(at[0]), high = line_value(at[1]);
            const double range = facts_.input_range();
            const double slope = range > 0.0 ? (high - low) / range : 0.0;
            filter.scale = std::clamp(slope, -most, most);
            filter.bias = std::clamp(low - slope * facts_.input_low, -most, most);
        }
        if (part.interp) {
            const Dimension dimension = speed_dimension();
            filter.interp = true;
            filter.speed_increasing = dimension.value(at[speeds]);
            filter.speed_decreasing = dimension.value(at[speeds + 1]);
        }
        return filter;
    }

    /// Of a line, its clamp at the ends of the response.
    Bends bends_of(const Line& line) const {
        const double slope = (line.at_high - line.at_low) / input_range();
        Bends bends{facts_.input_low, input_range(), facts_.response_low, facts_.response_high};
        if (std::abs(slope) * input_range() < 1e-3 * scale()) return bends;
        if (slope < 0.0) std::swap(bends.low, bends.high);
        bends.at = facts_.input_low + (bends.low - line.at_low) / slope;
        bends.width = (bends.high - bends.low) / slope;
        return bends;
    }

    /// Lines through all rows, and through those that no clamp would have cut, each at several speeds.
    std::vector<std::vector<double>> starts(const BentPart& part) const {
        const double margin = 0.02 * scale();
        const Line lines[] = {
            regression(problem_, facts_, facts_.response_low, facts_.response_high),
            regression(problem_, facts_, facts_.response_low + margin, facts_.response_high - margin)};
        std::vector<std::vector<double>> starts;
        for (const Line& line : lines) {
            for (const double speed : {3.0, 10.0, 30.0}) {
                std::vector<double> at{line_place(line.at_low), line_place(line.at_high)};
                if (part.clamp) at = place_of(bends_of(line));
                if (part.levels_follow) at.resize(2);
                if (part.interp) at.insert(at.end(), 2, speed_dimension().at(speed));
                starts.push_back(std::move(at));
                if (!part.interp) break;
            }
        }
        if (part.clamp && !part.levels_follow) starts.push_back(bends_start_);
        if (part.levels_follow && part.interp) add_bends(starts);
        return starts;
    }

    /// Bends all over the input, and so that only its ends are on the slope, at fast and slow speeds.
    void add_bends(std::vector<std::vector<double>>& starts) const {
        const Dimension bend = bend_dimension(), width = width_dimension(), speed = speed_dimension();
        for (const double wide : {0.05, 0.2, 0.5, 1.0})
            for (const double at : {0.07 - wide, 0.3 - wide, 0.1, 0.4, 0.7, 0.93})
                for (const double rising : {1.0, 4.0, 16.0})
                    for (const double falling : {1.0, 4.0, 16.0})
                        starts.push_back({bend.at(facts_.input_low + at * input_range()),
                                          width.at(wide * input_range()), speed.at(rising),
                                          speed.at(falling)});
    }

    Minimiser search(const BentPart& part) {
        const std::size_t line = part.clamp && !part.levels_follow ? 4 : 2;
        return {
            [this, &part](std::span<const double> at) { return trial_.residual_of(filter_at(at, part)); },
            {.dimensions = line + (part.interp ? 2u : 0u), .starts = starts(part), .enough = exact_residual}};
    }

    const FitProblem& problem_;
    FitFacts facts_;
    Trial trial_;
    const signal::Kind& kind_;
    std::vector<Fit> fits_;            ///< of the searches that are done
    std::size_t part_ = 0;             ///< of `parts`, the one that is searched
    std::vector<double> bends_start_;  ///< the best place where the levels follow
    int evaluations_ = 0;              ///< of searches that only led to a start
    std::optional<Minimiser> minimiser_;
};

}  // namespace

std::unique_ptr<FitTask> begin_scale_fit(const FitProblem& problem) {
    return std::make_unique<ScaleFit>(problem);
}

}  // namespace tendril::app
