// Commands with hostile arguments in scripts: refused with a reason and an exit code, the document unchanged.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

struct Refusal {
    std::string line;  ///< the script line, without the closing brace
    std::string told;  ///< part of the reason
};

/// Each line is valid JSON. The labs' own tests cover the others.
const std::vector<Refusal>& refusals() {
    static const std::vector<Refusal> list{
        {R"({"command": "chain.add")", "length"},
        {R"({"command": "chain.add", "length": 1, "colour": "red")", "colour"},
        {R"({"command": "chain.insert", "index": 8, "length": 1)", "8"},
        {R"({"command": "chain.mode", "mode": "sideways")", "sideways"},
        {R"({"command": "chain.clear", "default_direction": [0, 0, 0])", "direction"},
        {R"({"command": "chain.seek", "tick": 4)", "path"},
        {R"({"command": "lab.open", "name": "kitchen")", "kitchen"},
        {R"({"command": "undo")", "undo"},
        {R"({"command": "scene.open", "path": "/no/such/scene.json")", "/no/such/scene.json"},
        {R"({"command": "scene.save", "path": "/no/such/folder/scene.json")", "/no/such/folder/scene.json"},
        {R"({"command": "scene.save")", "path"},
    };
    return list;
}

class Refused : public testing::Test {
  protected:
    Outcome run(const std::string& script) {
        write(folder_ / "script.jsonl", script);
        return run_here({"--headless", "--script", (folder_ / "script.jsonl").string(), "--state",
                         (folder_ / "state.json").string()});
    }
    std::string state() { return read(folder_ / "state.json"); }
    TempFolder folder_;
};

LABEL(slow, "Refused.ChangesNothingAndEndsTheScriptWith1");

TEST_F(Refused, ChangesNothingAndEndsTheScriptWith1) {
    EXPECT_TRUE(succeeded(run("{\"wait\": 1}\n")));
    const std::string before = state();
    for (const Refusal& refusal : refusals()) {
        const Outcome outcome = run("{\"wait\": 1}\n" + refusal.line + "}\n{\"command\": \"chain.clear\"}\n");
        EXPECT_TRUE(complained(outcome, 1, {"line 2", refusal.told})) << refusal.line;
        EXPECT_EQ(state(), before) << refusal.line;
    }
}

TEST_F(Refused, AsExpectedLetsTheScriptGoOn) {
    std::string script;
    for (const Refusal& refusal : refusals()) script += refusal.line + ", \"refused\": true}\n";
    script += "{\"command\": \"undo\", \"refused\": true}\n";  // they leave no step to undo
    EXPECT_TRUE(succeeded(run("{\"wait\": 1}\n")));
    const std::string before = state();
    EXPECT_EQ(run(script).exit_code, 0);
    EXPECT_EQ(state(), before);
}

TEST_F(Refused, WhereItWasAcceptedIsAFailure) {
    const Outcome outcome = run("{\"command\": \"chain.add\", \"length\": 1, \"refused\": true}\n");
    EXPECT_TRUE(complained(outcome, 1, {"line 1", "chain.add"}));
    EXPECT_FALSE(state().empty());
}

TEST_F(Refused, AFailedExpectationReportsTheValueAndWritesTheState) {
    struct Failing {
        const char* line;
        const char* found;
    };
    for (const Failing& failing : {Failing{R"({"expect": "mode", "equals": "forward"})", "backward"},
                                   Failing{R"({"expect": "moon", "equals": 1})", "moon"}}) {
        const Outcome outcome =
            run(std::string("{\"wait\": 1}\n") + failing.line + "\n{\"command\": \"chain.clear\"}\n");
        EXPECT_TRUE(complained(outcome, 1, {"line 2", failing.found})) << failing.line;
        EXPECT_EQ(app::parse_json(state())["segments"].size(), 8u) << failing.line;
    }
}

}  // namespace
}  // namespace tendril::test
