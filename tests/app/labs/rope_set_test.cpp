// Editing the material of ropes, cloth and hair while they hang.
#include "app/labs/kit/named_world.hpp"
#include "app/labs/kit/race.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class RopeSet : public RopeTest {
  protected:
    RopeSet() {
        single_rope(16);
        run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
        add_cloth();
        run("rope.hair.add", {{"centre", {6, 2, 0}}, {"strands", 3}, {"segments", 8}});
        wait(120);
    }
    static Json made_of(const char* body, const NamedWorld& in) {
        const BodySettings settings = settings_of(in, *in.find(body));
        const std::vector<Field> rows = body_fields(settings);
        return save_fields({rows, &settings});
    }
    Json made_of(const char* body) const { return made_of(body, world()); }
    static void expect_near(const Json& value, const Json& wanted) {
        if (wanted.is_number())
            EXPECT_NEAR(value.get<double>(), wanted.get<double>(), 1e-4 * wanted.get<double>());
        else
            EXPECT_EQ(value, wanted);
    }
    double lowest() const {
        double low = 10.0;
        for (const glm::dvec3& each : world().state().position) low = std::min(low, each.y);
        return low;
    }
};

/// For each kind, and for cut pieces: a set value is kept, saved, undone and replayed, or refused by name.
TEST_F(RopeSet, EveryPropertyOfEveryKind) {
    run("rope.cut", {{"rope", "rope"}, {"segment", 9}});
    run("rope.add", {{"name", "bit"}, {"from", {0, 4, 0}}, {"to", {1, 4, 0}}, {"segments", 1}});
    run("rope.cut", {{"rope", "bit"}, {"segment", 0}});
    run("rope.cloth.cut",
        {{"rope", "cloth"}, {"lines", {{{-1, 2.5}, {3.5, 5.5}, {8, 2.5}}, {{-1, 6.5}, {8, 6.5}}}}});
    wait(30);
    const struct {
        const char *body, *lacks;
    } cases[] = {
        {"rope", "width columns rows shear bend"},
        {"rope 2", "width columns rows shear bend"},
        {"bit", "length width segments columns rows density stretch shear bend"},  // a single particle
        {"cloth", "segments bending"},
        {"cloth 2", "segments bending"},                           // with gaps
        {"cloth 3", "width segments rows density bending shear"},  // a thread
        {"hair", "width columns rows bending shear tear"}};
    const Json start = save_scene(workspace);
    std::vector<Json> done;
    for (const auto& each : cases)
        for (const Field& field : fields<BodySettings>()) {
            SCOPED_TRACE(each.body + (" " + std::string(field.name)));
            const Json was = made_of(each.body), now = was.value(field.name, Json(nullptr));
            const Json value = field.type == FieldType::Choice ? Json(field.choices[2])
                               : field.type == FieldType::Integer
                                   ? Json(now.is_null() ? 5 : now.get<int>() + 3)
                               : now.is_null() || now == 0.0 ? Json(0.25)
                                                             : Json(1.5 * now.get<double>());
            const Json given{{"rope", each.body}, {field.name, value}};
            if (test::says(each.lacks, field.name)) {
                const std::string none =
                    was.contains(field.name) ? "" : " it has no " + std::string(field.name);
                refuses("rope.set", given, "rope.set" + none);
                continue;
            }
            run("rope.set", given);
            done.push_back(given);
            const Json set = made_of(each.body);
            expect_near(set.at(field.name), value);
            for (const char* const other :
                 {"radius", "friction", "stretch", "shear", "bend", "tear", "colour"})
                if (other != std::string(field.name) && was.contains(other))
                    expect_near(set.at(other), was.at(other));
            run("undo");
            EXPECT_EQ(made_of(each.body), was);
            run("redo");
            EXPECT_EQ(made_of(each.body), set);
        }
    const Workspace opened = reopened();
    for (const auto& each : cases)
        EXPECT_EQ(made_of(each.body, *rope_part(opened).world), made_of(each.body)) << each.body;
    Workspace again = make_blank_workspace(labs);
    load_scene(again, start);
    for (const Json& each : done) run_in(again, "rope.set", each);
    EXPECT_EQ(save_scene(again).at("labs"), save_scene(workspace).at("labs"));
}

