// A trace from an engine, opened in the Chain lab: the strip is the trace, with its marks.
#include "app/labs/chain/engine_trace.hpp"

#include <cstdio>
#include <fstream>
#include <limits>

#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/panel.hpp"
#include "tests/app/io/trace_support.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

using test::made::Format, test::made::MadeFrame, test::made::MadeTrace, test::made::Plant;

class ChainTrace : public ChainTest {
  protected:
    std::string file(const char* name, const MadeTrace& made, Format format) {
        return write(name, test::made::written(made, test::made::spaces[0], format));
    }
    std::string file(const char* name, Plant plant, Format format = Format::JsonLines) {
        return file(name, test::made::TraceMaker(5).make(plant), format);
    }
    std::vector<Incident> flips() const {
        std::vector<Incident> all;
        std::ranges::copy_if(workspace.rewind.incidents(), std::back_inserter(all),
                             [](const Incident& each) { return each.kind == Incident::Kind::Flip; });
        return all;
    }
    /// Opens a trace with this incident.
    MadeTrace opened(int seed, Plant plant) {
        MadeTrace made = test::made::TraceMaker(seed).make(plant);
        run("chain.trace", {{"path", file("arm.jsonl", made, Format::JsonLines)}});
        return made;
    }
};

TEST_F(ChainTrace, EachFrameIsAMomentAndAFlipIsMarkedWithItsCauseAndCure) {
    const MadeTrace made = test::made::TraceMaker(5).make(Plant::FlipAtPole);
    run("file.open", {{"path", file("arm.jsonl", made, Format::JsonLines)}});
    EXPECT_EQ(workspace.lab, chain_lab);
    ASSERT_EQ(workspace.rewind.size(), made.frames.size());
    EXPECT_EQ(workspace.moment, made.frame) << "it opens where it goes wrong";
    EXPECT_TRUE(test::says(lab().invitation(workspace), "Drag strip frame"));
    EXPECT_TRUE(workspace.ui.incident);
    for (std::size_t i = 0; i < made.frames.size(); ++i) {
        const auto& then = dynamic_cast<const ChainPart&>(*workspace.rewind.moments()[i].part);
        for (std::size_t j = 0; j < 3; ++j)
            EXPECT_LT(glm::distance(then.chain.position(j), glm::vec3(made.frames[i].joints[j])), 1e-4f);
        EXPECT_LT(glm::distance(then.target, glm::vec3(made.frames[i].target)), 1e-4f);
    }
    ASSERT_EQ(flips().size(), 1u);
    EXPECT_EQ(flips()[0].tick + 1, made.frame);
    EXPECT_EQ(flips()[0].joint, 1u);
    EXPECT_NE(flips()[0].cause.find("pole"), std::string::npos);
    ASSERT_FALSE(flips()[0].buttons.empty());
    EXPECT_NE(flips()[0].buttons[0].text.find("Pole target moved by"), std::string::npos);
    run("time.incident", {{"number", 0}});
    EXPECT_TRUE(workspace.ui.incident);
    EXPECT_EQ(workspace.moment, made.frame);
    // In a row too narrow for all of it, the amount stays.
    workspace.rewind.note(
        {.cause = "the pole",
         .title = "Frame 1: flip at joint 1 (a_bone_whose_name_leaves_no_room), 57 degrees"});
    EXPECT_NE(test::PanelReader().inspector(lab(), workspace).find("Frame 1: flip at joint 1, 57 degrees"),
              std::string::npos);
}

TEST_F(ChainTrace, TheTitleIsTheFirstIncidentAndEveryFrameIsInView) {
    MadeTrace made = test::made::TraceMaker(5).make(Plant::FlipAtPole);
    made.frames[20].joints[2].x = std::numeric_limits<double>::quiet_NaN();
    run("chain.trace", {{"path", file("arm.jsonl", made, Format::JsonLines)}});
    EXPECT_EQ(workspace.moment, 20u);
    EXPECT_TRUE(chain_verdict(part()).text.starts_with("Frame 20: NaN at joint 2"))
        << chain_verdict(part()).text;
    EXPECT_TRUE(workspace.ui.incident->title.starts_with("Frame 20: NaN at joint 2"));
    EXPECT_TRUE(flips()[0].title.starts_with("Frame 60: flip at joint 1")) << flips()[0].title;
    const Bounds bounds = ChainLab().bounds(workspace, false);
    for (const MadeFrame& frame : made.frames)
        EXPECT_LE(glm::distance(glm::vec3(frame.target), bounds.centre), bounds.radius);
    EXPECT_FALSE(workspace.ui.incident_chosen) << "the inspector would scroll its title away";
    EXPECT_EQ(workspace.camera.target, bounds.centre);
    run("time.incident", {{"number", 1}});
    EXPECT_EQ(chain_verdict(part()).text, flips()[0].title) << "and of the shown frame, if that has one";
}

