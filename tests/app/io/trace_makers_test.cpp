// Logs in the formats that programs of many makers print.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/io/json_complete.hpp"
#include "tests/app/io/trace_reading.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

using test::made::MadeTrace, test::made::Plant, test::made::Space, test::made::TraceMaker;

/// A number as a language writes it.
std::string spelled(double x, const std::string& language) {
    if (language == "thousands") return test::made::number_text(x / 1e3, 7);
    const char* const brackets = language == "haskell" && x < 0.0 ? "(%.4f)" : "%.4f";
    char text[40];
    std::snprintf(text, sizeof text, language == "fortran" ? "%.6E" : brackets, x);
    std::string all = text;
    if (language == "fortran") std::ranges::replace(all, 'E', 'D');
    if (language == "comma") std::ranges::replace(all, '.', ',');
    return all;
}

/// How a program prints a frame. # is its number, @ a joint's name, ~ its number and ^ its letter.
struct Maker {
    explicit Maker(const Json& of)
        : name(of.at("name")), joint(of.at("joint")), between(of.value("between", " ")),
          before(of.value("before", "")), after(of.value("after", "\n")), header(of.value("header", "")),
          engine(of.value("engine", "")), number(of.value("number", "")),
          sometimes(of.value("sometimes", "")), space(of.value("space", 2)) {}

    std::string name, joint, between, before, after, header;
    std::string engine;     ///< in the text of the conventions
    std::string number;     ///< how it spells each, where the format has %s
    std::string sometimes;  ///< before every seventh frame
    std::size_t space;      ///< of test::made::spaces

    std::string print(const std::vector<glm::dvec3>& joints, std::size_t frame) const {
        std::string text = before;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            constexpr const char* names[]{"shoulder", "elbow", "hand"};
            std::string format = replaced(replaced(joint, '@', names[i]), '~', std::to_string(i));
            format = replaced(format, '^', std::string(1, "pru"[i]));
            if (!number.empty())
                for (const int axis : {0, 1, 2}) {
                    const std::size_t at = format.find("%s");
                    format.replace(at, 2, spelled(joints[i][axis], number));
                }
            text += (i > 0 ? between : "") + printed(joints[i], format.c_str());
        }
        if (frame % 7 == 3) text.insert(0, sometimes);
        return replaced(text + after, '#', std::to_string(frame));
    }

  private:
    static std::string replaced(std::string text, char what, const std::string& by) {
        for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
            text.replace(at, 1, by);
        return text;
    }
};

/// "makers", or "vectors": a program's format for one vector, used for shoulder, elbow, hand, target and pole
/// target.
Json formats_of(const char* of) {
    return read_json_file(test::source_path("tests/app/data/trace_formats.json")).at(of);
}

