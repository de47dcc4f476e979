// `tendril trace` as a terminal runs it, and the writers that engines copy.
#include <regex>

#include "app/system/child_process.hpp"
#include "app/io/trace/trace.hpp"
#include "app/writers/tendril_trace.hpp"
#include "tests/app/io/trace_support.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

using made::Format;
using made::Plant;

class TraceProgram : public testing::Test {
  protected:
    std::string file(const char* name, Plant plant, Format format) const {
        const auto made = made::TraceMaker(5).make(plant);
        write(folder_ / name, made::written(made, made::spaces[0], format));
        return path(name);
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }
    /// The frames of a file, read without any given convention.
    static std::vector<app::TracedFrame> frames_of(const std::string& path) {
        std::ifstream in(path);
        app::TraceReader reader(in);
        std::vector<app::TracedFrame> frames;
        for (app::TracedFrame frame; reader.next(frame);) frames.push_back(frame);
        EXPECT_TRUE(reader.notes().empty());
        return frames;
    }
    TempFolder folder_;
};

TEST_F(TraceProgram, PrintsTheFrameJointAndCauseOfAFlip) {
    const Outcome outcome = run_here({"trace", file("arm.jsonl", Plant::FlipAtPole, Format::JsonLines)});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_TRUE(says(outcome.out, "arm.jsonl: 120 frames, 60 fps, Z up, left-handed, centimetres (given)"));
    EXPECT_TRUE(says(outcome.out, "Frame 60: flip at joint 1, degrees"));
    EXPECT_TRUE(says(outcome.out, "Two-bone flips on the same input"));
    EXPECT_TRUE(says(outcome.out, "prevented by: pole target moved by"));
    EXPECT_TRUE(says(outcome.out, "1 incident"));
}

TEST_F(TraceProgram, JsonListsWhatWouldHavePreventedAFlip) {
    const Outcome outcome =
        run_here({"trace", file("arm.jsonl", Plant::FlipAtPole, Format::JsonLines), "--json"});
    const app::Json flip = app::parse_json(outcome.out)[0];
    EXPECT_EQ(flip["flips_in"], "two_bone");
    ASSERT_FALSE(flip["prevented_by"].empty());
    EXPECT_EQ(flip["prevented_by"][0]["change"], "pole");
    // In the file's units: centimetres from the trace's pole target, not metres.
    const app::Json to = flip["prevented_by"][0]["to"];
    ASSERT_EQ(to.size(), 3u);
    const auto made = made::TraceMaker(5).make(Plant::FlipAtPole);
    const glm::dvec3 was = made::spaces[0].of(*made.frames[made.frame].pole);
    const double away = glm::distance(was, glm::dvec3(to[0], to[1], to[2]));
    EXPECT_GT(away, 0.01);
    EXPECT_LT(away, 30.0);
}

TEST_F(TraceProgram, ACleanTraceExitsWithZero) {
    const Outcome outcome = run_here({"trace", file("arm.csv", Plant::None, Format::Csv)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_TRUE(says(outcome.out, "0 incidents"));
}

TEST_F(TraceProgram, JsonIsOneArrayAndCsvHasARowEach) {
    const std::string arm = file("arm.csv", Plant::Length, Format::Csv);
    const Outcome json = run_here({"trace", arm, "--json", "--up", "z", "--unit", "cm"});
    EXPECT_EQ(json.exit_code, 1);
    const app::Json list = app::parse_json(json.out);
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0]["kind"], "length");
    EXPECT_EQ(list[0]["frame"], 60);
    EXPECT_EQ(list[0]["unit"], "metres");
    const Outcome csv = run_here({"trace", arm, "--csv", "--up", "z", "--unit", "cm"});
    EXPECT_TRUE(csv.out.starts_with("chain,frame,last_frame,joint,kind,amount,unit,cause\n")) << csv.out;
    EXPECT_EQ(count_lines(csv.out), 2);
}

TEST_F(TraceProgram, ErrorsNameTheFileAndLine) {
    write(folder_ / "empty.log", "");
    write(folder_ / "bad.jsonl", "{\"tendril\": \"trace\"}\n{\"joints\": [[0, 0, 0], [1, \"a\", 0]]}\n");
    EXPECT_TRUE(complained(run_here({"trace", path("empty.log")}), 2, {"empty.log", "has nothing in it"}));
    EXPECT_TRUE(complained(run_here({"trace", path("bad.jsonl")}), 2,
                           {"bad.jsonl", "line 2", "joints.1.1", "expected a number"}));
    EXPECT_TRUE(complained(run_here({"trace", path("missing.jsonl")}), 2, {"missing.jsonl"}));
    EXPECT_TRUE(complained(run_here({"trace", folder_.path().string()}), 2, {"is a folder"}));
    EXPECT_TRUE(complained(run_here({"trace", path("bad.jsonl"), "--up", "w"}), 2, {"--up"}));
}

