// Iterations on a tree: reaching, the Newton step, which result is accepted, and when to stop.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ik/solve/convergence.hpp"
#include "ik/solve/perturbation.hpp"
#include "ik/tree/workspace.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::tree;

/// Turns every bone a little, each in its own direction, to leave a stall.
void perturb_all(TreeScratch& scratch) noexcept {
    for (std::size_t k = 1; k < scratch.used; ++k) {
        const Node& node = scratch.nodes[k];
        const glm::vec3 by{scattered(k, 1), scattered(k, 2), scattered(k, 3)};
        scratch.trial[k] = moved(scratch.at[k], by, bend * node.length);
    }
    for (std::size_t k = 1; k < scratch.used; ++k) {
        const Node& node = scratch.nodes[k];
        scratch.at[k] = at_length(scratch.at[node.parent], scratch.trial[k], node.length);
    }
}

class Iteration {
  public:
    Iteration(TreeScratch& scratch, const TreeOptions& options, double tolerance) noexcept
        : scratch_(scratch),
          tolerance_(tolerance),
          plain_(options.plain),
          now_(fit(scratch, scratch.at)),
          best_(now_) {}

    const Fit& now() const noexcept { return now_; }

    void step(int number) noexcept {
        forward_reaching(scratch_);
        backward_reaching(scratch_);
        const Fit reached = fit(scratch_, scratch_.next);
        if (plain_ || number < newton_from || reached.worst <= tolerance_)
            return take(scratch_.next, reached);
        const bool nearer = reached.cost < now_.cost;
        const double before = std::min(reached.cost, now_.cost);
        newton_step(scratch_, nearer ? scratch_.next : scratch_.at,
                    damping_ * scratch_.lightest / static_cast<double>(scratch_.used));
        const Fit tried = fit(scratch_, scratch_.trial);
        if (tried.cost < before) {
            damping_ = std::max(tune::tree::damping_falls * damping_, tune::tree::min_damping);
            return take(scratch_.trial, tried);
        }
        damping_ = std::min(tune::tree::damping_grows * damping_, tune::tree::max_damping);
        if (nearer) take(scratch_.next, reached);
    }

    void perturb() noexcept {
        save_best();
        perturb_all(scratch_);
        now_ = fit(scratch_, scratch_.at);
        damping_ = tune::tree::first_damping;
    }

    void restore_best() noexcept {
        if (best_.cost < now_.cost) {
            std::copy_n(scratch_.best.begin(), scratch_.used, scratch_.at.begin());
            now_ = best_;
        }
    }

  private:
    void save_best() noexcept {
        if (saved_ && best_.cost <= now_.cost) return;
        std::copy_n(scratch_.at.begin(), scratch_.used, scratch_.best.begin());
        best_ = now_;
        saved_ = true;
    }
    void take(std::vector<glm::vec3>& places, const Fit& new_fit) noexcept {
        if (new_fit.cost > now_.cost) save_best();
        std::swap(scratch_.at, places);
        now_ = new_fit;
    }

    TreeScratch& scratch_;
    double tolerance_;
    bool plain_;
    Fit now_, best_;
    bool saved_ = false;  ///< scratch.best is valid
    double damping_ = tune::tree::first_damping;
};

}  // namespace

double worst_residual(const TreeScratch& scratch, std::span<const Effector> effectors) noexcept {
    double worst = 0.0;
    for (const Effector& effector : effectors) {
        if (effector.weight == 0.0f) continue;
        worst = std::max(worst, gap(scratch.at[scratch.node_of[effector.joint]], effector.target));
    }
    return worst;
}

TreeRun iterate(TreeScratch& scratch, std::span<const Effector> effectors, const TreeOptions& options,
                double tolerance) noexcept {
    TreeRun run;
    Iteration iteration(scratch, options, tolerance);
    // Either the sum over the effectors or the worst one may still converge.
    const StallRule rule{.window = tune::tree::stall_window,
                         .absolute = static_cast<float>(std::max(0.01 * tolerance, 1e-6 * scratch.reach))};
    const auto cost = [&] { return static_cast<float>(std::sqrt(iteration.now().cost)); };
    const auto worst = [&] { return static_cast<float>(iteration.now().worst); };
    const auto reach = static_cast<float>(scratch.reach);
    Convergence together(rule, cost(), reach), furthest(rule, worst(), reach);
    int perturbations = options.plain ? tune::tree::max_perturbations : 0;
    while (run.iterations < options.max_iterations) {
        if (!options.every_iteration && iteration.now().worst <= tolerance) break;
        iteration.step(++run.iterations);
        const auto done = static_cast<std::size_t>(run.iterations);
        if (done <= options.residuals.size()) {
            options.residuals[done - 1] = static_cast<float>(worst_residual(scratch, effectors));
        }
        together.record(cost());
        furthest.record(worst());
        if (options.every_iteration || !together.stalled() || !furthest.stalled()) continue;
        if (iteration.now().worst <= tolerance) break;
        if ((run.stalled = perturbations++ == tune::tree::max_perturbations)) break;
        iteration.perturb();
        together.restart(cost());
        furthest.restart(worst());
    }
    iteration.restore_best();
    return run;
}

}  // namespace tendril::ik::detail
