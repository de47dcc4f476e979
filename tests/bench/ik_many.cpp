// What solve_many gains: against one Solver called in a loop, by vector unit, by the number of chains, and by
// threads; with forced iterations and with real ones.
//
//     tendril_bench_ik_many            the tables and one line per claim
//     tendril_bench_ik_many --check    the same, and exit code 1 when a claim does not hold
//
// Claims: with AVX2, 10 bones and 20 forced iterations, at least 30 times the scalar solver per core; two
// threads at least 1.8 times one, where there are two cores. Times are processor time but for the threads,
// whose gain needs a quiet machine to be seen.
#include <cmath>
#include <random>
#include <string>
#include <thread>

#include "measure.hpp"
#include "tendril/ik/many.hpp"
#include "tendril/ik/solver.hpp"

namespace {

using namespace tendril::bench;
using tendril::ik::Batch;
using tendril::ik::ManyOptions;
using tendril::ik::Method;
using tendril::ik::Options;
using tendril::ik::Report;
using tendril::ik::Solver;

constexpr int repetitions = 15;
constexpr int forced = 20;
constexpr std::size_t crowd = 4096;

/// Chains of bones of one metre in random poses, and targets between `least` and `most` of the reach.
struct Crowd {
    std::size_t chains, bones;
    std::vector<glm::vec3> joints, targets;

    Crowd(std::size_t chain_count, std::size_t bone_count, float least, float most)
        : chains(chain_count), bones(bone_count) {
        std::mt19937 random(1);
        std::normal_distribution<float> normal;
        const auto direction = [&] {
            const glm::vec3 p(normal(random), normal(random), normal(random));
            return p * (1.0f / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z));
        };
        std::uniform_real_distribution<float> part(least, most);
        for (std::size_t i = 0; i < chains; ++i) {
            glm::vec3 at(0.0f);
            joints.push_back(at);
            for (std::size_t j = 0; j < bones; ++j) joints.push_back(at += direction());
            targets.push_back(direction() * (part(random) * static_cast<float>(bones)));
        }
    }
    std::span<const glm::vec3> chain(std::size_t i) const {
        return std::span(joints).subspan(i * (bones + 1), bones + 1);
    }
};

/// Solves all chains of a crowd, each time from the same poses.
class Contest {
  public:
    Contest(const Crowd& of, const Options& options)
        : crowd_(of),
          options_(options),
          solver_(std::vector<float>(of.bones, 1.0f)),
          batch_(of.chains, of.bones),
          reports_(of.chains) {}

    /// The poses are set apart from what is timed, so the two take the same from the caches.
    void reset() {
        joints_ = crowd_.joints;
        for (std::size_t i = 0; i < crowd_.chains; ++i) batch_.set_joints(i, crowd_.chain(i));
    }
    void scalar() {
        for (std::size_t i = 0; i < crowd_.chains; ++i) {
            const auto joints = std::span(joints_).subspan(i * (crowd_.bones + 1), crowd_.bones + 1);
            reports_[i] = solver_.solve(Method::FabrikPlain, joints, crowd_.targets[i], options_);
        }
    }
    void many(std::string_view unit, int threads) {
        solve_many(batch_, crowd_.targets, reports_,
                   {.tolerance = options_.tolerance,
                    .max_iterations = options_.max_iterations,
                    .every_iteration = options_.every_iteration,
                    .threads = threads,
                    .vector_unit = unit});
    }
    double mean_iterations() const {
        double sum = 0.0;
        for (const Report& report : reports_) sum += report.iterations;
        return sum / static_cast<double>(reports_.size());
    }

    std::vector<double> race(const std::vector<std::function<void()>>& runs, double (*now)() = cpu_seconds) {
        return tendril::bench::race(runs, repetitions, now, [this] { reset(); });
    }

  private:
    const Crowd& crowd_;
    Options options_;
    Solver solver_;
    Batch batch_;
    std::vector<glm::vec3> joints_;
    std::vector<Report> reports_;
};

std::vector<std::function<void()>> scalar_and_units(Contest& contest) {
    std::vector<std::function<void()>> runs{[&contest] { contest.scalar(); }};
    for (const std::string_view unit : tendril::ik::vector_units()) {
        runs.push_back([&contest, unit] { contest.many(unit, 1); });
    }
    return runs;
}

void print_units(const char* first) {
    std::printf("%-28s%14s", first, "scalar");
    for (const std::string_view unit : tendril::ik::vector_units()) {
        std::printf("%16s", std::string(unit).c_str());
    }
    std::printf("\n");
}

