// Cost of hand IK and look-at per character and frame.
//
// Claim: both hands and the gaze of a character take at most 10 loops (measure.hpp) per frame.
#include "../core/humanoid_figure.hpp"
#include "measure.hpp"
#include "tendril/humanoid/hands.hpp"
#include "tendril/humanoid/look_at.hpp"

namespace {

using namespace tendril::bench;
using namespace tendril::humanoid;

constexpr int characters = 1000;

struct Figure {
    Skeleton skeleton = tendril::test::make_figure({});
    BoneMap map = match_bones(skeleton);
    Hands hands = Hands::make(skeleton, map).value();
    LookAt look_at = LookAt::make(skeleton, map).value();
    std::vector<tendril::rig::Transform> rest = rest_pose(skeleton), pose = rest;
    HandsState hands_state;
    LookAtState look_state;
    double time = 0.0;

    void reach(std::size_t count, double weight) {
        for (int i = 0; i < characters; ++i) {
            time += 1e-4;
            pose = rest;
            HandTargets targets;
            for (std::size_t hand = 0; hand < count; ++hand)
                targets[hand] = {.position = {hand == 0 ? 0.3 : -0.3, 1.2 + 0.1 * time, 0.3},
                                 .rotation = glm::dquat(1.0, 0.0, 0.0, 0.0),
                                 .weight = weight};
            hands.step(pose, targets, 1.0 / 60, hands_state);
        }
    }
    void look() {
        for (int i = 0; i < characters; ++i) {
            time += 1e-4;
            pose = rest;
            look_at.step(pose, {.target = {1.0, 1.5 + 0.1 * time, 2.0}}, 1.0 / 60, look_state);
        }
    }
};

}  // namespace

int main(int count, char** arguments) {
    Figure figure;
    const std::vector<double> seconds = race({[&] { figure.reach(2, 0.0); }, [&] { figure.reach(1, 0.7); },
                                              [&] { figure.reach(2, 0.7); }, [&] { figure.look(); }},
                                             31);
    const char* const titles[]{"hands at weight 0", "one hand", "both hands", "gaze"};
    std::printf("%-24s%16s\n", "", "us a character");
    for (std::size_t i = 0; i < seconds.size(); ++i)
        std::printf("%-24s%16.2f\n", titles[i], seconds[i] * 1e6 / characters);
    const bool all =
        claim_loops("the hands and gaze of a character", (seconds[2] + seconds[3]) / characters, 10);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
