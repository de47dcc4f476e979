#include "app/labs/humanoid/clip/playback.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/gtc/quaternion.hpp>

namespace tendril::app {
namespace {

/// A point on the ground, and an angle about the vertical, as complex numbers: z + i x, so that an angle runs
/// from +Z to +X.
using Complex = std::complex<double>;

struct OnGround {
    Complex at{0.0, 0.0};
    double angle = 0.0;
};

std::vector<rig::Transform> sampled(const humanoid::Clip& clip, const humanoid::Skeleton& skeleton,
                                    double time) {
    std::vector<rig::Transform> pose(skeleton.size());
    humanoid::sample(clip, skeleton, time, pose);
    return pose;
}

OnGround hips_at(const humanoid::Skeleton& skeleton, const std::vector<rig::Transform>& pose,
                 std::size_t hips) {
    std::vector<humanoid::Placement> placed(skeleton.size());
    humanoid::place(skeleton, pose, placed);
    const glm::dquat rotation = placed[hips].rotation();
    return {{placed[hips].position.z, placed[hips].position.x}, 2.0 * std::atan2(rotation.y, rotation.w)};
}

/// What takes the character from the first round to this one: z -> turn * z + move.
struct RoundTurn {
    Complex turn{1.0, 0.0}, move{0.0, 0.0};
};

RoundTurn of_rounds(const OnGround& first, const OnGround& last, double rounds) {
    const double angle = std::remainder(last.angle - first.angle, 2.0 * 3.14159265358979323846);
    const Complex once = std::polar(1.0, angle), move = last.at - once * first.at;
    if (std::abs(angle) < 1e-9) return {Complex(1.0, 0.0), rounds * move};
    const Complex all = std::polar(1.0, angle * rounds);
    return {all, move * (all - 1.0) / (once - 1.0)};
}

rig::Transform transform(const RoundTurn& ground) {
    const double half = 0.5 * std::arg(ground.turn);
    return {.translation = {ground.move.imag(), 0.0, ground.move.real()},
            .rotation = {std::cos(half), 0.0, std::sin(half), 0.0}};
}

double duration_of(const Playback& playback, const LoadedCharacter& character) {
    return playback.clip ? character.clips()[*playback.clip].duration : 0.0;
}

}  // namespace

bool goes_on(const Playback& playback, const LoadedCharacter& character) {
    return playback.playing && playback.speed > 0.0 && duration_of(playback, character) > 0.0;
}

void advance(Playback& playback, const LoadedCharacter& character, double seconds) {
    if (!goes_on(playback, character)) return;
    const double duration = duration_of(playback, character);
    playback.time += playback.speed * seconds;
    if (playback.time <= duration) return;
    if (!playback.loop) {
        playback.time = duration;
        playback.playing = false;
        return;
    }
    const double whole = std::ceil(playback.time / duration) - 1.0;
    playback.time = std::clamp(playback.time - whole * duration, 0.0, duration);
    playback.rounds = std::min(playback.rounds + static_cast<std::int64_t>(std::min(whole, 1e6)), max_rounds);
}

void go_to(Playback& playback, const LoadedCharacter& character, double seconds) {
    const double duration = duration_of(playback, character);
    playback.rounds = 0;
    playback.time = std::clamp(seconds, 0.0, duration);
    if (!playback.loop || !(seconds > duration) || !(duration > 0.0)) return;
    const double whole = std::min(std::ceil(seconds / duration) - 1.0, static_cast<double>(max_rounds));
    playback.rounds = static_cast<std::int64_t>(whole);
    playback.time = std::clamp(seconds - whole * duration, 0.0, duration);
}

std::vector<rig::Transform> animated_pose(const Playback& playback, const LoadedCharacter& character,
                                          std::optional<std::size_t> hips) {
    const humanoid::Skeleton& skeleton = character.skeleton();
    if (!playback.clip) return humanoid::rest_pose(skeleton);
    const humanoid::Clip& clip = character.clips()[*playback.clip];
    std::vector<rig::Transform> pose = sampled(clip, skeleton, playback.time);
    if (!hips || (playback.rounds == 0 && !playback.in_place)) return pose;
    const OnGround first = hips_at(skeleton, sampled(clip, skeleton, 0.0), *hips);
    RoundTurn ground;
    if (playback.in_place)
        ground.move = first.at - hips_at(skeleton, pose, *hips).at;
    else
        ground = of_rounds(first, hips_at(skeleton, sampled(clip, skeleton, clip.duration), *hips),
                           static_cast<double>(playback.rounds));
    for (std::size_t i = 0; i < pose.size(); ++i)
        if (skeleton[i].parent < 0) pose[i] = rig::compose(transform(ground), pose[i]);
    return pose;
}

glm::dvec3 missing_velocity(const Playback& playback, const LoadedCharacter& character,
                            std::optional<std::size_t> hips) {
    if (!playback.clip || !playback.in_place || !hips) return glm::dvec3(0.0);
    const humanoid::Clip& clip = character.clips()[*playback.clip];
    const double from = std::max(0.0, playback.time - 1.0 / 120.0),
                 to = std::min(clip.duration, playback.time + 1.0 / 120.0);
    if (!(to > from)) return glm::dvec3(0.0);
    const humanoid::Skeleton& skeleton = character.skeleton();
    const auto at = [&](double time) { return hips_at(skeleton, sampled(clip, skeleton, time), *hips).at; };
    const Complex velocity = playback.speed * (at(to) - at(from)) / (to - from);
    return {velocity.imag(), 0.0, velocity.real()};
}

}  // namespace tendril::app
