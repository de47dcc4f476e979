// Invented traces for tests: an arm of two bones, solved in closed form here, with one fault planted, written
// in the conventions and formats of engines.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace tendril::test::made {

struct MadeFrame {
    std::vector<glm::dvec3> joints;
    glm::dvec3 target{0.0};
    std::optional<glm::dvec3> pole;
};

struct MadeTrace {
    std::vector<MadeFrame> frames;  ///< metres, right-handed, Y up
    std::string kind;               ///< kind of the planted incident; empty: clean
    std::size_t frame = 0;
    int joint = -1;                         ///< -1: none
    std::string cause;                      ///< words of the cause
    std::string also;                       ///< words of another cause that is also correct
    double amount = 0.0, tolerance = -1.0;  ///< not compared while negative
    std::string limits;                     ///< JSON, for the first line
};

enum class Plant {
    None,
    FlipAtPole,
    FlipAtRoot,
    FlipWhenStraight,
    FlipAtJump,
    FlipForNothing,
    NanForNothing,
    NanAtRoot,
    NanBeyondReach,
    Length,
    Lag,
    Jitter,
    Missed,
    Repeated,
    Jump,
    Limit
};
inline constexpr int plants = static_cast<int>(Plant::Limit);  ///< without None

class TraceMaker {
  public:
    explicit TraceMaker(unsigned seed) : random_(seed) {}

