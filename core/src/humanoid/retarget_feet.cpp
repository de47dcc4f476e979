#include "humanoid/retarget_feet.hpp"

#include <algorithm>
#include <cmath>

#include "tendril/elementary.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

namespace {

constexpr double blend_time = 0.4;    // seconds over which a stance's displacement fades out
constexpr double hips_time = 0.15;    // seconds within which the hips are lowered
constexpr double lift_time = 0.1;     // seconds within which a swinging foot is lifted
constexpr double min_swing = 0.05;    // minimum duration of a step, seconds
constexpr double min_hold = 0.1;      // seconds that a foot must be still to be held off the floor
constexpr double swing_speed = 0.3;   // m/s: a slower foot has landed or has not left yet
constexpr double floor_gap = 0.03;    // metres of the source
constexpr double max_slide = 0.04;    // metres of the source: shorter slides of a standing foot are removed
constexpr double max_rise = 0.006;    // metres of the source: a foot lower than this has landed
constexpr double max_sinking = 0.05;  // metres of the source: feet deeper in the ground are intended
constexpr double straight = 0.995;    // in leg lengths, unless the source's leg is straighter
constexpr double sole_part = 0.006;   // in leg lengths: points of the sole this near to the ground touch it
constexpr double clear_part = 0.012;  // in leg lengths: a swinging foot is lifted up to this height
constexpr double loop_part = 0.01;    // in leg lengths: maximum difference of first and last pose in a loop

/// The frames of a clip, or three rounds of one that ends as it begins. Only the second round, which leads
/// into the next, is used.
class Rounds {
  public:
    explicit Rounds(const FootingTask& task) : frames_(task.frames.size()), loops_(loops(task)) {}
    std::size_t size() const { return loops_ ? 3 * (frames_ - 1) : frames_; }
    std::size_t frame(std::size_t i) const { return loops_ ? i % (frames_ - 1) : i; }
    /// The frame at the end of the step from i - 1 to i.
    std::size_t step_to(std::size_t i) const {
        return loops_ && i % (frames_ - 1) == 0 ? frames_ - 1 : frame(i);
    }
    std::size_t planned(std::size_t frame) const {
        return loops_ ? (frames_ - 1) + frame % (frames_ - 1) : frame;
    }

  private:
    static bool loops(const FootingTask& task) {
        const PointedFrame &a = task.frames.front(), &b = task.frames.back();
        if (task.frames.size() < 4) return false;
        const double limit = loop_part * task.leg;
        bool same = std::abs(a.hips.y - b.hips.y) < limit;
        for (std::size_t foot = 0; foot < 2; ++foot) {
            const PointedFoot &was = a.feet[foot], &now = b.feet[foot];
            same &= length(minus(minus(was.ankle, a.hips), minus(now.ankle, b.hips))) < limit;
            for (std::size_t k = 0; k < 3; ++k) same &= length(minus(was.sole[k], now.sole[k])) < limit;
        }
        return same;
    }
    std::size_t frames_;
    bool loops_;
};

struct Stand {
    std::size_t first, last;              // frames of the rounds
    std::size_t still_first, still_last;  // without landing and lift-off
    double height = 0.0;                  // height of the target's sole over its floor, metres
};

class Planner {
  public:
    explicit Planner(const FootingTask& task) : task_(task), rounds_(task) {}

    std::vector<Footing> plan() {
        for (std::size_t foot = 0; foot < 2; ++foot) find_stands(foot);
        for (std::size_t foot = 0; foot < 2; ++foot) moves_[foot].assign(rounds_.size(), glm::dvec3(0.0));
        find_shift();
        for (std::size_t foot = 0; foot < 2; ++foot) {
            for (const Stand& each : stands_[foot]) hold(foot, each);
            swing(foot);
            clear_ground(foot);
        }
        find_drops();
        std::vector<Footing> result;
        for (std::size_t i = 0; i < task_.frames.size(); ++i) {
            const std::size_t at = rounds_.planned(i);
            Footing& each = result.emplace_back();
            each.hips = shift_ - drops_[at];
            for (std::size_t foot = 0; foot < 2; ++foot)
                each.feet[foot] = plus(moves_[foot][at], {0.0, shift_, 0.0});
        }
        return result;
    }

