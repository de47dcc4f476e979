// The worst case of one call of World::advance: random worlds of about 149 particles among a few colliders,
// with hostile numbers in every edit.
//
//     tendril_bench_rope_hostile [worlds]    the most expensive calls, and one line per claim; 300 worlds
//     tendril_bench_rope_hostile --check     the same, and exit code 1 if a claim does not hold
//
// A call simulates at most 16 substeps. Work counts solved links and collider distances, and is the same on
// every machine; times are processor time, the minimum of five runs of the same call.
//
// Claims: no substep takes more than twice the work that max_pass_work allows its passes, and no call more
// than 80 000 loops of measure.hpp (worst of 1500 worlds: 44 000, 0.56 of the work).
#include "../core/rope_hostile.hpp"
#include "measure.hpp"

namespace {

using namespace tendril::bench;
namespace rope = tendril::rope;
using tendril::test::HostileEditor;
using tendril::test::HostileNumbers;

constexpr int edits = 40;
constexpr rope::AdvanceOptions options{.max_substeps = 16};

/// A rope and a cloth, 149 particles, between two colliders.
rope::World start(HostileNumbers& hostile) {
    rope::World world;
    const glm::vec3 to = hostile.point(2);
    static_cast<void>(world.add_rope({.from = {0, 0, 0}, .to = to, .segments = 48, .radius = 0.05f}));
    const glm::vec3 along = hostile.point(1), down = hostile.point(1);
    static_cast<void>(world.add_cloth(
        {.corner = {0, 0.1f, 0}, .along = along, .down = down, .columns = 10, .rows = 10, .tear = 0.5f}));
    for (int i = 0; i < 2; ++i) static_cast<void>(world.add_collider(hostile.shape()));
    return world;
}

struct Call {
    std::uint64_t seed = 0;
    int edit = 0;
    rope::World before;
    rope::Advance done;
    double seconds = 0.0;    ///< simulated
    double taken = 0.0;      ///< processor time, milliseconds
    double work_part = 0.0;  ///< of a substep, relative to what max_pass_work and fixed costs allow
};

/// The allowed work of a substep: twice the bound of the passes, or the passes that always run.
double allowed_work(const rope::World& world) {
    const auto particles = static_cast<double>(world.size()),
               links = static_cast<double>(world.state().links.size());
    const auto colliders = static_cast<double>(world.state().colliders.size());
    const double pass = links + colliders * (particles + 14.0 * links);
    const double passes = std::max(static_cast<double>(rope::max_pass_work), rope::unbounded_passes * pass);
    return 2.0 * passes + 256.0 * particles * colliders;
}

/// Milliseconds of repeating the same call.
double time_again(const Call& call) {
    rope::Workspace workspace;
    double minimum = 1e300;
    for (int i = 0; i < 5; ++i) {
        rope::World world = call.before;
        const double from = cpu_seconds();
        world.advance(call.seconds, workspace, options);
        minimum = std::min(minimum, cpu_seconds() - from);
    }
    return 1e3 * minimum;
}

void print(const char* what, const Call& call) {
    const rope::State& state = call.before.state();
    std::printf("%-16s seed %llu, edit %d: %.2f ms, %d substeps, work %llu, %.2f of what is allowed\n", what,
                static_cast<unsigned long long>(call.seed), call.edit, call.taken, call.done.substeps,
                static_cast<unsigned long long>(call.done.work), call.work_part);
    std::printf("%-16s %zu particles, %zu links, %zu colliders, %s, %d iterations, %d substeps shortened\n",
                "", state.position.size(), state.links.size(), state.colliders.size(),
                name(state.settings.solver), state.settings.iterations, call.done.shortened);
}

struct Worst {
    Call time, work;
    std::uint64_t calls = 0, over_5_ms = 0;
};

void play(std::uint64_t seed, Worst& worst) {
    HostileNumbers hostile(seed);
    rope::World world = start(hostile);
    rope::Workspace workspace;
    for (int i = 0; i < edits; ++i) {
        static_cast<void>(HostileEditor(world, workspace, hostile, 300).edit());
        Call call{seed, i, world, {}, 16.0 * world.settings().substep, 0.0, 0.0};
        const double from = cpu_seconds();
        call.done = world.advance(call.seconds, workspace, options);
        call.taken = 1e3 * (cpu_seconds() - from);
        const double substeps = std::max(call.done.substeps, 1);
        call.work_part = static_cast<double>(call.done.work) / (substeps * allowed_work(call.before));
        ++worst.calls;
        if (call.taken > 5.0) ++worst.over_5_ms;
        if (call.work_part > worst.work.work_part) worst.work = call;
        if (call.taken > worst.time.taken) {
            call.taken = time_again(call);  // ignores disturbances by other processes
            if (call.taken > worst.time.taken) worst.time = call;
        }
    }
}

}  // namespace

int main(int count, char** arguments) {
    const bool check = take_flag(count, arguments, "--check");
    const std::uint64_t worlds = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 300;
    Worst worst;
    for (std::uint64_t seed = 1; seed <= worlds; ++seed) play(seed, worst);
    worst.work.taken = time_again(worst.work);
    std::printf("%llu calls of %d substeps at most, %llu of them over 5 ms\n",
                static_cast<unsigned long long>(worst.calls), static_cast<int>(options.max_substeps),
                static_cast<unsigned long long>(worst.over_5_ms));
    print("most time", worst.time);
    print("most work", worst.work);
    bool all =
        claim("work that a substep may take over the most that one took", 1.0 / worst.work.work_part, 1.0);
    all &= claim_loops("the costliest call", 1e-3 * worst.time.taken, 80'000);
    return all || !check ? 0 : 1;
}