/// Mass follows length at constant density, and stretch is the material's.
TEST_F(RopeSet, TheMaterialStaysTheSameAsABodyGrows) {
    run("rope.set", {{"rope", "rope"}, {"density", 2}, {"stretch", 1e-3}});
    const double mass = made_of("rope")["mass"];
    run("rope.set", {{"rope", "rope"}, {"length", 3}, {"segments", 24}});
    const Json rope = made_of("rope");
    expect_near(rope["density"], 2.0);
    EXPECT_NEAR(rope["mass"].get<double>(), 3.0 * mass, 0.15 * mass);
    expect_near(rope["stretch"], 1e-3);
    EXPECT_EQ(rope["segments"], 24);
    for (const auto& [name, value] : rope.items()) EXPECT_EQ(state()["ropes"][0][name], value) << name;
    run("rope.set", {{"rope", "cloth"}, {"length", 2}, {"width", 0.5}, {"columns", 12}, {"rows", 5}});
    const Json cloth = made_of("cloth");
    expect_near(cloth["length"], 2.0);
    expect_near(cloth["width"], 0.5);
    EXPECT_EQ(cloth["columns"], 12);
    EXPECT_EQ(cloth["rows"], 5);
    expect_near(cloth["mass"], 0.2);
    EXPECT_TRUE(world().pinned(world().find("cloth")->first + 11));
    for (int i = 0; i < 3; ++i) run("undo");
    EXPECT_EQ(made_of("cloth")["columns"], 8);
    expect_near(made_of("rope")["density"], 1.0);
}

TEST_F(RopeSet, TheSelectionFollowsItsParticles) {
    const auto selected = [&] { return part().selection->particles.all(); };
    const auto active = [&] { return part().selection->particle(); };
    run("rope.select", {{"rope", "rope"}, {"particles", {4, 12}}});
    run("rope.set", {{"rope", "rope"}, {"segments", 32}});
    EXPECT_EQ(selected(), (std::vector<std::size_t>{8, 24}));
    EXPECT_EQ(active(), 24u);
    run("rope.reverse", {{"rope", "rope"}});
    EXPECT_EQ(selected(), (std::vector<std::size_t>{8, 24}));
    EXPECT_EQ(active(), 8u);
    run("rope.select", {{"rope", "rope"}});
    run("rope.merge", {{"rope", "rope"}});
    EXPECT_EQ(made_of("rope")["segments"], 16);
    EXPECT_EQ(selected().size(), 17u);  // still all of it
    run("rope.subdivide", {{"rope", "rope"}});
    EXPECT_EQ(selected().size(), 33u);
    run("rope.subdivide", {{"rope", "cloth"}});
    EXPECT_EQ(made_of("cloth")["columns"], 15);
    run("rope.merge", {{"rope", "cloth"}});
    EXPECT_EQ(made_of("cloth")["rows"], 8);
    run("rope.subdivide", {{"rope", "hair"}});
    EXPECT_EQ(made_of("hair")["segments"], 16);
}

TEST_F(RopeSet, AHeldRopeIsDividedAndReleased) {
    workspace.clock.playing = true;
    run("rope.hold", {{"rope", "rope"}, {"particle", 16}, {"at", {1, 2.2, 0}}});
    wait(10);
    run("rope.set", {{"rope", "rope"}, {"segments", 40}});
    run("rope.let_go");
    EXPECT_FALSE(world().pinned(40));
    EXPECT_TRUE(world().pinned(0));
}

/// It is copied as C++; set to the world's value, it follows the world's again.
TEST_F(RopeSet, ABodyCanHaveItsOwnFriction) {
    const auto friction = [&](const char* body) { return made_of(body)["friction"]; };
    run("rope.set", {{"rope", "rope"}, {"friction", 0.75}});
    EXPECT_EQ(friction("rope"), 0.75);
    EXPECT_EQ(friction("cloth"), nullptr) << "the world's";
    run("rope.settings", {{"friction", 0.5}});
    EXPECT_EQ(friction("rope"), 0.75) << "its own";
    run("rope.copy");
    EXPECT_NE(workspace.ui.copied.value().find(".friction = 0.75f"), std::string::npos);
    run("rope.settings", {{"friction", 0.25}});
    run("rope.set", {{"rope", "rope"}, {"friction", 0.25}});
    EXPECT_EQ(friction("rope"), nullptr);
}

