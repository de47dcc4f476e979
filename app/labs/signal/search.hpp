// Looks for the minimum of a function of a few numbers, each from 0 to 1: points spread evenly over the whole
// range, the best of them improved by NLopt's local methods (Sbplx, Nelder-Mead). The same at every run: no
// random numbers, no clock, as many evaluations as the number of dimensions says.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace tendril::app {

using Objective = std::function<double(std::span<const double>)>;

struct Search {
    std::size_t dimensions = 1;
    /// Dimensions in which the function is made of level steps, as of a threshold: no local method sees them.
    std::vector<std::size_t> stepped{};
    /// Points to try beside those spread evenly.
    std::vector<std::vector<double>> starts{};
    double enough = 0.0;  ///< ends at a value that is no larger
};

struct Minimum {
    std::vector<double> at;
    double value = 0.0;
    int evaluations = 0;
};

/// The search, a share at a time. Cost: some 200 evaluations in one dimension to 10 000 in six, of which a
/// share has 1500 at most. Values that are not finite count as very large.
class Minimiser {
  public:
    Minimiser(Objective objective, Search search);

    /// Whether there is more to do after this share.
    bool advance();
    /// So far.
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
    std::vector<Point> candidates_;  ///< the best of those that were spread, to be improved
    std::size_t shares_ = 0;
};

}  // namespace tendril::app
