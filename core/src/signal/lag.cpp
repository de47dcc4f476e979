// The shift that best fits one signal to another.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tendril/signal/measure.hpp"

namespace tendril::signal {
namespace {

constexpr double max_shifts = 1e4;
constexpr int refinements = 28;  ///< for an accuracy of a millionth of a row
constexpr double unlimited = std::numeric_limits<double>::infinity();
/// A fit counts as good as the best if it is worse by less than this part of the input's spread: values held
/// beyond the ends favour large shifts if the output is weaker than the input.
constexpr double tie_margin = 0.1;
constexpr double explained = 0.1;  ///< the part of the output's variance that an input must explain

class Fit {
  public:
    explicit Fit(const Response& response) : response_(response) {
        const auto& [time, wanted, output] = response;
        for (std::size_t i = 1; i < time.size(); ++i) {
            const double dt = time[i] - time[i - 1];
            slopes_.push_back(dt > 0.0 ? (wanted[i] - wanted[i - 1]) / dt : 0.0);
        }
    }

    /// Sum of squared differences between the output and `wanted` shifted by `shift` seconds, constant beyond
    /// the ends. Stops summing above `limit`.
    double error(double shift, double limit = unlimited) const {
        const auto& [time, wanted, output] = response_;
        double sum = 0.0;
        std::size_t next = 0;  // the first row that is later
        for (std::size_t i = 0; i < time.size() && sum <= limit; ++i) {
            const double at = time[i] - shift;
            while (next < time.size() && time[next] <= at) ++next;
            double value = wanted[next > 0 ? next - 1 : 0];
            if (next > 0 && next < time.size()) value += slopes_[next - 1] * (at - time[next - 1]);
            sum += (output[i] - value) * (output[i] - value);
        }
        return sum;
    }

    /// The correlation of the output with `wanted` shifted by `shift` seconds; 0 if either is constant.
    double correlation(double shift) const {
        const auto& [time, wanted, output] = response_;
        const double n = static_cast<double>(time.size());
        double mean_x = 0.0, mean_y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
        const std::vector<double> late = shifted(shift);
        for (std::size_t i = 0; i < time.size(); ++i) mean_x += late[i] / n, mean_y += output[i] / n;
        for (std::size_t i = 0; i < time.size(); ++i) {
            const double x = late[i] - mean_x, y = output[i] - mean_y;
            xx += x * x, yy += y * y, xy += x * y;
        }
        return xx > 0.0 && yy > 0.0 ? xy / (std::sqrt(xx) * std::sqrt(yy)) : 0.0;
    }

    /// The shift of smallest error between `low` and `high`, which enclose one minimum: golden section.
    double refined(double low, double high) const {
        constexpr double golden = 0.6180339887498949;
        double a = high - golden * (high - low), b = low + golden * (high - low);
        double at_a = error(a), at_b = error(b);
        for (int i = 0; i < refinements; ++i) {
            if (at_a <= at_b) {
                high = b, b = a, at_b = at_a;
                a = high - golden * (high - low);
                at_a = error(a);
            } else {
                low = a, a = b, at_a = at_b;
                b = low + golden * (high - low);
                at_b = error(b);
            }
        }
        return 0.5 * (low + high);
    }

  private:
    std::vector<double> shifted(double shift) const {
        const auto& [time, wanted, output] = response_;
        std::vector<double> values;
        values.reserve(time.size());
        std::size_t next = 0;  // the first row that is later
        for (const double each : time) {
            const double at = each - shift;
            while (next < time.size() && time[next] <= at) ++next;
            values.push_back(wanted[next > 0 ? next - 1 : 0]);
            if (next > 0 && next < time.size()) values.back() += slopes_[next - 1] * (at - time[next - 1]);
        }
        return values;
    }

    const Response& response_;
    std::vector<double> slopes_;  ///< from each row to the next
};

double median_dt(std::span<const double> time) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

/// Sum of squared differences from the mean.
double spread_of(std::span<const double> values) {
    double mean = 0.0, sum = 0.0;
    for (const double x : values) mean += x / static_cast<double>(values.size());
    for (const double x : values) sum += (x - mean) * (x - mean);
    return sum;
}

bool changes(std::span<const double> values) {
    return std::any_of(values.begin(), values.end(), [&](double x) { return x != values.front(); });
}

}  // namespace

std::optional<double> lag(const Response& response, double longest) {
    const auto& [time, wanted, output] = response;
    if (time.size() < 3 || wanted.size() != time.size() || output.size() != time.size()) return std::nullopt;
    if (!changes(wanted) || !changes(output) || !(longest > 0.0 && longest <= max_dt)) return std::nullopt;
    longest = std::min(longest, 0.25 * (time.back() - time.front()));
    const double spacing = std::max(median_dt(time), 2.0 * longest / max_shifts);
    if (!(spacing > 0.0)) return std::nullopt;
    const int reach = static_cast<int>(std::ceil(longest / spacing));

    const Fit fit(response);
    const double margin = tie_margin * spread_of(wanted);
    std::vector<double> errors(2 * static_cast<std::size_t>(reach) + 1);
    const auto error_at = [&](int shift) -> double& {
        return errors[static_cast<std::size_t>(shift + reach)];
    };
    double smallest = unlimited;
    for (int k = 0; k <= reach; ++k) {
        for (const int shift : {k, -k}) {
            error_at(shift) = fit.error(spacing * shift, smallest + margin);
            smallest = std::min(smallest, error_at(shift));
        }
    }
    // From shift 0 outwards: the first minimum that is as good as the best.
    for (int k = 0; k < reach; ++k) {
        for (const int shift : {k, -k}) {
            const double error = error_at(shift);
            if (error > smallest + margin || error > error_at(shift - 1) || error > error_at(shift + 1))
                continue;
            const double found = fit.refined(spacing * (shift - 1), spacing * (shift + 1));
            const double r = fit.correlation(found);
            if (r > 0.0 && r * r >= explained) return found;
            return std::nullopt;
        }
    }
    return std::nullopt;
}

}  // namespace tendril::signal