void print_row(const std::string& name, const std::vector<double>& seconds, double unit_of_work) {
    std::printf("%-28s%14.2f", name.c_str(), seconds[0] / unit_of_work * 1e9);
    for (std::size_t i = 1; i < seconds.size(); ++i) {
        std::printf("%8.3f %6.1fx", seconds[i] / unit_of_work * 1e9, seconds[0] / seconds[i]);
    }
    std::printf("\n");
}

/// How often the scalar solver's throughput each unit has, for 10 bones.
std::vector<double> forced_table() {
    std::printf(
        "\nns per bone and pass, %d forced iterations, %zu chains, one thread (and times the scalar "
        "solver); medians of %d\n",
        forced, crowd, repetitions);
    print_units("");
    std::vector<double> gains;
    for (const std::size_t bones : {3u, 10u, 30u}) {
        const Crowd chains(crowd, bones, 0.05f, 0.9f);
        Contest contest(chains, {.max_iterations = forced, .every_iteration = true});
        const std::vector<double> seconds = contest.race(scalar_and_units(contest));
        print_row(std::to_string(bones) + " bones", seconds,
                  2.0 * forced * static_cast<double>(bones * crowd));
        if (bones != 10) continue;
        for (const double each : seconds) gains.push_back(seconds[0] / each);
    }
    return gains;
}

/// One register alone waits on its own square root; and a few chains do not fill one.
void company_table() {
    std::printf("\nns per bone and pass, 10 bones, by the number of chains in a batch\n");
    print_units("");
    for (const std::size_t chains : {1u, 4u, 8u, 16u, 32u, 64u, 128u, 1024u}) {
        const Crowd few(chains, 10, 0.05f, 0.9f);
        Contest contest(few, {.max_iterations = 100 * forced, .every_iteration = true});
        const std::vector<double> seconds = contest.race(scalar_and_units(contest));
        print_row(std::to_string(chains) + " chains", seconds,
                  2.0 * 100 * forced * 10 * static_cast<double>(chains));
    }
}

void tolerance_table() {
    std::printf("\nns per chain of 10 bones until within tolerance (1e-3 of the reach)\n");
    print_units("targets, mean iterations");
    struct Band {
        const char* name;
        float least, most;
    };
    for (const Band& band : {Band{"0.05 to 0.9 R", 0.05f, 0.9f}, Band{"0.9 to 0.99 R", 0.9f, 0.99f},
                             Band{"0.99 to 0.999 R", 0.99f, 0.999f}, Band{"out of reach", 1.1f, 3.0f},
                             Band{"0.05 to 1.2 R", 0.05f, 1.2f}}) {
        const Crowd chains(crowd, 10, band.least, band.most);
        Contest contest(chains, {.max_iterations = 1000});
        const std::vector<double> seconds = contest.race(scalar_and_units(contest));
        char name[64];
        std::snprintf(name, sizeof name, "%-18s%7.1f", band.name, contest.mean_iterations());
        print_row(name, seconds, static_cast<double>(crowd));
    }
}

/// How much faster two threads are than one, by the clock on the wall.
double thread_table() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    std::printf(
        "\nms for %zu chains of 10 bones, %d forced iterations, by threads (and times one), %u cores\n",
        8 * crowd, forced, cores);
    const Crowd chains(8 * crowd, 10, 0.05f, 0.9f);
    Contest contest(chains, {.max_iterations = forced, .every_iteration = true});
    std::vector<std::function<void()>> runs;
    for (const int threads : {1, 2, 3, 4}) {
        runs.push_back([&contest, threads] { contest.many({}, threads); });
    }
    const std::vector<double> seconds = contest.race(runs, wall_seconds);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        std::printf("%zu: %.2f (%.2fx)   ", i + 1, seconds[i] * 1e3, seconds[0] / seconds[i]);
    }
    std::printf("\n\n");
    return seconds[0] / seconds[1];
}

}  // namespace

int main(int count, char** arguments) {
    const std::vector<double> gains = forced_table();
    company_table();
    tolerance_table();
    const double two_threads = thread_table();
    bool all = true;
    const auto units = tendril::ik::vector_units();
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (units[i] != "AVX2" && units[i] != "AVX3") continue;
        const std::string what = "throughput with " + std::string(units[i]) + " over the scalar solver's";
        all &= claim(what.c_str(), gains[i + 1], 30.0);
    }
    if (std::thread::hardware_concurrency() >= 2) all &= claim("two threads over one", two_threads, 1.8);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
