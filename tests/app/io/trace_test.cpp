// Traces in every format and convention, with one fault each, and clean ones.
#include "app/io/trace/trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <sstream>

#include "tests/app/io/trace_reading.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::made::Format, test::made::MadeTrace, test::made::Plant, test::made::Space, test::made::TraceMaker;

const Space& space_for(unsigned seed) {
    return test::made::spaces[seed % std::size(test::made::spaces)];
}

TEST(Trace, EveryPlantedFaultIsFoundAtItsFrameWithItsCause) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const auto plant = static_cast<Plant>(1 + seed % test::made::plants);
        auto format = static_cast<Format>(seed / test::made::plants % test::made::formats);
        if (plant == Plant::Limit) format = seed % 2 == 0 ? Format::JsonLines : Format::JsonList;
        const MadeTrace made = TraceMaker(seed).make(plant);
        const ReadTrace found = read_trace(test::made::written(made, space_for(seed), format));
        const auto same = [&](const TracedIncident& each) {
            const int joint = each.joint == ik::no_joint ? -1 : static_cast<int>(each.joint);
            const std::string cause = each.cause;
            return ik::name(each.kind) == made.kind && joint == made.joint &&
                   (made.kind == "lag" || each.frame == made.frame ||
                    (made.kind == "missed" && each.frame < made.frame + 3)) &&
                   (cause.find(made.cause) != cause.npos ||
                    (!made.also.empty() && cause.find(made.also) != cause.npos)) &&
                   (made.tolerance < 0.0 || std::abs(each.amount - made.amount) <= made.tolerance);
        };
        EXPECT_TRUE(std::ranges::any_of(found.incidents(), same))
            << "seed " << seed << ", format " << static_cast<int>(format) << ": " << made.kind << " at "
            << made.frame << " joint " << made.joint << " (" << made.cause << ", " << made.amount
            << "); found:\n"
            << found.text();
        // A flip caused by a jump is reported beside the jump; close to the root there may be two flips.
        const std::size_t others = plant == Plant::FlipAtJump || plant == Plant::FlipAtRoot ? 1 : 0;
        EXPECT_LE(found.incidents().size(), 1 + others) << "seed " << seed << ", " << made.kind << ":\n"
                                                        << found.text();
    }
}

/// The maximum rotation of the upper arm in a frame of Tendril's solve, degrees.
float fastest_turn(const std::vector<TracedFrame>& frames, const TraceSolve& how) {
    Retrace chain(how);
    glm::vec3 before(0.0f);
    float fastest = 0.0f;
    for (const TracedFrame& frame : frames) {
        const std::vector<glm::vec3>& joints = chain.follow(frame);
        const glm::vec3 bone = joints[1] - joints[0];
        if (before != glm::vec3(0.0f))
            fastest = std::max(fastest, glm::degrees(ik::angle_between(before, bone)));
        before = bone;
    }
    return fastest;
}

TEST(Trace, ASuggestedPreventionWorksInASolve) {
    std::size_t poles = 0, methods = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const Plant plant = seed % 2 == 0 ? Plant::FlipAtPole : Plant::FlipForNothing;
        const MadeTrace made = TraceMaker(seed).make(plant);
        const std::string text = test::made::written(made, test::made::spaces[0], Format::JsonLines);
        std::istringstream in(text);
        TraceReader reader(in);
        std::vector<TracedFrame> frames;
        for (TracedFrame frame; reader.next(frame);) frames.push_back(frame);
        const ReadTrace found = read_trace(text);
        ASSERT_EQ(found.incidents().size(), 1u) << found.text();
        const PreventedFlip& prevented = found.incidents()[0].prevented;
        ASSERT_TRUE(prevented.tried);
        EXPECT_EQ(prevented.flips_in.has_value(), plant == Plant::FlipAtPole) << "seed " << seed;
        EXPECT_FALSE(prevented.by.empty()) << "seed " << seed;
        const std::vector<TracedFrame> around(frames.begin() + 36, frames.begin() + 77);
        for (const Prevention& each : prevented.by) {
            const float turn = fastest_turn(around, each.solve);
            EXPECT_LT(turn, 30.0f) << "seed " << seed << ": " << each.text(found.conventions);
            methods += each.kind == Prevention::Kind::Method;
            if (each.kind != Prevention::Kind::Pole) continue;
            ++poles;
            TraceSolve less = each.solve;
            less.pole_by *= 0.5f;
            EXPECT_GT(fastest_turn(around, less), turn) << "seed " << seed << ": it is the smallest";
            EXPECT_GT(fastest_turn(around, {.method = *prevented.flips_in}), 1.2f * turn) << "seed " << seed;
        }
    }
    EXPECT_EQ(poles, 20u);
    EXPECT_GE(methods, 20u);
}

