// What each lab says first: in the inspector, and in the state.
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {
namespace {

class RopeVerdict : public LabTest {
  protected:
    RopeVerdict() : LabTest("rope") {}
    std::string said() const { return state()["verdict"]; }
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) lab().step(workspace);
    }
};

TEST_F(RopeVerdict, SaysWhetherLengthsHold) {
    run("rope.clear");
    EXPECT_EQ(said(), "No ropes");
    run("rope.preset", {{"name", "pendulum"}});
    EXPECT_EQ(said(), "Not moved yet");
    wait(60);
    EXPECT_EQ(said(), "Lengths hold");
    // A solver that does not hold them, with next to no iterations.
    run("rope.preset", {{"name", "bridge"}});
    run("rope.settings", {{"solver", "relaxation"}, {"iterations", 1}});
    wait(60);
    EXPECT_TRUE(said().starts_with("Lengths off by ")) << said();
}

class SignalVerdict : public LabTest {
  protected:
    SignalVerdict() : LabTest("signal") {}
    std::string said() const { return state()["verdict"]; }
};

TEST_F(SignalVerdict, SaysHowTheChainFollows) {
    EXPECT_TRUE(said().starts_with("Settles in ")) << said();
    run("signal.preset", {{"name", "spring_that_explodes"}});
    EXPECT_EQ(said(), "Runs away");
    while (!state()["filters"].empty()) run("signal.filter.remove", {{"at", 0}});
    EXPECT_EQ(said(), "No filter is on");
}

class RigVerdict : public LabTest {
  protected:
    RigVerdict() : LabTest("rig") {}
    std::string said() const { return state()["verdict"]; }
};

TEST_F(RigVerdict, SaysWhetherEveryUnitRan) {
    run("rig.solve");
    EXPECT_EQ(said(), "All units ran");
    // The target of an aim onto the head itself: there is no direction to it.
    run("rig.clear");
    EXPECT_EQ(said(), "No units");
    run("rig.element.add", {{"name", "a"}});
    run("rig.element.add", {{"name", "b"}});
    run("rig.unit.add", {{"unit", "aim"}, {"item", "a"}, {"primary", {{"target", "b"}}}});
    run("rig.solve");
    EXPECT_EQ(said(), "1 unit left out");
}

class HumanoidVerdict : public LabTest {
  protected:
    HumanoidVerdict() : LabTest("humanoid") {}
    std::string said() const { return state()["verdict"]; }
};

TEST_F(HumanoidVerdict, SaysWhetherItReaches) {
    EXPECT_EQ(said(), "A whole body");
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.5, 1.2, 0.2}}});
    EXPECT_EQ(said(), "Reached");
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {9, 1.2, 0.2}}});
    EXPECT_TRUE(said().ends_with(" short")) << said();
}

}  // namespace
}  // namespace tendril::app
