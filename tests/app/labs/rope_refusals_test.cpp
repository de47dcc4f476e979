// Refusals of the Rope lab's commands: their messages, and that nothing changes.
#include "tests/app/labs/rope_support.hpp"

namespace tendril::app {
namespace {

class RopeRefusals : public RopeTest {};

const Json origin = Json::array({0, 0, 0}), right = Json::array({1, 0, 0});

TEST_F(RopeRefusals, SayWhyInOneLine) {
    single_rope(8);
    refuses("rope.add", {{"from", origin}}, "rope.add to missing point");
    refuses("rope.pin", {{"rope", "rope"}, {"particle", 9}}, "rope.pin 9 range rope 9");
    refuses("rope.pin", {{"rope", "line"}, {"particle", 0}}, "rope.pin no rope line");
    refuses("rope.cut", {{"rope", "rope"}, {"segment", 8}}, "rope.cut segment 8 range rope 8");
    refuses("rope.remove", {{"name", "x"}}, "rope.remove no rope x");
    refuses("rope.collider.move", {{"name", "x"}, {"to", origin}}, "rope.collider.move no collider x");
    refuses("rope.collider.remove", {{"name", "x"}}, "rope.collider.remove no collider x");
    refuses("rope.collider.swing", {{"name", "x"}, {"by", right}}, "rope.collider.swing no collider x");
}

TEST_F(RopeRefusals, AColliderTakesOnlyTheArgumentsOfItsKind) {
    refuses("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}},
            "rope.collider.add radius missing sphere");
    refuses("rope.collider.add",
            {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}, {"normal", right}},
            "rope.collider.add sphere normal");
    refuses("rope.collider.add", {{"name", "s"}, {"kind", "capsule"}, {"a", origin}, {"radius", 1}},
            "rope.collider.add b missing capsule");
    refuses("rope.collider.add", {{"name", "s"}, {"kind", "plane"}, {"normal", right}},
            "rope.collider.add point missing plane");
    refuses("rope.collider.add", {{"name", "s"}, {"kind", "box"}, {"centre", origin}},
            "rope.collider.add half_extents missing box");
    refuses("rope.collider.add",
            {{"name", "s"},
             {"kind", "box"},
             {"centre", origin},
             {"half_extents", right},
             {"rotation", {1, 1, 1, 1}}},
            "rope.collider.add rotation quaternion length 1 [1,1,1,1]");
    expect_refused("rope.collider.add",
                   {{"name", "ground"}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}},
                   {"no other collider"});
    refuses("rope.collider.add", {{"name", ""}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}},
            "rope.collider.add name empty");
    refused("rope.collider.add", {{"name", "p"}, {"kind", "plane"}, {"point", origin}, {"normal", origin}});
}

TEST_F(RopeRefusals, AColliderNeedsTheArgumentsOfItsKind) {
    run("rope.preset", {{"name", "drape"}});
    refuses("rope.collider.set", {{"name", "x"}, {"radius", 1}}, "rope.collider.set no collider x");
    refuses("rope.collider.set", {{"name", "ball"}, {"half_extents", right}},
            "rope.collider.set sphere half_extents");
    refused("rope.collider.set", {{"name", "ground"}, {"normal", origin}});
}

TEST_F(RopeRefusals, ScenesThatWouldTakeTooLongAreRefusedWithTheirSize) {
    single_rope(8000);
    refuses("rope.settings", {{"iterations", 10'000}},
            "rope.settings 8000 links 10000 iterations 80008001 50000000");
    run("rope.settings", {{"iterations", 6000}});
    refused("rope.add", {{"from", origin}, {"to", right}, {"segments", 1000}});
}

TEST_F(RopeRefusals, TooManyAreRefusedWithTheNumberAndTheLimit) {
    single_rope(8);
    refuses("rope.add", {{"from", origin}, {"to", right}, {"segments", 99'999}},
            "rope.add 100009 particles 100000");
    refuses(
        "rope.cloth.add",
        {{"corner", origin}, {"along", right}, {"down", {0, 1, 0}}, {"columns", 100'000}, {"rows", 100'000}},
        "rope.cloth.add 10000000009 particles 100000");
    refuses("rope.hair.add", {{"centre", origin}, {"strands", 10'000}, {"segments", 9}},
            "rope.hair.add 100009 particles 100000");
    run("rope.clear");
    for (std::size_t i = 0; i < max_lab_colliders; ++i)
        run("rope.collider.add",
            {{"name", std::to_string(i)}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}});
    refuses("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}},
            "rope.collider.add 1001 colliders 1000");
}

TEST_F(RopeRefusals, IncompatibleArguments) {
    single_rope(8);
    refuses("rope.select", {{"particle", 0}}, "rope.select rope missing text");
    refuses("rope.select", {{"rope", "rope"}, {"particle", 0}, {"collider", "x"}},
            "rope.select particle collider both");
    refuses("rope.hair.add", Json::object(), "rope.hair.add centre missing collider");
    refuses("rope.hair.add", {{"attach", "x"}}, "rope.hair.add no collider x");
    refuses("rope.hair.add", {{"centre", origin}, {"direction", origin}},
            "rope.hair.add direction finite length 0");
    refused("rope.add", {{"from", origin}, {"to", right}, {"name", "rope"}});
    add_cloth("cloth", origin, right, {0, 1, 0}, 3, 3);
    refused("rope.cut", {{"rope", "cloth"}, {"segment", 0}});
    run("rope.collider.add", {{"name", "far"}, {"kind", "sphere"}, {"centre", {9e8, 0, 0}}, {"radius", 1}});
    refuses("rope.collider.swing", {{"name", "far"}, {"by", {9e8, 0, 0}}}, "rope.collider.swing 1e9 m");
    refused("rope.collider.swing", {{"name", "far"}, {"by", right}, {"period", 0}});
}

}  // namespace
}  // namespace tendril::app