TEST(Trace, OfAFlipThatNoSolverHasItReportsWhetherOneReaches) {
    // Bones of 1 and 0.3 m, which the engine stretches, since they cannot reach closer than 0.7 m.
    std::vector<TracedFrame> frames;
    for (int i = 0; i < 20; ++i) {
        const float x = std::max(0.4f, 0.75f - 0.02f * static_cast<float>(i));
        TracedFrame frame;
        frame.joints = {{0, 0, 0}, {0.95f, i < 10 ? 0.25f : -0.25f, 0}, {x, 0, 0}};
        frame.target = glm::vec3(x, 0, 0);
        frames.push_back(frame);
    }
    const PreventedFlip none = prevent_flip(frames, 10, 1);
    EXPECT_TRUE(none.tried && none.by.empty() && !none.flips_in);
    EXPECT_EQ(none.text(),
              "no solver of Tendril flips on the same input, but none reaches the target as well as yours");
    PreventedFlip one;
    one.tried = true;
    one.flips_in = ik::Method::TwoBone;
    EXPECT_TRUE(test::says(one.text(), "Two-bone flips no change prevents it")) << one.text();
    one.flips_in.reset();
    one.reaches = true;
    EXPECT_TRUE(test::says(one.text(), "no solver flips has pole target, log it")) << one.text();
    one.has_pole = true;
    EXPECT_EQ(one.text(), "no solver of Tendril flips on the same input");
    const Conventions metres;
    const Prevention pole{
        .kind = Prevention::Kind::Pole, .solve = {.pole_by = {0.042f, 0, 0}}, .pole = glm::vec3(1, 2, 3)};
    EXPECT_EQ(pole.text(metres), "pole target moved by 0.042 m, to (1.000, 2.000, 3.000) m");
}

TEST(Trace, ABoneThatRollsWhileItsEndsStayFlips) {
    for (const bool rolls : {false, true})
        for (const Space& space : test::made::spaces) {
            const MadeTrace made = TraceMaker(3).make(Plant::None);
            std::string text = std::string("{\"tendril\": \"trace\", \"up\": \"") + space.up +
                               "\", \"handed\": \"" + space.handed + "\", \"unit\": \"" + space.unit +
                               "\", \"rotations\": \"xyzw\"}\n";
            for (std::size_t i = 0; i < made.frames.size(); ++i) {
                std::string joints, rotations;
                for (std::size_t j = 0; j < 3; ++j) {
                    const glm::dvec3 p = space.of(made.frames[i].joints[j]);
                    joints += printed(p, j > 0 ? ", [%.5f, %.5f, %.5f]" : "[%.5f, %.5f, %.5f]");
                    if (j == 2) break;
                    const glm::dvec3 bone = glm::normalize(space.of(made.frames[i].joints[j + 1]) - p);
                    // From +X; the lower arm rolls about itself from frame 60 on.
                    glm::dquat q(glm::dvec3(1, 0, 0), bone);
                    if (rolls && j == 1 && i >= 60) q = glm::angleAxis(2.9, bone) * q;
                    rotations +=
                        printed({q.x, q.y, q.z}, j > 0 ? ", [%.6f, %.6f, %.6f, " : "[%.6f, %.6f, %.6f, ") +
                        test::made::number_text(q.w, 6) + "]";
                }
                text += "{\"joints\": [" + joints + "], \"rotations\": [" + rotations + "]}\n";
            }
            const ReadTrace found = read_trace(text);
            ASSERT_EQ(found.incidents().size(), rolls ? 1u : 0u) << found.text();
            if (!rolls) continue;
            const TracedIncident& roll = found.incidents()[0];
            EXPECT_EQ(roll.frame, 60u);
            EXPECT_EQ(roll.joint, 1u);
            EXPECT_NEAR(roll.amount, glm::degrees(2.9), 1.0);
            EXPECT_EQ(roll.flip, ik::FlipCause::Rolled);
        }
}

