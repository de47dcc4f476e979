// The effect of the constants in core/src/ik/tunables.hpp: change one, build, run again, compare the rows.
//
//     tendril_bench_ik_heuristics [solves per row, 1000] [prefix of rows]
//
// Every row solves the same random cases by one method: how many arrive (within 1e-3 of the reach and 500
// iterations, or 200 with limits and for trees), end as Limited or otherwise, mean iterations and residual
// (in reaches), mean time, and a hash of all joints, which shows whether anything changed at all.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "tendril/ik/solver.hpp"
#include "tendril/ik/tree.hpp"

namespace {

using namespace tendril::ik;
using Points = std::vector<glm::vec3>;
using Lengths = std::vector<float>;

constexpr float pi = 3.14159265f;

class Random {
  public:
    explicit Random(std::uint64_t seed) : generator_(seed) {}
    float between(float a, float b) {
        return a + (b - a) * static_cast<float>(generator_() >> 40) * (1.0f / 16777216.0f);
    }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(generator_() % count); }
    glm::vec3 direction() {
        const float z = between(-1.0f, 1.0f), angle = between(-pi, pi), r = std::sqrt(1.0f - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

  private:
    std::mt19937_64 generator_;
};

double microseconds() {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

float sum(const Lengths& lengths) {
    float all = 0.0f;
    for (const float length : lengths) all += length;
    return all;
}

class Row {
  public:
    Row(std::string name, const char* method) : name_(std::move(name)), method_(method) {}

    void add(Status status, int iterations, float residual, float reach, const Points& joints) {
        ++count_;
        arrived_ += status == Status::Converged;
        limited_ += status == Status::Limited;
        iterations_ += iterations;
        residual_ += static_cast<double>(residual / reach);
        for (const glm::vec3& joint : joints)
            for (const float coordinate : {joint.x, joint.y, joint.z}) {
                std::uint32_t bits = 0;
                std::memcpy(&bits, &coordinate, sizeof bits);
                hash_ = (hash_ ^ bits) * 1099511628211u;
            }
    }
    void add_time(double time) { time_ += time; }
    void print() const {
        const double n = static_cast<double>(count_);
        std::printf(
            "%-14s %-18s %7.2f %% %6ld limited %6ld short %8.2f iterations %9.5f R %8.2f us  %016llx\n",
            name_.c_str(), method_, 100.0 * static_cast<double>(arrived_) / n, limited_,
            count_ - arrived_ - limited_, static_cast<double>(iterations_) / n, residual_ / n, time_ / n,
            static_cast<unsigned long long>(hash_));
    }

  private:
    std::string name_;
    const char* method_;
    long count_ = 0, arrived_ = 0, limited_ = 0, iterations_ = 0;
    double residual_ = 0.0, time_ = 0.0;
    std::uint64_t hash_ = 1469598103934665603u;
};

constexpr Method methods[] = {Method::Fabrik, Method::Ccd, Method::JacobianTranspose, Method::Dls,
                              Method::SvdDls};

void solve(Row& row, Method method, Points joints, const Lengths& lengths, const glm::vec3& target,
           const Options& options) {
    Solver solver = Solver::make(lengths).value();
    State state = solver.initial_state();
    const double before = microseconds();
    const Report report = solver.solve(method, joints, state, target, options);
    row.add_time(microseconds() - before);
    row.add(report.status, report.iterations, report.residual, solver.reach(), joints);
}

/// Without limits: from random poses, or straight and folded ones with the target on their line.
enum class Start { Random, Straight, Folded };

void free_rows(const char* name, std::size_t bones, Start start, int count) {
    for (const Method method : methods) {
        Random random(7);
        Row row(name, tendril::ik::name(method));
        for (int i = 0; i < count; ++i) {
            Lengths lengths(bones);
            for (float& length : lengths) length = random.between(0.5f, 1.5f);
            const glm::vec3 line = random.direction();
            Points joints{glm::vec3(0.0f)};
            for (const float length : lengths) {
                const bool back = start == Start::Folded && random.below(2) == 0;
                const glm::vec3 way =
                    start == Start::Random ? random.direction() : line * (back ? -1.0f : 1.0f);
                joints.push_back(joints.back() + way * length);
            }
            const float far = sum(lengths) * random.between(0.01f, 0.998f);
            const glm::vec3 to = start == Start::Random ? random.direction() : line;
            solve(row, method, joints, lengths, to * far * (random.below(2) == 0 ? -1.0f : 1.0f),
                  {.max_iterations = 500});
        }
        row.print();
    }
}

/// Within limits, from rest along +X.
enum class Kind { All, Hinges, OneAxis, Cones };
enum class Target { Reached, Anywhere, Ahead };

Limit limit_of(Kind kind, Random& random) {
    constexpr JointKind all[] = {JointKind::Hinge, JointKind::Gliding,       JointKind::Saddle,
                                 JointKind::Pivot, JointKind::BallAndSocket, JointKind::Free};
    if (kind == Kind::All) return Limit::of(all[random.below(6)]);
    const glm::vec3 axis = random.below(2) == 0 ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    if (kind == Kind::Hinges) return Limit::hinge(axis, -1.2f, 1.8f);
    if (kind == Kind::OneAxis) return Limit::hinge({0, 0, 1}, 0.0f, 2.5f);
    Limit cone = Limit::of(JointKind::BallAndSocket);
    cone.up = cone.down = cone.left = cone.right = 1.2f;
    return cone;
}

glm::quat rotation_within(const Limit& limit, Random& random) {
    if (limit.kind == JointKind::Hinge)
        return glm::angleAxis(random.between(limit.min, limit.max), glm::normalize(limit.axis));
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 axis = random.direction();
        const float part = random.between(0.0f, 1.0f);
        const glm::quat rotation = glm::angleAxis(2.0f * part * part, axis);
        if (excess(limit, measure(limit, {1, 0, 0}, rotation)) <= 0.0f) return rotation;
    }
    return {1, 0, 0, 0};
}

void limited_rows(const char* name, Kind kind, Target target, int count) {
    for (const Method method : methods) {
        Random random(11);
        Row row(name, tendril::ik::name(method));
        for (int i = 0; i < count; ++i) {
            Lengths lengths(3 + random.below(3));
            for (float& length : lengths) length = random.between(0.5f, 1.5f);
            std::vector<Limit> limits;
            Points joints{glm::vec3(0.0f)};
            glm::vec3 tip(0.0f);
            glm::quat world{1, 0, 0, 0};
            for (const float length : lengths) {
                limits.push_back(limit_of(kind, random));
                joints.push_back(joints.back() + glm::vec3(length, 0, 0));
                world = glm::normalize(world * rotation_within(limits.back(), random));
                tip += world * glm::vec3(length, 0, 0);
            }
            const glm::vec3 way = random.direction();
            const float far = sum(lengths) * random.between(0.15f, 0.98f);
            if (target == Target::Anywhere) tip = way * far;
            if (target == Target::Ahead) tip = {far, 0, 0};
            solve(row, method, joints, lengths, tip, {.max_iterations = 200, .limits = limits});
        }
        row.print();
    }
}

/// Limbs on a short spine: targets from another pose's tips, straight ahead, or in conflict.
enum class Goals { Reached, Ahead, Conflict };

Points tree_pose(const std::vector<TreeJoint>& joints, std::size_t base, bool straight, Random& random) {
    Points places(joints.size(), glm::vec3(0.0f)), ways(joints.size(), glm::vec3(0.0f));
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const std::size_t parent = joints[k].parent;
        const glm::vec3 way = random.direction();
        ways[k] = straight && parent > base ? ways[parent] : way;
        places[k] = places[parent] + ways[k] * joints[k].length;
    }
    return places;
}

void tree_row(const char* name, Goals goals, int count) {
    Random random(13);
    Row row(name, "tree");
    for (int i = 0; i < count; ++i) {
        std::vector<TreeJoint> joints{{no_joint, 0.0f}};
        const auto grow = [&](std::size_t parent, std::size_t bones) {
            for (std::size_t k = 0; k < bones; ++k) {
                joints.push_back({parent, random.between(0.5f, 1.5f)});
                parent = joints.size() - 1;
            }
            return parent;
        };
        const std::size_t base = grow(0, random.below(4)), limbs = 2 + random.below(3);
        std::vector<std::size_t> tips;
        for (std::size_t k = 0; k < limbs; ++k) tips.push_back(grow(base, 2 + random.below(4)));
        Points places = tree_pose(joints, base, goals == Goals::Ahead, random);
        const Points other = tree_pose(joints, base, false, random);
        std::vector<Effector> effectors;
        for (const std::size_t tip : tips) {
            const float weight = random.between(0.2f, 2.0f), part = random.between(0.2f, 0.95f);
            const glm::vec3 way = random.direction() * random.between(0.3f, 4.0f);
            const glm::vec3 ahead = places[base] + (places[tip] - places[base]) * part;
            const glm::vec3 goal = goals == Goals::Reached ? other[tip] : goals == Goals::Ahead ? ahead : way;
            effectors.push_back({tip, goal, weight});
        }
        Tree tree = Tree::make(joints).value();
        const double before = microseconds();
        const TreeReport report = tree.solve(places, effectors, {.max_iterations = 200});
        row.add_time(microseconds() - before);
        row.add(report.status, report.iterations, report.residual, static_cast<float>(tree.reach()), places);
    }
    row.print();
}

}  // namespace