/// It is in the scene and the legend; pieces keep it, and a body that takes a freed slot does not.
TEST_F(RopeSet, ABodyHasAColour) {
    const Palette& colours = palette(workspace.settings.theme);
    const auto legend = [&] { return lab().legend(workspace); };
    const auto colour = [&](const char* body) { return body_colour(world(), *world().find(body), colours); };
    const std::size_t rows = legend().size();
    const glm::vec3 usual = colour("cloth"), pink = racer_colour(colours, 2);
    run("rope.set", {{"rope", "cloth"}, {"colour", "pink"}});
    EXPECT_EQ(colour("cloth"), pink);
    EXPECT_EQ(particle_colours(world(), colours, false)[world().find("cloth")->first], pink);
    EXPECT_EQ(colour("rope"), colours.joint);
    run("rope.view", {{"cloths", "blue"}, {"ropes", "pink"}});
    const KindColours kinds = rope_part(workspace).view.colours();
    EXPECT_EQ(body_colour(world(), *world().find("cloth"), colours, kinds), pink) << "its own";
    EXPECT_EQ(body_colour(world(), *world().find("rope"), colours, kinds), pink) << "its kind's";
    run("rope.view", {{"cloths", "by_kind"}, {"ropes", "by_kind"}});
    ASSERT_EQ(legend().size(), rows + 1);
    EXPECT_EQ(legend().back().name, "cloth");
    EXPECT_EQ(legend().back().colour, pink);
    run("rope.cloth.cut", {{"rope", "cloth"}, {"points", {{-1, 3.5}, {8, 3.5}}}});
    EXPECT_EQ(colour("cloth 2"), pink);
    EXPECT_TRUE(test::says(legend().back().name, "cloth and 1 more"));
    EXPECT_EQ(lab().state(workspace)["cloths"][1]["colour"], "pink");
    load_scene(workspace, save_scene(workspace));
    EXPECT_EQ(colour("cloth 2"), pink);
    run("rope.view", {{"strain", true}});
    EXPECT_NE(legend().back().colour, pink);
    run("rope.remove", {{"name", "cloth 2"}});
    run("rope.cloth.add", {{"corner", {9, 2, 0}}, {"along", {1, 0, 0}}, {"down", {0, -1, 0}}});
    EXPECT_EQ(colour("cloth 2"), usual);
    run("rope.set", {{"rope", "cloth"}, {"colour", "by_kind"}});
    EXPECT_EQ(colour("cloth"), usual);
    run("undo");
    EXPECT_EQ(colour("cloth"), pink);
}

TEST_F(RopeSet, RenamesABody) {
    run("rope.select", {{"rope", "rope"}, {"particle", 3}});
    run("rope.set", {{"rope", "rope"}, {"name", "line"}});
    EXPECT_EQ(part().selection->body, "line");
    EXPECT_EQ(world().find("rope"), nullptr);
    refuses("rope.set", {{"rope", "line"}, {"name", "cloth"}}, "rope.set name cloth");
    refuses("rope.set", {{"rope", "line"}, {"name", ""}}, "rope.set name");
    run("rope.set", {{"rope", "line"}, {"name", "line"}, {"radius", 0.1}});
    EXPECT_EQ(made_of("line")["radius"], 0.1);
}

TEST_F(RopeSet, RefusesPropertiesThatABodyLacks) {
    refuses("rope.set", {{"rope", "line"}, {"mass", 1}}, "rope.set line");
    refuses("rope.set", {{"rope", "rope"}, {"mass", 1}, {"density", 1}}, "rope.set mass density");
    refuses("rope.set", {{"rope", "cloth"}, {"columns", 50000}}, "rope.set maximum");
    refuses("rope.reverse", {{"rope", "cloth"}}, "rope.reverse only ropes");
    refuses("rope.subdivide", {{"rope", "line"}}, "rope.subdivide line");
    run("rope.pin", {{"rope", "rope"}, {"particle", 7}});
    refuses("rope.set", {{"rope", "rope"}, {"segments", 1}}, "rope.set 2 segments");
}

// Several particles at once: selecting, pinning, cutting.

class RopeSelectionTest : public RopeTest {
  protected:
    using Indices = std::vector<std::size_t>;
    Indices selected() const { return part().selection ? part().selection->particles.all() : Indices(); }
    bool pinned(const char* body, std::size_t index) const {
        return world().pinned(world().find(body)->first + index);
    }
    void select(const std::vector<PickId>& picks, bool add = false) {
        emit([&](Emit& to) { lab().select(workspace, picks, add, to); });
    }
};

TEST_F(RopeSelectionTest, ParticlesOfOneRopeAreAddedAndRemoved) {
    single_rope(8);
    run("rope.select", {{"rope", "rope"}, {"particle", 2}});
    run("rope.select", {{"rope", "rope"}, {"particle", 5}, {"add", true}});
    EXPECT_EQ(selected(), (Indices{2, 5}));
    EXPECT_EQ(state()["selected"]["particle"], 5);
    EXPECT_EQ(state()["selected"]["particles"], Json({2, 5}));
    run("rope.select", {{"rope", "rope"}, {"particle", 2}, {"add", true}});
    EXPECT_EQ(selected(), Indices{5});
    run("rope.select", {{"rope", "rope"}, {"particle", 5}, {"add", true}});
    EXPECT_FALSE(part().selection);
    // Selecting on another rope replaces the selection.
    run("rope.add", {{"name", "other"}, {"from", {0, 3, 0}}, {"to", {1, 3, 0}}, {"segments", 4}});
    run("rope.select", {{"rope", "rope"}, {"particles", {1, 3}}});
    run("rope.select", {{"rope", "other"}, {"particle", 4}, {"add", true}});
    EXPECT_EQ(part().selection->body, "other");
    EXPECT_EQ(selected(), Indices{4});
}