TEST(Trace, NothingIsFoundInCleanTraces) {
    for (unsigned seed = 1000; seed < 1200; ++seed) {
        const auto format = static_cast<Format>(seed % test::made::formats);
        const MadeTrace made = TraceMaker(seed).make(Plant::None);
        const bool rounded = seed % 3 == 0;
        const ReadTrace found = read_trace(test::made::written(made, space_for(seed / 10), format, rounded));
        EXPECT_EQ(found.text(), "") << "seed " << seed;
        EXPECT_EQ(found.notes.size(), 0u);
    }
}

TEST(Trace, FloatsFarFromTheOriginAreAsRoundAsFloatsAre) {
    for (unsigned seed = 0; seed < 264; ++seed) {
        const MadeTrace made = TraceMaker(seed).make(Plant::None);
        const double away = seed % 3 == 0 ? 5e3 : 5e4, scale = seed % 2 == 0 ? 1.0 : 100.0;  // metres
        std::string text;
        for (const auto& frame : made.frames) {
            std::vector<glm::dvec3> points = frame.joints;
            points.push_back(frame.target);
            for (const glm::dvec3& point : points) {
                const glm::vec3 rounded(scale * (point + glm::dvec3(away, 0.0, -0.7 * away)));
                text += (&point == &points.back() ? "target " : "") +
                        printed(rounded, seed % 4 < 2 ? "(%.4f, %.4f, %.4f) " : "(%.9g, %.9g, %.9g) ");
            }
            text += '\n';
        }
        const ReadTrace found = read_trace(
            text, {.up = "y", .handed = "right", .unit = seed % 2 == 0 ? "m" : "cm", .rotations = ""});
        EXPECT_EQ(found.text(), "") << "seed " << seed;
    }
}

TEST(Trace, ConventionsAreGuessedOrNotSure) {
    std::size_t sure = 0, right = 0;
    for (unsigned seed = 2000; seed < 2400; ++seed) {
        const auto format = static_cast<Format>(seed % test::made::formats);
        if (format == Format::JsonLines || format == Format::JsonList) continue;  // they say it
        const MadeTrace made = TraceMaker(seed).make(Plant::None);
        const Space& space = space_for(seed / 10);
        const Conventions guess = read_trace(test::made::written(made, space, format)).conventions;
        const auto judge = [&](bool is_sure, const std::string& name, const char* is) {
            if (!is_sure) return;
            ++sure;
            right += name == is;
        };
        judge(guess.up.sure, trace_ups.name(guess.up.value), space.up);
        judge(guess.handed.sure, trace_hands.name(guess.handed.value), space.handed);
        judge(guess.unit.sure, trace_units.name(guess.unit.value), space.unit);
    }
    EXPECT_GT(sure, 400u);
    EXPECT_GE(right, sure * 95 / 100) << "of " << sure;
}

TEST(Trace, OrderOfAQuaternionIsFoundFromTheBones) {
    for (const bool w_first : {false, true}) {
        std::string text;
        for (int i = 0; i < 30; ++i) {
            const glm::dquat q = glm::angleAxis(0.05 * i + 0.3, glm::normalize(glm::dvec3(0.2, 0.3, 0.9)));
            const glm::dvec3 tip = q * glm::dvec3(0.5, 0, 0);
            char line[400];
            const double numbers[]{w_first ? q.w : q.x, w_first ? q.x : q.y, w_first ? q.y : q.z,
                                   w_first ? q.z : q.w};
            std::snprintf(
                line, sizeof line,
                "{\"joints\": [[0,0,0],[%.9f,%.9f,%.9f]], \"rotations\": [[%.9f,%.9f,%.9f,%.9f]]}\n", tip.x,
                tip.y, tip.z, numbers[0], numbers[1], numbers[2], numbers[3]);
            text += line;
        }
        const Conventions guess = read_trace(text).conventions;
        EXPECT_TRUE(guess.rotations.sure);
        EXPECT_EQ(guess.rotations.value, w_first ? QuaternionOrder::Wxyz : QuaternionOrder::Xyzw);
    }
}

