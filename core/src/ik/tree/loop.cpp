// Iterations on a tree: pulls, the Newton step, what is kept of them, and when it is over.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

constexpr int newton_from = 3;  ///< the pulls alone get the gross shape right, and move the joints least
constexpr double first_damping = 1e-3, least_damping = 1e-9, most_damping = 1e3;
constexpr int patience = 8;  ///< iterations without progress that make a stall
constexpr int most_kicks = 1;

/// Sees when nothing gets better any more.
class Progress {
  public:
    Progress(Fit fit, double least) noexcept : least_(least) { reset(fit); }
    void reset(Fit fit) noexcept {
        mark_ = best_ = {std::sqrt(fit.cost), fit.worst};
        since_ = 0;
    }
    bool stalled(Fit fit) noexcept {
        best_.cost = std::min(best_.cost, std::sqrt(fit.cost));
        best_.worst = std::min(best_.worst, fit.worst);
        if (++since_ < patience) return false;
        const bool better = mark_.cost - best_.cost > least_ || mark_.worst - best_.worst > least_;
        mark_ = best_;
        since_ = 0;
        return !better;
    }

  private:
    double least_;     ///< metres
    Fit mark_, best_;  ///< the cost as its root
    int since_ = 0;
};

class Iteration {
  public:
    Iteration(TreeRoom& room, const TreeOptions& options, double tolerance) noexcept
        : room_(room), tolerance_(tolerance), plain_(options.plain), now_(fit(room, room.at)), best_(now_) {}

    const Fit& now() const noexcept { return now_; }

    void step(int number) noexcept {
        pull_inward(room_);
        pull_outward(room_);
        const Fit pulled = fit(room_, room_.next);
        if (plain_ || number < newton_from || pulled.worst <= tolerance_) return take(room_.next, pulled);
        const bool nearer = pulled.cost < now_.cost;
        const double before = std::min(pulled.cost, now_.cost);
        newton_step(room_, nearer ? room_.next : room_.at,
                    damping_ * room_.lightest / static_cast<double>(room_.used));
        const Fit tried = fit(room_, room_.trial);
        if (tried.cost < before) {
            damping_ = std::max(damping_ / 4.0, least_damping);
            return take(room_.trial, tried);
        }
        damping_ = std::min(damping_ * 8.0, most_damping);
        if (nearer) take(room_.next, pulled);
    }

    void leave_lines() noexcept {
        keep_best();
        if (kick_lines(room_, tolerance_)) now_ = fit(room_, room_.at);
    }

    void kick() noexcept {
        keep_best();
        kick_all(room_);
        now_ = fit(room_, room_.at);
        damping_ = first_damping;
    }

    /// What would end worse than it once was goes back there.
    void settle() noexcept {
        if (best_.cost < now_.cost) {
            std::copy_n(room_.best.begin(), room_.used, room_.at.begin());
            now_ = best_;
        }
    }

  private:
    void keep_best() noexcept {
        if (saved_ && best_.cost <= now_.cost) return;
        std::copy_n(room_.at.begin(), room_.used, room_.best.begin());
        best_ = now_;
        saved_ = true;
    }
    void take(std::vector<glm::vec3>& places, const Fit& fit_of_them) noexcept {
        if (fit_of_them.cost > now_.cost) keep_best();
        std::swap(room_.at, places);
        now_ = fit_of_them;
    }

    TreeRoom& room_;
    double tolerance_;
    bool plain_;
    Fit now_, best_;
    bool saved_ = false;  ///< room.best holds something
    double damping_ = first_damping;
};

}  // namespace

double worst_residual(const TreeRoom& room, std::span<const Effector> effectors) noexcept {
    double worst = 0.0;
    for (const Effector& effector : effectors) {
        if (effector.weight == 0.0f) continue;
        worst = std::max(worst, gap(room.at[room.slot_of[effector.joint]], effector.target));
    }
    return worst;
}

TreeRun iterate(TreeRoom& room, std::span<const Effector> effectors, const TreeOptions& options,
                double tolerance) noexcept {
    TreeRun run;
    Iteration iteration(room, options, tolerance);
    if (!options.plain) iteration.leave_lines();
    Progress progress(iteration.now(), std::max(0.01 * tolerance, 1e-6 * room.reach));
    int kicks = options.plain ? most_kicks : 0;
    while (run.iterations < options.max_iterations) {
        if (!options.every_iteration && iteration.now().worst <= tolerance) break;
        iteration.step(++run.iterations);
        const auto done = static_cast<std::size_t>(run.iterations);
        if (done <= options.residuals.size()) {
            options.residuals[done - 1] = static_cast<float>(worst_residual(room, effectors));
        }
        if (options.every_iteration || !progress.stalled(iteration.now())) continue;
        if (iteration.now().worst <= tolerance) break;
        if ((run.stalled = kicks++ == most_kicks)) break;
        iteration.kick();
        progress.reset(iteration.now());
    }
    iteration.settle();
    return run;
}

}  // namespace tendril::ik::detail