TEST(Trace, WordsBeforeEveryVectorAreItsType) {
    const auto prefix = [](std::size_t i) {
        return "[2026.11.29-02.44.02:016][" + std::to_string(i) + "]Arm: ";
    };
    for (const Json& each : formats_of("vectors")) {
        const std::string format = each.at("format"), engine = each.value("engine", "");
        const Space& space = test::made::spaces[each.value("space", std::size_t{2})];
        for (const int layout : {0, 1, 2, 3, 4})
            for (unsigned seed = 0; seed < (test::is_thorough() ? 2u : 1u); ++seed) {
                const bool listed = std::string_view("({[<").find(format[0]) != std::string_view::npos;
                if (layout > 2 && !listed) continue;
                const MadeTrace made = TraceMaker(seed).make(Plant::None);
                std::string text;
                for (std::size_t i = 0; i < made.frames.size(); ++i) {
                    const auto& frame = made.frames[i];
                    const auto v = [&](const glm::dvec3& point) {
                        return printed(space.of(point), format.c_str()) + ' ';
                    };
                    const std::string a = v(frame.joints[0]), b = v(frame.joints[1]), c = v(frame.joints[2]),
                                      target = v(frame.target),
                                      pole = v(frame.pole.value_or(glm::dvec3(0, 9, 0)));
                    if (layout == 0)
                        text += prefix(i) + "shoulder: " + a + "elbow: " + b + "wrist: " + c +
                                "target: " + target + "pole: " + pole + '\n';
                    if (layout == 1)
                        text += "shoulder: " + a + "\nelbow: " + b + "\nwrist: " + c + "\ntarget: " + target +
                                "\npole: " + pole + '\n';
                    if (layout == 2)
                        for (const std::string side : {"left_", "right_"})
                            text += side + "shoulder: " + a + side + "elbow: " + b + side + "hand: " + c +
                                    side + "target: " + target + (side == "right_" ? "\n" : "");
                    if (layout == 3)
                        text += "Solving IK toward " + target + "\n -> chain " + a + b + c + '\n';
                    if (layout == 4)
                        for (const char* leg : {"leg 0: ", "leg 1: "})
                            text += leg + a + b + c + "target " + target + '\n';
                }
                SCOPED_TRACE(text.substr(0, 500));
                ASSERT_EQ(trace_refusal(text), "read");
                const ReadTrace found = read_trace(text);
                const std::size_t chains = layout == 2 || layout == 4 ? 2 : 1;
                ASSERT_EQ(found.findings.chains.size(), chains);
                for (const auto& chain : found.findings.chains) EXPECT_EQ(chain.frames, made.frames.size());
                EXPECT_EQ(found.findings.count(), 0u) << found.text();
                EXPECT_TRUE(found.notes.empty()) << found.notes[0];
                EXPECT_NE(found.conventions.text().find(engine), std::string::npos)
                    << found.conventions.text();
                std::istringstream in(text);
                TraceReader reader(
                    in, {.up = space.up, .handed = space.handed, .unit = space.unit, .rotations = ""});
                TracedFrame frame;
                for (std::size_t i = 0; i < 10 * chains; ++i) {
                    const auto& expected = made.frames[i / chains];
                    ASSERT_TRUE(reader.next(frame));
                    ASSERT_EQ(frame.joints.size(), 3u);
                    ASSERT_TRUE(frame.target.has_value());
                    constexpr float rounded = 9e-3f;  // metres, %.2e
                    EXPECT_LT(glm::distance(*frame.target, glm::vec3(expected.target)), rounded);
                    EXPECT_LT(glm::distance(frame.joints[1], glm::vec3(expected.joints[1])), rounded);
                    EXPECT_EQ(frame.pole.has_value(), layout < 2);
                    if (frame.pole && expected.pole) {
                        EXPECT_LT(glm::distance(*frame.pole, glm::vec3(*expected.pole)), rounded);
                    }
                }
            }
    }
}

TEST(Trace, LogsOfManyMakersAreRead) {
    for (const Json& each : formats_of("makers")) {
        const Maker maker(each);
        for (unsigned seed = 0; seed < 6; seed += test::is_thorough() ? 1 : 3) {
            SCOPED_TRACE(maker.name);
            const MadeTrace made = TraceMaker(seed).make(seed < 3 ? Plant::Length : Plant::None);
            const Space& space = test::made::spaces[maker.space];
            std::string text = maker.header;
            for (std::size_t i = 0; i < made.frames.size(); ++i) {
                std::vector<glm::dvec3> joints;
                for (const glm::dvec3& joint : made.frames[i].joints) joints.push_back(space.of(joint));
                text += maker.print(joints, i);
            }
            ASSERT_EQ(trace_refusal(text), "read") << maker.name << '\n' << text.substr(0, 400);
            const ReadTrace found = read_trace(text);
            EXPECT_EQ(found.findings.chains[0].frames, made.frames.size()) << maker.name << '\n'
                                                                           << text.substr(0, 400);
            const Conventions& said = found.conventions;
            EXPECT_NE(said.text().find(maker.engine), std::string::npos) << maker.name << ": " << said.text();
            EXPECT_TRUE(!said.up.sure || trace_ups.name(said.up.value) == std::string(space.up))
                << maker.name;
            EXPECT_TRUE(!said.handed.sure || trace_hands.name(said.handed.value) == std::string(space.handed))
                << maker.name << ": " << said.text();
            EXPECT_TRUE(!said.unit.sure || trace_units.name(said.unit.value) == std::string(space.unit))
                << maker.name << ": " << said.text();
            ASSERT_EQ(found.incidents().size(), made.kind.empty() ? 0u : 1u) << maker.name << '\n'
                                                                             << found.text();
            if (made.kind.empty()) continue;
            EXPECT_EQ(found.incidents()[0].frame, made.frame) << maker.name;
            EXPECT_EQ(found.incidents()[0].joint, static_cast<std::size_t>(made.joint)) << maker.name;
            EXPECT_NEAR(found.incidents()[0].amount, made.amount, 5e-3) << maker.name;
        }
    }
}

}  // namespace
}  // namespace tendril::app