TracedFrame first_frame(const std::string& text) {
    std::istringstream in(text);
    TraceReader reader(in, {.up = "y", .handed = "right", .unit = "m", .rotations = ""});
    TracedFrame frame;
    EXPECT_TRUE(reader.next(frame)) << text;
    return frame;
}

TEST(Trace, PastedPosesAreRead) {
    for (const char* text :
         {"[[0, 1, 0], [0.5, 1, 0], [1, 1, 0.25]]",
          "{\"x\": [0, 0.5, 1], \"y\": [1, 1, 1], \"z\": [0, 0, 0.25]}", "0 1 0\n0.5 1 0\n1 1 0.25\n",
          "0,1,0\n0.5,1,0\n1,1,0.25", "0\t1\t0\t0.5\t1\t0\t1\t1\t0.25\n",
          "shoulder (0.0, 1.0, 0.0)\nelbow (0.5, 1.0, 0.0)\nhand (1.0, 1.0, 0.25)\n",
          "FVector(0, 1, 0), FVector(0.5, 1, 0), FVector(1, 1, 0.25)",
          "[time=0.50] shoulder=(0, 1, 0) elbow=(0.5, 1, 0) hand=(1, 1, 0.25)\n",
          "dt=0.016 shoulder (0, 1, 0) elbow (0.5, 1, 0) hand (1, 1, 0.25)\n",
          "fps: 60, speed 1.5: (0, 1, 0) (0.5, 1, 0) (1, 1, 0.25)\n",
          "time: 3\nshoulder: (0, 1, 0)\nelbow: (0.5, 1, 0)\nhand: (1, 1, 0.25)\n",
          "<Vector (0.0, 1.0, 0.0)> <Vector (0.5000, 1.0000, 0.0)> <Vector (1, 1, 0.25)>",
          "[{\"x\": 0, \"y\": 1, \"z\": 0}, {\"x\": 0.5, \"y\": 1, \"z\": 0}, {\"x\": 1, "
          "\"y\": 1, \"z\": 0.25}]"}) {
        const TracedFrame frame = first_frame(text);
        ASSERT_EQ(frame.joints.size(), 3u) << text;
        EXPECT_EQ(frame.joints[0], glm::vec3(0, 1, 0)) << text;
        EXPECT_EQ(frame.joints[2], glm::vec3(1, 1, 0.25f)) << text;
    }
    const TracedFrame aimed = first_frame(
        "root: (0, 1, 0)\nelbow: (0.5, 1, 0)\nhand: (1, 1, 0)\ngoal: (1, 2, 0)\n"
        "pole_target: (0, 0, 1)\nroot: (0, 1, 0)\nelbow: (0.5, 1, 0)\nhand: (1, 1, 0)\n");
    EXPECT_EQ(aimed.joints.size(), 3u);
    EXPECT_EQ(aimed.target, glm::vec3(1, 2, 0));
    EXPECT_EQ(aimed.pole, glm::vec3(0, 0, 1));
    for (const char* target : {"target_rotation (0, 0, 0, 1)", "target rotation: (0, 0, 0, 1)",
                               "target (1, 2, 0) rotation (0, 0, 0, 1)", "target (1, 2, 0) (0, 0, 0, 1)"})
        EXPECT_EQ(
            first_frame(std::string(target) + " root (0, 1, 0) (1, 0, 0, 0) tip (1, 1, 0) (1, 0, 0, 0)\n")
                .rotations.size(),
            2u)
            << target;
}

