// Minimises a function of a few numbers, each from 0 to 1: evaluates points spread evenly over the range,
// then improves the best with NLopt's local methods (Sbplx, Nelder-Mead). Deterministic: no random numbers,
// no clock; the number of dimensions bounds the evaluations.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace tendril::app {

using Objective = std::function<double(std::span<const double>)>;

struct Search {
    std::size_t dimensions = 1;
    /// Dimensions in which the function is a step function, as for a threshold: local methods fail there.
    std::vector<std::size_t> stepped{};
    /// Points to try in addition.
    std::vector<std::vector<double>> starts{};
    double enough = 0.0;  ///< stop at this value or below
};

struct Minimum {
    std::vector<double> at;
    double value = 0.0;
    int evaluations = 0;
};

/// The search, computed in slices. Cost: some 200 evaluations in one dimension to 10 000 in six, at most 1500
/// in one slice. Values that are not finite count as very large.
class Minimiser {
  public:
    Minimiser(Objective objective, Search search);

    /// Returns whether there is more to do.
    bool advance();
    /// The best point so far.
    const Minimum& best() const { return best_; }

  private:
    using Point = std::vector<double>;

    std::size_t dimensions() const { return search_.dimensions; }
    bool enough() const { return best_.value <= search_.enough; }
    std::size_t point_count() const;
    double value(std::span<const double> at);
    void spread();
    Point scan(Point at);
    void improve(int algorithm, Point at, double step, std::size_t evaluations_each);

    Objective objective_;
    Search search_;
    Minimum best_;
    std::vector<Point> candidates_;  ///< the best of the initial points, to be improved
    std::size_t shares_ = 0;
};

}  // namespace tendril::app
