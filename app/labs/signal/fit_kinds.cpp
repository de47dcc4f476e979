// Fits of the two kinds with their own methods. A curve's output depends only on the present input, so every
// row is a point of it.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

#include "app/labs/signal/fit.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_fitted_keys = 12;
constexpr double closest_keys = 1e-4;  ///< minimum distance in time

/// Solves a symmetric, positive definite system in place by Cholesky factorisation. Undetermined unknowns
/// come out close to 0.
std::vector<double> solve(std::vector<double> matrix, std::vector<double> right) {
    const std::size_t n = right.size();
    const auto at = [&](std::size_t row, std::size_t column) -> double& { return matrix[row * n + column]; };
    double largest = 1e-30;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, at(i, i));
    for (std::size_t i = 0; i < n; ++i) at(i, i) += 1e-11 * largest;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = at(i, j);
            for (std::size_t k = 0; k < j; ++k) sum -= at(i, k) * at(j, k);
            at(i, j) = i == j ? std::sqrt(std::max(sum, 1e-14 * largest)) : sum / at(j, j);
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) right[i] -= at(i, k) * right[k];
        right[i] /= at(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) right[i] -= at(k, i) * right[k];
        right[i] /= at(i, i);
    }
    return right;
}

class CurveFit final : public FitTask {
  public:
    explicit CurveFit(const FitProblem& problem) : problem_(problem), facts_(problem), trial_(problem) {
        const double range = facts_.input_range() > 0.0 ? facts_.input_range() : 1.0;
        for (const signal::Sample& sample : problem.samples)
            times_.push_back((sample.input - facts_.input_low) / range);
        order_.resize(times_.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return times_[a] < times_[b]; });
        left_ = residual(keys_);
    }

    /// Adds a key if that helps.
    bool advance() override {
        if (!wants_another()) return false;
        std::vector<double> more = with_another(keys_);
        if (more.size() == keys_.size()) return false;
        const double then = improve(more);
        if (then > 0.9 * left_) return false;
        keys_ = std::move(more);
        left_ = then;
        return wants_another();
    }

    Fit fit() override {
        const signal::Filter filter = curve_through(keys_);
        return {filter, trial_.residual_of(filter), evaluations_};
    }

    int evaluations() const override { return evaluations_; }

  private:
    bool wants_another() const { return left_ > exact_residual && keys_.size() < max_fitted_keys; }

    /// The unknowns of a key: value, arriving slope, leaving slope.
    static std::size_t unknown(std::size_t key, std::size_t which) { return 3 * key + which; }

    /// Values and slopes of keys at these times, in one list.
    std::vector<double> shape(const std::vector<double>& keys) {
        ++evaluations_;
        const std::size_t n = 3 * keys.size();
        std::vector<double> matrix(n * n, 0.0), right(n, 0.0);
        std::size_t piece = 0;
        for (const std::size_t i : order_) {
            while (piece + 2 < keys.size() && times_[i] > keys[piece + 1]) ++piece;
            const double width = keys[piece + 1] - keys[piece];
            const double u = std::clamp((times_[i] - keys[piece]) / width, 0.0, 1.0), v = 1.0 - u;
            const double weights[4] = {v * v * (1.0 + 2.0 * u), v * v * u * width, u * u * (1.0 + 2.0 * v),
                                       -u * u * v * width};
            const std::size_t unknowns[4] = {unknown(piece, 0), unknown(piece, 2), unknown(piece + 1, 0),
                                             unknown(piece + 1, 1)};
            for (std::size_t a = 0; a < 4; ++a) {
                right[unknowns[a]] += weights[a] * problem_.response[i];
                for (std::size_t b = 0; b < 4; ++b)
                    matrix[unknowns[a] * n + unknowns[b]] += weights[a] * weights[b];
            }
        }
        return solve(std::move(matrix), std::move(right));
    }

    signal::Filter curve_through(const std::vector<double>& keys) {
        const std::vector<double> found = shape(keys);
        const double most = max_magnitude;
        const auto number = [&](std::size_t key, std::size_t which) {
            const double value = found[unknown(key, which)];
            return std::isfinite(value) ? std::clamp(value, -most, most) : 0.0;
        };
        signal::Curve curve;
        curve.keys.clear();
        for (std::size_t k = 0; k < keys.size(); ++k)
            curve.keys.push_back({.time = keys[k],
                                  .value = number(k, 0),
                                  .arrive = number(k, 1),
                                  .leave = number(k, 2),
                                  .piece = signal::Piece::Cubic});
        curve.source_min = facts_.input_low;
        curve.source_max = facts_.input_high;
        return curve;
    }

    double residual(const std::vector<double>& keys) { return trial_.residual_of(curve_through(keys)); }

    /// Adds a key at the best of a few times.
    std::vector<double> with_another(const std::vector<double>& keys) {
        std::vector<double> best = keys;
        double smallest = 1e300;
        for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
            for (const double share : {0.125, 0.3, 0.5, 0.7, 0.875}) {
                const double time = keys[k] + share * (keys[k + 1] - keys[k]);
                if (time - keys[k] < closest_keys || keys[k + 1] - time < closest_keys) continue;
                std::vector<double> tried = keys;
                tried.insert(tried.begin() + static_cast<std::ptrdiff_t>(k) + 1, time);
                const double left = residual(tried);
                if (left < smallest) smallest = left, best = std::move(tried);
            }
        }
        return best;
    }

    /// Moves each inner key to the smallest residual between its neighbours: three rounds of golden sections.
    double improve(std::vector<double>& keys) {
        double left = residual(keys);
        for (int round = 0; round < 3; ++round) {
            for (std::size_t k = 1; k + 1 < keys.size() && left > exact_residual; ++k) {
                const double low = keys[k - 1] + closest_keys, high = keys[k + 1] - closest_keys;
                const double reach = round == 0 ? 1.0 : 0.2;
                left = section(keys, k, std::max(low, keys[k] - reach * (keys[k] - low)),
                               std::min(high, keys[k] + reach * (high - keys[k])), left);
            }
        }
        return left;
    }

    double section(std::vector<double>& keys, std::size_t k, double low, double high, double left) {
        constexpr double golden = 0.6180339887498949;
        const auto at = [&](double time) {
            std::vector<double> tried = keys;
            tried[k] = time;
            return residual(tried);
        };
        double a = high - golden * (high - low), b = low + golden * (high - low);
        double at_a = at(a), at_b = at(b);
        for (int i = 0; i < 24 && high - low > 1e-9; ++i) {
            if (at_a < at_b) {
                high = b, b = a, at_b = at_a;
                a = high - golden * (high - low), at_a = at(a);
            } else {
                low = a, a = b, at_a = at_b;
                b = low + golden * (high - low), at_b = at(b);
            }
        }
        const double best = std::min(at_a, at_b);
        if (best >= left) return left;
        keys[k] = at_a < at_b ? a : b;
        return best;
    }

    const FitProblem& problem_;
    FitFacts facts_;
    Trial trial_;
    std::vector<double> times_;       ///< each row's input, scaled to 0 to 1
    std::vector<std::size_t> order_;  ///< rows in order of time
    std::vector<double> keys_{0.0, 1.0};
    double left_ = 0.0;  ///< the residual with those keys
    int evaluations_ = 0;
};

}  // namespace

