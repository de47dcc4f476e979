// A curve: what comes out depends on nothing but what goes in, so rows are points of it.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/labs/signal/fit_linear.hpp"
#include "app/labs/signal/fit_space.hpp"
#include "app/labs/signal/search.hpp"
#include "app/labs/signal/trial.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_fitted_keys = 12;
constexpr double closest_keys = 1e-4;  ///< times apart

/// Solves a symmetric, positive definite system in place, by Cholesky's factors. Unknowns that nothing says
/// anything about come out as about 0.
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

    /// Another key, where it helps.
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

    /// Of a key: its value, the slope that arrives at it and the one that leaves it.
    static std::size_t unknown(std::size_t key, std::size_t which) { return 3 * key + which; }

    /// Values and slopes for keys at these times, all in one list.
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

    /// The best of a few places for one more key.
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

    /// Moves each inner key between its neighbours, the newest ones as well as the others, to where the
    /// smallest residual is: golden sections, twice around.
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
    std::vector<double> times_;       ///< of each row: its input from 0 to 1
    std::vector<std::size_t> order_;  ///< of rows by time
    std::vector<double> keys_{0.0, 1.0};
    double left_ = 0.0;  ///< by those keys
    int evaluations_ = 0;
};

}  // namespace

std::unique_ptr<FitTask> begin_curve_fit(const FitProblem& problem) {
    return std::make_unique<CurveFit>(problem);
}

}  // namespace tendril::app
