// Cost of whole-body reaching per frame, by bones, limits and the motion of its five targets.
//
// Claims, for the worst row with reachable targets:
//  - a frame takes at most 40 loops (measure.hpp) without limits, 55 within them, and 72 with self-collision
//    of the body's capsules as well.
//
// Targets that jump anywhere in every frame, most of them out of reach, have a separate row and claim: at
// most 210 loops per frame.
//
// Balance: a hand that is dragged far ahead, alternately with and without balance. A frame with balance costs
// under three times as much: the hand stays out of reach, and most frames run to the end of their iterations.
//
// A wheel in both hands (hold.hpp), alternately with its grips as plain targets: moved about within reach it
// costs under 4 times as much, and under 6 times where it yields in every frame.
#include "../core/humanoid_figure.hpp"
#include "measure.hpp"
#include "tendril/humanoid/hold.hpp"

namespace {

using namespace tendril;
using namespace tendril::bench;
using namespace tendril::humanoid;

constexpr Effector five[]{Effector::LeftHand, Effector::RightHand, Effector::Head, Effector::LeftFoot,
                          Effector::RightFoot};

/// The fifteen bones that a body requires; all 22; those and 38 finger nodes, which rotate with the hands.
enum class Figure { Fifteen, All, Sixty };
constexpr const char* figure_names[]{"15 bones", "22 bones", "22 of 60 nodes"};

Skeleton make(Figure figure) {
    std::map<std::string, std::string> left_out;
    for (const char* bone :
         {"Chest", "UpperChest", "Neck", "LeftShoulder", "RightShoulder", "LeftToes", "RightToes", "Head end",
          "LeftHand end", "RightHand end", "LeftToes end", "RightToes end"})
        left_out[bone];
    if (figure == Figure::Fifteen) return test::make_figure(left_out);
    Skeleton all = test::make_figure({});
    if (figure == Figure::All) return all;
    std::vector<Node> nodes = all.nodes();
    for (int i = 0; nodes.size() < 60; ++i) {
        std::string name = "finger ";
        name += std::to_string(i);
        nodes.push_back({name,
                         static_cast<std::int32_t>(*all.find(i % 2 ? "LeftHand" : "RightHand")),
                         {.translation = {0.02, 0.0, 0.01 * i}}});
    }
    return *Skeleton::make(std::move(nodes));
}

/// Nothing, limits, or limits and self-collision.
enum class Held { Free, Limits, Apart };

/// The motion of the targets.
enum class Play { Still, Drag, Activated, Anywhere };
constexpr const char* play_names[]{"still", "drag, 5 mm a frame", "set at once", "anywhere"};

struct Subject {
    Skeleton skeleton;
    BoneMap map = match_bones(skeleton);
    Body body;
    std::vector<rig::Transform> rest = rest_pose(skeleton), pose = rest;
    std::vector<std::vector<BodyTarget>> frames;
    BodyState state;
    BodyOptions options{};

