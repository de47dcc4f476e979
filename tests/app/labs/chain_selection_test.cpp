// Several joints at once: selecting, limiting, lengthening, removing.
#include "app/labs/chain/draw.hpp"
#include "tests/app/labs/chain_support.hpp"

namespace tendril::app {
namespace {

class ChainSelection : public ChainTest {
  protected:
    using Indices = std::vector<std::size_t>;
    const Indices& selected() const { return part().selection.all(); }
    ik::JointKind kind(std::size_t joint) const { return limit_of(part().reach, joint).kind; }
};

TEST_F(ChainSelection, LimitsApplyToAllAndEachKeepsOmittedValues) {
    reach_with(6);
    run("chain.limit",
        {{"index", 1}, {"kind", "hinge"}, {"axis", {0, 0, 1}}, {"min_deg", -10}, {"max_deg", 90}});
    run("chain.limit",
        {{"index", 3}, {"kind", "hinge"}, {"axis", {0, 1, 0}}, {"min_deg", 0}, {"max_deg", 120}});
    run("chain.limit", {{"joints", {1, 3}}, {"max_deg", 45}});
    EXPECT_EQ(kind(1), ik::JointKind::Hinge);
    EXPECT_EQ(limit_of(part().reach, 1).axis, glm::vec3(0, 0, 1));
    EXPECT_EQ(limit_of(part().reach, 3).axis, glm::vec3(0, 1, 0));
    EXPECT_EQ(kind(2), ik::JointKind::Free);
    EXPECT_FLOAT_EQ(limit_of(part().reach, 1).max, glm::radians(45.0f));
    EXPECT_FLOAT_EQ(limit_of(part().reach, 3).max, glm::radians(45.0f));
    EXPECT_FLOAT_EQ(limit_of(part().reach, 1).min, glm::radians(-10.0f));
    run("chain.limit", {{"joints", {0, 2, 4}}, {"kind", "hinge"}});
    for (const std::size_t joint : {0u, 1u, 2u, 3u, 4u})
        EXPECT_EQ(kind(joint), ik::JointKind::Hinge) << joint;
    run("undo");
    EXPECT_EQ(kind(2), ik::JointKind::Free) << "one step for all";
    EXPECT_EQ(kind(1), ik::JointKind::Hinge);
}

TEST_F(ChainSelection, DeleteRemovesAllOfThem) {
    const std::size_t size = part().chain.size();
    run("chain.set_length", {{"index", 4}, {"length", 0.5}});
    run("chain.select", {{"joints", {1, 3, 6}}});
    run("chain.remove_selected");
    EXPECT_EQ(part().chain.size(), size - 3);
    EXPECT_FLOAT_EQ(part().chain.length(2), 0.5f) << "the fourth is the second now";
    EXPECT_TRUE(selected().empty());
    expect_refused("chain.remove_selected", Json::object(), {"no joint is selected"});
    run("undo");
    EXPECT_EQ(part().chain.size(), size);
    run("chain.select", {{"joints", {0, 1, 2, 3, 4, 5, 6, 7}}});
    run("chain.remove_selected");
    EXPECT_TRUE(part().chain.empty());
}

/// One by one this would take hours and run out of time.
TEST_F(ChainSelection, ThousandsAreSetAtOnce) {
    run("chain.preset", {{"name", "start"}, {"count", 100'000}});
    run("chain.mode", {{"mode", "reach"}});
    Json most = Json::array();
    for (std::size_t i = part().chain.size() - 1; i-- > 10;) most.push_back(i);
    run("chain.set_length", {{"joints", most}, {"length", 0.5}});
    EXPECT_FLOAT_EQ(part().chain.length(50'000), 0.5f);
    EXPECT_FLOAT_EQ(part().chain.length(5), 1.0f);
    run("chain.limit", {{"joints", most}, {"kind", "free"}});
    EXPECT_TRUE(part().reach.limits.empty());
    run("chain.limit", {{"joints", most}, {"kind", "hinge"}});
    EXPECT_EQ(kind(99'998), ik::JointKind::Hinge);
    run("chain.limit", {{"joints", most}, {"kind", "free"}});
    EXPECT_TRUE(part().reach.limits.empty());
    run("chain.select", {{"joints", most}});
    run("chain.remove_selected");
    EXPECT_EQ(part().chain.size(), 11u) << "the first ten, and the tail";
}

TEST_F(ChainSelection, RemovedTogetherOrOneByOneTheSameLimitsStay) {
    for (const std::vector<std::size_t>& gone :
         {std::vector<std::size_t>{1, 3}, {0, 2, 5}, {6, 7}, {0, 7}, {2, 3, 4}}) {
        std::vector<Json> left;
        for (const bool together : {true, false}) {
            reach_with(7);
            for (int i = 0; i < 7; ++i)
                run("chain.limit",
                    {{"index", i}, {"kind", "hinge"}, {"axis", {0, 0, 1}}, {"max_deg", 10 + i}});
            run("chain.mode", {{"mode", "with_index"}, {"index", 4}});
            if (together) run("chain.select", {{"joints", gone}});
            if (together) run("chain.remove_selected");
            for (std::size_t i = gone.size(); !together && i-- > 0;)
                run("chain.remove", {{"index", gone[i]}});
            Json& found = left.emplace_back(Json{part().index, part().chain.size()});
            for (const ik::Limit& limit : part().reach.limits) found.push_back(limit.max);
            run("chain.mode", {{"mode", "reach"}});
        }
        EXPECT_EQ(left[0], left[1]) << gone.front();
    }
}

TEST_F(ChainSelection, OtherIndicesAreRefusedAndChangeNothing) {
    reach_with(4);
    run("chain.select", {{"joints", {1, 2}}});
    const Json joints_that_are_none = Json::array({{0, 9}, {-1}, {0.5}, {"tip"}, {nullptr}, {{0}}, {1e300}});
    for (const Json& joints : joints_that_are_none)
        for (const char* command : {"chain.select", "chain.limit", "chain.set_length"}) {
            Json arguments{{"joints", joints}};
            if (std::string(command) == "chain.set_length") arguments["length"] = 1;
            EXPECT_FALSE(refused(command, arguments).empty()) << command << joints;
        }
    expect_refused("chain.limit", {{"joints", {1, 4}}, {"kind", "hinge"}}, {"tail"});
    refused("chain.limit", {{"joints", Json::array()}, {"kind", "hinge"}});
    refused("chain.set_length", {{"joints", Json::array()}, {"length", 1}});
    expect_refused("chain.limit", {{"kind", "hinge"}}, {"either index or joints"});
    expect_refused("chain.select", {{"index", 1}, {"joints", {1}}}, {"either index or joints"});
    expect_refused("chain.select", {{"point", "pole"}}, {"no pole"});
    refused("chain.select", {{"point", "target"}, {"index", 1}});
}

TEST_F(ChainSelection, TheTargetOrThePoleInsteadOfJoints) {
    reach_with(3);
    run("chain.pole", {{"to", {0, 2, 0}}});
    EXPECT_FALSE(lab().gizmo(workspace));
    run("chain.select", {{"joints", {1, 2}}});
    EXPECT_EQ(lab().gizmo(workspace)->name, "segment.2") << "of several, at the active one";
    run("chain.select", {{"index", 1}});
    EXPECT_EQ(lab().gizmo(workspace)->name, "segment.1");
    run("chain.select", {{"point", "target"}});
    EXPECT_TRUE(selected().empty());
    EXPECT_EQ(state()["selected"], "target");
    EXPECT_EQ(lab().gizmo(workspace)->name, "target");
    run("chain.select", {{"point", "pole"}});
    EXPECT_EQ(lab().gizmo(workspace)->name, "pole");
    run("chain.mode", {{"mode", "forward"}});
    EXPECT_FALSE(lab().gizmo(workspace)) << "the pole is for mode reach";
    run("chain.mode", {{"mode", "reach"}});
    run("chain.pole", {{"off", true}});
    EXPECT_FALSE(lab().gizmo(workspace));
    EXPECT_TRUE(state()["selected"].is_null());
    run("chain.pole", {{"to", {0, 3, 0}}});
    run("chain.preset", {{"name", "snake"}});
    EXPECT_FALSE(part().reach.options.pole) << "a preset begins without one";
}

TEST_F(ChainSelection, AMomentWithFewerJointsKeepsTheRestOfTheSelection) {
    ChainPart then = part();
    then.chain = Chain();
    ChainPart now = part();
    now.selection.take({0, 5}, false);
    const auto shown = now.at_moment(std::make_shared<ChainPart>(then));
    EXPECT_TRUE(dynamic_cast<const ChainPart&>(*shown).selection.empty());
}

}  // namespace
}  // namespace tendril::app