TEST_F(RopeSelectionTest, PinsAndUnpinsAllInOneStep) {
    single_rope(8);
    run("rope.pin", {{"rope", "rope"}, {"particles", {1, 4, 6}}});
    for (const std::size_t i : {1u, 4u, 6u}) EXPECT_TRUE(pinned("rope", i)) << i;
    EXPECT_FALSE(pinned("rope", 3));
    run("rope.unpin", {{"rope", "rope"}, {"particles", {4, 5, 6}}});
    EXPECT_TRUE(pinned("rope", 1));
    EXPECT_FALSE(pinned("rope", 4));
    run("undo");
    EXPECT_TRUE(pinned("rope", 4));
    run("undo");
    EXPECT_FALSE(pinned("rope", 1));
}

TEST_F(RopeSelectionTest, ABoxTakesTheRopeWithMostParticlesInIt) {
    single_rope(8);
    run("rope.add", {{"name", "other"}, {"from", {0, 3, 0}}, {"to", {1, 3, 0}}, {"segments", 4}});
    const auto first = static_cast<PickId>(world().find("other")->first);
    EXPECT_EQ(lab().selectable(workspace, 0).size(), world().size());
    select({first + 3, 2, first + 1, first, 7});
    EXPECT_EQ(part().selection->body, "other");
    EXPECT_EQ(selected(), (Indices{0, 1, 3}));
    // Adding keeps the selected body, even if another has more particles in the box.
    select({first + 2, 1, 2, 3, 4, 5}, true);
    EXPECT_EQ(selected(), (Indices{0, 1, 2, 3}));
    select({}, true);
    EXPECT_EQ(selected().size(), 4u);
    select({});
    EXPECT_FALSE(part().selection);
}

/// A box selects the particles that it shows, not those at the same pixels of the first pane.
TEST_F(RopeSelectionTest, ABoxInARacesOtherPaneSelectsThatPanesParticles) {
    single_rope(8);
    race_aside();
    const auto box = [&](std::size_t pane, float from, float to) {
        std::vector<PickId> picks;
        for (const Handle& each : lab().selectable(workspace, pane))
            if (each.frame.position.x > from && each.frame.position.x < to) picks.push_back(each.pick);
        select(picks);
    };
    box(1, 2.1f, 2.4f);
    EXPECT_EQ(selected(), (Indices{1, 2, 3}));
    box(2, 0.6f, 0.7f);
    EXPECT_EQ(selected(), (Indices{5}));
    box(1, 0.1f, 0.4f);
    EXPECT_FALSE(part().selection);
}

TEST_F(RopeSelectionTest, ACutKeepsTheSelectionOnTheActiveOnesPart) {
    single_rope(8);
    run("rope.select", {{"rope", "rope"}, {"particles", {1, 7, 3, 6}}});
    run("rope.cut", {{"rope", "rope"}, {"segment", 4}});
    EXPECT_NE(part().selection->body, "rope");
    EXPECT_EQ(selected(), (Indices{1, 2})) << "6 and 7, counted in the new rope";
    EXPECT_EQ(part().selection->particle(), 1u);
    run("rope.select", {{"rope", "rope"}, {"particles", {0, 4, 2}}});
    run("rope.cut", {{"rope", "rope"}, {"segment", 2}});
    EXPECT_EQ(part().selection->body, "rope");
    EXPECT_EQ(selected(), (Indices{0, 2}));
}

TEST_F(RopeSelectionTest, OtherIndicesAreRefusedAndChangeNothing) {
    single_rope(8);
    run("rope.select", {{"rope", "rope"}, {"particles", {1, 2}}});
    for (const char* command : {"rope.select", "rope.pin", "rope.unpin"})
        EXPECT_FALSE(refused(command, {{"rope", "rope"}, {"particles", {0, 9}}}).empty()) << command;
    refused("rope.pin", {{"rope", "rope"}, {"particles", {1, 2}}, {"at", {0, 0, 0}}});
    refused("rope.pin", {{"rope", "rope"}});
    refused("rope.select", {{"rope", "rope"}, {"particle", 1}, {"particles", {2}}});
}

}  // namespace
}  // namespace tendril::app
