// An element's rotation at each remembered moment, against an independent computation.
#include "app/labs/kit/past.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/rig/rig_edit.hpp"
#include "tests/app/labs/rig/rig_support.hpp"
#include "tests/app/support/random_numbers.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RigPast : public RigTest, protected test::RandomNumbers {
  protected:
    RigPast() : RandomNumbers(23) {}

    glm::dquat rotation() {
        const double w = uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
        return glm::normalize(glm::dquat(w, x, y, z + 1e-3));
    }
    glm::dvec3 point() {
        const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
        return {x, y, z};
    }

    /// A tree of bones and nulls, each below a random earlier one.
    rig::Definition tree(std::size_t count) {
        rig::Definition definition;
        for (std::size_t i = 0; i < count; ++i) {
            rig::Element each{.name = "e" + std::to_string(i)};
            each.kind = random() % 5 == 0 ? rig::ElementKind::Null : rig::ElementKind::Bone;
            if (i > 0) each.parent = "e" + std::to_string(random() % i);
            each.initial.translation = point();
            each.initial.rotation = rotation();
            definition.elements.push_back(each);
        }
        return definition;
    }
    void plot(const std::string& what, const std::string& element) {
        run("view.rig_plot", {{"of", what}});
        run("rig.select", {{"element", element}});
    }
    std::vector<PastValue> values() const {
        return past_values(workspace, rig_past(), *rig_past().curve(workspace));
    }
};

/// Degrees: swing of the bone's direction, and twist after undoing the swing by the shortest rotation.
struct Counted {
    double swing, twist;
};
Counted count(const glm::dquat& turn, const glm::dvec3& along) {
    const glm::dvec3 bone = glm::normalize(along), went = turn * bone;
    const glm::dvec3 axis = glm::cross(went, bone);
    const double sine = glm::length(axis), cosine = glm::dot(went, bone);
    const glm::dquat back =
        sine > 1e-12 ? glm::angleAxis(std::atan2(sine, cosine), axis / sine) : glm::dquat(1, 0, 0, 0);
    const glm::dvec3 other = std::abs(bone.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(bone, other)), turned = back * (turn * side);
    return {glm::degrees(std::atan2(sine, cosine)),
            glm::degrees(std::atan2(glm::dot(glm::cross(side, turned), bone), glm::dot(side, turned)))};
}

TEST_F(RigPast, ValuesEqualThePoseAtEachTick) {
    for (int round = 0; round < 20; ++round) {
        run("rig.clear");
        workspace.rewind.clear();
        const rig::Definition definition = tree(3 + random() % 12);
        workspace.document.edit<RigPart>(rig_lab) = RigPart(definition);
        const std::size_t chosen = random() % definition.elements.size();
        const rig::Element& element = definition.elements[chosen];
        std::vector<glm::dquat> turns;
        for (int moment = 0; moment < 30; ++moment) {
            auto& part = workspace.document.edit<RigPart>(rig_lab);
            for (int i = 0; i < 3; ++i) {
                rig::Transform to;
                to.translation = point();
                to.rotation = rotation();
                const auto space = random() % 2 == 0 ? rig::Space::Local : rig::Space::Global;
                const auto down = random() % 2 == 0 ? rig::Propagate::Yes : rig::Propagate::No;
                const rig::ElementId id = part.rig.id(random() % definition.elements.size());
                ASSERT_TRUE(part.state.edit().elements.set(id, space, to, down));
            }
            rig::Hierarchy resolved = part.state->elements;
            turns.push_back(glm::conjugate(element.initial.rotation) *
                            resolved.get(part.rig.id(chosen), rig::Space::Local).rotation);
            remember();
        }
        glm::dvec3 along(0.0);
        for (const rig::Element& each : definition.elements)
            if (each.parent == element.name && each.kind == rig::ElementKind::Bone)
                along += each.initial.translation;
        const bool leaf = glm::length(along) < 1e-9;
        const auto is_led = [&](const rig::Element& each) {
            return each.name == element.parent && each.kind == rig::ElementKind::Bone;
        };
        const bool led = std::any_of(definition.elements.begin(), definition.elements.end(), is_led);
        if (leaf) along = led ? element.initial.translation : glm::dvec3(0, 1, 0);
        for (const char* const what : {"swing", "twist", "angle"}) {
            plot(what, element.name);
            const std::vector<PastValue> told = values();
            const bool known = element.kind == rig::ElementKind::Bone || what[0] == 'a';
            ASSERT_EQ(told.size() >= turns.size(), known);
            for (std::size_t i = 0; known && i < turns.size(); ++i) {
                const Counted counted = count(turns[i], along);
                const double angle = 2.0 * glm::degrees(std::acos(std::min(1.0, std::abs(turns[i].w))));
                const double expected = what[0] == 's'   ? counted.swing
                                        : what[0] == 't' ? counted.twist
                                                         : angle;
                EXPECT_NEAR(static_cast<double>(told[i].value), expected, 1e-3) << what << " at " << i;
            }
        }
    }
}

TEST_F(RigPast, AnElementIsFoundByNameInThePast) {
    element("arm");
    element("hand", "arm", transform(0, 1, 0));
    remember();
    run("rig.element.add", {{"name", "base"}, {"kind", "bone"}});
    remember();
    plot("angle", "base");
    EXPECT_EQ(values().size(), 2u) << "of the moment without it there is none; the present is one more";
    plot("angle", "hand");
    EXPECT_EQ(values().size(), 3u);
}

TEST_F(RigPast, WithoutASelectionItIsTheFirstBoneBelowAnother) {
    run("view.rig_plot", {{"of", "swing"}});
    EXPECT_TRUE(test::says(rig_past().curve(workspace)->missing, "rig elements"));
    control("look", "position");
    EXPECT_EQ(rig_past().curve(workspace)->name, "swing of look");
    element("arm");
    EXPECT_EQ(rig_past().curve(workspace)->name, "swing of arm");
    element("hand", "arm", transform(0, 1, 0));
    EXPECT_EQ(rig_past().curve(workspace)->name, "swing of hand");
    run("rig.select", {{"element", "look"}});
    EXPECT_TRUE(values().empty());
    EXPECT_TRUE(test::says(rig_past().curve(workspace)->missing, "look swing twist bone"));
}

TEST_F(RigPast, GhostsAreThePastBones) {
    element("arm", "", transform(1, 0, 0));
    element("hand", "arm", transform(0, 1, 0));
    const PoseLines lines = rig_past().pose(workspace, now());
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].first, glm::vec3(1, 0, 0));
    EXPECT_EQ(lines[0].second, glm::vec3(1, 1, 0));
    EXPECT_EQ(lines[1].first, glm::vec3(1, 1, 0));
}

}  // namespace
}  // namespace tendril::app
