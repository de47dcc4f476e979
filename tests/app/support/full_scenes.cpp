#include "tests/app/support/full_scenes.hpp"

#include <tendril/signal/filter.hpp>

#include "app/document/json_complete.hpp"
#include "tests/places.hpp"

namespace tendril::test {

using namespace app;

CommandCall call(const char* name, ArgumentList arguments) {
    return {name, std::move(arguments)};
}

std::vector<CommandCall> bones_and_a_control() {
    const SharedJson above(Json{{"translation", {0.0, 0.3, 0.0}}});
    return {call("rig.clear"), call("rig.element.add", {{"name", "a"}}),
            call("rig.element.add", {{"name", "b"}, {"parent", "a"}, {"local", above}}),
            call("rig.element.add", {{"name", "c"}, {"parent", "b"}, {"local", above}}),
            call("rig.element.add", {{"name", "look"}, {"kind", "control"}, {"control", "position"}})};
}

namespace {

/// The lab's scenes: its opening, its test scenes, and every preset.
std::vector<Shown> scenes_of(const Lab& lab, const CommandTable& table) {
    std::vector<Shown> all{{"as it opens", lab.opening()}};
    for (const TestScene& scene : lab.test_scenes()) all.push_back({scene.name, scene.commands});
    if (const Command* preset = table.find(lab.name() + ".preset"))
        for (const Argument& argument : preset->arguments)
            if (argument.name == "name")
                for (const std::string& name : argument.choices)
                    all.push_back({"preset " + name, {call(preset->name.c_str(), {{"name", name}})}});
    return all;
}

std::vector<Shown> full_chains() {
    const CommandCall arm = call("chain.preset", {{"name", "arm"}}),
                      reach = call("chain.mode", {{"mode", "reach"}}),
                      first = call("chain.select", {{"index", 1}});
    std::vector<Shown> all;
    for (const char* mode : {"forward", "backward", "fixed", "with_index"})
        all.push_back({mode, {call("chain.mode", {{"mode", mode}}), first}});
    for (const char* kind : {"hinge", "ball_and_socket"})
        all.push_back({kind,
                       {arm, reach, call("chain.pole", {{"to", glm::vec3(0.5f, 2.0f, 0.5f)}}), first,
                        call("chain.limit", {{"index", 1}, {"kind", kind}})}});
    all.push_back({"a limit about no axis",
                   {arm, reach, first,
                    call("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"axis", glm::vec3(1, 0, 1)}})}});
    all.push_back({"root selected", {arm, reach, call("chain.select", {{"index", 0}})}});
    all.push_back({"two bones",
                   {call("chain.preset", {{"name", "start"}, {"count", 3}}), reach,
                    call("chain.solver", {{"name", "two_bone"}})}});
    all.push_back({"race", {arm, reach, call("race.open"), first}});
    all.push_back(
        {"race side by side", {arm, reach, call("race.open"), call("race.side_by_side", {{"on", true}})}});
    all.push_back({"several joints",
                   {arm, reach, call("chain.limit", {{"index", 1}, {"kind", "hinge"}}),
                    call("chain.select", {{"joints", SharedJson(Json{0, 1})}})}});
    all.push_back({"the target selected", {arm, reach, call("chain.select", {{"point", "target"}})}});
    all.push_back({"microscope", {arm, reach, call("microscope.open"), first}});
    all.push_back(
        {"moving target",
         {arm, reach, call("chain.motion", {{"path", "circle"}, {"radius", 5.0f}, {"period", 0.5f}}), first},
         60});
    return all;
}

std::vector<Shown> full_ropes() {
    std::vector<Shown> all;
    const CommandCall drape = call("rope.preset", {{"name", "drape"}});
    for (const char* name : {"rope", "cloth", "hair"}) {
        std::vector<CommandCall> commands{call("rope.clear")};
        if (std::string(name) == "rope")
            commands.push_back(call("rope.add", {{"name", "it"},
                                                 {"from", glm::vec3(0, 1, 0)},
                                                 {"to", glm::vec3(1, 1, 0)},
                                                 {"segments", 5},
                                                 {"pin_start", true}}));
        if (std::string(name) == "cloth")
            commands.push_back(call("rope.cloth.add", {{"name", "it"},
                                                       {"corner", glm::vec3(0, 1, 0)},
                                                       {"along", glm::vec3(1, 0, 0)},
                                                       {"down", glm::vec3(0, -1, 0)},
                                                       {"pins", "corners"}}));
        if (std::string(name) == "hair")
            commands.push_back(
                call("rope.hair.add",
                     {{"name", "it"}, {"strands", 3}, {"length", 0.5f}, {"centre", glm::vec3(0, 1, 0)}}));
        for (const int particle : {0, 1}) {
            std::vector<CommandCall> selected = commands;
            selected.push_back(call("rope.select", {{"rope", "it"}, {"particle", particle}}));
            all.push_back({std::string(name) + ", a particle", selected, 20});
        }
    }
    struct Kind {
        const char* name;
        ArgumentList shape;
    };
    const Kind kinds[] = {{"sphere", {{"centre", glm::vec3(0.0f)}, {"radius", 0.2f}}},
                          {"capsule", {{"a", glm::vec3(0.0f)}, {"b", glm::vec3(0, 0, 1)}, {"radius", 0.2f}}},
                          {"box", {{"centre", glm::vec3(0.0f)}, {"half_extents", glm::vec3(0.25f)}}},
                          {"plane", {{"point", glm::vec3(0.0f)}, {"normal", glm::vec3(0, 1, 0)}}}};
    for (const Kind& kind : kinds) {
        ArgumentList arguments{{"name", "it"}, {"kind", kind.name}};
        arguments.insert(arguments.end(), kind.shape.begin(), kind.shape.end());
        all.push_back(
            {kind.name,
             {call("rope.clear"), call("rope.collider.add", arguments),
              call("rope.collider.swing", {{"name", "it"}, {"by", glm::vec3(0.2f, 0, 0)}, {"period", 2.0f}}),
              call("rope.select", {{"collider", "it"}})}});
    }
    for (const char* solver : {"direct", "xpbd", "relaxation"})
        all.push_back({solver, {drape, call("rope.settings", {{"solver", solver}})}});
    return all;
}

std::vector<Shown> full_signals() {
    std::vector<Shown> all;
    for (const signal::Kind& kind : signal::kinds())
        all.push_back({kind.name,
                       {call("signal.clear"), call("signal.filter.add", {{"kind", kind.name}}),
                        call("signal.select", {{"at", 0}})}});
    for (const char* input : {"hand", "square", "sine", "noise"})
        all.push_back({input, {call("signal.input", {{"kind", input}})}});
    const CommandCall draw =
        call("signal.fit.draw", {{"from", -1.0}, {"from_value", 0.0}, {"to", -1.0}, {"to_value", 0.0}});
    all.push_back({"a response", {call("signal.input", {{"kind", "square"}}), draw}});
    all.push_back({"fitting", {call("signal.input", {{"kind", "square"}}), draw, call("signal.fit")}});
    return all;
}

std::vector<Shown> full_rigs() {
    std::vector<Shown> all;
    for (const char* kind : {"bool", "float", "vector2d", "position", "rotation", "transform"}) {
        Shown shown{std::string("control ") + kind, bones_and_a_control()};
        shown.commands.push_back(
            call("rig.element.add", {{"name", "it"}, {"kind", "control"}, {"control", kind}}));
        shown.commands.push_back(call("rig.select", {{"element", "it"}}));
        all.push_back(std::move(shown));
    }
    for (const char* element : {"a", "c"}) {
        Shown shown{std::string("bone ") + element, bones_and_a_control()};
        shown.commands.push_back(call("rig.select", {{"element", element}}));
        all.push_back(std::move(shown));
    }
    Shown several{"several", bones_and_a_control()};
    several.commands.push_back(call("rig.select", {{"elements", SharedJson(Json{"a", "b", "look"})}}));
    all.push_back(std::move(several));
    return all;
}

std::vector<Shown> full_humanoids() {
    const CommandCall walk = call("humanoid.clip", {{"name", "walk"}, {"time", 0.3}});
    std::vector<Shown> all;
    for (const char* node : {"LeftHand", "Head", "Hips", "HeadTop_End", "LeftLowerLeg"})
        all.push_back({node, {walk, call("humanoid.select", {{"node", node}})}});
    all.push_back({"several nodes",
                   {walk, call("humanoid.spring", {{"node", "HeadTop_End"}}),
                    call("humanoid.limits", {{"from", "none"}, {"bone", "Head"}}),
                    call("humanoid.select",
                         {{"nodes", SharedJson(Json::array({"Hips", "Head", "LeftHand", "HeadTop_End"}))}})},
                   20});
    all.push_back({"a spring",
                   {walk, call("humanoid.spring", {{"node", "HeadTop_End"}}),
                    call("humanoid.select", {{"node", "HeadTop_End"}})},
                   20});
    const std::string golden = source_path("tests/app/golden/");
    all.push_back({"a file with a skin", {call("humanoid.load", {{"path", golden + "body.glb"}})}});
    all.push_back({"a clip with faults",
                   {call("humanoid.load", {{"path", golden + "faulty_walk.bvh"}}),
                    call("humanoid.clip", {{"index", 0}})}});
    for (const char* ground : {"flat", "slope", "stairs", "terrain"})
        all.push_back(
            {ground,
             {walk, call("humanoid.ground", {{"kind", ground}}), call("humanoid.foot_ik", {{"on", true}})}});
    all.push_back(
        {"hands",
         {walk, call("humanoid.target", {{"effector", "left_hand"}, {"to", glm::vec3(0.4f, 1.5f, 0.7f)}}),
          call("humanoid.target", {{"effector", "right_hand"}, {"to", glm::vec3(0, 1.4f, 0.5f)}}),
          call("humanoid.hand_ik", {{"on", true}, {"hand", "left"}, {"curve", true}}),
          call("humanoid.hand_ik", {{"on", true}, {"hand", "right"}, {"curve", true}}),
          call("humanoid.look_at", {{"on", true}, {"to", glm::vec3(0.5f, 1.5f, 1.5f)}})}});
    return all;
}

}  // namespace

std::vector<Shown> all_scenes(const Lab& lab, const CommandTable& table) {
    std::vector<Shown> all = scenes_of(lab, table);
    const auto add = [&](std::vector<Shown> more) {
        all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    };
    if (lab.name() == "chain") add(full_chains());
    if (lab.name() == "rope") add(full_ropes());
    if (lab.name() == "signal") add(full_signals());
    if (lab.name() == "rig") add(full_rigs());
    if (lab.name() == "humanoid") add(full_humanoids());
    std::set<std::string> seen;
    std::erase_if(all, [&](const Shown& shown) {
        Json json = shown.ticks;
        for (const CommandCall& each : shown.commands) json = {json, each.name, to_json(each.arguments)};
        return !seen.insert(json.dump()).second;
    });
    return all;
}

}  // namespace tendril::test
