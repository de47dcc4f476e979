// The contents of the Rig lab's panels: their lists, offers and edits.
#include <set>

#include "app/document/refused.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/labs/rig/values.hpp"
#include "rig_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class RigPanels : public RigTest {
  protected:
    std::vector<UnitInput> inputs(const std::string& unit) {
        auto& runtime = workspace.runtimes.of<RigRuntime>(rig_lab);
        return unit_inputs(part(), runtime.resolved(workspace), *unit_row(part(), unit)->unit);
    }
    UnitInput input(const std::string& unit, const std::string& path) {
        for (const UnitInput& each : inputs(unit))
            if (each.path == path) return each;
        ADD_FAILURE() << "no input " << path << " in " << unit;
        return {};
    }
    void expect_says(const std::string& text, const std::string& what) {
        EXPECT_NE(text.find(what), std::string::npos) << what << " is not in:\n" << text;
    }
    /// With every section unfolded.
    std::string panel_text() {
        set_folded(workspace.settings, rig_lab, false);
        return reader_.panel(lab(), workspace);
    }
    std::string inspector_text() { return reader_.inspector(lab(), workspace); }

  private:
    test::PanelReader reader_;
};

/// Members of a unit's JSON that are not inputs, or have rows of their own.
bool is_input(const std::string& member) {
    return member != "unit" && member != "name" && member != "enabled" && member != "body";
}

TEST_F(RigPanels, EveryMemberOfEveryUnitIsListed) {
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
        run("rig.preset", {{"name", "fk"}});
        run("rig.curve.add", {{"name", "smile"}});
        run("rig.select", {{"element", "bone 5"}});
        const UnitOffer offer = offered_unit(part(), i);
        ASSERT_TRUE(offer.unit) << rig::operation_name(i);
        Json unit = **offer.unit;
        unit["name"] = "new";
        run("rig.unit.add", unit);
        EXPECT_TRUE(test::says(inspector_text(), "Unit: Element")) << "the one chosen last is first";
        run("rig.select", {{"element", "bone 4"}, {"unit", "new"}});
        EXPECT_TRUE(test::says(inspector_text(), "Element Unit:"));
        const rig::Unit& added = *unit_row(part(), "new")->unit;
        const Json json = save_fields(added);
        std::set<std::string> listed, members;
        for (const UnitInput& each : inputs("new")) {
            EXPECT_NO_THROW(static_cast<void>(json.at(Json::json_pointer(each.path)))) << each.path;
            listed.insert(each.path.substr(1, each.path.find('/', 1) - 1));
        }
        for (const auto& [key, value] : json.items())
            if (is_input(key)) members.insert(key);
        EXPECT_EQ(listed, members) << rig::operation_name(i);
    }
}

TEST_F(RigPanels, EveryOfferIsAccepted) {
    std::size_t taken = 0;
    const auto offer_all = [&] {
        for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
            const UnitOffer offer = offered_unit(part(), i);
            if (!offer.unit) {
                EXPECT_TRUE(test::says(offer.needs, "add first") ||
                            test::says(offer.needs, "select two bones above"))
                    << rig::operation_name(i);
                continue;
            }
            const std::size_t before = part().state->units.size();
            run("rig.unit.add", *offer.unit);
            EXPECT_EQ(part().state->units.size(), before + 1);
            ++taken;
        }
    };
    offer_all();  // an empty rig
    EXPECT_EQ(taken, 7u) << "those without an item";
    for (const RigPreset& preset : rig_presets()) {
        run("rig.preset", {{"name", preset.name}});
        const std::vector<rig::Element> elements = part().rig.definition().elements;
        for (std::size_t i = 0; i < elements.size(); i += 3) {
            run("rig.preset", {{"name", preset.name}});
            run("rig.select", {{"element", elements[i].name}});
            offer_all();
            tick();
        }
    }
    EXPECT_EQ(free_element_name(part(), "left 1"), "left 1 2");
}

