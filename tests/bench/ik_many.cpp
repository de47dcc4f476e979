// Gain of solve_many over a plain loop over one Solver with Method::Fabrik: to tolerance, from the same
// initial poses, with all joints read from and written to the caller's memory.
//
// Claims: the minimum gain over the scalar solver in any band of distance, for 4, 11 and 31 joints and 1 000
// chains, free, in a plane and within limits; and the gain of two threads over one, if there are two cores.
// The goal is 15 times with 16 lanes (AVX3) and 7 times with 8 (AVX2), and half of that within limits; prints
// how many rows reach it. Two things keep it below 15: on the processor of these claims, the divider splits a
// register of 16 lanes in two, which bounds the accelerated step; and a quarter of the time is transfers,
// which no width accelerates. Times are processor time, except for threads, whose gain needs an idle machine.
#include <glm/glm.hpp>
#include <random>
#include <thread>

#include "../core/kept_solver.hpp"
#include "measure.hpp"
#include "tendril/ik/many.hpp"

namespace {

using namespace tendril::bench;
using tendril::ik::Batch;
using tendril::ik::JointKind;
using tendril::ik::Limit;
using tendril::ik::ManyReport;
using tendril::ik::ManySummary;
using tendril::ik::Method;
using tendril::ik::Options;
using tendril::ik::Report;
using Solver = tendril::test::KeptSolver;

constexpr int repetitions = 41, limited_repetitions = 5;

/// Chains of bones of 1 m in random poses, and targets between `least` and `most` of the reach.
struct Crowd {
    std::size_t chains, bones;
    std::vector<float> lengths;
    std::vector<glm::vec3> joints, targets;
    std::vector<Limit> limits;
    std::optional<tendril::ik::Plane> plane;