    MadeTrace make(Plant plant) {
        upper_ = uniform(0.2, 0.4);
        lower_ = plant == Plant::FlipAtRoot ? upper_ : upper_ * uniform(0.8, 1.2);
        root_ = {uniform(-0.2, 0.2), uniform(1.2, 1.6), uniform(-0.2, 0.2)};
        MadeTrace trace;
        const double reach = upper_ + lower_;
        const glm::dvec3 axis = direction();
        const glm::dvec3 start = glm::normalize(glm::cross(axis, direction()));
        const double turned = uniform(0.5, 1.2), near = uniform(0.6, 0.7), far = uniform(0.75, 0.85);
        const std::size_t count = 120, at = 60;
        // The pole target is off the plane in which the target moves.
        glm::dvec3 pole = root_ + reach * (1.2 * axis + 0.3 * start);
        for (std::size_t i = 0; i < count; ++i) {
            const double t = static_cast<double>(i) / 119.0, smooth = t * t * (3.0 - 2.0 * t);
            const glm::dvec3 way = glm::angleAxis(turned * (smooth - 0.5), axis) * start;
            trace.frames.push_back(
                {{}, root_ + reach * glm::mix(near, far, 0.5 - 0.5 * std::cos(6.0 * t)) * way, pole});
        }
        plan(trace, plant, at, axis, start);
        for (MadeFrame& frame : trace.frames) frame.joints = solved(frame);
        spoil(trace, plant, at);
        return trace;
    }

    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 8) / 16777216.0;
    }
    unsigned below(unsigned count) { return static_cast<unsigned>(random_()) % count; }

  private:
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            const double length = glm::length(v);
            if (length > 0.1 && length < 1.0) return v / length;
        }
    }
    double reach() const { return upper_ + lower_; }

    /// Solves by the law of cosines, bent towards the pole target or, without one, upwards.
    std::vector<glm::dvec3> solved(const MadeFrame& frame) const {
        const glm::dvec3 way = frame.target - root_;
        const double far = glm::length(way),
                     d = std::clamp(far, std::abs(upper_ - lower_) + 1e-6, reach() * (1.0 - 1e-9));
        const glm::dvec3 line = far > 1e-9 ? way / far : glm::dvec3(1, 0, 0);
        const glm::dvec3 side = frame.pole ? *frame.pole - root_ : glm::dvec3(0.13, 1.0, 0.21);
        const glm::dvec3 off = side - line * glm::dot(side, line);
        const glm::dvec3 bend = off / std::max(glm::length(off), 1e-12);
        const double along = (d * d + upper_ * upper_ - lower_ * lower_) / (2.0 * d),
                     height = std::sqrt(std::max(0.0, upper_ * upper_ - along * along));
        return {root_, root_ + along * line + height * bend, root_ + d * line};
    }
    /// Mirrors the elbow to the other side of the line from root to tip.
    void mirror(MadeFrame& frame) const {
        const glm::dvec3 line = glm::normalize(frame.joints[2] - root_), elbow = frame.joints[1] - root_;
        frame.joints[1] = root_ + 2.0 * line * glm::dot(elbow, line) - elbow;
    }

    /// Changes the targets before the solve.
    void plan(MadeTrace& trace, Plant plant, std::size_t at, glm::dvec3 axis, glm::dvec3 start) {
        auto& frames = trace.frames;
        const glm::dvec3 across = glm::cross(axis, start);
        switch (plant) {
            case Plant::FlipAtPole:
                // The target's line sweeps over the pole target from one frame to the next.
                for (std::size_t i = 0; i < frames.size(); ++i) {
                    const double angle = 0.02 * (static_cast<double>(i) - static_cast<double>(at) + 0.5);
                    frames[i].target =
                        root_ + 0.8 * reach() * (std::cos(angle) * start + std::sin(angle) * across);
                    frames[i].pole = root_ + 1.3 * reach() * start + 1e-4 * reach() * axis;
                }
                trace = {std::move(frames), "flip", at, 1, "passed the pole", "close to the pole", 0, -1, ""};
                break;
            case Plant::FlipAtRoot:
                for (std::size_t i = 0; i < frames.size(); ++i) {
                    const double x = std::clamp(
                        0.04 * (static_cast<double>(at) - static_cast<double>(i) - 0.5), -0.8, 0.8);
                    frames[i].target = root_ + reach() * (x * start + 0.004 * across);
                    frames[i].pole.reset();
                }
                break;
            case Plant::FlipWhenStraight:
                for (std::size_t i = 0; i < frames.size(); ++i) {
                    const double t = std::abs(static_cast<double>(i) - static_cast<double>(at) + 5.0) / 60.0;
                    frames[i].target = root_ + reach() * (1.03 - 0.35 * t) * start;
                    frames[i].pole.reset();
                }
                break;
            case Plant::FlipAtJump:
            case Plant::Jump:
                for (std::size_t i = at; i < frames.size(); ++i)
                    frames[i].target = root_ + glm::angleAxis(0.75, axis) * (frames[i].target - root_);
                if (plant == Plant::Jump)
                    trace = {std::move(frames), "target_jump", at, -1, "changes abruptly", "", 0, -1, ""};
                break;
            case Plant::NanAtRoot:
                frames[at].target = root_;
                break;
            case Plant::NanBeyondReach:
                for (std::size_t i = at - 10; i < at + 10; ++i)
                    frames[i].target = root_ + 1.1 * glm::normalize(frames[i].target - root_) * reach();
                break;
            case Plant::Jitter:
            case Plant::Missed:
                for (std::size_t i = at; i < frames.size(); ++i) frames[i].target = frames[at - 1].target;
                break;
            default:
                break;
        }
    }

    /// Changes the poses after the solve.
    void spoil(MadeTrace& trace, Plant plant, std::size_t at) {
        auto& frames = trace.frames;
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        const auto planted = [&](const char* kind, int joint, const char* cause) {
            trace.kind = kind;
            trace.frame = at;
            trace.joint = joint;
            trace.cause = cause;
        };
        switch (plant) {
            case Plant::FlipAtRoot:
                for (std::size_t i = at; i < frames.size(); ++i) mirror(frames[i]);
                planted("flip", 1, "through the root");
                break;
            case Plant::FlipWhenStraight: {
                std::size_t bent = at - 5;
                while (height(frames[bent]) < 0.02 * reach()) ++bent;
                for (std::size_t i = at - 5; i < frames.size(); ++i) mirror(frames[i]);
                planted("flip", 1, "straight");
                trace.frame = bent;
                break;
            }
            case Plant::FlipAtJump:
                for (std::size_t i = at; i < frames.size(); ++i) mirror(frames[i]);
                planted("flip", 1, "jump");
                break;
            case Plant::FlipForNothing:
                for (std::size_t i = at; i < frames.size(); ++i) mirror(frames[i]);
                planted("flip", 1, "nothing in the input");
                break;
            case Plant::NanForNothing: {
                const unsigned joint = 1 + below(2);
                for (std::size_t i = at; i < frames.size(); ++i) frames[i].joints[joint] = glm::dvec3(nan);
                planted("nan", static_cast<int>(joint), "nothing in the input");
                break;
            }
            case Plant::NanAtRoot:
                frames[at].joints[1] = frames[at].joints[2] = glm::dvec3(nan);
                planted("nan", 1, "on the root");
                break;
            case Plant::NanBeyondReach:
                at -= 10;
                for (std::size_t i = at; i < at + 20; ++i) frames[i].joints[1].y = nan;
                planted("nan", 1, "out of reach");
                break;
            case Plant::Length: {
                const unsigned bone = 1 + below(2);
                const double by = uniform(0.01, 0.05);
                for (std::size_t i = at; i < frames.size(); ++i) {
                    const glm::dvec3 way = frames[i].joints[bone] - frames[i].joints[bone - 1];
                    for (std::size_t j = bone; j < 3; ++j) frames[i].joints[j] += by * way;
                }
                planted("length", static_cast<int>(bone), "");
                trace.amount = by * (bone == 1 ? upper_ : lower_);
                trace.tolerance = 0.15 * trace.amount + 2e-4;
                break;
            }
            case Plant::Lag: {
                const std::size_t by = 1 + below(3);
                const auto before = frames;
                for (std::size_t i = by; i < frames.size(); ++i) frames[i].joints = before[i - by].joints;
                planted("lag", 2, "frame");
                trace.amount = static_cast<double>(by);
                trace.tolerance = 0.0;
                break;
            }
            case Plant::Jitter: {
                const double hertz = uniform(4.0, 20.0), amplitude = uniform(0.003, 0.01) * reach();
                for (std::size_t i = at; i < frames.size(); ++i) {
                    MadeFrame shaken = frames[i];
                    shaken.target.y += amplitude * std::sin(6.2832 * hertz * static_cast<double>(i) / 60.0);
                    frames[i].joints = solved(shaken);
                }
                planted("jitter", 2, "still");
                trace.amount = amplitude;
                trace.tolerance = 0.35 * amplitude + 1e-3;
                break;
            }
            case Plant::Missed: {
                const glm::dvec3 off = uniform(0.03, 0.1) * reach() * direction();
                for (std::size_t i = at; i < frames.size(); ++i) {
                    MadeFrame short_of = frames[i];
                    short_of.target += off;
                    frames[i].joints = solved(short_of);
                }
                planted("missed", 2, "within reach");
                break;
            }
            case Plant::Repeated:
                frames[at] = frames[at - 1];
                planted("repeated", -1, "the frame before");
                break;
            case Plant::Limit: {
                const double most = bend_degrees(frames[at]) - 3.0;
                trace.limits = "[null, [0, " + std::to_string(most) + "]]";
                std::size_t first = 0;
                while (bend_degrees(frames[first]) <= most + 0.5) ++first;
                planted("limit", 1, "further than its limit");
                trace.frame = first;
                break;
            }
            default:
                break;
        }
    }
    double height(const MadeFrame& frame) const {
        const glm::dvec3 line = glm::normalize(frame.joints[2] - root_);
        return glm::length(glm::cross(frame.joints[1] - root_, line));
    }
    static double bend_degrees(const MadeFrame& frame) {
        const glm::dvec3 a = frame.joints[1] - frame.joints[0], b = frame.joints[2] - frame.joints[1];
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29577951308232;
    }

    std::mt19937 random_;
    double upper_ = 0.3, lower_ = 0.3;
    glm::dvec3 root_{0.0};
};