TEST_F(ChainTrace, CodeIsInTheTracesAxesAndUnitWithTheChosenCure) {
    MadeTrace made = test::made::TraceMaker(5).make(Plant::FlipAtPole);
    for (std::size_t i = 0; i < made.frames.size(); ++i) {  // its root moves
        const glm::dvec3 by(0.01 * static_cast<double>(i), 0.0, 0.0);
        for (glm::dvec3& joint : made.frames[i].joints) joint += by;
        made.frames[i].target += by;
        *made.frames[i].pole += by;
    }
    run("chain.trace", {{"path", file("arm.jsonl", made, Format::JsonLines)}});
    run("chain.trace", {{"soft_zone", 0.05}, {"hinge", 1}, {"pole_by", {0, 0.02, 0}}});
    const std::string code = chain_code(part());
    EXPECT_NE(code.find("Its pole target is 2 cm from the trace's."), code.npos) << code;
    EXPECT_NE(code.find("Z up, left-handed, centimetres"), code.npos) << code;
    EXPECT_NE(code.find("options.soft_zone = 0.05f;"), code.npos) << code;
    EXPECT_NE(code.find("limits[1]"), code.npos) << code;
    // Z up and left-handed: Y and Z change places.
    const auto expect_point = [&](std::size_t at, const char* format, const glm::dvec3& is) {
        glm::vec3 p(0.0f);
        ASSERT_NE(at, code.npos);
        ASSERT_EQ(std::sscanf(code.c_str() + at, format, &p.x, &p.y, &p.z), 3) << code;
        EXPECT_LT(glm::distance(p, 100.0f * glm::vec3(is.x, is.z, is.y)), 1e-2f);
    };
    const MadeFrame &first = made.frames[0], &now = made.frames[traced_pose(part())->frame];
    expect_point(code.find("target{"), "target{%ff, %ff, %ff}", now.target);
    std::size_t at = code.find("segments{");
    for (const glm::dvec3& joint : first.joints) {
        at = code.find("{{", at + 1);
        expect_point(at, "{{%ff, %ff, %ff}", joint + now.joints[0] - first.joints[0]);
    }
    EXPECT_NE(code.find("%g cm from the target"), code.npos) << code;
}

TEST_F(ChainTrace, TheGhostIsTendrilsSolveUntilTheChainIsChanged) {
    run("chain.trace", {{"path", file("arm.jsonl", Plant::FlipForNothing)}});
    run("time.seek", {{"ticks_back", 100}});
    const auto* ghost = traced_pose(part());
    ASSERT_NE(ghost, nullptr);
    for (std::size_t j = 0; j < 3; ++j)
        EXPECT_LT(glm::distance(ghost->ghost[j], part().chain.position(j)), 0.01f * part().chain.reach())
            << "the same pose, until the engine's chain flips";
    run("time.seek", {{"ticks_back", 0}});
    ghost = traced_pose(part());
    ASSERT_NE(ghost, nullptr);
    EXPECT_GT(glm::distance(ghost->ghost[1], part().chain.position(1)), 0.2f * part().chain.reach());
    run("time.seek", {{"ticks_back", 90}});
    const std::size_t moments = workspace.rewind.size();
    run("chain.target", {{"to", point(part().target + glm::vec3(0.0f, 0.05f, 0.0f))}});
    EXPECT_EQ(traced_pose(part()), nullptr);
    EXPECT_LT(workspace.rewind.size(), moments) << "it goes on from there";
}

