// The explanation of a bone's pose: the contributions of all units add up to it.
#include <glm/geometric.hpp>
#include <random>
#include <tendril/rig/explain.hpp>

#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/values.hpp"
#include "rig_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class RigWhy : public RigTest {
  protected:
    void select(const std::string& element) { run("rig.select", {{"element", element}}); }
    /// A value of the control's kind, inside or outside of its limits, which the control enforces.
    Json any_value(const rig::Element& element) {
        std::uniform_real_distribution<double> some(-1.2, 1.2);
        const double a = some(random_), b = some(random_), c = some(random_), d = some(random_);
        switch (element.control->kind) {
            case rig::ControlKind::Float:
                return a;
            case rig::ControlKind::Bool:
                return a > 0.0;
            case rig::ControlKind::Vector2d:
                return {a, b};
            case rig::ControlKind::Position:
                return {a, b, c};
            case rig::ControlKind::Rotation:
                return {a, b, c, d};
            case rig::ControlKind::Transform:
                break;
        }
        return {{"translation", {a, b, c}}, {"rotation", {b, c, d, a}}};
    }
    static rig::Transform read(const Json& json) {
        return read_transform(JsonPlace(json, ""), {}, max_reached);
    }
    static void expect_same(const rig::Transform& a, const rig::Transform& b, const std::string& what) {
        EXPECT_LT(glm::length(a.translation - b.translation), 1e-5) << what;
        EXPECT_GT(std::abs(glm::dot(a.rotation, b.rotation)), 1.0 - 1e-10) << what;
        EXPECT_LT(glm::length(a.scale - b.scale), 1e-5) << what;
    }

    std::mt19937 random_{9};
};

TEST_F(RigWhy, ContributionsAddUpToThePoseInEveryScene) {
    for (const RigPreset& preset : rig_presets()) {
        run("rig.preset", {{"name", preset.name}});
        for (int round = 0; round < 3; ++round) {
            const std::vector<rig::Element> elements = part().rig.definition().elements;
            for (const rig::Element& each : elements)
                if (each.control) run("rig.control.set", {{"name", each.name}, {"value", any_value(each)}});
            tick(1 + 20 * round);
            for (const rig::Element& each : elements) {
                const std::string what = preset.name + std::string(": ") + each.name;
                select(each.name);
                const Json why = state().at("why");
                EXPECT_EQ(why.at("element"), each.name);
                ASSERT_EQ(why.at("units").size(), part().rig.definition().units.size());
                rig::Transform pose = read(why.at("input"));
                for (const Json& unit : why.at("units")) pose = rig::compose(pose, read(unit.at("change")));
                expect_same(pose, read(why.at("result")), what);
                expect_same(pose, read(named("elements", each.name).at("global")), what + ", as it is shown");
            }
        }
    }
}

TEST_F(RigWhy, AMutedUnitAddsNothing) {
    run("rig.preset", {{"name", "fk"}});
    set("dial", 0.5);
    select("bone 2");
    tick();
    const auto added = [&](std::size_t unit) {
        return state().at("why").at("units")[unit]["degrees"].get<double>();
    };
    ASSERT_EQ(state().at("why").at("units")[2].at("name"), "follow 2");
    EXPECT_NEAR(added(2), 12.5, 1e-6);
    run("rig.unit.enable", {{"name", "follow 2"}, {"on", false}});
    tick();
    EXPECT_EQ(added(2), 0.0);
    EXPECT_EQ(state().at("why").at("units").size(), 7u) << "it is still listed";
    run("rig.select");
    EXPECT_TRUE(state().at("why").is_null());
}

TEST_F(RigWhy, IsComputedOncePerChange) {
    run("rig.preset", {{"name", "loop"}});
    auto& runtime = workspace.runtimes.of<RigRuntime>(rig_lab);
    const rig::Contribution* first = runtime.explanation(workspace, 8).units.data();
    EXPECT_EQ(runtime.explanation(workspace, 8).units.data(), first);
    const rig::Transform before = runtime.explanation(workspace, 8).result;
    set("dial", 0.7);
    EXPECT_FALSE(runtime.explanation(workspace, 8).result == before);
}

TEST_F(RigWhy, ThePanelFoldsUnitsWithoutEffectAndKeepsMutedOnes) {
    run("rig.preset", {{"name", "fk"}});
    set("dial", 0.5);
    select("bone 2");
    tick();
    test::PanelReader reader;
    const auto says = [&](const char* what) {
        return reader.inspector(lab(), workspace).find(what) != std::string::npos;
    };
    EXPECT_TRUE(says("Why is this bone here?"));
    EXPECT_TRUE(says("follow 2"));
    EXPECT_FALSE(says("follow 5")) << "bones below do not move it";
    EXPECT_TRUE(says("5 units did not change it"));
    run("rig.unit.enable", {{"name", "follow 2"}, {"on", false}});
    tick();
    EXPECT_TRUE(says("follow 2"));
    EXPECT_TRUE(says("muted"));
}

}  // namespace
}  // namespace tendril::app
