// Cost of foot IK per character and frame, by ground.
//
// Claims, for the worst row: the feet of a character take at most 26 loops (measure.hpp) per frame; a mesh of
// 200 000 triangles costs at most three times as much as flat ground.
#include "../core/humanoid_walk.hpp"
#include "measure.hpp"
#include "tendril/humanoid/feet_many.hpp"

namespace {

using namespace tendril::bench;
using namespace tendril::humanoid;
using tendril::test::FigureWalk;
using tendril::test::make_figure;

constexpr std::size_t characters = 1000;
constexpr int frames = 66;  // of a loop of the walk

/// Hills that need a mesh and its grid.
Ground hills(int side) {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> triangles;
    const double cell = 40.0 / side;
    for (int row = 0; row <= side; ++row)
        for (int column = 0; column <= side; ++column) {
            const double x = cell * column - 20.0, z = cell * row - 20.0;
            points.push_back({x, 0.3 * std::sin(x) * std::cos(0.7 * z), z});
        }
    const auto at = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * (side + 1) + column);
    };
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            for (const std::uint32_t place :
                 {at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1),
                  at(row, column + 1), at(row + 1, column)})
                triangles.push_back(place);
    return *Ground::mesh(points, triangles);
}

enum class Motion { Stand, Walk, Hostile };

class Crowd {
  public:
    Crowd(Ground ground, Motion motion)
        : ground_(std::move(ground)),
          skeleton_(make_figure({})),
          feet_(*Feet::make(skeleton_, match_bones(skeleton_))),
          poses_(characters, rest_pose(skeleton_)),
          states_(characters) {
        const Clip walk = FigureWalk(skeleton_).clip();
        std::mt19937 random(5);
        std::normal_distribution<double> number;
        for (int frame = 0; frame < frames; ++frame) {
            clip_.push_back(rest_pose(skeleton_));
            if (motion == Motion::Walk) sample(walk, skeleton_, walk.duration * frame / frames, clip_.back());
            if (motion != Motion::Hostile) continue;
            for (tendril::rig::Transform& each : clip_.back())
                for (int i = 0; i < 4; ++i) each.rotation[i] = number(random);
            for (tendril::rig::Transform& each : clip_.back())
                each.rotation = tendril::rig::normalised(each.rotation);
        }
        for (std::size_t i = 0; i < characters; ++i) {
            jobs_.push_back({.feet = &feet_, .pose = poses_[i], .state = &states_[i]});
            jobs_.back().options.root.translation = {0.01 * static_cast<double>(i), 0.0,
                                                     0.01 * static_cast<double>(i)};
        }
    }
    /// Sets the poses of the clips, each character's at another frame.
    void prepare() {
        ++frame_;
        for (std::size_t i = 0; i < characters; ++i)
            poses_[i] = clip_[(static_cast<std::size_t>(frame_) + 7 * i) % frames];
    }
    void step() { step_many(jobs_, ground_, 1.0 / 60, {.threads = 1}); }

  private:
    Ground ground_;
    Skeleton skeleton_;
    Feet feet_;
    std::vector<std::vector<tendril::rig::Transform>> poses_, clip_;
    std::vector<FeetState> states_;
    std::vector<FeetJob> jobs_;
    int frame_ = 0;
};

/// Milliseconds for all characters.
double milliseconds(Crowd& crowd) {
    return race({[&] { crowd.step(); }}, 3 * frames, cpu_seconds, [&] { crowd.prepare(); })[0] * 1e3;
}

}  // namespace

int main(int count, char** arguments) {
    struct Row {
        const char* title;
        Ground ground;
        Motion motion;
    };
    const Row rows[]{{"standing, flat", *Ground::flat(), Motion::Stand},
                     {"walking, flat", *Ground::flat(), Motion::Walk},
                     {"walking, slope", *Ground::slope(0.35), Motion::Walk},
                     {"walking, stairs", *Ground::stairs(0.15, 0.3), Motion::Walk},
                     {"walking, mesh of 2 000 triangles", hills(32), Motion::Walk},
                     {"walking, mesh of 200 000 triangles", hills(316), Motion::Walk},
                     {"hostile, stairs", *Ground::stairs(0.15, 0.3), Motion::Hostile}};
    std::printf("%-36s%16s\n", "1 000 characters", "us a character");
    double worst = 0.0, flat = 0.0, mesh = 0.0;
    for (const Row& row : rows) {
        Crowd crowd(row.ground, row.motion);
        const double one = milliseconds(crowd);
        std::printf("%-36s%16.2f\n", row.title, one);
        worst = std::max(worst, one);
        if (std::string(row.title) == "walking, flat") flat = one;
        if (std::string(row.title) == "walking, mesh of 200 000 triangles") mesh = one;
    }
    bool all = claim_loops("the feet of a character, worst row", 1e-6 * worst, 26);
    all &= claim("three times flat ground over a large mesh", 3.0 * flat / mesh, 1.0);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
