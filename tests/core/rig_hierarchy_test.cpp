// What each write leaves pending, what it costs, what is refused.
#include <string>

#include "memory.hpp"
#include "rig_support.hpp"

namespace tendril::test {
namespace {

using namespace rig;
using enum Space;

/// Three in a line, one metre apart along Y, and a fourth beside the last; all read.
struct Line {
    Hierarchy tree;
    ElementId root = *tree.add(ElementKind::Bone, {}, moved(0, 1, 0));
    ElementId middle = *tree.add(ElementKind::Bone, root, moved(0, 1, 0));
    ElementId tip = *tree.add(ElementKind::Bone, middle, moved(0, 1, 0));
    ElementId other = *tree.add(ElementKind::Bone, middle, moved(1, 0, 0));
    Line() { tree.resolve_all(); }

    std::string flags() const {
        std::string text;
        for (const ElementId each : {root, middle, tip, other}) text += name(tree.pending(each))[0];
        return text;
    }
    void expect_set(ElementId element, Space space, const Transform& value, Propagate propagate) {
        const Result result = tree.set(element, space, value, propagate);
        EXPECT_TRUE(result.ok()) << result.message();
    }
    glm::dvec3 at(ElementId element, Space space = Global) { return tree.get(element, space).translation; }
};

TEST(RigHierarchy, EachWriteMakesPendingWhatThePageSays) {
    Line line;
    EXPECT_EQ(line.flags(), "nnnn");
    line.expect_set(line.middle, Global, moved(5, 2, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "nlgg");
    line = Line();
    line.expect_set(line.middle, Global, moved(5, 2, 0), Propagate::No);
    EXPECT_EQ(line.flags(), "nlll");
    line = Line();
    line.expect_set(line.root, Global, moved(5, 2, 0), Propagate::No);
    EXPECT_EQ(line.flags(), "llnn") << "only the first level is touched";
    line = Line();
    line.expect_set(line.middle, Local, moved(5, 2, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "nggg");
    line = Line();
    line.expect_set(line.middle, Local, moved(5, 2, 0), Propagate::No);
    EXPECT_EQ(line.flags(), "nnll");
}

TEST(RigHierarchy, ReadingWorksOutWhatIsPendingAboveAndNothingElse) {
    Line line;
    line.expect_set(line.root, Global, moved(3, 1, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "lggg");
    EXPECT_EQ(line.at(line.tip), glm::dvec3(3, 3, 0));
    EXPECT_EQ(line.flags(), "lnng");
    EXPECT_EQ(line.at(line.root, Local), glm::dvec3(3, 1, 0));
    EXPECT_EQ(line.flags(), "nnng");
}

TEST(RigHierarchy, ALocalThatWaitsIsWorkedOutBeforeItsParentMoves) {
    Line line;
    line.expect_set(line.tip, Global, moved(0, 5, 0), Propagate::Yes);  // 3 above its parent
    EXPECT_EQ(line.flags(), "nnln");
    line.expect_set(line.root, Global, moved(10, 1, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "lggg");
    EXPECT_EQ(line.at(line.tip), glm::dvec3(10, 5, 0));
    EXPECT_EQ(line.at(line.tip, Local), glm::dvec3(0, 3, 0));
}

TEST(RigHierarchy, ChildrenThatStayKeepTheirGlobalToTheBit) {
    Random random(2);
    Line line;
    for (const ElementId each : {line.root, line.middle, line.tip, line.other})
        line.expect_set(each, Local, some_transform(random), Propagate::Yes);
    const Transform tip = line.tree.get(line.tip, Global);
    for (int i = 0; i < 10; ++i) {
        line.expect_set(line.middle, i % 2 ? Local : Global, some_transform(random), Propagate::No);
        EXPECT_TRUE(same_bits(line.tree.get(line.tip, Global), tip));
        if (i % 3 == 0) line.tree.get(line.tip, Local);
    }
}

TEST(RigHierarchy, WhatWasSetIsReadBackToTheBit) {
    Random random(3);
    Line line;
    for (int i = 0; i < 100; ++i) {
        const Transform value = some_transform(random);
        const Space space = i % 2 ? Local : Global;
        line.expect_set(line.tip, space, value, i % 3 ? Propagate::Yes : Propagate::No);
        EXPECT_TRUE(same_bits(line.tree.get(line.tip, space), value));
    }
}

TEST(RigHierarchy, ThePosesAreIndependent) {
    Line line;
    line.expect_set(line.root, Global, moved(3, 1, 0), Propagate::Yes);
    EXPECT_EQ(line.tree.pending(line.tip, Pose::Initial), Pending::None);
    EXPECT_EQ(line.tree.get(line.tip, Global, Pose::Initial).translation, glm::dvec3(0, 3, 0));
    ASSERT_TRUE(line.tree.set(line.root, Local, moved(0, 7, 0), Propagate::Yes, Pose::Initial).ok());
    EXPECT_EQ(line.tree.get(line.tip, Global, Pose::Initial).translation, glm::dvec3(0, 9, 0));
    EXPECT_EQ(line.at(line.tip), glm::dvec3(3, 3, 0));
    line.expect_set(line.tip, Global, moved(0, 0, 1), Propagate::Yes);
    line.tree.copy_pose(Pose::Initial, Pose::Current);
    EXPECT_EQ(line.at(line.tip), glm::dvec3(0, 9, 0));
}

TEST(RigHierarchy, MovingAFingersBaseRecomputesTheThreeThatFollowIt) {
    Hierarchy tree;
    std::vector<ElementId> bones{*tree.add(ElementKind::Bone, {}, moved(0, 1, 0))};
    const auto grow = [&](ElementId from, int count) {
        for (int i = 0; i < count; ++i)
            bones.push_back(from = *tree.add(ElementKind::Bone, from, moved(0, 0.1, 0)));
        return from;
    };
    const ElementId neck = grow(bones.front(), 39);
    for (int arm = 0; arm < 2; ++arm) {
        const ElementId hand = grow(neck, 10);
        for (int finger = 0; finger < 4; ++finger) grow(hand, 4);
    }
    grow(bones.front(), 100 - static_cast<int>(bones.size()));  // a tail
    ASSERT_EQ(tree.size(), 100u);
    tree.resolve_all();

    const ElementId base = bones[40 + 10];  // of the first finger
    ASSERT_EQ(tree.child_count(base), 1u);
    const std::uint64_t before = tree.recomputations();
    ASSERT_TRUE(tree.set(base, Global, moved(1, 2, 3)).ok());
    for (const ElementId each : bones) tree.get(each, Global);
    EXPECT_EQ(tree.recomputations() - before, 3u);
    for (const ElementId each : bones) tree.get(each, Local);
    EXPECT_EQ(tree.recomputations() - before, 4u) << "and the base's own local";
    for (const ElementId each : bones) tree.get(each, Global);
    EXPECT_EQ(tree.recomputations() - before, 4u);
}

TEST(RigHierarchy, ALineOf100000DoesNotOverflowTheStack) {
    constexpr int count = 100'000;
    Hierarchy tree;
    std::vector<ElementId> line(count);
    for (int i = 0; i < count; ++i)
        line[std::size_t(i)] =
            *tree.add(ElementKind::Null, i ? line[std::size_t(i) - 1] : ElementId{}, moved(0, 1, 0));
    EXPECT_EQ(tree.get(line.back(), Global).translation, glm::dvec3(0, count, 0));
    ASSERT_TRUE(tree.set(line.front(), Global, moved(7, 1, 0)).ok());
    EXPECT_EQ(tree.pending(line.back()), Pending::Global);
    EXPECT_EQ(tree.get(line.back(), Global).translation, glm::dvec3(7, count, 0));
    EXPECT_TRUE(tree.is_within(line.back(), line.front()));
    EXPECT_FALSE(tree.set_parent(line.front(), line.back()).ok());
    const Hierarchy copy = tree;
    EXPECT_TRUE(copy == tree);
    ASSERT_TRUE(tree.remove(line[1]).ok());
    EXPECT_EQ(tree.size(), 1u);
    EXPECT_FALSE(copy == tree);
}

TEST(RigHierarchy, RotationsStayUnitLengthAndNumbersFinite) {
    Hierarchy tree;
    Random random(8);
    ElementId at;
    for (int i = 0; i < 400; ++i) {
        Transform local = some_transform(random);
        local.scale = {1e9, -1e9, 1e-9};  // 1e3600 at the end, were there no bound
        at = *tree.add(ElementKind::Null, at, local);
    }
    EXPECT_TRUE(is_finite(tree.get(at, Global)));
    ASSERT_TRUE(tree.set(at, Global, moved(1, 2, 3)).ok());
    EXPECT_TRUE(is_finite(tree.get(at, Local)));
    EXPECT_LE(std::abs(norm(tree.get(at, Local).rotation) - 1.0), 1e-15);

    Line line;
    Transform turn;
    turn.rotation = some_rotation(random);
    for (int i = 0; i < 100'000; ++i) {
        const Transform now = line.tree.get(line.middle, Global);
        line.tree.put(line.middle, Global, compose(now, turn), i % 2 ? Propagate::Yes : Propagate::No);
    }
    for (const ElementId each : {line.middle, line.tip, line.other})
        for (const Space space : {Local, Global})
            EXPECT_LE(std::abs(norm(line.tree.get(each, space).rotation) - 1.0), 1e-14);
}

TEST(RigHierarchy, AScaleOfZeroHasAnInverseOfZero) {
    Line line;
    Transform flat = moved(0, 1, 0);
    flat.scale = {1, 0, 1};
    line.tree.put(line.root, Local, flat);
    EXPECT_EQ(line.at(line.tip), glm::dvec3(0, 1, 0));
    line.expect_set(line.middle, Global, moved(4, 5, 6), Propagate::Yes);
    EXPECT_EQ(line.at(line.middle, Local), glm::dvec3(4, 0, 6));
    EXPECT_EQ(line.tree.get(line.middle, Local).scale, glm::dvec3(1, 0, 1));
}

TEST(RigHierarchy, ElementsAreFoundInTheOrderOfAdding) {
    Line line;
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

TEST(RigHierarchy, AHandleOfWhatIsGoneFindsNothing) {
    Line line;
    ASSERT_TRUE(line.tree.remove(line.middle).ok());
    EXPECT_EQ(line.tree.size(), 1u);
    EXPECT_EQ(line.tree.child_count(line.root), 0u);
    for (const ElementId gone : {line.middle, line.tip, line.other}) EXPECT_FALSE(line.tree.contains(gone));
    const ElementId next = *line.tree.add(ElementKind::Control, line.root, {});
    EXPECT_EQ(line.tree.kind(next), ElementKind::Control);
    EXPECT_FALSE(line.tree.contains(line.middle));
    EXPECT_STREQ(line.tree.remove(line.tip).message(),
                 "remove: element must be the handle of an element that is there, got slot 2");
    EXPECT_EQ(line.tree.set(line.tip, Local, {}).code(), ErrorCode::OutOfRange);
    line.tree.clear();
    EXPECT_EQ(line.tree.size(), 0u);
    EXPECT_FALSE(line.tree.contains(line.root));
}

TEST(RigHierarchy, RefusesWithoutChangingAnything) {
    Line line;
    const Hierarchy before = line.tree;
    const auto refused = [&](const Result& result, const char* message) {
        EXPECT_STREQ(result.message(), message);
        EXPECT_TRUE(line.tree == before);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Transform bad;
    bad.scale.y = 0.0;
    refused(line.tree.set(line.tip, Global, bad), "set: transform.scale.y must be other than 0, got 0");
    refused(line.tree.add(ElementKind::Bone, line.tip, bad).error(),
            "add: local.scale.y must be other than 0, got 0");
    bad = moved(0, nan, 0);
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.translation.y must be finite and at most 1e9 in magnitude, got nan");
    bad = moved(2e9, 0, 0);
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.translation.x must be finite and at most 1e9 in magnitude, got 2e+09");
    bad = {};
    bad.rotation = {0.0, 0.0, 0.0, 0.0};
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.rotation must be of a length of at least 1e-6, got 0");
    refused(line.tree.set_parent(line.middle, line.tip),
            "set_parent: parent must be neither the element itself nor below it, got slot 2");
    refused(line.tree.set_parent(line.middle, line.middle),
            "set_parent: parent must be neither the element itself nor below it, got slot 1");
    refused(line.tree.set_parent(line.middle, {9, 1}),
            "set_parent: parent must be the handle of an element that is there, got slot 9");
    refused(line.tree.add(ElementKind::Bone, {9, 1}, {}).error(),
            "add: parent must be the handle of an element that is there, got slot 9");
    refused(line.tree.remove({}),
            "remove: element must be the handle of an element that is there, got an empty one");
}

TEST(RigHierarchy, AnotherParentKeepsThePlaceOrTheLocal) {
    for (const Space keep : {Local, Global}) {
        Line line;
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

TEST(RigHierarchy, ReadingAndWritingAllocateNothing) {
    Line line;
    without_memory([&] {
        line.expect_set(line.root, Global, moved(1, 2, 3), Propagate::No);
        line.expect_set(line.middle, Local, moved(1, 2, 3), Propagate::Yes);
        line.tree.get(line.tip, Global);
        line.tree.copy_pose(Pose::Initial, Pose::Input);
        line.tree.resolve_all();
    });
    EXPECT_EQ(line.flags(), "nnnn");
}

TEST(RigHierarchyDeathTest, ReadingWhatIsNotThereEndsTheProgramWithAMessage) {
    Line line;
    EXPECT_DEATH(line.tree.get({}, Local), "get: element must be the handle of an element that is there");
}

}  // namespace
}  // namespace tendril::test