TEST_F(TraceProgram, TheCppWriterIsRead) {
    {
        tendril_trace::Writer writer(path("cpp.jsonl").c_str(), "z", "left", "cm", 30.0);
        ASSERT_TRUE(writer.is_open());
        for (int i = 0; i < 3; ++i) {
            writer.begin(i / 30.0);
            writer.joint(0, 0, 140);
            writer.joint(i == 2 ? std::numeric_limits<double>::quiet_NaN() : 30.0, 0, 140);
            writer.target(30, 0, 140);
            writer.pole(0, 50, 140);
            writer.end();
        }
    }
    const auto frames = frames_of(path("cpp.jsonl"));
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_LT(glm::distance(frames[0].joints[1], glm::vec3(0.3f, 1.4f, 0.0f)), 1e-6f);
    EXPECT_LT(glm::distance(frames[0].pole.value(), glm::vec3(0.0f, 1.4f, 0.5f)), 1e-6f);
    EXPECT_TRUE(std::isnan(frames[2].joints[1].x));
}

TEST_F(TraceProgram, ThePythonWriterIsRead) {
    const auto python = app::find_program("python3");
    if (python.empty()) GTEST_SKIP() << "python3 is not installed";
    const std::string module = source_path("app/writers/tendril_trace.py");
    app::ChildProcess run({python.string(), "-B", "-c",
                           "import importlib.util as u, sys\n"
                           "s = u.spec_from_file_location('w', sys.argv[1]); w = u.module_from_spec(s); "
                           "s.loader.exec_module(w)\n"
                           "f = open(sys.argv[2], 'w')\n"
                           "w.write_header(f, 24, ['upper_arm'])\n"
                           "w.write_frame(f, 0.0, [(0, 0, 1), (0.5, 0, 1)], (0.5, 0, 1), (0, -1, 1))\n"
                           "w.write_frame(f, 1 / 24, [(0, 0, 1), (float('nan'), 0, 1)])\n"
                           "f.close()\n",
                           module, path("python.jsonl")});
    run.finish(30.0);
    const auto frames = frames_of(path("python.jsonl"));
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_LT(glm::distance(frames[0].pole.value(), glm::vec3(0.0f, 1.0f, 1.0f)), 1e-6f);
    EXPECT_TRUE(std::isnan(frames[1].joints[1].x));
}

// Its own solver flips where the target's line passes the pole.
TEST_F(TraceProgram, AChainInBlenderIsExplained) {
    const auto blender = app::find_program("blender");
    std::string trace = source_path("tests/app/io/traces/blender_arm.jsonl");
    if (!blender.empty()) {
        trace = path("blender.jsonl");
        app::ChildProcess run({blender.string(), "-b", "--factory-startup", "-P",
                               source_path("tests/app/io/traces/blender_arm.py"), "--",
                               source_path("app/writers/tendril_trace.py"), trace});
        run.finish(120.0);
    }
    const Outcome outcome = run_here({"trace", trace});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_TRUE(says(outcome.out, "60 frames, 60 fps, Z up, right-handed, metres (given)"));
    EXPECT_TRUE(says(outcome.out, "Frame 30: flip at joint 1 (lower_arm), degrees"));
    EXPECT_TRUE(says(outcome.out, "the target's line passed the pole"));
    EXPECT_TRUE(says(outcome.out, "1 incident"));
}

// The other writers' languages are not available here: reads the sample line in each writer's comment.
TEST_F(TraceProgram, TheSampleOfEveryWriterIsRead) {
    for (const char* name :
         {"tendril_trace.hpp", "tendril_trace.py", "TendrilTrace.cs", "tendril_trace.gd", "TendrilTrace.h"}) {
        const std::string source = read(source_path(std::string("app/writers/") + name));
        std::smatch sample, header;
        ASSERT_TRUE(std::regex_search(source, sample, std::regex("Writes: (\\{.*\\})"))) << name;
        write(folder_ / "sample.jsonl", sample[1].str() + "\n");
        const auto frames = frames_of(path("sample.jsonl"));
        ASSERT_EQ(frames.size(), 1u) << name;
        EXPECT_EQ(frames[0].joints.size(), 3u) << name;
        EXPECT_TRUE(frames[0].target && frames[0].pole) << name;
        // The code must write the sample's keys.
        for (const char* key : {"joints", "target", "pole", "tendril"})
            EXPECT_NE(source.find(key), std::string::npos) << name << ": " << key;
    }
}

}  // namespace
}  // namespace tendril::test
