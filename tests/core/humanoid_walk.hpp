// A walk for the figure of humanoid_figure.hpp: 1 m/s towards +Z, with stance feet on the floor to within a
// micrometre.
#pragma once

#include <tendril/humanoid/clip.hpp>

#include "humanoid_figure.hpp"

namespace tendril::test {

class FigureWalk {
  public:
    static constexpr double period = 1.1, speed = 1.0, rate = 240.0;

    explicit FigureWalk(const Skeleton& skeleton, int rounds = 1) : skeleton_(skeleton) {
        clip_.name = "walk";
        clip_.duration = rounds * period;
        const int frames = static_cast<int>(std::lround(period * rate));
        for (const char* name : {"Hips", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToes",
                                 "RightUpperLeg", "RightLowerLeg", "RightFoot", "RightToes"})
            clip_.channels.push_back({.node = *skeleton.find(name)});
        for (int i = 0; i <= rounds * frames; ++i) add(static_cast<double>(i) / frames);
    }
    Clip clip() const { return clip_; }

  private:
    struct Foot {
        glm::dvec3 ankle;
        double pitch, bend;  // positive raises the toes; toes relative to the foot; radians
    };
    static glm::dquat about_x(double angle) { return glm::angleAxis(angle, glm::dvec3(1, 0, 0)); }
    static double smooth(double u) { return u * u * (3.0 - 2.0 * u); }

    /// The foot's pose after heel strike, with the hips then at z = 0.
    static Foot standing(double phase) {
        const glm::dvec3 ankle(0, 0.09, 0), heel(0, 0, -0.05), ball(0, 0.02, 0.15);
        const auto turned = [&](const glm::dvec3& about, double pitch) {
            return about + about_x(-pitch) * (ankle - about);
        };
        if (phase < 0.1) {
            const double pitch = 0.28 * (1.0 - smooth(phase / 0.1));
            return {turned(heel, pitch), pitch, 0.0};
        }
        const double u = std::max(phase - 0.36, 0.0) / 0.26, pitch = -0.8 * u * u;
        return {turned(ball, pitch), pitch, -pitch};
    }
    static Foot foot_at(double phase) {
        constexpr double off = 0.62, ahead = 0.26;
        Foot foot = standing(std::min(phase, off));
        if (phase > off) {
            const Foot before = standing(off - 1e-4), landing = standing(0.0), next = standing(1e-4);
            const double span = 1.0 - off, u = (phase - off) / span, u2 = u * u, u3 = u2 * u;
            const glm::dvec3 leave = (foot.ankle - before.ankle) / 1e-4 * span,
                             land = (next.ankle - landing.ankle) / 1e-4 * span,
                             end = landing.ankle + glm::dvec3(0, 0, period * speed);
            const Foot left = foot;
            foot.ankle = (2 * u3 - 3 * u2 + 1) * left.ankle + (u3 - 2 * u2 + u) * leave +
                         (3 * u2 - 2 * u3) * end + (u3 - u2) * land;
            foot.pitch = left.pitch + (landing.pitch - left.pitch) * smooth(u);
            foot.bend = left.bend * (1.0 - smooth(std::min(u / 0.35, 1.0)));
        }
        foot.ankle.z += ahead;
        return foot;
    }

    void add(double phase) {
        const double turn = 2.0 * std::acos(-1.0) * phase;
        const glm::dvec3 hips(0.018 * std::sin(turn), 0.938 - 0.012 * std::cos(2.0 * turn),
                              speed * period * phase);
        const double time = std::min(phase * period, clip_.duration);
        Channel& root = clip_.channels[0];
        root.translation.times.push_back(time);
        root.translation.values.push_back(hips);
        add_leg(1, time, phase, 0.1, hips, 0.0);
        add_leg(5, time, phase, -0.1, hips, 0.5);
    }
    void add_leg(std::size_t first, double time, double phase, double x, const glm::dvec3& hips,
                 double late) {
        const double step = std::floor(phase - late);
        const Foot foot = foot_at(phase - late - step);
        const glm::dvec3 ankle = foot.ankle + glm::dvec3(x, 0, (step + late) * period * speed);
        const glm::dvec3 hip = hips + bone(first), thigh = bone(first + 1), shin = bone(first + 2);
        const double a = glm::length(thigh), b = glm::length(shin), d = glm::distance(ankle, hip);
        const glm::dvec3 along = (ankle - hip) / d;
        const glm::dvec3 aside = glm::normalize(glm::dvec3(0, 0, 1) - along * along.z);
        const double far = (d * d + a * a - b * b) / (2.0 * d);
        const glm::dvec3 knee = hip + along * far + aside * std::sqrt(a * a - far * far);
        const glm::dquat upper = between(thigh, knee - hip), lower = between(shin, ankle - knee);
        const glm::dquat turns[]{upper, glm::inverse(upper) * lower,
                                 glm::inverse(lower) * about_x(-foot.pitch), about_x(-foot.bend)};
        for (std::size_t i = 0; i < 4; ++i) {
            Track<glm::dquat>& track = clip_.channels[first + i].rotation;
            track.times.push_back(time);
            track.values.push_back(turns[i]);
        }
    }
    glm::dvec3 bone(std::size_t channel) const {
        return skeleton_[clip_.channels[channel].node].rest.translation;
    }
    static glm::dquat between(const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 a = glm::normalize(from), b = glm::normalize(to);
        return glm::normalize(glm::dquat(1.0 + glm::dot(a, b), glm::cross(a, b)));
    }

    const Skeleton& skeleton_;
    Clip clip_;
};

}  // namespace tendril::test
