// Refusals of the Rope lab's commands: their messages, and that nothing changes.
#include "app/fields/fields.hpp"
#include "tests/app/labs/rope_support.hpp"

namespace tendril::app {
namespace {

class RopeRefusals : public RopeTest {};

const Json origin = Json::array({0, 0, 0}), right = Json::array({1, 0, 0});

TEST_F(RopeRefusals, AColliderTakesTheArgumentsOfItsKindAndNeedsThem) {
    run("rope.clear");
    const Field& shape = fields<rope::Collider>().front();
    std::vector<Json> usual;
    for (const FieldKind& kind : shape.kinds) usual.push_back(save_fields({kind.table(), kind.fresh()}));
    for (std::size_t i = 0; i < usual.size(); ++i) {
        const std::string kind = shape.choices[i];
        Json made{{"name", kind}, {"kind", kind}};
        made.update(usual[i]);
        for (const Field& field : shape.kinds[i].table()) {
            Json without = made;
            without.erase(field.name);
            if (field.required)
                refuses("rope.collider.add", without,
                        "rope.collider.add " + std::string(field.name) + " missing " + kind);
        }
        run("rope.collider.add", made);
        refuses("rope.collider.add", made, "rope.collider.add no other collider " + kind);
        for (const Json& other : usual)
            for (const auto& [name, value] : other.items())
                if (!usual[i].contains(name))
                    refuses("rope.collider.set", {{"name", kind}, {name, value}},
                            "rope.collider.set " + kind + " no " + name);
    }
    refuses("rope.collider.add", {{"name", ""}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}},
            "rope.collider.add name empty");
    refuses("rope.collider.set", {{"name", "x"}, {"radius", 1}}, "rope.collider.set no collider x");
    refused("rope.collider.set", {{"name", "plane"}, {"normal", origin}});
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
}

}  // namespace
}  // namespace tendril::app