TEST(Trace, AnArrayOfManyLinesIsReadInLinearTime) {
    const auto begin = std::chrono::steady_clock::now();
    for (const char* each : {"1 2\n", ": 1.0 2.0 3.0 ", "a: -"}) {
        std::string text = "data = [0\n";
        while (text.size() < 700'000) text += each;
        EXPECT_EQ(trace_refusal(text + "]\n(0, 0, 0) (1, 0, 0)\n"), "read") << each;
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(Trace, ATargetIsKnownByItsName) {
    const auto check = [](const std::string& text, bool pole) {
        const TracedFrame frame = first_frame(text);
        EXPECT_EQ(frame.joints.size(), 3u) << text;
        EXPECT_EQ(pole ? frame.pole : frame.target, glm::vec3(1, 2, 0)) << text;
    };
    for (const std::string name :
         {"target p=", "target at ", "target world position: ", "GetTarget()=", "moving to ", "tgt ",
          "cmd: ", "desired=", "EffectorLocation: ", "EndEffectorTarget=", "Target.Position "})
        check("shoulder=(0, 1, 0) elbow=(0.5, 1, 0) EndEffector=(1, 1, 0) " + name + "(1, 2, 0)\n", false);
    for (const std::string name :
         {"t", "target_pos_", "target_position_", "target.position.", "Target Position ", "TargetPosition",
          "ik_target.", "ee_target_", "hand_target_", "goal_pos_", "effector_", "tgt_", "cmd_", "desired_",
          "IK Target ", "pole_vector_", "elbow_hint_"}) {
        std::string header;
        for (const std::string& each :
             {std::string("a_"), std::string("hand_r_"), std::string("end_effector_"), name})
            for (const char* axis : {"x", "y", "z"}) header += (header.empty() ? "" : ",") + each + axis;
        check(header + "\n0,1,0,0.5,1,0,1,1,0,1,2,0\n", name == "pole_vector_" || name == "elbow_hint_");
    }
    check(
        "a (x),a (y),a (z),b (x),b (y),b (z),c (x),c (y),c (z),target (x),target (y),target (z),body\n"
        "0,1,0,0.5,1,0,1,1,0,1,2,0,7\n",
        false);
    const ReadTrace two = read_trace(
        "a_x,a_y,a_z,b_x,b_y,b_z,target_x,target_y,target_z,goal_x,goal_y,goal_z\n"
        "0,1,0,0.5,1,0,1,1,0,1,2,0\n");
    EXPECT_TRUE(test::says(two.notes.at(0), "goal second target")) << two.notes[0];
    for (const bool aims : {true, false}) {  // without names, by its distance from the joint before
        std::string text;
        const MadeTrace made = TraceMaker(4).make(Plant::Lag);
        for (const auto& [joints, target, pole] : made.frames)
            text += printed(joints[0]) + printed(joints[1]) + printed(joints[2]) + " -> " +
                    printed(aims ? target : joints[2] + joints[1] - joints[0]) + '\n';
        const ReadTrace found = read_trace(text);
        EXPECT_EQ(found.notes.size(), aims ? 1u : 0u);
        EXPECT_TRUE(!aims || found.incidents().at(0).kind == ik::IncidentKind::Lag) << found.text();
    }
}

TEST(Trace, WithoutATargetNoneIsReported) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const MadeTrace made = TraceMaker(seed).make(static_cast<Plant>(seed % (test::made::plants + 1)));
        std::string text =
            "{\"tendril\": \"trace\", \"up\": \"y\", \"handed\": \"right\", \"unit\": \"m\"}\n";
        for (std::size_t i = 0; i < made.frames.size(); ++i) {
            const double scale = seed >= 30 && i >= 60 && i < 65 ? 1.6 : 1.0;
            text += "{\"joints\": [";
            for (std::size_t j = 0; j < 3; ++j)
                text += (j > 0 ? "," : "") + printed(scale * made.frames[i].joints[j], "[%.5f,%.5f,%.5f]");
            text += "]}\n";
        }
        const ReadTrace found = read_trace(text);
        for (const TracedIncident& each : found.incidents())
            EXPECT_TRUE(each.kind != ik::IncidentKind::TargetJump && !test::says(each.cause, "target"))
                << "seed " << seed << ": " << each.cause;
    }
}

TEST(Trace, TablesAndTheirTimesAreReadHoweverTheyAreWritten) {
    using Stamp = std::pair<const char*, double>;
    for (const auto& [time, unit] :
         {Stamp{"timestamp", 1}, Stamp{"stamp", 1}, Stamp{"time_ms", 1e3}, Stamp{"time_us", 1e6},
          Stamp{"t_ns", 1e9}, Stamp{"Time (s)", 1}, Stamp{"time [s]", 1}, Stamp{"elapsed", 1},
          Stamp{"%time", 1}, Stamp{"field.header.stamp", 1e9}, Stamp{"time", 1e3}})
        for (const int style : {0, 1, 2, 3, 4}) {
            const char separator = ",; ,\t"[style];
            if (separator == ' ' && std::string(time).find(' ') != std::string::npos) continue;
            std::string text = style == 3 ? "# logged\n# by arm 1.2\nsep=,\n" : style == 2 ? "# " : "";
            text += time;
            for (const char* name : {"ax", "ay", "az", "bx", "by", "bz"})
                text += separator + std::string(name);
            for (int i = 0; i < 80; ++i) {
                std::string row =
                    test::made::number_text(std::round(i / 30.0 * 1e4) / 1e4 * unit, unit > 1 ? 0 : 4);
                for (const char* number : {"0.0", "1.5", "0.0", "0.25", "1.0", "0.0"})
                    row += ' ' + std::string(number);
                if (separator == ';' || separator == '\t') std::ranges::replace(row, '.', ',');
                std::ranges::replace(row, ' ', separator);
                text += '\n' + row;
            }
            std::istringstream in(text);
            TraceReader reader(in);
            EXPECT_TRUE(reader.fps_known()) << text.substr(0, 200);
            EXPECT_NEAR(reader.fps(), 30.0, 0.02) << text.substr(0, 200);
            TracedFrame frame;
            ASSERT_TRUE(reader.next(frame));
            EXPECT_EQ(frame.joints.at(1), glm::vec3(0.25f, 1, 0)) << text.substr(0, 200);
        }
    EXPECT_TRUE(test::says(trace_refusal(std::string("\xff\xfet\0i\0", 6)), "UTF-16"));
    EXPECT_EQ(trace_refusal("{\"joints\": [{\"position\": {\"x\": 0, \"y\": 1, \"z\": 0}}, [1, 1, 0]]}\n"),
              "read");
}

TEST(Trace, StampsOfLogsGiveTheRate) {
    const auto seconds = [](double t) { return test::made::number_text(t, 3); };
    const std::function<std::string(double)> stamps[]{
        [&](double t) { return '[' + seconds(t) + "] "; },
        [&](double t) { return "  " + seconds(t + 1.69e9) + ": "; },
        [&](double t) { return "12:00:0" + seconds(t) + " INFO "; },
        [&](double t) { return "arm time=" + seconds(t) + ' '; },
        [&](double t) { return "[stamp_ms: " + seconds(1e3 * t) + "] "; },
        [](double t) {
            const double whole = std::floor(t);
            return "stamp:\n  sec: " + test::made::number_text(1.69e9 + whole, 0) +
                   "\n  nanosec: " + test::made::number_text(1e9 * (t - whole), 0) + '\n';
        }};
    for (const auto& stamp : stamps) {
        std::string text;
        for (int i = 0; i < 80; ++i)
            text += stamp(i / 30.0) + "a (0.0, 1.5, 0.0) b (0.25, 1.0, " + seconds(0.01 * i) + ")\n";
        std::istringstream in(text);
        EXPECT_NEAR(TraceReader(in).fps(), 30.0, 0.05) << text.substr(0, 100);
    }
}

TEST(Trace, BothSidesInOneTableAreTwoChains) {
    const auto table = [](std::vector<std::string> names, bool with_targets) {
        std::string text = "time";
        for (const std::string& name : names)
            for (const char* axis : {"_x", "_y", "_z"}) text += ',' + name + axis;
        for (unsigned i = 0; i < 120; ++i) {
            text += '\n' + std::to_string(i / 60.0);
            for (const Plant plant : {Plant::None, Plant::Length}) {
                static const MadeTrace sides[]{TraceMaker(1).make(Plant::None),
                                               TraceMaker(2).make(Plant::Length)};
                const auto& frame = sides[plant == Plant::None ? 0 : 1].frames[i];
                for (const glm::dvec3& joint : frame.joints) text += ',' + printed(joint, "%.5f,%.5f,%.5f");
                if (with_targets) text += ',' + printed(frame.target, "%.5f,%.5f,%.5f");
            }
        }
        return text;
    };
    for (const auto& names : std::initializer_list<std::vector<std::string>>{
             {"left_shoulder", "left_elbow", "left_hand", "left_target", "right_shoulder", "right_elbow",
              "right_hand", "right_target"},
             {"LeftArm", "LeftForeArm", "LeftHand", "LeftTarget", "RightArm", "RightForeArm", "RightHand",
              "RightTarget"},
             {"arm.L", "forearm.L", "hand.L", "target.L", "arm.R", "forearm.R", "hand.R", "target.R"},
             {"l_arm", "l_elbow", "l_hand", "r_arm", "r_elbow", "r_hand"}}) {
        const ReadTrace found = read_trace(table(names, names.size() == 8));
        ASSERT_EQ(found.findings.chains.size(), 2u) << names[0];
        EXPECT_EQ(found.findings.chains[0].name, "left");
        EXPECT_EQ(found.findings.chains[0].incidents.size(), 0u) << found.text();
        ASSERT_EQ(found.findings.chains[1].incidents.size(), 1u);
        EXPECT_TRUE(
            test::says(found.bones.at(1), names[1].find("lbow") != std::string::npos ? "elbow" : "forearm"));
        EXPECT_EQ(found.findings.chains[1].incidents[0].kind, ik::IncidentKind::Length);
        EXPECT_EQ(found.notes.size(), 0u);
    }
    // One side alone, or sides that differ, are one chain.
    EXPECT_EQ(read_trace(table({"left_a", "left_b", "left_c", "right_d", "right_e", "right_f"}, false))
                  .findings.chains.size(),
              1u);
}

TEST(Trace, EmptyCellsAreNoTargetOrNaN) {
    const std::string head = "time,a_x,a_y,a_z,b_x,b_y,b_z,target_x,target_y,target_z\n0,0,1,0,1,1,0,1,1,0\n";
    const ReadTrace found =
        read_trace(head + "0.1,0,1,0,1,1,0,,,\n0.2,0,1,0,,,,1,1,0\n0.3,0,1,0,1,1,0,1,1,0\n");
    EXPECT_EQ(found.findings.chains[0].frames, 4u);
    ASSERT_EQ(found.incidents().size(), 1u) << found.text();
    EXPECT_TRUE(test::says(found.incidents()[0].title(found.bones, found.conventions),
                           "Frame 2: NaN at joint 1 (b)"));
}

TEST(Trace, TheWholeChainScaledOrUnwrittenOrFrozenIsOneIncident) {
    for (unsigned seed = 0; seed < 20; ++seed)
        for (const double scale : {1.1, 0.9, 100.0, 0.01, 0.0, 1.0}) {  // 1: frozen
            MadeTrace made = TraceMaker(seed).make(Plant::None);
            for (std::size_t i = 60; i < (scale == 1.0 ? 120u : scale == 0.0 ? 61u : 63u); ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    made.frames[i].joints[j] =
                        scale == 1.0 ? made.frames[59].joints[j] : scale * made.frames[i].joints[j];
            std::size_t lengths = 0, repeats = 0;
            const ReadTrace found =
                read_trace(test::made::written(made, test::made::spaces[2], Format::JsonLines));
            for (const TracedIncident& each : found.incidents()) {
                lengths += each.kind == ik::IncidentKind::Length;
                repeats += each.kind == ik::IncidentKind::Repeated;
                EXPECT_NE(each.kind, ik::IncidentKind::Missed) << seed << ' ' << scale << '\n'
                                                               << found.text();
                if (each.kind != ik::IncidentKind::Length) continue;
                EXPECT_TRUE(test::says(each.cause, scale == 0.0 ? "at one point" : "scale or unit"))
                    << each.cause;
                EXPECT_EQ(each.frame, 60u);
            }
            EXPECT_EQ(lengths, scale == 1.0 ? 0u : 1u) << seed << ' ' << scale << '\n' << found.text();
            EXPECT_EQ(repeats, scale == 1.0 ? 1u : 0u) << seed << ' ' << scale << '\n' << found.text();
        }
}

TEST(Trace, ATargetOfTheWristIsNotMissedByTheHand) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        MadeTrace made = TraceMaker(seed).make(seed % 2 == 0 ? Plant::None : Plant::Lag);
        const glm::dvec3 hand(0.1, 0.1, 0.1);
        for (auto& frame : made.frames) frame.joints.push_back(frame.joints.back() + hand);
        const ReadTrace found =
            read_trace(test::made::written(made, test::made::spaces[seed % 4], Format::JsonLines));
        EXPECT_TRUE(test::says(found.conventions.text(), "joint 2 reaches for the target"))
            << found.conventions.text();
        EXPECT_EQ(found.incidents().size(), seed % 2) << "seed " << seed << ":\n" << found.text();
    }
}

