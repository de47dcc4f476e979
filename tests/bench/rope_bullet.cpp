// The default solver against the soft-body rope of Bullet: 1024 segments, the same shape to start from, the
// same masses and gravity, one simulated second, one run. Each is asked for the cheapest settings with which
// no link is ever longer or shorter than its rest by more than a stated part; the times of those are
// compared.
//
//     tendril_bench_rope_bullet            the table and one line per claim
//     tendril_bench_rope_bullet --check    the same, and exit code 1 when a claim does not hold
//
// Claim: at 1 % Bullet takes at least 8 times as long.
//
// Bullet's body is stepped by itself, without the world around it, which would only cost more: position
// solver, stiffness 1, no collisions, no damping. Its settings are the substeps of a frame and the solver's
// iterations; more of either is less stretch, and which of them is cheaper is looked for.
#include <BulletSoftBody/btSoftBody.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "measure.hpp"
#include "tendril/rope/world.hpp"

namespace {

using namespace tendril::bench;
namespace rope = tendril::rope;

constexpr int segments = 1024, frames = 60;

struct Outcome {
    double seconds = std::numeric_limits<double>::infinity(), stretch = 0.0;
    int substeps = 0, iterations = 0;
};

class BulletRope {
  public:
    explicit BulletRope(const rope::State& state) {
        info_.m_gravity = btVector3(0, btScalar(-9.81), 0);
        info_.m_broadphase = nullptr;
        info_.m_dispatcher = nullptr;
        info_.air_density = 0;
        std::vector<btVector3> points;
        std::vector<btScalar> masses;
        for (std::size_t i = 0; i < state.position.size(); ++i) {
            const glm::vec3 p(state.position[i]);
            points.emplace_back(p.x, p.y, p.z);
            masses.push_back(static_cast<btScalar>(state.mass[i]));
        }
        body_ = std::make_unique<btSoftBody>(&info_, static_cast<int>(points.size()), points.data(),
                                             masses.data());
        for (int i = 0; i < segments; ++i) {
            body_->appendLink(i, i + 1);
            btSoftBody::Link& link = body_->m_links[i];
            link.m_rl = state.links[static_cast<std::size_t>(i)].rest;
            link.m_c1 = link.m_rl * link.m_rl;
        }
        for (const rope::Pin& pin : state.pins) body_->setMass(static_cast<int>(pin.particle), 0);
        body_->m_materials[0]->m_kLST = 1;
        body_->m_cfg.kDP = 0;
        body_->m_cfg.collisions = 0;
    }

    void advance(int substeps, int iterations) {
        body_->m_cfg.piterations = iterations;
        const auto h = static_cast<btScalar>(1.0 / 60.0 / substeps);
        for (int i = 0; i < substeps; ++i) {
            body_->predictMotion(h);
            body_->solveConstraints();
            body_->integrateMotion();
        }
    }
    double stretch() const {
        double worst = 0.0;
        for (int i = 0; i < segments; ++i) {
            const btSoftBody::Link& link = body_->m_links[i];
            const double length = (link.m_n[1]->m_x - link.m_n[0]->m_x).length();
            worst = std::max(worst, std::abs(length / static_cast<double>(link.m_rl) - 1.0));
        }
        return worst;
    }

  private:
    btSoftBodyWorldInfo info_;
    std::unique_ptr<btSoftBody> body_;
};

/// Ends early where it already stretched too far or took too long: it is out of the race then.
Outcome run_bullet(const rope::State& state, int substeps, int iterations, double goal, double longest) {
    BulletRope body(state);
    Outcome result{0.0, 0.0, substeps, iterations};
    for (int i = 0; i < frames && result.stretch <= goal && result.seconds < longest; ++i) {
        const double start = cpu_seconds();
        body.advance(substeps, iterations);
        result.seconds += cpu_seconds() - start;
        result.stretch = std::max(result.stretch, body.stretch());
    }
    return result;
}

/// The fewest substeps that do, to a seventh, for each number of iterations; the cheapest of all.
Outcome cheapest_bullet(const rope::State& state, double goal) {
    Outcome best;
    for (const int iterations : {4, 2, 8, 1, 16}) {
        for (double substeps = 64.0; substeps < 4000.0; substeps *= 1.15) {
            const Outcome tried =
                run_bullet(state, static_cast<int>(substeps), iterations, goal, best.seconds);
            if (tried.seconds >= best.seconds) break;
            if (tried.stretch <= goal) {
                best = tried;
                break;
            }
        }
    }
    return best;
}

Outcome cheapest_ours(const rope::State& state, double goal) {
    Outcome best;
    for (const int substeps : {1, 2, 4, 8}) {
        rope::World world = *rope::World::from_state(state);
        rope::Workspace workspace;
        rope::Settings settings = world.settings();
        settings.substep = 1.0 / 60.0 / substeps;
        static_cast<void>(world.set_settings(settings));
        Outcome tried{0.0, 0.0, substeps, settings.iterations};
        for (int i = 0; i < frames; ++i) {
            const double start = cpu_seconds();
            world.advance(1.0 / 60.0, workspace);
            tried.seconds += cpu_seconds() - start;
            tried.stretch = std::max(tried.stretch, world.length_error(world.state().bodies[0]));
        }
        if (tried.stretch <= goal && tried.seconds < best.seconds) best = tried;
    }
    return best;
}

void print(const char* name, const Outcome& result) {
    std::printf("  %-10s%10.1f ms, %d substeps a frame, %d iterations, stretch %.2e\n", name,
                result.seconds * 1e3, result.substeps, result.iterations, result.stretch);
}

double contest(const char* title, const rope::State& state, double goal) {
    const Outcome bullet = cheapest_bullet(state, goal);
    std::vector<double> times;
    Outcome ours;
    for (int i = 0; i < 5; ++i) {
        ours = cheapest_ours(state, goal);
        times.push_back(ours.seconds);
    }
    ours.seconds = median(times);
    std::printf("%s, at most %g %% stretch\n", title, goal * 100.0);
    print("bullet", bullet);
    print("tendril", ours);
    return bullet.seconds / ours.seconds;
}

}  // namespace

int main(int count, char** arguments) {
    rope::World world;
    static_cast<void>(world.set_settings({.damping = 0.0f}));
    static_cast<void>(world.add_rope(
        {.to = {1, 0, 0}, .segments = segments, .length = 1.1f, .pin_start = true, .pin_end = true}));
    const double hung = contest("hung between two points", world.state(), 0.01);
    world.clear();
    static_cast<void>(world.add_rope({.to = {1, 0, 0}, .segments = segments, .pin_start = true}));
    const double let_go = contest("let go at one end", world.state(), 0.01);
    bool all = claim("time of Bullet's rope over ours, hung", hung, 8.0);
    all &= claim("time of Bullet's rope over ours, let go", let_go, 8.0);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