  private:
    const PointedFoot& pointed(std::size_t foot, std::size_t i) const {
        return task_.frames[rounds_.frame(i)].feet[foot];
    }
    const lint_detail::Foot& source(std::size_t foot) const { return task_.motion.feet[foot]; }
    std::size_t seconds(double time) const { return static_cast<std::size_t>(std::ceil(time * task_.rate)); }
    /// Height of the lowest point of the sole, with the ankle at 0.
    static double lowest(const PointedFoot& foot) {
        return std::min({foot.sole[0].y, foot.sole[1].y, foot.sole[2].y});
    }

    void find_stands(std::size_t foot) {
        if (!task_.source_floor) return;
        const lint_detail::Foot& its = source(foot);
        const double floor = *task_.source_floor;
        std::vector<bool> stands(task_.frames.size(), false);
        const auto mark = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i <= last; ++i) stands[i] = true;
        };
        for (const lint_detail::FrameRange& each : lint_detail::stances_of(its, floor, task_.rate))
            mark(each.first, each.last);
        // Feet on stairs, or held in the air, stand too.
        for (std::size_t i = 0; i < stands.size();) {
            std::size_t end = i;
            while (end < stands.size() && its.still[end] && !stands[end]) ++end;
            if (end - i >= seconds(min_hold)) mark(i, end - 1);
            i = std::max(end, i + 1);
        }
        // Include the frame at either end: the swing next to it affects its speed.
        const std::vector<bool> certain = stands;
        for (std::size_t i = 1; i < stands.size(); ++i) {
            const double limit = swing_speed / task_.rate;
            const glm::dvec3 ground = times(task_.motion.treadmill, 1.0 / task_.rate);
            if (certain[i - 1] == certain[i] || std::abs(its.height[i] - its.height[i - 1]) > limit ||
                lint_detail::level(lint_detail::smallest_move(its, i, ground)) > limit)
                continue;
            stands[i - 1] = stands[i] = true;
        }
        const std::size_t rounds = rounds_.size();
        for (std::size_t i = 0; i < rounds; ++i) {
            if (!stands[rounds_.frame(i)] && !stands[rounds_.step_to(i)]) continue;
            std::vector<Stand>& all = stands_[foot];
            if (!all.empty() && i - all.back().last <= seconds(min_swing))
                all.back().last = i;
            else
                all.push_back({i, i, i, i});
        }
        for (Stand& each : stands_[foot]) {
            each.still_first = each.first, each.still_last = each.last;
            const auto still = [&](std::size_t i) { return its.still[rounds_.frame(i)]; };
            while (each.still_first < each.last && !still(each.still_first)) ++each.still_first;
            while (each.still_last > each.still_first && !still(each.still_last)) --each.still_last;
            if (!still(each.still_first)) {
                const auto low = [&](std::size_t i) { return pointed(foot, i).source_low; };
                for (std::size_t i = each.first; i <= each.last; ++i)
                    if (low(i) < low(each.still_first)) each.still_first = each.still_last = i;
            }
            std::vector<double> heights;
            for (std::size_t i = each.first; i <= each.last; ++i)
                heights.push_back(its.height[rounds_.frame(i)] - floor);
            const double height = lint_detail::median(heights);
            if (std::abs(height) > floor_gap) each.height = task_.scale * height;
        }
    }

    /// Raises or lowers the whole motion so that standing feet are on the floor without bending a leg. Feet
    /// of a figure that sits or lies count only if it never stands.
    void find_shift() {
        const auto upright = [&](std::size_t foot) {
            const std::vector<bool>& its = source(foot).upright;
            return std::find(its.begin(), its.end(), true) != its.end();
        };
        const bool ever_stands = upright(0) || upright(1);
        std::vector<double> gaps;
        for (std::size_t foot = 0; foot < 2; ++foot)
            for (const Stand& each : stands_[foot])
                for (std::size_t i = each.first; each.height == 0.0 && i <= each.last; ++i)
                    if (!ever_stands || source(foot).upright[rounds_.frame(i)])
                        gaps.push_back(task_.floor - pointed(foot, i).ankle.y - lowest(pointed(foot, i)));
        shift_ = gaps.empty() ? task_.shift : lint_detail::median(gaps);
    }

    /// Keeps the sole in place on the ground, or moves it with the ground in an in-place motion.
    void hold(std::size_t foot, const Stand& stand) {
        std::vector<glm::dvec3>& moves = moves_[foot];
        const std::vector<glm::dvec3> path = sole_path(foot, stand);
        glm::dvec3 sum(0.0);
        for (std::size_t i = stand.first; i <= stand.last; ++i) {
            if (i > stand.first) {
                const std::size_t k = i - stand.first;
                const glm::dvec3 step = minus(minus(path[k], path[k - 1]), pointed_step(foot, i));
                moves[i] = plus(moves[i - 1], {step.x, 0.0, step.z});
            }
            sum = plus(sum, moves[i]);
        }
        const glm::dvec3 mean = times(sum, 1.0 / static_cast<double>(stand.last - stand.first + 1));
        for (std::size_t i = stand.first; i <= stand.last; ++i) {
            const PointedFoot& its = pointed(foot, i);
            const double up = task_.floor + height_of(foot, stand, i) - its.ankle.y - shift_ - lowest(its);
            moves[i] = {moves[i].x - mean.x, up, moves[i].z - mean.z};
        }
    }
    /// Height of the sole above the target's floor. A foot that lands or lifts off is as high as the
    /// source's, scaled.
    double height_of(std::size_t foot, const Stand& stand, std::size_t i) const {
        if (stand.height != 0.0 || (i >= stand.still_first && i <= stand.still_last)) return stand.height;
        const std::size_t level = i < stand.still_first ? stand.still_first : stand.still_last;
        return task_.scale *
               std::max(0.0, pointed(foot, i).source_low - pointed(foot, level).source_low - max_rise);
    }
    /// Horizontal path of the sole during a stance. A small slide is a fault of the source and is removed;
    /// the rest of a larger one stays.
    std::vector<glm::dvec3> sole_path(std::size_t foot, const Stand& stand) const {
        const glm::dvec3 ground = times(task_.motion.treadmill, 1.0 / task_.rate);
        std::vector<glm::dvec3> path{glm::dvec3(0.0)};
        glm::dvec3 low(0.0), high(0.0);
        for (std::size_t i = stand.first + 1; i <= stand.last; ++i) {
            path.push_back(
                plus(path.back(), lint_detail::smallest_move(source(foot), rounds_.step_to(i), ground)));
            for (int axis = 0; axis < 3; axis += 2) {
                low[axis] = std::min(low[axis], path.back()[axis]);
                high[axis] = std::max(high[axis], path.back()[axis]);
            }
        }
        for (std::size_t k = 0; k < path.size(); ++k) {
            const glm::dvec3 slide = minus(path[k], times(plus(low, high), 0.5));
            const double far = lint_detail::level(slide), excess = std::max(0.0, far - max_slide);
            const glm::dvec3 moved = times(ground, static_cast<double>(k));
            path[k] = plus(moved, far > 0.0 ? times(slide, excess / far) : glm::dvec3(0.0));
            path[k] = times(rotated(task_.turn, path[k]), task_.scale);
        }
        return path;
    }
    /// Move, in one step, of the part of the sole that is on the ground.
    glm::dvec3 pointed_step(std::size_t foot, std::size_t i) const {
        const std::size_t to = rounds_.step_to(i);
        const PointedFoot &was = task_.frames[to - 1].feet[foot], &now = task_.frames[to].feet[foot];
        const double near = sole_part * task_.leg, low = lowest(was) + lowest(now);
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = math::decay(0.5 * (was.sole[k].y + now.sole[k].y - low) / near);
            sum = plus(sum, times(minus(now.sole[k], was.sole[k]), weight));
            weights += weight;
        }
        return plus(minus(now.ankle, was.ankle), times(sum, 1.0 / weights));
    }

    /// Between stances, one displacement fades out while the next fades in.
    void swing(std::size_t foot) {
        std::vector<glm::dvec3>& moves = moves_[foot];
        const std::vector<Stand>& stands = stands_[foot];
        const std::size_t none = moves.size();
        for (std::size_t k = 0; k <= stands.size(); ++k) {
            const std::size_t before = k > 0 ? stands[k - 1].last : none,
                              after = k < stands.size() ? stands[k].first : none;
            const std::size_t first = before == none ? 0 : before + 1;
            double over = blend_time * task_.rate;
            if (before != none && after != none) over = std::min(over, static_cast<double>(after - before));
            for (std::size_t i = first; i < after; ++i) {
                glm::dvec3 move(0.0);
                if (before != none)
                    move = times(moves[before], lint_detail::falloff(static_cast<double>(i - before) / over));
                if (after != none)
                    move = plus(move, times(moves[after],
                                            lint_detail::falloff(static_cast<double>(after - i) / over)));
                moves[i] = move;
            }
        }
    }

    /// Keeps a foot above the ground where the source's foot is above it. The lift begins early.
    void clear_ground(std::size_t foot) {
        std::vector<glm::dvec3>& moves = moves_[foot];
        std::vector<double> lifts(moves.size()), from_stand(moves.size(), 1e9);
        for (std::size_t i = 0; i < moves.size(); ++i) lifts[i] = lift(foot, i);
        for (const Stand& each : stands_[foot])
            for (std::size_t i = 0; i < moves.size(); ++i) {
                const std::size_t off = i < each.first ? each.first - i : i > each.last ? i - each.last : 0;
                from_stand[i] = std::min(from_stand[i], static_cast<double>(off) / task_.rate);
            }
        for (std::size_t i = 0; i < moves.size(); ++i)
            if (from_stand[i] == 0.0) lifts[i] = 0.0;
        const std::size_t half = std::max<std::size_t>(seconds(0.5 * lift_time), 1);
        const std::vector<double> early = mean_around(largest_around(lifts, half), half);
        for (std::size_t i = 0; i < moves.size(); ++i)
            if (from_stand[i] > 0.0)
                moves[i].y += std::max(lifts[i], early[i] * std::min(1.0, from_stand[i] / lift_time));
    }
    double lift(std::size_t foot, std::size_t i) const {
        const double ground = task_.source_floor.value_or(task_.ground), most = clear_part * task_.leg;
        const PointedFoot& its = pointed(foot, i);
        const double over = its.source_low - ground;
        const double meant = over < 0.0 ? std::min(over + max_sinking, 0.0) : over;
        const double wanted = std::min(task_.scale * meant, most);
        const double low = task_.floor + wanted - (its.ankle.y + lowest(its) + shift_ + moves_[foot][i].y);
        return low > 0.0 ? low * low / (low + most) : 0.0;
    }

    /// Distance to lower the hips so that the foot is within reach. No leg becomes straighter than
    /// `straight`, unless the source's is and its foot hardly moves: a leg that near to full length for one
    /// frame snaps.
    double shortfall(std::size_t foot, std::size_t i) const {
        const PointedFoot& its = pointed(foot, i);
        const glm::dvec3 pointed_leg = minus(its.ankle, its.hip), leg = plus(pointed_leg, moves_[foot][i]);
        const double longest = std::max(straight * its.leg, length(pointed_leg) - length(moves_[foot][i]));
        const double aside = lint_detail::level(leg);
        if (dot(leg, leg) <= longest * longest || aside >= longest) return 0.0;
        return std::min(-leg.y - std::sqrt(longest * longest - aside * aside), 0.2 * task_.leg);
    }

    void find_drops() {
        const std::size_t count = rounds_.size();
        drops_.assign(count, 0.0);
        for (std::size_t i = 0; i < count; ++i) drops_[i] = std::max({0.0, shortfall(0, i), shortfall(1, i)});
        // The maximum over neighbours, then two means over half as many: no frame gets less than it needs.
        const std::size_t half = std::max<std::size_t>(seconds(0.5 * hips_time), 1);
        drops_ = largest_around(drops_, 2 * half);
        for (int round = 0; round < 2; ++round) drops_ = mean_around(drops_, half);
    }
    static std::vector<double> largest_around(const std::vector<double>& values, std::size_t reach) {
        std::vector<double> result(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            for (std::size_t k = i - std::min(i, reach); k <= std::min(i + reach, values.size() - 1); ++k)
                result[i] = std::max(result[i], values[k]);
        return result;
    }
    static std::vector<double> mean_around(const std::vector<double>& values, std::size_t reach) {
        std::vector<double> result(values.size());
        const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1,
                   wide = static_cast<std::ptrdiff_t>(reach);
        for (std::ptrdiff_t i = 0; i <= last; ++i) {
            double sum = 0.0;
            for (std::ptrdiff_t k = i - wide; k <= i + wide; ++k)
                sum += values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k, 0, last))];
            result[static_cast<std::size_t>(i)] = sum / static_cast<double>(2 * wide + 1);
        }
        return result;
    }

    const FootingTask& task_;
    const Rounds rounds_;
    std::array<std::vector<Stand>, 2> stands_{};
    std::array<std::vector<glm::dvec3>, 2> moves_{};  // the ankles' moves, after the shift
    std::vector<double> drops_{};
    double shift_ = 0.0;
};

}  // namespace

std::vector<Footing> plan_feet(const FootingTask& task) {
    return Planner(task).plan();
}

}  // namespace tendril::humanoid::detail