TEST(Trace, TheWristIsFoundBehindAFrameThatIsNotFinite) {
    std::string text;
    for (int i = 0; i < 30; ++i)
        text += std::string("{\"joints\": [[0,0,0],[0.5,0.1,0],[") + (i == 0 ? "NaN" : "1") +
                ",0,0],[1.2,0,0]], \"target\": [1,0,0]}\n";
    EXPECT_TRUE(test::says(read_trace(text).conventions.text(), "joint 2 reaches for the target"));
}

TEST(Trace, AGivenJointReachesInEachChainThatHasIt) {
    const auto frame = [](const char* chain, int joints) {
        std::string text = std::string("{\"chain\": \"") + chain + "\", \"joints\": [[0,0,0]";
        for (int i = 1; i < joints; ++i) text += ",[" + std::to_string(i) + ",0.1,0]";
        return text + "], \"target\": [2,0.1,0]}\n";
    };
    std::string text;
    for (int i = 0; i < 100; ++i) text += frame("arm", 4) + frame("neck", 2);
    text += frame("late", 5);
    std::istringstream in(text);
    ConventionChoice choice;
    choice.target_joint = 2;
    TraceReader reader(in, choice);
    for (TracedFrame each; reader.next(each);)
        EXPECT_EQ(each.end.value_or(0), each.chain == "neck" ? 0u : 2u) << each.chain;
    const std::string both = read_trace(frame("left", 4) + frame("right", 5)).conventions.text();
    EXPECT_TRUE(test::says(both, "joint 2 of left reaches") && test::says(both, "joint 2 of right reaches"))
        << both;
}

