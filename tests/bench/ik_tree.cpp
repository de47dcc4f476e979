// Trees of chains: cost of an iteration per joint, by the number of joints and effectors, beside a single
// chain's solver. The tolerance is 0, so that the Newton step always runs.
//
// Claims, for the worst size: an iteration is O(joints), however many effectors there are; the two passes
// alone cost at most 1.6 times those of a chain's solver; an iteration with the Newton step at most 2.5 times
// as much. Times are medians; only ratios within one run are meaningful.
#include "../core/kept_solver.hpp"
#include "measure.hpp"
#include "tendril/ik/tree.hpp"

namespace {

using namespace tendril::bench;
using tendril::ik::Effector;
using tendril::ik::Tree;
using tendril::ik::TreeJoint;

constexpr int iterations = 20, repetitions = 15;
constexpr std::size_t sizes[] = {10, 30, 100, 300, 1'000, 3'000};
using Places = std::vector<glm::vec3>;

/// A gentle curve, so that nothing is straight and nothing coincides.
Places bow(const std::vector<TreeJoint>& joints) {
    Places places(joints.size(), glm::vec3(0.0f));
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const float angle = 0.7f * static_cast<float>(k);
        const glm::vec3 way(std::cos(angle), std::sin(angle), 0.3f);
        places[k] = places[joints[k].parent] + way * (joints[k].length / std::sqrt(1.09f));
    }
    return places;
}

glm::vec3 target(std::size_t turn) {
    const float angle = 0.1f * static_cast<float>(turn % 64);
    return {0.6f * std::cos(angle), 0.6f * std::sin(angle), 0.2f};
}

std::vector<TreeJoint> chain(std::size_t bones) {
    std::vector<TreeJoint> joints{{}};
    for (std::size_t k = 0; k < bones; ++k) joints.push_back({k, 1.0f / static_cast<float>(bones)});
    return joints;
}

/// Effectors at the tips of branches that share a trunk of 20 bones; about 6 times as many bones in all,
/// whatever the number of tips.
struct Figure {
    std::vector<TreeJoint> joints = chain(20);
    std::vector<Effector> effectors;

    explicit Figure(std::size_t tips) {
        for (std::size_t tip = 0; tip < tips; ++tip) {
            std::size_t parent = 20;
            for (std::size_t k = 0; k < 100 / tips; ++k) {
                joints.push_back({parent, 0.05f});
                parent = joints.size() - 1;
            }
            effectors.push_back({parent});
        }
    }
};

/// Enough solves for 20 000 bones.
std::size_t solves_for(std::size_t bones) {
    return std::max<std::size_t>(1, 20'000 / bones);
}

/// Solves for a target that circles.
class ChainRun {
  public:
    explicit ChainRun(std::size_t bones)
        : places_(bow(chain(bones))), solver_(std::vector<float>(bones, 1.0f / static_cast<float>(bones))) {}
    void operator()() {
        for (std::size_t i = solves_for(solver_.bones()); i > 0; --i)
            solver_.solve(tendril::ik::Method::FabrikPlain, places_, target(turn_++),
                          {.max_iterations = iterations, .every_iteration = true});
    }

  private:
    Places places_;
    tendril::test::KeptSolver solver_;
    std::size_t turn_ = 0;
};

class TreeRun {
  public:
    TreeRun(const std::vector<TreeJoint>& joints, std::vector<Effector> effectors, bool plain)
        : tree_(Tree::make(joints).value()),
          effectors_(std::move(effectors)),
          places_(bow(joints)),
          goals_(places_),
          plain_(plain) {}
    void operator()() {
        for (std::size_t i = solves_for(places_.size() - 1); i > 0; --i) {
            const glm::vec3 by = target(turn_++);
            for (Effector& effector : effectors_) effector.target = goals_[effector.joint] * 0.7f + by * 0.1f;
            tree_.solve(
                places_, effectors_,
                {.tolerance = 0.0f, .max_iterations = iterations, .every_iteration = true, .plain = plain_});
        }
    }

  private:
    Tree tree_;
    std::vector<Effector> effectors_;
    Places places_;
    Places goals_;
    bool plain_;
    std::size_t turn_ = 0;
};

/// Nanoseconds per bone and iteration.
double each(double seconds, std::size_t bones) {
    return seconds * 1e9 / static_cast<double>(solves_for(bones) * bones * iterations);
}

struct Worst {
    double plain = 0.0;   ///< passes of the tree over those of the chain solver
    double newton = 0.0;  ///< with the Newton step over passes alone
    double growth = 0.0;  ///< ns per bone over those of the smallest size
};

Worst chain_table() {
    Worst worst;
    std::printf("One chain, ns a bone and iteration\n%8s %16s %16s %16s\n", "bones", "chain's solver",
                "tree, plain", "with Newton");
    double first[2] = {};
    for (const std::size_t bones : sizes) {
        ChainRun alone(bones);
        const std::vector<Effector> tip{{bones}};
        TreeRun plain(chain(bones), tip, true), newton(chain(bones), tip, false);
        const std::vector<double> seconds =
            race({[&] { alone(); }, [&] { plain(); }, [&] { newton(); }}, repetitions);
        std::printf("%8zu %16.1f %16.1f %16.1f\n", bones, each(seconds[0], bones), each(seconds[1], bones),
                    each(seconds[2], bones));
        worst.plain = std::max(worst.plain, seconds[1] / seconds[0]);
        worst.newton = std::max(worst.newton, seconds[2] / seconds[1]);
        for (std::size_t i = 0; i < 2; ++i) {
            const double here = each(seconds[i + 1], bones);
            if (bones == sizes[0]) first[i] = here;
            worst.growth = std::max(worst.growth, here / first[i]);
        }
    }
    return worst;
}

/// The cost of the most expensive number of effectors over that of one.
double branches_table() {
    constexpr std::size_t counts[] = {1, 2, 5, 10, 20, 50};
    std::vector<TreeRun> runs;
    std::vector<std::size_t> bones;
    for (const std::size_t tips : counts) {
        const Figure figure(tips);
        runs.emplace_back(figure.joints, figure.effectors, false);
        bones.push_back(figure.joints.size() - 1);
    }
    std::vector<std::function<void()>> calls;
    for (TreeRun& run : runs) calls.emplace_back(std::ref(run));
    const std::vector<double> seconds = race(calls, repetitions);
    std::printf("\nBranches on a trunk, with Newton, ns a bone and iteration\n%8s %8s\n", "tips", "bones");
    double worst = 0.0;
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const double here = each(seconds[i], bones[i]);
        std::printf("%8zu %8zu %16.1f\n", counts[i], bones[i], here);
        worst = std::max(worst, here / each(seconds[0], bones[0]));
    }
    return worst;
}

}  // namespace

int main(int count, char** arguments) {
    const Worst worst = chain_table();
    const double crowded = branches_table();
    std::printf("\n");
    bool all = claim("1.6 times a chain solver's passes, over a tree's", 1.6 / worst.plain, 1.0);
    all &= claim("2.5 times the passes, over an iteration with the Newton step", 2.5 / worst.newton, 1.0);
    all &= claim("2.5 times a bone of the smallest chain, over one of any other", 2.5 / worst.growth, 1.0);
    all &= claim("1.5 times one effector's time, over that of any number", 1.5 / crowded, 1.0);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
