#include "app/io/trace/trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <stdexcept>
#include <tendril/ik/incident.hpp>
#include <utility>

#include "app/io/solver_text.hpp"
#include "app/io/text.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

/// Any direction perpendicular to this one.
glm::vec3 across(glm::vec3 way) {
    const glm::vec3 other =
        std::abs(way.x) < 0.9f * glm::length(way) ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(glm::cross(way, other));
}

/// +X if the points coincide.
glm::vec3 direction(glm::vec3 from, glm::vec3 to) {
    const float length = glm::distance(from, to);
    return length > 0.0f ? (to - from) / length : glm::vec3(1, 0, 0);
}

}  // namespace

bool is_finite_point(glm::vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool TracedFrame::finite() const {
    return std::ranges::all_of(joints, is_finite_point) && (!target || is_finite_point(*target)) &&
           (!pole || is_finite_point(*pole));
}

std::optional<glm::vec3> TraceSolve::pole(const TracedFrame& frame) const {
    if (frame.pole) return *frame.pole + pole_by;
    if (pole_by == glm::vec3(0.0f)) return std::nullopt;
    return frame.joints.front() + pole_by;
}

std::vector<ik::Limit> TraceSolve::limits(std::span<const glm::vec3> joints) const {
    if (hinge == 0) return {};
    const auto joint = static_cast<std::size_t>(hinge);
    if (joint + 1 >= joints.size()) throw std::invalid_argument("a hinge must be between root and tip");
    // Angles count from the first frame's pose, where the joint is already bent by `bend`.
    const glm::vec3 above = direction(joints[joint - 1], joints[joint]),
                    below = direction(joints[joint], joints[joint + 1]), axis = glm::cross(above, below);
    const float bend = ik::angle_between(above, below);
    std::vector<ik::Limit> limits(joints.size() - 1);
    limits[joint] = ik::Limit::hinge(glm::length(axis) > 1e-4f ? glm::normalize(axis) : across(below), -bend,
                                     glm::pi<float>() - bend);
    return limits;
}

void Retrace::begin(const TracedFrame& frame) {
    joints_ = frame.joints;
    std::vector<float> lengths;
    std::vector<glm::vec3> rest;
    for (std::size_t i = 1; i <= frame.end_effector(); ++i) {
        lengths.push_back(glm::distance(joints_[i - 1], joints_[i]));
        rest.push_back(direction(joints_[i - 1], joints_[i]));
    }
    auto made = ik::Solver::make(lengths, rest);
    if (!made) throw std::invalid_argument(made.message());
    if (const Result taken = ik::check_takes(how_.method, lengths.size()); !taken)
        throw std::invalid_argument(taken.message());
    solver_.emplace(std::move(made).value());
    state_ = solver_->initial_state();
    limits_ = how_.limits(std::span(joints_).first(lengths.size() + 1));
}

const std::vector<glm::vec3>& Retrace::follow(const TracedFrame& frame) {
    if (!frame.finite()) {
        if (joints_.empty()) return frame.joints;
        return joints_;
    }
    if (!solver_) begin(frame);
    const glm::vec3 by = frame.joints.front() - joints_.front();
    for (glm::vec3& joint : joints_) joint += by;
    ik::Options options = how_.options(frame);
    options.limits = limits_;
    const std::size_t end = frame.end_effector();
    const glm::vec3 was = joints_[end];
    solver_->solve(how_.method, std::span(joints_).first(end + 1), state_, frame.goal(), options);
    for (std::size_t i = end + 1; i < joints_.size(); ++i) joints_[i] += joints_[end] - was;
    return joints_;
}

namespace {

/// The result of solving the frames around a flip.
struct Attempt {
    bool flips = false, flips_there = false;  ///< in any frame; in the frame where the engine's chain flips
    bool reaches = false;                     ///< gets as close as the engine in every frame

    bool prevents() const { return reaches && !flips; }
};

class Attempts {
  public:
    Attempts(std::span<const TracedFrame> frames, std::size_t at) : frames_(frames), at_(at), allowed_(0.0f) {
        const TracedFrame& first = frames.front();
        for (std::size_t i = 1; i <= first.end_effector(); ++i)
            reach_ += glm::distance(first.joints[i - 1], first.joints[i]);
        for (const TracedFrame& frame : frames)
            if (frame.finite()) allowed_ = std::max(allowed_, shortfall(frame, frame.joints));
        allowed_ += 0.02f * reach_;
    }

    float reach() const { return reach_; }
    /// How far a direction stays from the target's line, both ways: 0 in line with it in some frame, 1 square
    /// to it in all.
    float aside(glm::vec3 way) const {
        float smallest = 1.0f;
        for (const TracedFrame& frame : frames_)
            if (const glm::vec3 line = frame.goal() - frame.joints.front(); frame.finite())
                smallest = std::min(smallest, 1.0f - std::abs(glm::dot(direction({}, line), way)));
        return smallest;
    }
    bool prevents(const TraceSolve& how) const { return run(how).prevents(); }
    Attempt run(const TraceSolve& how) const {
        Retrace chain(how);
        ik::IncidentFinder finder({.end_effector = frames_.front().end});
        Attempt came{.reaches = true};
        try {
            for (const TracedFrame& frame : frames_) {
                const std::vector<glm::vec3>& joints = chain.follow(frame);
                finder.add({.joints = joints, .target = frame.goal(), .pole = how.pole(frame)});
                if (frame.finite()) came.reaches = came.reaches && shortfall(frame, joints) <= allowed_;
            }
        } catch (const std::invalid_argument&) {
            return {};
        }
        for (const ik::ChainIncident& each : finder.incidents()) {
            if (each.kind != ik::IncidentKind::Flip) continue;
            came.flips = true;
            came.flips_there = came.flips_there || (each.frame + 3 > at_ && each.frame < at_ + 4);
        }
        return came;
    }

  private:
    float shortfall(const TracedFrame& frame, const std::vector<glm::vec3>& joints) const {
        const float beyond = glm::distance(frame.goal(), joints.front()) - reach_;
        return glm::distance(frame.goal(), joints[frame.end_effector()]) - std::max(0.0f, beyond);
    }

    std::span<const TracedFrame> frames_;
    std::size_t at_;
    float reach_ = 0.0f, allowed_;
};

/// A position for the pole target that prevents the flip, in the first of eight directions that works.
std::optional<Prevention> try_poles(const Attempts& attempts, const TracedFrame& at, const TraceSolve& base) {
    constexpr std::array shares{0.02f, 0.05f, 0.1f, 0.2f, 0.4f, 0.8f};
    constexpr int ways = 8, halvings = 4;
    const glm::vec3 root = at.joints.front(), line = at.goal() - root;
    if (!(glm::length(line) > 1e-6f * attempts.reach())) return std::nullopt;
    const glm::vec3 u = across(line), v = glm::normalize(glm::cross(line, u));
    const auto with = [&](glm::vec3 by) {
        TraceSolve how = base;
        how.pole_by = by;
        return how;
    };
    const auto found = [&](glm::vec3 by) {
        const TraceSolve how = with(by);
        return Prevention{Prevention::Kind::Pole, how, how.pole(at), !at.pole};
    };
    std::array<glm::vec3, ways> sides;
    for (int i = 0; i < ways; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / ways;
        sides[static_cast<std::size_t>(i)] = math::cosine(angle) * u + math::sine(angle) * v;
    }
    if (!at.pole) {  // half the reach from the middle of the target's line, square to where that goes
        std::ranges::stable_sort(sides, std::greater(), [&](glm::vec3 way) { return attempts.aside(way); });
        for (const glm::vec3 way : sides)
            if (const glm::vec3 by = 0.5f * (line + attempts.reach() * way); attempts.prevents(with(by)))
                return found(by);
        return std::nullopt;
    }
    float below = 0.0f;
    for (const float share : shares) {
        for (const glm::vec3 way : sides) {
            if (!attempts.prevents(with(share * attempts.reach() * way))) continue;
            float low = below, high = share;
            for (int half = 0; half < halvings; ++half) {
                const float middle = 0.5f * (low + high);
                (attempts.prevents(with(middle * attempts.reach() * way)) ? high : low) = middle;
            }
            return found(high * attempts.reach() * way);
        }
        below = share;
    }
    return std::nullopt;
}

std::optional<Prevention> try_soft_zones(const Attempts& attempts, const TraceSolve& base) {
    for (const float zone : {0.01f, 0.02f, 0.05f, 0.1f, 0.2f}) {
        TraceSolve how = base;
        how.soft_zone = zone;
        if (attempts.prevents(how)) return Prevention{Prevention::Kind::SoftZone, how};
    }
    return std::nullopt;
}

std::optional<Prevention> try_hinge(const Attempts& attempts, std::size_t joint, const TraceSolve& base) {
    TraceSolve how = base;
    how.hinge = static_cast<int>(joint);
    if (!attempts.prevents(how)) return std::nullopt;
    return Prevention{Prevention::Kind::Hinge, how};
}

}  // namespace

PreventedFlip prevent_flip(std::span<const TracedFrame> frames, std::size_t at, std::size_t joint,
                           ik::FlipCause cause) {
    PreventedFlip result;
    if (frames.front().joints.size() > max_tried_joints || !frames.front().finite() || !frames[at].finite())
        return result;
    result.tried = true;
    result.has_pole = frames[at].pole.has_value();
    const Attempts attempts(frames, at);
    using enum ik::Method;
    std::optional<ik::Method> stays;
    for (const ik::Method method : {TwoBone, Fabrik, Dls, SvdDls, Ccd, JacobianTranspose, FabrikPlain}) {
        const TraceSolve plain{.method = method};
        const Attempt came = attempts.run(plain);
        if (!result.flips_in && came.flips_there) result.flips_in = method;
        if (!stays && came.prevents()) stays = method;
        result.reaches = result.reaches || came.reaches;
    }
    const TraceSolve base{.method = result.flips_in.value_or(Fabrik)};
    const auto add = [&](std::optional<Prevention> tried) {
        if (tried) result.by.push_back(std::move(*tried));
    };
    if (result.flips_in || cause == ik::FlipCause::PassedAxis) add(try_poles(attempts, frames[at], base));
    if (result.flips_in) {
        add(try_soft_zones(attempts, base));
        add(try_hinge(attempts, joint, base));
    }
    if (stays) add(Prevention{Prevention::Kind::Method, {.method = *stays}});
    return result;
}

std::string Prevention::text(const Conventions& space) const {
    switch (kind) {
        case Kind::Method:
            return std::string("solver ") + solver_title(solve.method);
        case Kind::Pole:
            if (adds_pole) return "pole target at " + space.place(*pole);
            return "pole target moved by " + space.length(static_cast<double>(glm::length(solve.pole_by))) +
                   ", to " + space.place(*pole);
        case Kind::SoftZone:
            return "soft zone of " + fixed_text(static_cast<double>(solve.soft_zone), 2);
        case Kind::Hinge:
            break;
    }
    return "hinge at joint " + std::to_string(solve.hinge);
}

std::string PreventedFlip::text() const {
    if (!tried) return {};
    if (!flips_in)
        return std::string("no solver of Tendril flips on the same input") +
               (!reaches   ? ", but none reaches the target as well as yours"
                : has_pole ? ""
                           : "; if yours has a pole target, log it, too");
    return std::string("Tendril's ") + solver_title(*flips_in) + " flips on the same input, too" +
           (by.empty() ? "; no change of pole target, soft zone, limit or solver prevents it" : "");
}

}  // namespace tendril::app