TEST(Trace, DamageIsRefusedByItsLineOrReadUpToIt) {
    for (const auto& [text, words] : std::initializer_list<std::pair<const char*, const char*>>{
             {"", "nothing"},
             {"hello\nworld\n", "no positions"},
             {"{\"joints\": 3}\n", "line 1"},
             {"{\"joints\": [[0,0,0],[1,0;0]]}\n", "line 1 damaged found '0;'"},
             {"{\"tendril\": \"trace\"}\n{\"joints\": [[0,0,0]]}\n", "line 2: expected two joints"},
             {"time,j0x,j0y,j0z,j1x,j1y\n0,0,0,0,1,1\n", "line 1 columns"},
             {"{\"up\": \"w\"}\n{\"joints\": [[0,0,0],[1,0,0]]}\n", "\"w\""},
             {"At time 100.000\n- Translation: [0.300, 0.100, 0.200]\n- Rotation: in Quaternion [0.000, "
              "0.000, "
              "0.000, 1.000]\n            in RPY (radian) [0.000, -0.000, 0.000]\n",
              "line 2 one position and its rotation no chain"}})
        EXPECT_TRUE(test::says(trace_refusal(text), words)) << text;
    const std::string frame = "{\"joints\": [[0,0,0],[1,0,0]], \"target\": [1,0,0]}\n";
    for (const std::size_t frames : {2u, 64u, 300u}) {
        std::string whole;
        for (std::size_t i = 0; i < frames; ++i) whole += frame;
        const ReadTrace cut = read_trace(whole + "{\"joints\": [[0,0,0],[1,0");
        ASSERT_EQ(cut.notes.size(), 1u);
        EXPECT_NE(cut.notes[0].find("line " + std::to_string(frames + 1)), std::string::npos);
        EXPECT_EQ(cut.findings.chains[0].frames, frames);
    }
    const ReadTrace other = read_trace(frame + "{\"joints\": [[0,0,0],[1,0,0],[2,0,0]]}\n");
    EXPECT_NE(other.notes.at(0).find("expected 2 joints"), std::string::npos);
}

}  // namespace
}  // namespace tendril::app
