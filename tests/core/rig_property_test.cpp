// A hierarchy against one that recomputes everything after each write, and against itself read at other
// times.
#include "rig_support.hpp"

namespace tendril::test {
namespace {

using namespace rig;

/// A literal implementation without laziness: every transform is always up to date, computed with GLM.
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
    /// The deviation of one answer.
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

TEST(RigHierarchyProperty, ReadingChangesNoAnswer) {
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

TEST(RigHierarchyProperty, WhatIsPendingIsWhatIsNotKnown) {
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

TEST(RigHierarchyProperty, ACopyGoesOnAsTheOriginalDoes) {
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

}  // namespace
}  // namespace tendril::test
