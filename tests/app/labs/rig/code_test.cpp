// A rig as a C++ program: its text. tests/package/code.cmake checks that it compiles and poses every element
// as the lab does.
#include "app/labs/rig/code.hpp"

#include "rig_support.hpp"

namespace tendril::app {
namespace {

class RigCode : public RigTest {
  protected:
    std::string code() const { return rig_code(part()); }
    void expect_says(const std::string& what) const {
        EXPECT_NE(code().find(what), std::string::npos) << what << " is not in:\n" << code();
    }
    void expect_silent_about(const std::string& what) const {
        EXPECT_EQ(code().find(what), std::string::npos) << what << " is in:\n" << code();
    }
};

TEST_F(RigCode, WritesOnlyWhatDiffersFromTheDefaults) {
    element("bone 1");
    unit({{"unit", "offset_transform"},
          {"name", "shift"},
          {"item", "bone 1"},
          {"offset", transform(1, 0, 0)}});
    expect_says(".offset = rig::Transform{.translation = {1.0, 0.0, 0.0}}");
    for (const char* unsaid :
         {".weight", ".when", ".enabled", ".propagate", ".scale =", "state.controls", "held"})
        expect_silent_about(unsaid);
    run("rig.unit.set", {{"name", "shift"}, {"propagate", false}, {"weight", 0.5}, {"enabled", false}});
    for (const char* said : {".propagate = false", ".weight = 0.5", ".enabled = false"}) expect_says(said);
}

TEST_F(RigCode, IncludesSetValuesAndMemory) {
    run("rig.preset", {{"name", "secondary"}});
    expect_silent_about("state.controls");
    set("head", transform(0.5, 1, 0));
    run("rig.element.set", {{"name", "left 2"}, {"transform", transform(0, 0.25, 0)}});
    tick(5);
    expect_says(
        "state.controls[*made->element(\"head\")] = rig::Value(rig::Transform{.translation = {0.5, 1.0, "
        "0.0}");
    expect_says("state.elements.put(id(\"left 2\"), rig::Space::Local");
    expect_says("signal::SpringState<glm::dvec3>{.value = {");
}

TEST_F(RigCode, NamesAreWrittenSoThatTheyReadBack) {
    element("a \"b\" \\");
    expect_says(R"(.name = "a \"b\" \\")");
}

}  // namespace
}  // namespace tendril::app