int main(int count_of_arguments, char** arguments) {
    const int count = count_of_arguments > 1 ? std::atoi(arguments[1]) : 1000;
    const std::string only = count_of_arguments > 2 ? arguments[2] : "";
    const auto wanted = [&](const std::string& name) { return name.compare(0, only.size(), only) == 0; };
    if (wanted("free 10")) free_rows("free 10", 10, Start::Random, count);
    if (wanted("free 4")) free_rows("free 4", 4, Start::Random, count);
    if (wanted("straight 6")) free_rows("straight 6", 6, Start::Straight, count);
    if (wanted("folded 6")) free_rows("folded 6", 6, Start::Folded, count);
    constexpr const char* kinds[] = {"limits all", "limits hinges", "limits axis", "limits cones"};
    constexpr const char* targets[] = {"", " any", " ahead"};
    for (int kind = 0; kind < 4; ++kind)
        for (int target = 0; target < 3; ++target) {
            const std::string name = std::string(kinds[kind]) + targets[target];
            if (wanted(name))
                limited_rows(name.c_str(), static_cast<Kind>(kind), static_cast<Target>(target), count);
        }
    if (wanted("tree reached")) tree_row("tree reached", Goals::Reached, count);
    if (wanted("tree ahead")) tree_row("tree ahead", Goals::Ahead, count);
    if (wanted("tree conflict")) tree_row("tree conflict", Goals::Conflict, count);
}