TEST_F(ChainTrace, PreventionsOfAFlipAreTriedAndAClickShowsOne) {
    run("chain.trace", {{"path", file("arm.jsonl", Plant::FlipAtPole)}, {"solver", "two_bone"}});
    ASSERT_EQ(flips().size(), 1u);
    const Incident flip = flips()[0];
    EXPECT_NE(flip.cure.find("Two-bone flips on the same input"), std::string::npos) << flip.cure;
    run("time.incident", {{"number", 0}});
    const std::uint64_t moment = workspace.moment;
    const auto bends = [&](int back) {
        run("time.seek",
            {{"ticks_back", static_cast<int>(workspace.rewind.newest() - flip.tick) + back - 1}});
        const TracedPose* const pose = traced_pose(part());
        EXPECT_NE(pose, nullptr);
        return glm::cross(pose->ghost[1] - pose->ghost[0], pose->ghost[2] - pose->ghost[0]);
    };
    EXPECT_LT(glm::dot(bends(-3), bends(1)), 0.0f) << "the ghost flips, too, in three frames";
    run("time.incident", {{"number", 0}});
    for (const Cure& cure : flip.buttons) {
        for (const CommandCall& call : cure.calls) run(call.name.c_str(), to_json(call.arguments));
        EXPECT_EQ(workspace.moment, moment) << "the frame stays";
        EXPECT_EQ(workspace.rewind.size(), 120u) << "and those after it";
        EXPECT_TRUE(workspace.ui.incident) << "and the list of what prevents it";
        EXPECT_NE(workspace.ui.toasts.back().text.find("no flip"), std::string::npos) << cure.text;
    }
}

TEST_F(ChainTrace, ConventionsCanBeChangedWhileItIsShown) {
    run("chain.trace", {{"path", file("arm.csv", Plant::None, Format::Csv)}});
    ASSERT_NE(traced_pose(part()), nullptr);
    const Conventions guessed = traced_pose(part())->trace->conventions;
    EXPECT_NE(guessed.text().find("not sure"), std::string::npos) << guessed.text();
    const glm::vec3 before = part().chain.position(2);
    run("chain.trace", {{"unit", "mm"}, {"up", guessed.up.value == TraceUp::Y ? "z" : "y"}});
    const Conventions given = traced_pose(part())->trace->conventions;
    EXPECT_EQ(given.unit.reason, "given");
    EXPECT_NE(given.up.value, guessed.up.value);
    const float ratio = glm::length(before) / glm::length(part().chain.position(2));
    EXPECT_NEAR(ratio, static_cast<float>(guessed.metres() / given.metres()), 1e-2f * ratio);
    run("chain.trace", {{"up", trace_ups.name(guessed.up.value)}});
    EXPECT_EQ(traced_pose(part())->trace->conventions.unit.value, TraceUnit::Millimetres) << "it stays";
    run("chain.preset", {{"name", "start"}});
    EXPECT_NE(refused("chain.trace", {{"up", "z"}}).find("no trace is shown"), std::string::npos);
}

TEST_F(ChainTrace, TheStripIsSavedAsATraceThatIsReadBack) {
    const MadeTrace made = opened(5, Plant::FlipAtPole);
    const std::string saved = (folder_ / "saved.jsonl").string();
    run("chain.save_trace", {{"path", saved}});
    std::ifstream in(saved);
    TraceReader reader(in);
    EXPECT_TRUE(reader.conventions().up.sure && reader.conventions().unit.sure);
    const TraceFindings findings = find_incidents(reader);
    ASSERT_EQ(findings.chains.size(), 1u);
    EXPECT_EQ(findings.chains[0].frames, made.frames.size());
    ASSERT_EQ(findings.chains[0].incidents.size(), 1u);
    EXPECT_EQ(findings.chains[0].incidents[0].frame, made.frame);
    EXPECT_EQ(findings.chains[0].incidents[0].flip, ik::FlipCause::PassedPole);
    run("time.seek", {{"ticks_back", 0}});
    run("chain.save_trace", {{"path", (folder_ / "newest.jsonl").string()}});
    EXPECT_EQ(tendril::test::read(folder_ / "newest.jsonl"), tendril::test::read(folder_ / "saved.jsonl"));
    run("chain.clear", {});
    EXPECT_NE(refused("chain.save_trace", {{"path", saved}}).find("no bone"), std::string::npos);
}

TEST_F(ChainTrace, AFrameThatIsNotFiniteHoldsThePoseBefore) {
    const MadeTrace made = opened(6, Plant::NanForNothing);
    EXPECT_TRUE(std::ranges::any_of(workspace.rewind.incidents(), [&](const Incident& each) {
        return each.tick + 1 == made.frame && test::has(each.title, "NaN at joint");
    }));
    const glm::vec3 held(made.frames[made.frame - 1].joints[1]);
    EXPECT_LT(glm::distance(part().chain.position(1), held), 1e-4f);
}