/// The conventions of a file.
struct Space {
    const char *up, *handed, *unit;
    double scale;

    glm::dvec3 of(const glm::dvec3& p) const {
        const bool z = up[0] == 'z', left = handed[0] == 'l';
        glm::dvec3 turned =
            z ? glm::dvec3(p.x, left ? p.z : -p.z, p.y) : glm::dvec3(p.x, p.y, left ? -p.z : p.z);
        return turned * scale;
    }
};
inline constexpr Space spaces[]{{"z", "left", "cm", 100.0},  {"y", "left", "m", 1.0},
                                {"y", "right", "m", 1.0},    {"z", "right", "m", 1.0},
                                {"y", "right", "cm", 100.0}, {"z", "right", "mm", 1000.0},
                                {"y", "left", "cm", 100.0},  {"z", "left", "m", 1.0},
                                {"z", "right", "cm", 100.0}, {"y", "right", "mm", 1000.0}};

/// Those of engines are in trace_makers_test.cpp.
enum class Format { JsonLines, BareJsonLines, Csv, Semicolons, Tabs, JsonList };
inline constexpr int formats = 6;

inline std::string number_text(double value, int decimals) {
    if (std::isnan(value)) return "nan";
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// `rounded`: positions to the millimetre, times as before.
inline std::string written(const MadeTrace& trace, const Space& space, Format format, bool rounded = false) {
    // A log has few digits, but enough.
    const int decimals = (space.scale == 1.0 ? 5 : 3) - (rounded ? space.scale == 1000.0 ? 3 : 2 : 0);
    const auto points = [&](const glm::dvec3& p, const char* open, const char* between, const char* close) {
        const glm::dvec3 q = space.of(p);
        return open + number_text(q.x, decimals) + between + number_text(q.y, decimals) + between +
               number_text(q.z, decimals) + close;
    };
    std::string text;
    const auto array = [&](const glm::dvec3& p) { return points(p, "[", ", ", "]"); };
    const auto joints = [&](const MadeFrame& frame) {
        std::string list;
        for (const auto& joint : frame.joints) list += (list.empty() ? "[" : ", ") + array(joint);
        return list + "]";
    };
    const auto object = [&](const MadeFrame& frame, std::size_t i) {
        std::string line = "{\"t\": " + number_text(static_cast<double>(i) / 60.0, 6) +
                           ", \"joints\": " + joints(frame) + ", \"target\": " + array(frame.target);
        if (frame.pole) line += ", \"pole\": " + array(*frame.pole);
        return line + "}";
    };
    const std::string header = std::string("{\"tendril\": \"trace\", \"up\": \"") + space.up +
                               "\", \"handed\": \"" + space.handed + "\", \"unit\": \"" + space.unit +
                               "\", \"fps\": 60" +
                               (trace.limits.empty() ? "" : ", \"limits\": " + trace.limits) + "}";
    const char separator = format == Format::Semicolons ? ';' : format == Format::Tabs ? '\t' : ',';
    const bool table = format == Format::Csv || format == Format::Semicolons || format == Format::Tabs;
    if (format == Format::JsonLines) text += header + "\n";
    if (format == Format::JsonList) text += "[\n" + header + ",\n";
    if (table) {
        text += "time";
        for (std::size_t j = 0; j < trace.frames[0].joints.size(); ++j)
            for (const char axis : {'x', 'y', 'z'}) text += separator + ("j" + std::to_string(j)) + axis;
        for (const char* name : {"tx", "ty", "tz", "px", "py", "pz"}) text += separator + std::string(name);
        text += "\n";
    }
    for (std::size_t i = 0; i < trace.frames.size(); ++i) {
        const MadeFrame& frame = trace.frames[i];
        const std::string between(1, separator);
        switch (format) {
            case Format::JsonLines:
            case Format::BareJsonLines:
                text += object(frame, i) + "\n";
                break;
            case Format::JsonList:
                text += object(frame, i) + (i + 1 < trace.frames.size() ? ",\n" : "\n]\n");
                break;
            default:
                text += number_text(static_cast<double>(i) / 60.0, 6);
                for (const auto& joint : frame.joints)
                    text += between + points(joint, "", between.c_str(), "");
                text += between + points(frame.target, "", between.c_str(), "") + between;
                text += frame.pole ? points(*frame.pole, "", between.c_str(), "") : between + between;
                text += "\n";
        }
    }
    return text;
}

}  // namespace tendril::test::made
