// The tree itself: order, handles, reparenting, and refusals.
#include "rig_line.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace rig;
using enum Space;

TEST(RigElements, ElementsAreFoundInTheOrderOfAdding) {
    RigLine line;
    const Hierarchy& tree = line.tree;
    EXPECT_EQ(tree.first_child({}), line.root);
    EXPECT_EQ(tree.last_child({}), line.root);
    EXPECT_EQ(tree.first_child(line.middle), line.tip);
    EXPECT_EQ(tree.last_child(line.middle), line.other);
    EXPECT_EQ(tree.next_sibling(line.tip), line.other);
    EXPECT_EQ(tree.previous_sibling(line.other), line.tip);
    EXPECT_FALSE(tree.next_sibling(line.other));
    EXPECT_EQ(tree.child_count(line.middle), 2u);
    EXPECT_EQ(tree.child_count({}), 1u);
    EXPECT_EQ(tree.parent(line.tip), line.middle);
    EXPECT_FALSE(tree.parent(line.root));
    std::vector<ElementId> walked;
    for (ElementId at = line.root; at; at = tree.next_depth_first(at, line.root)) walked.push_back(at);
    EXPECT_EQ(walked, (std::vector{line.root, line.middle, line.tip, line.other}));
    EXPECT_FALSE(tree.next_depth_first(line.tip, line.tip));
}

TEST(RigElements, AHandleOfWhatIsGoneFindsNothing) {
    RigLine line;
    ASSERT_TRUE(line.tree.remove(line.middle).ok());
    EXPECT_EQ(line.tree.size(), 1u);
    EXPECT_EQ(line.tree.child_count(line.root), 0u);
    for (const ElementId gone : {line.middle, line.tip, line.other}) EXPECT_FALSE(line.tree.contains(gone));
    const ElementId next = *line.tree.add(ElementKind::Control, line.root, {});
    EXPECT_EQ(line.tree.kind(next), ElementKind::Control);
    EXPECT_FALSE(line.tree.contains(line.middle));
    EXPECT_TRUE(test::says(line.tree.remove(line.tip).message(), "remove element handle slot 2"));
    EXPECT_EQ(line.tree.set(line.tip, Local, {}).code(), ErrorCode::OutOfRange);
    line.tree.clear();
    EXPECT_EQ(line.tree.size(), 0u);
    EXPECT_FALSE(line.tree.contains(line.root));
}

TEST(RigElements, RefusesWithoutChangingAnything) {
    RigLine line;
    const Hierarchy before = line.tree;
    const auto refused = [&](const Result& result, const char* message) {
        EXPECT_STREQ(result.message(), message);
        EXPECT_TRUE(line.tree == before);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Transform bad;
    bad.scale.y = 0.0;
    refused(line.tree.set(line.tip, Global, bad), "set: transform.scale.y must be non-zero, got 0");
    refused(line.tree.add(ElementKind::Bone, line.tip, bad).error(),
            "add: local.scale.y must be non-zero, got 0");
    bad = moved(0, nan, 0);
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.translation.y must be finite and at most 1e9 in magnitude, got nan");
    bad = moved(2e9, 0, 0);
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.translation.x must be finite and at most 1e9 in magnitude, got 2e+09");
    bad = {};
    bad.rotation = {0.0, 0.0, 0.0, 0.0};
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.rotation must be of length 1e-6 or more, got 0");
    refused(line.tree.set_parent(line.middle, line.tip),
            "set_parent: parent must be neither the element itself nor below it, got slot 2");
    refused(line.tree.set_parent(line.middle, line.middle),
            "set_parent: parent must be neither the element itself nor below it, got slot 1");
    refused(line.tree.set_parent(line.middle, {9, 1}),
            "set_parent: parent must be the handle of an existing element, got slot 9");
    refused(line.tree.add(ElementKind::Bone, {9, 1}, {}).error(),
            "add: parent must be the handle of an existing element, got slot 9");
    refused(line.tree.remove({}),
            "remove: element must be the handle of an existing element, got an empty handle");
}

TEST(RigElements, AnotherParentKeepsThePlaceOrTheLocal) {
    for (const Space keep : {Local, Global}) {
        RigLine line;
        line.expect_set(line.other, Global, moved(4, 4, 4), Propagate::Yes);
        const Transform local = line.tree.get(line.tip, Local), global = line.tree.get(line.tip, Global);
        ASSERT_TRUE(line.tree.set_parent(line.tip, line.other, keep).ok());
        EXPECT_TRUE(same_bits(line.tree.get(line.tip, keep), keep == Local ? local : global));
        EXPECT_EQ(line.at(line.tip), keep == Local ? glm::dvec3(4, 5, 4) : glm::dvec3(0, 3, 0));
        EXPECT_EQ(line.tree.first_child(line.other), line.tip);
        ASSERT_TRUE(line.tree.set_parent(line.tip, {}, keep).ok());
        EXPECT_EQ(line.tree.last_child({}), line.tip);
        EXPECT_EQ(line.tree.get(line.tip, Local), line.tree.get(line.tip, Global));
    }
}

TEST(RigElementsDeathTest, ReadingWhatIsNotThereEndsTheProgramWithAMessage) {
    RigLine line;
    EXPECT_DEATH(line.tree.get({}, Local), "get: element must be the handle of an existing element");
}

}  // namespace
}  // namespace tendril::test