TEST_F(ChainTrace, ATargetOrPoleThatIsNotFiniteIsHeldOrLeftOut) {
    const std::string start =
                          R"({"joints":[[0,0,0],[1,0.2,0],[2,0,0]],"target":[null,0,0],"pole":[0,null,1]})",
                      good = R"({"joints":[[0,0,0],[1,0.2,0],[2,0,0]],"target":[2,0,0],"pole":[0,1,0]})",
                      none = R"({"joints":[[0,0,0],[1,0.2,0],[2,0,0]]})";
    run("chain.trace", {{"text", start + "\n" + good + "\n" + none + "\n" + start}});
    const std::vector<TracedFrame>& frames = traced_pose(part())->trace->frames;
    ASSERT_EQ(frames.size(), 4u);
    EXPECT_FALSE(frames[0].target || frames[0].pole) << "none was finite so far";
    EXPECT_FALSE(frames[2].target || frames[2].pole);
    EXPECT_EQ(frames[3].target, frames[1].target);
    EXPECT_EQ(frames[3].pole, frames[1].pole);
    for (const auto& each : workspace.rewind.moments()) {
        const auto& then = dynamic_cast<const ChainPart&>(*each.part);
        EXPECT_TRUE(is_finite_point(then.target));
        EXPECT_TRUE(!then.reach.options.pole || is_finite_point(*then.reach.options.pole));
    }
}

TEST_F(ChainTrace, ALongTraceIsShownAroundItsFirstIncidentOrFromAFrame) {
    MadeTrace made = test::made::TraceMaker(7).make(Plant::FlipForNothing);
    made.frames.insert(made.frames.begin(), 2000, made.frames.front());
    const std::string path = file("long.jsonl", made, Format::JsonLines);
    run("chain.trace", {{"path", path}});
    ASSERT_EQ(flips().size(), 1u);
    EXPECT_EQ(flips()[0].tick, Rewind::max_ticks / 2 - 1);
    run("chain.trace", {{"path", path}, {"from", 10}});
    EXPECT_TRUE(flips().empty());
    const std::string& said = workspace.ui.toasts.back().text;
    EXPECT_TRUE(test::says(said, "shown frames 10 to 609 with 0")) << said;
    EXPECT_EQ(said.find("flip"), std::string::npos) << said << ": it is not among those";
    EXPECT_EQ(workspace.rewind.size() + 1, Rewind::max_ticks);
    // One page further; the trace is not searched again.
    run("chain.trace", {{"from", 1700}});
    ASSERT_EQ(flips().size(), 1u);
    EXPECT_EQ(flips()[0].tick, 2060u - 1700u - 1u);
    const ShownTrace& trace = *traced_pose(part())->trace;
    EXPECT_EQ(trace.all, made.frames.size());
    EXPECT_EQ(trace.view.from, 1700);
    EXPECT_LT(glm::distance(trace.frames[0].joints[1], glm::vec3(made.frames[1700].joints[1])), 1e-4f);
}

TEST_F(ChainTrace, PastedTextIsReadAsATraceIfItIsOne) {
    const MadeTrace made = test::made::TraceMaker(8).make(Plant::None);
    const std::string text = test::made::written(made, test::made::spaces[1], Format::BareJsonLines);
    const TakenText taken = ChainLab().takes_text(text);
    ASSERT_TRUE(taken.command);
    EXPECT_EQ(taken.command->name, "chain.trace");
    run("chain.trace", {{"text", text}});
    EXPECT_EQ(part().chain.size(), 3u);
    for (const char* points : {"1 2 3", "0 0 0\n1 0 0\n2 0 0\n", "[[0,0,0],[1,0,0]]"})
        EXPECT_EQ(ChainLab().takes_text(points).command->name, "chain.paste") << points;
}

TEST_F(ChainTrace, TracesThatCannotBeShownAreRefusedAndNothingIsLost) {
    const Chain before = part().chain;
    refuses("chain.trace", {}, "path or text");
    refuses("chain.trace", {{"path", "missing.jsonl"}}, "missing.jsonl");
    refuses("chain.trace", {{"text", "{\"joints\": [[null, 0, 0], [1, 0, 0]]}"}}, "finite");
    refuses("chain.trace", {{"path", file("arm.jsonl", Plant::None)}, {"chain", "left"}}, "left");
    EXPECT_EQ(part().chain, before);
}

}  // namespace
}  // namespace tendril::app