std::unique_ptr<FitTask> begin_curve_fit(const FitProblem& problem) {
    return std::make_unique<CurveFit>(problem);
}

// scale_bias_clamp: a line with an optional clamp and an optional interpolation.

namespace {

/// Maps 0 to 1 to a factor from -10 to 10, finer around 0.
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

/// The least squares line through the rows, given by its values at the lowest and the highest input.
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

/// One search: which stages are on, and whether the clamp's levels follow from the rest by least squares.
struct BentPart {
    bool clamp = false, interp = false, levels_follow = false;
};
constexpr BentPart parts[] = {{false, false, false}, {true, false, true}, {true, false, false},
                              {false, true, false},  {true, true, true},  {true, true, false}};

/// A clamped line by its bends: `low` up to the input `at`, `high` from at + width on. Scale and bias would
/// be equivalent, but for a steep clamped line they are far outside the response's range.
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
          kind_(&signal::kind_of(signal::ScaleBiasClamp())) {}

    /// Runs one search after the other, simplest first, until one is exact.
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
        return dimension(*kind_, "speed_increasing", 0.02 / facts_.duration, 1.2 / facts_.shortest,
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

    /// With levels 0 and 1, the output would be the weight of `high`, and the rest the weight of `low`. The
    /// response's direction gives the speed, so both levels follow by linear least squares.
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

    /// The bends of a line clamped to the response's range.
    Bends bends_of(const Line& line) const {
        const double slope = (line.at_high - line.at_low) / input_range();
        Bends bends{facts_.input_low, input_range(), facts_.response_low, facts_.response_high};
        if (std::abs(slope) * input_range() < 1e-3 * scale()) return bends;
        if (slope < 0.0) std::swap(bends.low, bends.high);
        bends.at = facts_.input_low + (bends.low - line.at_low) / slope;
        bends.width = (bends.high - bends.low) / slope;
        return bends;
    }

    /// Starts from two lines, through all rows and through the unclamped ones, each at several speeds.
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

    /// Adds bends over the whole input range, some with only one end on the slope, at slow and fast speeds.
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
    const signal::Kind* kind_;
    std::vector<Fit> fits_;            ///< the completed searches' fits
    std::size_t part_ = 0;             ///< index in `parts` of the present search
    std::vector<double> bends_start_;  ///< the best point of the search with dependent levels
    int evaluations_ = 0;              ///< evaluations of searches that only gave a start
    std::optional<Minimiser> minimiser_;
};

}  // namespace

std::unique_ptr<FitTask> begin_scale_fit(const FitProblem& problem) {
    return std::make_unique<ScaleFit>(problem);
}

}  // namespace tendril::app
