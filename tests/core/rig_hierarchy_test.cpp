// What each write leaves pending, the cost of reading, and the values read.
#include "memory.hpp"
#include "rig_line.hpp"

namespace tendril::test {
namespace {

using namespace rig;
using enum Space;

TEST(RigHierarchy, EachWriteMakesPendingWhatThePageSays) {
    RigLine line;
    EXPECT_EQ(line.flags(), "nnnn");
    line.expect_set(line.middle, Global, moved(5, 2, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "nlgg");
    line = RigLine();
    line.expect_set(line.middle, Global, moved(5, 2, 0), Propagate::No);
    EXPECT_EQ(line.flags(), "nlll");
    line = RigLine();
    line.expect_set(line.root, Global, moved(5, 2, 0), Propagate::No);
    EXPECT_EQ(line.flags(), "llnn") << "only the first level is touched";
    line = RigLine();
    line.expect_set(line.middle, Local, moved(5, 2, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "nggg");
    line = RigLine();
    line.expect_set(line.middle, Local, moved(5, 2, 0), Propagate::No);
    EXPECT_EQ(line.flags(), "nnll");
}

TEST(RigHierarchy, ReadingWorksOutWhatIsPendingAboveAndNothingElse) {
    RigLine line;
    line.expect_set(line.root, Global, moved(3, 1, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "lggg");
    EXPECT_EQ(line.at(line.tip), glm::dvec3(3, 3, 0));
    EXPECT_EQ(line.flags(), "lnng");
    EXPECT_EQ(line.at(line.root, Local), glm::dvec3(3, 1, 0));
    EXPECT_EQ(line.flags(), "nnng");
}

TEST(RigHierarchy, ALocalThatWaitsIsWorkedOutBeforeItsParentMoves) {
    RigLine line;
    line.expect_set(line.tip, Global, moved(0, 5, 0), Propagate::Yes);  // 3 above its parent
    EXPECT_EQ(line.flags(), "nnln");
    line.expect_set(line.root, Global, moved(10, 1, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "lggg");
    EXPECT_EQ(line.at(line.tip), glm::dvec3(10, 5, 0));
    EXPECT_EQ(line.at(line.tip, Local), glm::dvec3(0, 3, 0));
}

TEST(RigHierarchy, ChildrenThatStayKeepTheirGlobalToTheBit) {
    Random random(2);
    RigLine line;
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
    RigLine line;
    for (int i = 0; i < 100; ++i) {
        const Transform value = some_transform(random);
        const Space space = i % 2 ? Local : Global;
        line.expect_set(line.tip, space, value, i % 3 ? Propagate::Yes : Propagate::No);
        EXPECT_TRUE(same_bits(line.tree.get(line.tip, space), value));
    }
}

TEST(RigHierarchy, ThePosesAreIndependent) {
    RigLine line;
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

TEST(RigHierarchy, ALeafOfALargeTreeRecomputesItsAncestorsAndNothingElse) {
    Hierarchy tree;
    std::vector<ElementId> all{*tree.add(ElementKind::Null, {}, {})};
    while (all.size() < 11'111)
        all.push_back(*tree.add(ElementKind::Null, all[(all.size() - 1) / 10], moved(0, 1, 0)));
    tree.resolve_all();
    const std::uint64_t before = tree.recomputations();
    ASSERT_TRUE(tree.set(all.front(), Global, moved(5, 0, 0)).ok());
    EXPECT_EQ(tree.recomputations() - before, 0u) << "no write walks a subtree";
    EXPECT_EQ(tree.get(all.back(), Global).translation, glm::dvec3(5, 4, 0));
    EXPECT_EQ(tree.recomputations() - before, 4u);
    EXPECT_EQ(tree.get(all[all.size() - 2], Global).translation, glm::dvec3(5, 4, 0));
    EXPECT_EQ(tree.recomputations() - before, 5u) << "its brother has only itself to do";
}

TEST(RigHierarchy, WhatWasReadCanBeReadBesideAndWritten) {
    Random random(15);
    RigLine line;
    for (const ElementId each : {line.root, line.middle, line.tip, line.other})
        line.expect_set(each, Local, some_transform(random), Propagate::Yes);
    for (const Space space : {Local, Global}) {
        for (const Propagate propagate : {Propagate::Yes, Propagate::No}) {
            for (const ElementId from : {line.root, line.middle, line.tip}) {
                RigLine again = line;
                const Transform& source = again.tree.get(from, space);
                const Transform copy = source;
                again.tree.get(line.other, Global);
                again.tree.get(line.other, Local);
                EXPECT_TRUE(same_bits(source, copy));
                again.tree.put(line.middle, Global, source, propagate);
                RigLine plain = line;
                plain.tree.put(line.middle, Global, copy, propagate);
                EXPECT_TRUE(again.tree == plain.tree);
            }
        }
    }
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
        local.scale = {1e9, -1e9, 1e-9};  // 1e3600 at the end if it were unbounded
        at = *tree.add(ElementKind::Null, at, local);
    }
    EXPECT_TRUE(is_finite(tree.get(at, Global)));
    ASSERT_TRUE(tree.set(at, Global, moved(1, 2, 3)).ok());
    EXPECT_TRUE(is_finite(tree.get(at, Local)));
    EXPECT_LE(std::abs(norm(tree.get(at, Local).rotation) - 1.0), 1e-15);

    RigLine line;
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
    RigLine line;
    Transform flat = moved(0, 1, 0);
    flat.scale = {1, 0, 1};
    line.tree.put(line.root, Local, flat);
    EXPECT_EQ(line.at(line.tip), glm::dvec3(0, 1, 0));
    line.expect_set(line.middle, Global, moved(4, 5, 6), Propagate::Yes);
    EXPECT_EQ(line.at(line.middle, Local), glm::dvec3(4, 0, 6));
    EXPECT_EQ(line.tree.get(line.middle, Local).scale, glm::dvec3(1, 0, 1));
}

TEST(RigHierarchy, ReadingAndWritingAllocateNothing) {
    RigLine line;
    without_memory([&] {
        line.expect_set(line.root, Global, moved(1, 2, 3), Propagate::No);
        line.expect_set(line.middle, Local, moved(1, 2, 3), Propagate::Yes);
        line.tree.get(line.tip, Global);
        line.tree.copy_pose(Pose::Initial, Pose::Input);
        line.tree.resolve_all();
    });
    EXPECT_EQ(line.flags(), "nnnn");
}

}  // namespace
}  // namespace tendril::test