    Subject(Figure figure, Held held, Play play)
        : skeleton(make(figure)),
          body(*Body::make(
              skeleton, map, held == Held::Free ? no_limits() : default_limits(skeleton, map),
              held == Held::Apart ? default_capsules(skeleton, map) : std::vector<BodyCapsule>())) {
        std::mt19937 engine(1);
        std::uniform_real_distribution<double> any(-1.0, 1.0);
        std::vector<Placement> placements(skeleton.size());
        place(skeleton, rest, placements);
        const glm::dvec3 usual[]{
            {-0.35, -0.2, 0.35}, {0.3, -0.3, 0.3}, {0.0, -0.15, 0.1}, {0.05, 0.15, 0.1}, {-0.05, 0.05, -0.1}};
        for (int frame = 0; frame < 240; ++frame) {
            std::vector<BodyTarget> targets;
            for (std::size_t k = 0; k < 5; ++k) {
                const auto node = static_cast<std::size_t>(map[bone_of(five[k])].node);
                const double x = any(engine), y = any(engine), z = any(engine);
                glm::dvec3 off = usual[k];
                if (play == Play::Drag) off *= 0.5 - 0.5 * std::cos(2.0 * 3.14159265358979 * frame / 240.0);
                if (play == Play::Activated) off = usual[k] + 0.05 * glm::dvec3(x, y, z);
                if (play == Play::Anywhere) off = 1.5 * glm::dvec3(x, y, z);
                targets.push_back({five[k], placements[node].position + off});
            }
            frames.push_back(std::move(targets));
        }
    }
    void run(Play play) {
        for (const auto& targets : frames) {
            if (play == Play::Activated) state = {};
            pose = rest;
            require(body.solve(pose, targets, state, options).error());
        }
    }
};

double microseconds(Figure figure, Held held, Play play) {
    Subject subject(figure, held, play);
    subject.run(play);
    return race({[&] { subject.run(play); }}, 31)[0] * 1e6 / static_cast<double>(subject.frames.size());
}

/// A hand dragged 1 m ahead and back, which takes the centre of mass over the toes; without and with balance,
/// us a frame.
std::pair<double, double> balance_microseconds() {
    const auto subject = [] {
        auto made = std::make_unique<Subject>(Figure::All, Held::Limits, Play::Drag);
        for (std::size_t frame = 0; frame < made->frames.size(); ++frame) {
            const double turn = 2.0 * 3.14159265358979 * static_cast<double>(frame) / 240.0;
            const double part = 0.5 - 0.5 * std::cos(turn);
            made->frames[frame] = {{Effector::RightHand, {-0.72 + 0.5 * part, 1.45 - 0.4 * part, part}}};
        }
        return made;
    };
    const auto without = subject(), with = subject();
    with->options.balance = true;
    const std::vector<double> seconds =
        race({[&] { without->run(Play::Drag); }, [&] { with->run(Play::Drag); }}, 31);
    const auto frames = static_cast<double>(without->frames.size());
    return {seconds[0] * 1e6 / frames, seconds[1] * 1e6 / frames};
}

/// Microseconds per frame: the grips as targets, then held. The wheel goes round `centre`.
std::pair<double, double> hold_microseconds(const glm::dvec3& centre) {
    const humanoid::Skeleton skeleton = tendril::test::make_figure({});
    const humanoid::BoneMap map = humanoid::match_bones(skeleton);
    humanoid::Body body =
        humanoid::Body::make(skeleton, map, humanoid::default_limits(skeleton, map)).value();
    const glm::dvec3 forward(0, 0, 1), up(0, 1, 0);
    const std::vector<humanoid::Grip> grips{
        *grip_of(body, {humanoid::Effector::LeftHand, {0.19, 0, 0}, forward, {-1, 0, 0}, up}, 0.08),
        *grip_of(body, {humanoid::Effector::RightHand, {-0.19, 0, 0}, forward, {1, 0, 0}, up}, 0.08)};
    const std::vector<rig::Transform> rest = humanoid::rest_pose(skeleton);
    std::vector<rig::Transform> pose = rest;
    humanoid::BodyState plain_state, held_state;
    humanoid::HoldState state;
    constexpr int frames = 200;
    const auto asked = [&](int frame) {
        const double angle = 0.05 * frame;
        return humanoid::ObjectPose{centre + 0.05 * glm::dvec3(std::sin(angle), std::cos(angle), 0.0),
                                    glm::angleAxis(0.5 * std::sin(angle), forward)};
    };
    const auto plain = [&] {
        for (int i = 0; i < frames; ++i) {
            const humanoid::ObjectPose wheel = asked(i);
            std::array<humanoid::BodyTarget, 2> targets;
            for (std::size_t k = 0; k < 2; ++k)
                targets[k] = {grips[k].hand, wheel.position + wheel.rotation * grips[k].position,
                              wheel.rotation * *grips[k].rotation};
            pose = rest;
            static_cast<void>(body.solve(pose, targets, plain_state));
        }
    };
    const auto held = [&] {
        for (int i = 0; i < frames; ++i) {
            pose = rest;
            static_cast<void>(humanoid::hold(body, pose, {}, {grips, asked(i)}, held_state, state));
        }
    };
    const std::vector<double> seconds = tendril::bench::race({plain, held}, 15);
    return {seconds[0] * 1e6 / frames, seconds[1] * 1e6 / frames};
}

}  // namespace

int main(int count, char** arguments) {
    double worst[3]{}, anywhere = 0.0;
    std::printf("us a frame%36s%12s%16s\n", "free", "limits", "and capsules");
    for (const Figure figure : {Figure::Fifteen, Figure::All, Figure::Sixty})
        for (const Play play : {Play::Still, Play::Drag, Play::Activated, Play::Anywhere}) {
            std::printf("%-16s%-20s", figure_names[static_cast<int>(figure)],
                        play_names[static_cast<int>(play)]);
            for (const Held held : {Held::Free, Held::Limits, Held::Apart}) {
                const double frame = microseconds(figure, held, play);
                std::printf(held == Held::Apart ? "%16.1f" : held == Held::Free ? "%10.1f" : "%12.1f", frame);
                double& most = play == Play::Anywhere ? anywhere : worst[static_cast<int>(held)];
                most = std::max(most, frame);
            }
            std::printf("\n");
        }
    const auto [plain, balanced] = balance_microseconds();
    std::printf("%-16s%-20s%10.1f without, %.1f with balance\n", "22 bones", "a hand far ahead", plain,
                balanced);
    bool all = claim_loops("a frame without limits", 1e-6 * worst[0], 40);
    all &= claim_loops("a frame within limits", 1e-6 * worst[1], 55);
    all &= claim_loops("a frame within limits, kept apart", 1e-6 * worst[2], 72);
    all &= claim_loops("a frame with targets anywhere", 1e-6 * anywhere, 210);
    all &= claim("balance costs under 3 times a frame without", 3.0 * plain / balanced, 1.0);
    const auto near = hold_microseconds({0.0, 1.2, 0.4}), far = hold_microseconds({0.3, 1.2, 1.5});
    std::printf("%-16s%-20s%10.1f as targets, %.1f held\n", "wheel", "within reach", near.first, near.second);
    std::printf("%-16s%-20s%10.1f as targets, %.1f held\n", "wheel", "gives way", far.first, far.second);
    all &= claim("a wheel within reach costs under 4 times its targets", 4.0 * near.first / near.second, 1.0);
    all &= claim("one that gives way costs under 6 times its targets", 6.0 * far.first / far.second, 1.0);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