    Crowd(std::size_t chain_count, std::size_t bone_count, float least, float most)
        : chains(chain_count), bones(bone_count), lengths(bone_count, 1.0f) {
        std::mt19937 random(1);
        std::normal_distribution<float> normal;
        const auto direction = [&] {
            const glm::vec3 p{normal(random), normal(random), normal(random)};
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
    /// Within limits: at rest, straight along +X.
    Crowd(std::size_t chain_count, const std::vector<Limit>& within, float least, float most);
    /// Puts all of it into the plane z = 0.
    void flatten() {
        plane.emplace();
        const auto flat = [](glm::vec3 v) {
            v.z = 0.0f;
            return v * (1.0f / std::max(std::sqrt(v.x * v.x + v.y * v.y), 1e-6f));
        };
        for (std::size_t i = 0; i < chains; ++i) {
            const float far = glm::length(targets[i]);
            targets[i] = flat(targets[i]) * far;
            glm::vec3* const chain = &joints[i * (bones + 1)];
            std::vector<glm::vec3> directions;
            for (std::size_t j = 0; j < bones; ++j) directions.push_back(flat(chain[j + 1] - chain[j]));
            for (std::size_t j = 0; j < bones; ++j) chain[j + 1] = chain[j] + directions[j];
        }
    }
    /// Makes the first bone so long that targets near the root are too close.
    void lengthen_first(float to) {
        lengths.front() = to;
        for (std::size_t i = 0; i < chains; ++i) {
            glm::vec3* const chain = &joints[i * (bones + 1)];
            const glm::vec3 by = (chain[1] - chain[0]) * (to - 1.0f);
            for (std::size_t j = 1; j <= bones; ++j) chain[j] += by;
        }
    }
};

float draw(std::mt19937& random, float least, float most) {
    return std::uniform_real_distribution<float>(least, most)(random);
}

/// A random rotation within the limit of a joint that rests along +X, up to `part` of the way to its bounds.
glm::quat some_turn(const Limit& limit, float part, std::mt19937& random) {
    const glm::vec3 bone(1, 0, 0), side = glm::cross(limit.axis, bone);
    if (limit.kind == JointKind::Hinge)
        return glm::angleAxis(part * draw(random, limit.min, limit.max), limit.axis);
    for (;;) {
        const float up = draw(random, -limit.down, limit.up), left = draw(random, -limit.right, limit.left);
        if (excess(limit, {up, left, 0.0f}) > 0.0f) continue;
        const glm::vec3 swing = limit.axis * up + side * left;
        const float angle = glm::length(swing), twist = draw(random, limit.twist_min, limit.twist_max);
        return glm::angleAxis(part * angle, swing / angle) * glm::angleAxis(part * twist, bone);
    }
}

Crowd::Crowd(std::size_t chain_count, const std::vector<Limit>& within, float least, float most)
    : Crowd(chain_count, within.size(), least, most) {
    limits = within;
    std::mt19937 random(2);
    for (std::size_t i = 0; i < joints.size(); ++i)
        joints[i] = {static_cast<float>(i % (bones + 1)), 0.0f, 0.0f};
    for (glm::vec3& target : targets) {
        float distance = 0.0f;
        do {
            const float part = draw(random, 0.0f, 1.0f);
            glm::quat turned(1, 0, 0, 0);
            target = glm::vec3(0.0f);
            for (const Limit& limit : limits) {
                turned = turned * some_turn(limit, part, random);
                target += turned * glm::vec3(1, 0, 0);
            }
            distance = glm::length(target) / static_cast<float>(bones);
        } while (distance < least || distance > most);
    }
}

/// Solves all chains of a crowd, each time from the same poses.
class Contest {
  public:
    explicit Contest(const Crowd& of, int threads = 1)
        : crowd_(of),
          solver_(of.lengths),
          batch_(*Batch::make(of.chains, of.bones, threads)),
          rest_(of.chains * of.bones, glm::quat(1, 0, 0, 0)),
          rotations_(rest_),
          reports_(of.chains),
          many_reports_(of.chains) {
        if (!batch_.set_lengths(of.lengths) || !batch_.set_limits(of.limits)) std::abort();
    }

    /// Poses are reset outside of the timed part, so that both use the caches equally.
    void reset() { joints_ = crowd_.joints; }
    void scalar() {
        for (std::size_t i = 0; i < crowd_.chains; ++i) {
            const auto joints = std::span(joints_).subspan(i * (crowd_.bones + 1), crowd_.bones + 1);
            solver_.state.reset();
            reports_[i] = solver_.solve(Method::Fabrik, joints, crowd_.targets[i],
                                        {.limits = crowd_.limits, .plane = crowd_.plane});
        }
    }
    /// From the same joints to the same joints; the rotations are copied into and out of the batch.
    void many(std::string_view unit) {
        const bool limited = !crowd_.limits.empty();
        if (limited && !batch_.set_rotations(rest_)) std::abort();
        summary_ = solve_many(batch_, joints_, crowd_.targets, many_reports_,
                              {.plane = crowd_.plane, .vector_unit = unit});
        if (limited && !batch_.copy_rotations(rotations_)) std::abort();
    }
    double mean_iterations() const {
        double sum = 0.0;
        for (const Report& report : reports_) sum += report.iterations;
        return sum / static_cast<double>(reports_.size());
    }
    const ManySummary& summary() const { return summary_; }

    /// Seconds of the scalar solver, then of each vector unit.
    std::vector<double> race(int times = repetitions) {
        std::vector<std::function<void()>> runs{[this] { scalar(); }};
        for (const std::string_view unit : tendril::ik::vector_units())
            runs.push_back([this, unit] { many(unit); });
        return tendril::bench::race(runs, times, cpu_seconds, [this] { reset(); });
    }

  private:
    const Crowd& crowd_;
    Solver solver_;
    Batch batch_;
    std::vector<glm::vec3> joints_;
    std::vector<glm::quat> rest_, rotations_;
    std::vector<Report> reports_;
    std::vector<ManyReport> many_reports_;
    ManySummary summary_;
};

void print_units(const char* first) {
    std::printf("%-40s%10s", first, "scalar");
    for (const std::string_view unit : tendril::ik::vector_units())
        std::printf("%16s", std::string(unit).c_str());
    std::printf("\n");
}

void print_row(const std::string& name, const std::vector<double>& seconds, std::size_t chains) {
    const double unit_of_work = static_cast<double>(chains) * 1e-9;
    std::printf("%-40s%10.0f", name.c_str(), seconds[0] / unit_of_work);
    for (std::size_t i = 1; i < seconds.size(); ++i)
        std::printf("%8.1f %6.1fx", seconds[i] / unit_of_work, seconds[0] / seconds[i]);
    std::printf("\n");
}

/// The gains of each vector unit, row by row.
using Gains = std::vector<std::vector<double>>;
void note(Gains& gains, const std::vector<double>& seconds) {
    gains.resize(seconds.size() - 1);
    for (std::size_t i = 0; i < gains.size(); ++i) gains[i].push_back(seconds[0] / seconds[i + 1]);
}

/// Prints the minimum and how many reach the goal.
bool claim_gains(const std::string& what, const std::vector<double>& gains, double least, double aim) {
    const auto reach = std::count_if(gains.begin(), gains.end(), [&](double gain) { return gain >= aim; });
    std::printf("      %s: %zu of %zu rows reach %.1f\n", what.c_str(), static_cast<std::size_t>(reach),
                gains.size(), aim);
    return claim(what.c_str(), *std::min_element(gains.begin(), gains.end()), least);
}

struct Band {
    const char* name;
    float least, most;
};
constexpr Band bands[] = {{"0.05-0.9 R", 0.05f, 0.9f},
                          {"0.9-0.95 R", 0.9f, 0.95f},
                          {"0.95-0.99 R", 0.95f, 0.99f},
                          {"0.99-0.999 R", 0.99f, 0.999f}};

std::string row_name(std::size_t joints, const char* what, const Contest& contest) {
    char name[64];
    std::snprintf(name, sizeof name, "%3zu joints, %-14s%6.2f iterations", joints, what,
                  contest.mean_iterations());
    return name;
}

Gains bands_table(bool flat) {
    std::printf(flat ? "\nthe same in a plane; medians of %d\n"
                     : "\nns per chain until within tolerance (1e-3 of the reach), 1000 chains, one thread; "
                       "medians of %d\n",
                repetitions);
    print_units("");
    Gains gains;
    for (const std::size_t bones : {3u, 10u, 30u})
        for (const Band& band : bands) {
            Crowd crowd(1000, bones, band.least, band.most);
            if (flat) crowd.flatten();
            Contest contest(crowd);
            const std::vector<double> seconds = contest.race();
            print_row(row_name(bones + 1, band.name, contest), seconds, crowd.chains);
            note(gains, seconds);
        }
    return gains;
}

/// The same within limits.
Gains limits_table() {
    std::printf(
        "\nthe same within limits, from rest; medians of %d; in brackets: left to the scalar solver\n",
        limited_repetitions);
    print_units("");
    Limit cone = Limit::of(JointKind::BallAndSocket);
    cone.up = cone.down = 1.4f, cone.left = cone.right = 1.2f, cone.twist_min = -1.0f, cone.twist_max = 1.0f;
    Gains gains;
    for (const char* const kind : {"cones", "hinges", "both"}) {
        for (const std::size_t bones : {3u, 10u, 30u}) {
            std::vector<Limit> limits;
            for (std::size_t i = 0; i < bones; ++i) {
                const bool is_cone = *kind == 'c' || (*kind == 'b' && i % 2 == 0);
                const bool turned = i % 4 < 2;  // or all hinges would have the same axis
                const glm::vec3 axis(0.0f, turned ? 1.0f : 0.0f, turned ? 0.0f : 1.0f);
                limits.push_back(is_cone ? cone : Limit::hinge(axis, -2.0f, 2.0f));
            }
            for (const Band& band : bands) {
                const Crowd crowd(1000, limits, band.least, band.most);
                Contest contest(crowd);
                const std::vector<double> seconds = contest.race(limited_repetitions);
                char name[64];
                std::snprintf(name, sizeof name, "%3zu joints, %-6s %-12s [%zu]", bones + 1, kind, band.name,
                              contest.summary().scalar_fallbacks);
                print_row(name, seconds, crowd.chains);
                note(gains, seconds);
            }
        }
    }
    return gains;
}

/// The break-even point, and the cost of mixed targets.
void company_table() {
    std::printf("\nthe same, 11 joints, 0.05-0.9 R, by the number of chains\n");
    print_units("");
    for (const std::size_t chains : {1u, 2u, 4u, 8u, 16u, 32u, 64u, 100u, 1000u, 10'000u}) {
        const Crowd crowd(chains, 10, 0.05f, 0.9f);
        Contest contest(crowd);
        const std::vector<double> seconds = contest.race();
        print_row(std::to_string(chains) + " chains", seconds, chains);
    }
    std::printf("\nthe same, 1000 chains of 11 joints, mixed targets\n");
    print_units("");
    for (const Band& band : {Band{"0.05-1.2 R", 0.05f, 1.2f}, Band{"1.1-3 R", 1.1f, 3.0f}}) {
        const Crowd crowd(1000, 10, band.least, band.most);
        Contest contest(crowd);
        const std::vector<double> seconds = contest.race();
        print_row(row_name(11, band.name, contest), seconds, crowd.chains);
    }
    Crowd crowd(1000, 10, 0.0f, 1.2f);
    crowd.lengthen_first(20.0f);  // with 10 m per bone as the unit of the targets: 11 m of 29 are too close
    for (glm::vec3& target : crowd.targets) target *= 2.4f;
    Contest contest(crowd);
    const std::vector<double> seconds = contest.race();
    print_row(row_name(11, "some too close", contest), seconds, crowd.chains);
}

/// The speed-up of two threads over one, in wall time.
double thread_table() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    std::printf(
        "\nms for 30000 chains of 11 joints by threads (and times one), without transfers, %u cores\n",
        cores);
    const Crowd crowd(30'000, 10, 0.05f, 0.95f);
    std::vector<Batch> batches;
    std::vector<std::function<void()>> runs;
    for (const int threads : {1, 2, 3, 4})
        batches.push_back(*Batch::make(crowd.chains, crowd.bones, threads));
    for (Batch& batch : batches) runs.push_back([&] { solve_many(batch, crowd.targets); });
    const std::vector<double> seconds = race(runs, repetitions, wall_seconds, [&] {
        for (Batch& batch : batches) {
            if (!batch.set_joints(crowd.joints)) std::abort();
        }
    });
    for (std::size_t i = 0; i < seconds.size(); ++i)
        std::printf("%zu: %.2f (%.2fx)   ", i + 1, seconds[i] * 1e3, seconds[0] / seconds[i]);
    std::printf("\n\n");
    return seconds[0] / seconds[1];
}

}  // namespace

int main(int count, char** arguments) {
    const Gains gains = bands_table(false), flat = bands_table(true), limited = limits_table();
    company_table();
    const double two_threads = thread_table();
    bool all = true;
    const auto units = tendril::ik::vector_units();
    for (std::size_t i = 0; i < units.size(); ++i) {
        const bool wide = units[i] == "AVX3";
        if (!wide && units[i] != "AVX2") continue;
        const std::string what = std::string(units[i]) + " over the scalar solver";
        all &= claim_gains(what, gains[i], wide ? 7.5 : 6.0, wide ? 15.0 : 7.0);
        all &= claim_gains(what + ", in a plane", flat[i], 1.3, 2.0);
        all &= claim_gains(what + ", within limits", limited[i], wide ? 2.5 : 2.2, wide ? 7.5 : 3.5);
    }
    if (std::thread::hardware_concurrency() >= 2) all &= claim("two threads over one", two_threads, 1.5);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