TEST_F(RigPanels, ALiteralIsSetAndNothingElseChanges) {
    run("rig.preset", {{"name", "fk"}});
    for (const rig::Unit& unit : part().rig.definition().units) {
        for (const UnitInput& each : inputs(unit.name)) {
            const auto& value = each.value;
            if (!each.literal() || !value) continue;
            Json other;
            if (const auto* on = std::get_if<bool>(&*value)) other = !*on;
            if (const auto* literal = std::get_if<double>(&*value)) other = *literal - 0.25;
            if (other.is_null()) continue;
            Json wanted = save_fields(*unit_row(part(), unit.name)->unit);
            wanted[Json::json_pointer(each.path)] = other;
            run("rig.unit.set", with_input(*unit_row(part(), unit.name)->unit, each.path, other));
            EXPECT_EQ(save_fields(*unit_row(part(), unit.name)->unit), wanted) << unit.name << each.path;
        }
    }
}

TEST_F(RigPanels, InputsShowTheirSourceAndPresentValue) {
    run("rig.preset", {{"name", "morph"}});
    set("shape", {0.25, 0.5});
    tick();
    const UnitInput value = input("ease", "/value");
    EXPECT_EQ(value.from, "shape, x, local");
    EXPECT_EQ(value.value, rig::Value(0.25));
    const UnitInput result = input("set bulge", "/value");
    EXPECT_EQ(result.from, "unit late");
    EXPECT_EQ(value_json(*result.value), output("late"));
    EXPECT_TRUE(input("ease", "/curve").literal());
    run("rig.preset", {{"name", "secondary"}});
    EXPECT_EQ(input("spring", "/target").from, "unit tip");
    EXPECT_FALSE(input("strength", "/value").value) << "another one in each round";
}

class RigOffers : public RigPanels {
  protected:
    std::vector<InputOffer> offers(const std::string& unit, const UnitInput& input) {
        return input_offers(part(), *unit_row(part(), unit), input);
    }

    /// Applies some of the offers and undoes each.
    void take_all(const std::string& unit, const UnitInput& before) {
        const std::vector<InputOffer> all = offers(unit, before);
        for (std::size_t i = 0; i<all.size(); i += all.size()> 20 ? 11 : 1)
            if (!all[i].now) take(unit, before, all[i]);
    }

    std::size_t taken = 0, refusals = 0;

  private:
    void take(const std::string& unit, const UnitInput& before, const InputOffer& offer) {
        try {
            run("rig.unit.set", with_input(*unit_row(part(), unit)->unit, before.path, *offer.value));
        } catch (const Refused& refusal) {
            // The ends of a bone chain and the type of a spring may not fit the other inputs.
            EXPECT_TRUE(before.field->of == std::string_view("bones") || !before.takes_input() ||
                        !before.type())
                << unit << before.path << offer.title << refusal.what();
            ++refusals;
            return;
        }
        ++taken;
        const UnitInput now = input(unit, before.path);
        const std::vector<std::string> names = now.names();
        const bool own = offer.title.starts_with("a value of") || offer.title.starts_with("a switch of");
        if (own) {
            EXPECT_TRUE(now.literal()) << unit << before.path;
        } else if (before.field->count == nullptr) {
            EXPECT_EQ(names.empty() ? now.from : names.front(), offer.title);
        }
        run("undo");
    }
};

TEST_F(RigOffers, EveryOfferForAnInputIsAcceptedAndApplied) {
    for (const RigPreset& preset : rig_presets()) {
        run("rig.preset", {{"name", preset.name}});
        tick();
        std::vector<std::string> units;
        for (const UnitRow& row : unit_rows(part())) units.push_back(row.unit->name);
        for (std::size_t u = 0; u<units.size(); u += units.size()> 12 ? 5 : 1)
            for (const UnitInput& each : inputs(units[u])) take_all(units[u], each);
    }
    EXPECT_GT(taken, 400u);
    EXPECT_LT(refusals, taken / 4);
}

