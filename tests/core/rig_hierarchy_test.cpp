// Poses that each write leaves pending, the cost of reading, and the values read.
#include "memory.hpp"
#include "rig_line.hpp"
#include "tendril/rig/euler.hpp"
#include "tendril/rig/transform_units.hpp"

namespace tendril::test {
namespace {

using namespace rig;
using enum Space;

TEST(RigHierarchy, EachWriteMakesPendingWhatTheSpecificationSays) {
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

TEST(RigHierarchy, ReadingResolvesOnlyPendingAncestors) {
    RigLine line;
    line.expect_set(line.root, Global, moved(3, 1, 0), Propagate::Yes);
    EXPECT_EQ(line.flags(), "lggg");
    EXPECT_EQ(line.at(line.tip), glm::dvec3(3, 3, 0));
    EXPECT_EQ(line.flags(), "lnng");
    EXPECT_EQ(line.at(line.root, Local), glm::dvec3(3, 1, 0));
    EXPECT_EQ(line.flags(), "nnng");
}

TEST(RigHierarchy, ChildrenThatStayKeepTheirGlobalBitForBit) {
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

TEST(RigHierarchy, AValueThatIsSetIsReadBackBitForBit) {
    Random random(3);
    RigLine line;
    for (int i = 0; i < 100; ++i) {
        const Transform value = some_transform(random);
        const Space space = i % 2 ? Local : Global;
        line.expect_set(line.tip, space, value, i % 3 ? Propagate::Yes : Propagate::No);
        EXPECT_TRUE(same_bits(line.tree.get(line.tip, space), value));
    }
}

TEST(RigHierarchy, MovingAFingersBaseRecomputesItsThreeChildren) {
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

    const ElementId base = bones[40 + 10];  // base of the first finger
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

TEST(RigHierarchy, ALeafOfALargeTreeRecomputesOnlyItsAncestors) {
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

TEST(RigHierarchy, AReferenceStaysValidAcrossReadsAndWrites) {
    Random random(15);
    RigLine line;
    for (const ElementId each : {line.root, line.middle, line.tip, line.other})
        line.expect_set(each, Local, some_transform(random), Propagate::Yes);
    for (const Space space : {Local, Global})
        for (const Propagate propagate : {Propagate::Yes, Propagate::No})
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

TEST(RigHierarchy, RotationsStayUnitAndNumbersFinite) {
    Hierarchy tree;
    Random random(8);
    ElementId at;
    for (int i = 0; i < 400; ++i) {
        Transform local = some_transform(random);
        local.scale = {1e9, -1e9, 1e-9};  // 1e3600 at the end if unbounded
        at = *tree.add(ElementKind::Null, at, local);
    }
    EXPECT_TRUE(is_finite(tree.get(at, Global)));
    ASSERT_TRUE(tree.set(at, Global, moved(1, 2, 3)).ok());
    EXPECT_TRUE(is_finite(tree.get(at, Local)));
    EXPECT_LE(std::abs(norm(tree.get(at, Local).rotation) - 1.0), 1e-15);

    RigLine line;
    Transform turn{.rotation = some_rotation(random)};
    for (int i = 0; i < 100'000; ++i) {
        const Transform now = line.tree.get(line.middle, Global);
        line.tree.put(line.middle, Global, compose(now, turn), i % 2 ? Propagate::Yes : Propagate::No);
    }
    for (const ElementId each : {line.middle, line.tip, line.other})
        for (const Space space : {Local, Global})
            EXPECT_LE(std::abs(norm(line.tree.get(each, space).rotation) - 1.0), 1e-14);
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

// Compares a hierarchy with one that recomputes everything after each write, and with itself read at other
// times.

/// A literal implementation without lazy updates: every transform is always up to date, computed with GLM.
class Naive {
  public:
    struct Element {
        int parent = -1;
        Transform local[3], global[3];
        bool there = true;
    };

    int add(int parent, const Transform& local) {
        Element made{parent, {local, local, local}, {}, true};
        const int at = static_cast<int>(elements.size());
        elements.push_back(made);
        for (int pose = 0; pose < 3; ++pose) take_global(at, pose);
        return at;
    }
    void remove(int at) {
        elements[std::size_t(at)].there = false;
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (elements[i].there && elements[i].parent == at) remove(static_cast<int>(i));
    }
    void set(int at, Space space, const Transform& value, Propagate propagate, int pose) {
        Element& element = elements[std::size_t(at)];
        if (space == Space::Local) {
            element.local[pose] = value;
            take_global(at, pose);
        } else {
            element.global[pose] = value;
            take_local(at, pose);
        }
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (!elements[i].there || elements[i].parent != at) continue;
            if (propagate == Propagate::Yes)
                take_globals(static_cast<int>(i), pose);
            else
                take_local(static_cast<int>(i), pose);
        }
    }
    void set_parent(int at, int parent, Space keep) {
        elements[std::size_t(at)].parent = parent;
        for (int pose = 0; pose < 3; ++pose) {
            if (keep == Space::Global)
                take_local(at, pose);
            else
                take_globals(at, pose);
        }
    }

    std::vector<Element> elements;

  private:
    Transform above(int at, int pose) const {
        const int parent = elements[std::size_t(at)].parent;
        return parent < 0 ? Transform{} : elements[std::size_t(parent)].global[pose];
    }
    void take_global(int at, int pose) {
        const Transform p = above(at, pose), c = elements[std::size_t(at)].local[pose];
        elements[std::size_t(at)].global[pose] = {p.translation + p.rotation * (p.scale * c.translation),
                                                  p.rotation * c.rotation, p.scale * c.scale};
    }
    void take_globals(int at, int pose) {
        take_global(at, pose);
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (elements[i].there && elements[i].parent == at) take_globals(static_cast<int>(i), pose);
    }
    void take_local(int at, int pose) {
        const Transform p = above(at, pose), g = elements[std::size_t(at)].global[pose];
        const glm::dquat back = glm::inverse(p.rotation);
        elements[std::size_t(at)].local[pose] = {(back * (g.translation - p.translation)) / p.scale,
                                                 back * g.rotation, g.scale / p.scale};
    }
};

/// The same edits on two hierarchies and the naive one; `ids` maps its elements to theirs.
struct Trio {
    Hierarchy tree, also;
    Naive naive;
    std::vector<ElementId> ids;
    std::vector<int> there;

    int some(Random& random) const { return there[random.below(there.size())]; }
    ElementId id(int at) const { return at < 0 ? ElementId{} : ids[std::size_t(at)]; }

    void add(Random& random) {
        const int parent = there.empty() || random.chance(20) ? -1 : some(random);
        const Transform local = some_transform(random);
        there.push_back(naive.add(parent, local));
        ids.push_back(*tree.add(ElementKind::Bone, id(parent), local));
        EXPECT_EQ(*also.add(ElementKind::Bone, id(parent), local), ids.back());
    }
    void remove(Random& random) {
        const int at = some(random);
        naive.remove(at);
        EXPECT_TRUE(tree.remove(id(at)).ok());
        EXPECT_TRUE(also.remove(id(at)).ok());
        std::erase_if(there, [&](int each) { return !naive.elements[std::size_t(each)].there; });
        EXPECT_EQ(tree.size(), there.size());
    }
    void set(Random& random) {
        const int at = some(random);
        const Space space = random.chance(2) ? Space::Local : Space::Global;
        const Propagate propagate = random.chance(2) ? Propagate::Yes : Propagate::No;
        const int pose = some_pose(random);
        const Transform value = some_transform(random);
        naive.set(at, space, value, propagate, pose);
        EXPECT_TRUE(tree.set(id(at), space, value, propagate, pose_of(pose)).ok());
        EXPECT_TRUE(also.set(id(at), space, value, propagate, pose_of(pose)).ok());
    }
    void set_parent(Random& random) {
        const int at = some(random), parent = random.chance(10) ? -1 : some(random);
        const Space keep = random.chance(2) ? Space::Local : Space::Global;
        const bool cycle = parent >= 0 && tree.is_within(id(parent), id(at));
        const bool same = naive.elements[std::size_t(at)].parent == parent;
        EXPECT_EQ(tree.set_parent(id(at), id(parent), keep).ok(), !cycle);
        EXPECT_EQ(also.set_parent(id(at), id(parent), keep).ok(), !cycle);
        if (!cycle && !same) naive.set_parent(at, parent, keep);
    }
    void copy_pose(Random& random) {
        const int from = some_pose(random), to = some_pose(random);
        for (Naive::Element& each : naive.elements)
            each.local[to] = each.local[from], each.global[to] = each.global[from];
        tree.copy_pose(pose_of(from), pose_of(to));
        also.copy_pose(pose_of(from), pose_of(to));
    }
    void edit(Random& random) {
        if (there.size() < 4 || (there.size() < 60 && random.chance(12))) return add(random);
        if (there.size() > 40 && random.chance(40)) return remove(random);
        if (random.chance(15)) return set_parent(random);
        if (random.chance(50)) return copy_pose(random);
        set(random);
    }
    /// Deviation of one value from the naive one.
    double read(int at, Space space, int pose) {
        const Naive::Element& wanted = naive.elements[std::size_t(at)];
        const Transform& got = tree.get(id(at), space, pose_of(pose));
        EXPECT_LE(std::abs(norm(got.rotation) - 1.0), 1e-14);
        return distance(got, space == Space::Local ? wanted.local[pose] : wanted.global[pose]);
    }
    static Pose pose_of(int pose) { return static_cast<Pose>(pose); }
    static int some_pose(Random& random) {
        return static_cast<int>(std::min<std::size_t>(random.below(6), 2));
    }
    template <class Each>
    void each_transform(Each each) {
        for (const int at : there)
            for (const int pose : {0, 1, 2})
                for (const Space space : {Space::Local, Space::Global}) each(at, space, pose);
    }
};

TEST(RigHierarchyProperty, AgreesWithANaiveImplementationOverManyEdits) {
    double worst = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Random random(seed);
        Trio trio;
        for (int i = 0; i < 25'000; ++i) {
            trio.edit(random);
            if (!random.chance(3)) continue;
            const int at = trio.some(random), pose = Trio::some_pose(random);
            worst = std::max(worst, trio.read(at, random.chance(3) ? Space::Local : Space::Global, pose));
        }
        trio.each_transform(
            [&](int at, Space space, int pose) { worst = std::max(worst, trio.read(at, space, pose)); });
    }
    EXPECT_LE(worst, 1e-4);
    std::printf("100 000 edits, worst relative deviation %.2g\n", worst);
}

TEST(RigHierarchyProperty, ReadingChangesNoResult) {
    Random edits(77), reads(78);
    Trio trio;  // only `also` is read
    for (int i = 0; i < 20'000; ++i) {
        trio.edit(edits);
        for (std::size_t j = reads.below(4); j > 0; --j) {
            const ElementId at = trio.id(trio.some(reads));
            const Space space = reads.chance(2) ? Space::Local : Space::Global;
            trio.also.get(at, space, Trio::pose_of(Trio::some_pose(reads)));
        }
        if (reads.chance(500)) trio.also.resolve_all();
    }
    EXPECT_TRUE(trio.tree == trio.also);
    EXPECT_NE(trio.tree.recomputations(), trio.also.recomputations());
    trio.each_transform([&](int at, Space space, int pose) {
        EXPECT_TRUE(same_bits(trio.tree.get(trio.id(at), space, Trio::pose_of(pose)),
                              trio.also.get(trio.id(at), space, Trio::pose_of(pose))));
    });
}

TEST(RigHierarchyProperty, APendingPoseIsExactlyAnUnknownOne) {
    Random edits(5), reads(6);
    Trio trio;
    int seen[3]{};
    for (int i = 0; i < 3'000; ++i) {
        trio.edit(edits);
        if (reads.chance(2)) trio.tree.get(trio.id(trio.some(reads)), Space::Global);
        Hierarchy copy = trio.tree;
        const int at = trio.some(reads), pose = Trio::some_pose(reads);
        const Pending pending = trio.tree.pending(trio.id(at), Trio::pose_of(pose));
        ++seen[static_cast<int>(pending)];
        for (const Space space : {Space::Local, Space::Global}) {
            const auto known = trio.tree.known(trio.id(at), space, Trio::pose_of(pose));
            const bool missing = pending == (space == Space::Local ? Pending::Local : Pending::Global);
            ASSERT_EQ(known.has_value(), !missing);
            if (!known) continue;
            ASSERT_TRUE(same_bits(*known, copy.get(trio.id(at), space, Trio::pose_of(pose))));
        }
        copy.resolve_all();
        ASSERT_EQ(copy.pending(trio.id(at), Trio::pose_of(pose)), Pending::None);
    }
    for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(RigHierarchyProperty, ACopyContinuesLikeTheOriginal) {
    Random random(11);
    Trio trio;
    for (int i = 0; i < 2'000; ++i) trio.edit(random);
    const Hierarchy saved = trio.tree;
    const Trio then = trio;
    const Random from_here = random;
    for (int i = 0; i < 2'000; ++i) trio.edit(random);
    const Hierarchy went_on = trio.tree;
    EXPECT_FALSE(went_on == saved);

    Trio again = then;
    Random same = from_here;
    again.tree = saved;  // rollback
    for (int i = 0; i < 2'000; ++i) again.edit(same);
    EXPECT_TRUE(again.tree == went_on);
    EXPECT_EQ(again.tree.recomputations(), went_on.recomputations());
    again.each_transform([&](int at, Space space, int pose) {
        EXPECT_TRUE(same_bits(again.tree.get(again.id(at), space, Trio::pose_of(pose)),
                              trio.tree.get(trio.id(at), space, Trio::pose_of(pose))));
    });
}

// Transforms, Euler angles and simple operations on them.

TEST(RigTransform, ComposingScalesThenTurnsThenAdds) {
    const Transform parent{{1, 2, 3}, about({0, 0, 1}, 90), {2, 3, -4}},
        child{{1, 1, 1}, about({0, 0, 1}, 90), {5, 5, 5}};
    const Transform global = compose(parent, child);
    EXPECT_LE(distance(global.translation, {1 - 3, 2 + 2, 3 - 4}), 1e-15);
    EXPECT_LE(distance(global.rotation, about({0, 0, 1}, 180)), 1e-15);
    EXPECT_EQ(global.scale, glm::dvec3(10, 15, -20));
}

TEST(RigTransform, RelativeUndoesComposing) {
    Random random(1);
    for (int i = 0; i < 10'000; ++i) {
        const Transform parent = some_transform(random), child = some_transform(random);
        EXPECT_LE(distance(relative(parent, compose(parent, child)), child), 1e-14);
        EXPECT_LE(distance(compose(parent, relative(parent, child)), child), 1e-14);
    }
}

TEST(RigTransform, TheInverseOfZeroScaleIsZero) {
    Transform flat{.scale = {0, 1e-300, 2}};
    const Transform local = relative(flat, {{1, 2, 3}, {1, 0, 0, 0}, {4, 5, 6}});
    EXPECT_EQ(local.translation, glm::dvec3(0, 0, 1.5));
    EXPECT_EQ(local.scale, glm::dvec3(0, 0, 3));
}

TEST(RigTransform, NoProductBecomesInfinite) {
    Transform large{{1e99, -1e99, 1e99}, {1, 0, 0, 0}, {1e99, 1e-99, -1e99}};
    for (int i = 0; i < 10; ++i) {
        const Transform product = compose(large, large), quotient = relative(large, product);
        EXPECT_TRUE(is_finite(product));
        EXPECT_TRUE(is_finite(quotient));
        EXPECT_TRUE(is_finite(relative(quotient, large)));
        large = product;
    }
}

TEST(RigTransform, BlendingStartsAndEndsBitForBit) {
    Random random(4);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 100; ++i) {
        const Transform a = some_transform(random), b = some_transform(random);
        for (const double part : {0.0, -1.0, nan}) EXPECT_TRUE(same_bits(blend(a, b, part), a));
        for (const double part : {1.0, 2.0}) EXPECT_TRUE(same_bits(blend(a, b, part), b));
        const Transform near_a = blend(a, b, 1e-9), near_b = blend(a, b, 1.0 - 1e-9);
        EXPECT_LE(distance(near_a, a), 1e-7);
        EXPECT_LE(distance(near_b, b), 1e-7);
        EXPECT_LE(std::abs(norm(blend(a, b, 0.3).rotation) - 1.0), 1e-15);
    }
    const glm::dquat half = blend(about({1, 0, 0}, 10), about({1, 0, 0}, 70), 0.5);
    EXPECT_LE(distance(half, about({1, 0, 0}, 40)), 1e-15);
    const glm::dquat small = blend(about({1, 0, 0}, 0), about({1, 0, 0}, 1e-4), 0.25);
    EXPECT_LE(distance(small, about({1, 0, 0}, 0.25e-4)), 1e-15);
}

TEST(RigTransform, NormalisingTwiceChangesNothing) {
    Random random(9);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dquat once = some_rotation(random), twice = normalised(once);
        EXPECT_EQ(std::memcmp(&once, &twice, sizeof once), 0);
    }
    EXPECT_EQ(normalised({0, 0, 0, 0}), glm::dquat(1, 0, 0, 0));
    const Expected<Transform> long_one = checked({.rotation = {0, 3e8, 0, 4e8}}, "test");
    ASSERT_TRUE(long_one.ok());
    EXPECT_LE(distance(long_one->rotation, {0, 0.6, 0, 0.8}), 1e-15);
}

TEST(RigEuler, AnglesAndRotationAgreeBothWays) {
    Random random(6);
    double worst = 0.0;
    for (int i = 0; i < 10'000; ++i) {
        const glm::dquat rotation = some_rotation(random);
        const glm::dvec3 angles = to_euler(rotation);
        EXPECT_LE(std::abs(angles.x), pi);
        EXPECT_LE(std::abs(angles.y), pi / 2);
        EXPECT_LE(std::abs(angles.z), pi);
        const glm::dquat by_axes = glm::angleAxis(angles.z, glm::dvec3(0, 0, 1)) *
                                   glm::angleAxis(angles.y, glm::dvec3(0, 1, 0)) *
                                   glm::angleAxis(angles.x, glm::dvec3(1, 0, 0));
        worst = std::max({worst, distance(by_axes, rotation), distance(from_euler(angles), rotation)});
    }
    EXPECT_LE(worst, 1e-14);
}

TEST(RigEuler, ThePolesAreClean) {
    Random random(7);
    for (const double side : {-1.0, 1.0})
        for (const double from_pole : {0.0, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3}) {
            const double x = some_double(random, 3.0), z = some_double(random, 3.0);
            const glm::dquat rotation = from_euler({x, side * (pi / 2 - from_pole), z});
            const glm::dvec3 angles = to_euler(rotation);
            EXPECT_LE(distance(from_euler(angles), rotation), 2e-9);
            EXPECT_LE(std::abs(angles.y - side * (pi / 2 - from_pole)), 1e-12);
            if (from_pole <= 1e-9)
                EXPECT_EQ(angles.z, 0.0);
            else
                EXPECT_LE(std::abs(angles.z - z), 1e-6);
        }
}

TEST(RigUnits, AWeightOfZeroLeavesTheItemBitForBit) {
    Random random(10);
    for (int i = 0; i < 100; ++i) {
        const Transform item = some_transform(random), other = some_transform(random);
        const Transform third = some_transform(random), fourth = some_transform(random);
        EXPECT_TRUE(same_bits(offset_transform(item, other, 0.0), item));
        EXPECT_TRUE(same_bits(set_transform(item, other, 0.0), item));
        EXPECT_TRUE(same_bits(set_rotation(item, other.rotation, 0.0), item));
        EXPECT_TRUE(same_bits(project_to_parent(item, other, third, fourth, 0.0), item));
        EXPECT_TRUE(same_bits(set_transform(item, other), other));
        EXPECT_TRUE(same_bits(project_to_parent(item, other, third, fourth, 1.0),
                              project_to_parent(other, third, fourth)));
    }
}

TEST(RigUnits, AnOffsetIsInTheItemsSpace) {
    const Transform item{{1, 0, 0}, about({0, 0, 1}, 90), {2, 2, 2}};
    const Transform all = offset_transform(item, {{1, 0, 0}, about({1, 0, 0}, 90), {3, 1, 1}});
    EXPECT_LE(distance(all, {{1, 2, 0}, item.rotation * about({1, 0, 0}, 90), {6, 2, 2}}), 1e-15);
    const Transform half = offset_transform(item, {{1, 0, 0}, about({1, 0, 0}, 90), {3, 1, 1}}, 0.5);
    EXPECT_LE(distance(half, {{1, 1, 0}, item.rotation * about({1, 0, 0}, 45), {4, 2, 2}}), 1e-15);
}

TEST(RigUnits, ProjectedToItsParentInAnotherPoseAChildFollows) {
    Random random(12);
    const Transform child = some_transform(random), before = some_transform(random),
                    after = some_transform(random);
    EXPECT_LE(distance(project_to_parent(child, before, before), child), 1e-14);
    const Transform there = project_to_parent(child, before, after);
    EXPECT_LE(distance(relative(after, there), relative(before, child)), 1e-14);
}

TEST(RigUnits, FromTwoVectorsIsTheShortestArc) {
    Random random(13);
    for (int i = 0; i < 1'000; ++i) {
        const glm::dvec3 from = some_vector(random, 5.0), to = i % 4 ? some_vector(random, 5.0) : -from;
        const glm::dquat turn = from_two_vectors(from, to);
        EXPECT_LE(distance(turn * (from / norm(from)), to / norm(to)), 1e-7);
        EXPECT_LE(std::abs(norm(turn) - 1.0), 1e-15);
        const double angle = 2.0 * std::acos(std::min(1.0, std::abs(turn.w)));
        EXPECT_NEAR(angle, std::acos(std::clamp(glm::dot(from, to) / norm(from) / norm(to), -1.0, 1.0)),
                    1e-6);
    }
    EXPECT_EQ(from_two_vectors({0, 0, 0}, {1, 0, 0}), glm::dquat(1, 0, 0, 0));
    EXPECT_EQ(from_two_vectors({1, 0, 0}, {0, 0, 0}), glm::dquat(1, 0, 0, 0));
}

TEST(RigUnits, LocationsMoveAndDirectionsOnlyTurn) {
    const Transform transform{{1, 2, 3}, about({0, 0, 1}, 90), {2, 3, 4}};
    EXPECT_LE(distance(transform_location(transform, {1, 1, 1}), {1 - 3, 2 + 2, 3 + 4}), 1e-15);
    EXPECT_LE(distance(transform_direction(transform, {1, 1, 1}), {-1, 1, 1}), 1e-15);
}

}  // namespace
}  // namespace tendril::test