TEST_F(RigOffers, OneOfThemIsThePresentValue) {
    for (const RigPreset& preset : rig_presets()) {
        run("rig.preset", {{"name", preset.name}});
        tick();
        for (const UnitRow& row : unit_rows(part())) {
            for (const UnitInput& each : inputs(row.unit->name)) {
                const std::vector<InputOffer> all = offers(row.unit->name, each);
                const bool literal = each.takes_input() && each.literal();
                if (all.empty() || each.from == "none") continue;
                EXPECT_EQ(std::ranges::count_if(all, &InputOffer::now), literal ? 0 : 1)
                    << row.unit->name << each.path << each.from;
            }
        }
    }
}

std::size_t operation_index(const std::string& name) {
    const std::vector<std::string> names = operation_names();
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

TEST_F(RigPanels, OffersHaveTheRightKind) {
    const auto titles = [&](const std::string& unit, const std::string& path, std::size_t index = 0) {
        std::set<std::string> all;
        for (const InputOffer& each : input_offers(part(), *unit_row(part(), unit), input(unit, path), index))
            all.insert(each.title);
        return all;
    };
    run("rig.preset", {{"name", "morph"}});
    tick();
    const std::set<std::string> value = titles("set bulge", "/value");
    for (const char* there :
         {"a value of its own", "unit late", "unit ease", "colour, value", "shape, x, local"})
        EXPECT_TRUE(value.contains(there)) << there;
    for (const char* not_there : {"unit bands", "unit set bulge", "shape, value", "shape, rotation"})
        EXPECT_FALSE(value.contains(not_there)) << not_there;
    EXPECT_EQ(titles("set bulge", "/curve"), (std::set<std::string>{"stretch", "bulge", "hue"}));
    run("rig.preset", {{"name", "aim"}});
    tick();
    const std::set<std::string> target = titles("aim", "/primary/target");
    EXPECT_TRUE(target.contains("look, translation"));
    EXPECT_TRUE(target.contains("tilt, translation, local"));
    EXPECT_FALSE(target.contains("math form, value"));
    EXPECT_TRUE(titles("aim", "/when").contains("math form, value")) << "a bool";
    run("rig.preset", {{"name", "secondary"}});
    tick();
    const std::set<std::string> weight = titles("bend", "/weight");
    EXPECT_TRUE(weight.contains("unit share") && weight.contains("each ratio, 0 to 1"));
    EXPECT_FALSE(weight.contains("unit trail")) << "the for-each that it is in has not run by then";
    EXPECT_FALSE(titles("trail", "/weight").contains("unit share"));
    EXPECT_TRUE(titles("bend", "/item").contains("each element"));
    EXPECT_TRUE(titles("trail", "/roots", 0).contains("none: remove this root"));
    EXPECT_FALSE(titles("trail", "/roots", 0).contains("right 1")) << "a root already";
    EXPECT_FALSE(titles("trail", "/roots", 2).contains("left 1"));
    EXPECT_TRUE(titles("trail", "/roots", 2).contains("left 2"));
    run("rig.select", {{"element", "left 3"}});
    run("rig.unit.add", *offered_unit(part(), operation_index("spline")).unit);
    tick();
    EXPECT_FALSE(titles("spline", "/points", 0).contains("none: remove this point")) << "a curve needs two";
    EXPECT_TRUE(titles("spline", "/points", 2).contains("left 2"));
    run("rig.unit.set", {{"name", "spline"}, {"points", {"head", "left 2", "left 3"}}});
    EXPECT_TRUE(titles("spline", "/points", 0).contains("none: remove this point"));
}

TEST_F(RigPanels, UnitsMoveWithinTheirList) {
    run("rig.preset", {{"name", "morph"}});
    const auto names = [&] {
        std::string all;
        for (const Json& each : list("units")) all += each.at("name").get<std::string>() + ' ';
        return all;
    };
    EXPECT_EQ(names(), "ease set stretch late set bulge bands set hue ");
    run("rig.unit.move", {{"name", "late"}, {"at", 0}});
    EXPECT_EQ(names(), "late ease set stretch set bulge bands set hue ");
    run("rig.unit.move", {{"name", "late"}, {"at", 2}});
    EXPECT_EQ(names(), "ease set stretch late set bulge bands set hue ");
    expect_refused("rig.unit.move", {{"name", "late"}, {"at", 4}}, {"set bulge", "late"});
    expect_refused("rig.unit.move", {{"name", "late"}, {"at", 6}}, {"at must be 0 to 5"});
    expect_refused("rig.unit.move", {{"name", "nobody"}, {"at", 0}}, {"nobody"});
    run("rig.preset", {{"name", "secondary"}});
    run("rig.unit.move", {{"name", "share"}, {"at", 0}});  // within its body
    EXPECT_EQ(list("units")[0].at("body")[0].at("name"), "share");
    expect_refused("rig.unit.move", {{"name", "bend"}, {"at", 0}}, {"bend"});
}

TEST_F(RigPanels, ReadingUpdatesThePathToTheRootAndChangesNothing) {
    element("bone 1");
    for (int i = 2; i <= 9; ++i) {
        const std::string name = "bone " + std::to_string(i), parent = "bone " + std::to_string(i - 1);
        element(name.c_str(), parent.c_str(), transform(0, 1, 0));
    }
    const auto pending = [&](const char* name) {
        return part().state->elements.pending(part().rig.id(*part().rig.element(name)));
    };
    const auto said = [&] { return workspace.ui.toasts.back().text; };
    run("rig.read", {{"name", "bone 9"}});
    run("rig.element.set", {{"name", "bone 3"}, {"space", "global"}, {"transform", transform(5, 0, 0)}});
    EXPECT_EQ(pending("bone 3"), rig::Pending::Local);
    EXPECT_EQ(pending("bone 4"), rig::Pending::Global);
    EXPECT_EQ(pending("bone 9"), rig::Pending::Global);
    EXPECT_EQ(pending("bone 2"), rig::Pending::None);
    const Document before = workspace.document;
    const std::size_t steps = workspace.history.size();
    run("rig.read", {{"name", "bone 7"}});
    EXPECT_EQ(said(), "Reading bone 7: 4 transforms worked out");  // bones 4, 5, 6 and 7
    EXPECT_EQ(pending("bone 7"), rig::Pending::None);
    EXPECT_EQ(pending("bone 5"), rig::Pending::None);
    EXPECT_EQ(pending("bone 8"), rig::Pending::Global);
    run("rig.read", {{"name", "bone 7"}});
    EXPECT_EQ(said(), "Reading bone 7: nothing was pending");
    EXPECT_EQ(workspace.history.size(), steps);
    EXPECT_TRUE(workspace.document.get<RigPart>(rig_lab) == before.get<RigPart>(rig_lab));
    expect_refused("rig.read", {{"name", "bone 10"}}, {"bone 10"});
}

TEST_F(RigPanels, AWarningIsReported) {
    run("rig.preset", {{"name", "aim"}});
    tick();
    EXPECT_EQ(panel_text().find("! "), std::string::npos);
    run("rig.unit.set", {{"name", "aim"}, {"primary", {{"axis", {0, 0, 1}}, {"target", "head"}}}});
    tick();
    expect_says(panel_text(), "! The target is at the item");
}

TEST_F(RigPanels, TheRemainderOfABackwardSolveIsReported) {
    run("rig.preset", {{"name", "loop"}});
    solve("backward");
    expect_says(panel_text(), "The controls can give every bone its pose.");
    // Posed as by an imported animation: no dial turns one joint alone.
    auto& posed = workspace.document.edit<RigPart>(rig_lab);
    const rig::ElementId joint = posed.rig.id(*posed.rig.element("arm 1 joint 3"));
    ASSERT_TRUE(
        posed.state.edit().elements.set(joint, rig::Space::Local, {.rotation = {0.8, 0.6, 0.0, 0.0}}));
    solve("backward");
    EXPECT_GT(part().backward->worst_degrees(), 1.0);
    expect_says(panel_text(), "worst first");
    expect_says(panel_text(), part().backward->bone);
}

TEST_F(RigPanels, ARemainingScaleIsReported) {
    run("rig.preset", {{"name", "loop"}});
    auto& posed = workspace.document.edit<RigPart>(rig_lab);
    const rig::ElementId joint = posed.rig.id(*posed.rig.element("arm 1 joint 6"));
    rig::Transform pose = posed.state.edit().elements.get(joint, rig::Space::Local);
    pose.scale.z = 1.5;
    ASSERT_TRUE(posed.state.edit().elements.set(joint, rig::Space::Local, pose));
    solve("backward");
    EXPECT_LT(part().backward->worst_mm(), 0.1);
    EXPECT_NEAR(state().at("backward").at("worst_scale").get<double>(), 0.5, 1e-6);
    EXPECT_EQ(state().at("backward").at("stopped"), false);
    EXPECT_EQ(part().backward->bone, "arm 1 joint 6");
    expect_says(panel_text(), "The controls cannot give the pose");
    expect_says(panel_text(), "scale 0.500");
    EXPECT_EQ(rig_part(reopened()).backward, part().backward);
    run("rig.clip.record", {{"seconds", 0.1}});
    run("rig.clip.solve");
    while (lab().working(workspace)) lab().work(workspace);
    expect_says(panel_text(), "The rig can express all");
}

TEST_F(RigPanels, CountsAreWholeAndALimitOf0MeansNone) {
    run("rig.preset", {{"name", "loop"}});
    tick();
    const auto& units = part().rig.definition().units;
    const auto loop = std::ranges::find_if(
        units, [](const rig::Unit& unit) { return std::holds_alternative<rig::ForEach>(unit.operation); });
    ASSERT_NE(loop, units.end());
    const std::string count = std::to_string(static_cast<int>(output(loop->name).get<double>()));
    run("rig.unit.add",
        {{"unit", "evaluate_curve"}, {"name", "of count"}, {"value", {{"unit", loop->name}}}});
    tick();
    EXPECT_EQ(input_text(input("of count", "/value"), rig::Value(12.0)), "12");
    run("rig.select", {{"unit", loop->name}});
    const std::string text = inspector_text();
    const std::size_t at = text.find("gives result " + count);
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NE(text[at + 13 + count.size()], '.') << text;
    run("rig.preset", {{"name", "aim"}});
    EXPECT_EQ(input_text(input("aim", "/max_speed"), rig::Value(0.0)), "no limit");
    EXPECT_EQ(input_text(input("aim", "/max_speed"), rig::Value(90.0)), "90.0\xC2\xB0/s");
    run("rig.unit.set", {{"name", "aim"}, {"max_speed", 90}});
    run("rig.select", {{"unit", "aim"}});
    EXPECT_EQ(inspector_text().find("no limit"), std::string::npos);
}

TEST_F(RigPanels, TheInspectorShowsTheSelection) {
    expect_says(inspector_text(), "Nothing is selected");
    run("rig.preset", {{"name", "aim"}});
    tick();
    run("rig.select", {{"element", "look"}, {"unit", "aim"}});
    const std::string text = inspector_text();
    for (const char* said : {"Unit: aim", "primary target", "look, translation", "2D control", "no limit",
                             "-1.00  -1.00 to 1.00  1.00", "along x", "pending"})
        expect_says(text, said);
    run("rig.select", {{"element", "head"}});
    expect_says(inspector_text(), "Input pose, within its parent");
}

TEST_F(RigPanels, UntouchedDigitsStay) {
    const glm::dvec3 before(0.1, 1.0 / 3.0, 2.0);
    const glm::vec3 shown(before);
    EXPECT_EQ(edited_vector(before, shown, shown), before);
    EXPECT_EQ(edited_vector(before, shown, {0.3f, shown.y, shown.z}), glm::dvec3(0.3, 1.0 / 3.0, 2.0));
}

}  // namespace
}  // namespace tendril::app
