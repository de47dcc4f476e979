// The Rope lab in a scene file. What a drag holds when it is saved is let go: nobody holds it when it is
// opened.
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_names.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/labs/rope/rope_time.hpp"
#include "app/labs/rope/world_file.hpp"

namespace tendril::app {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& what) {
    throw std::runtime_error(where + ": " + what);
}

Json save_swing(const Swing& swing) {
    return Json{{"collider", swing.collider},
                {"middle", point(swing.middle)},
                {"swing", point(swing.swing)},
                {"period", number(swing.period)}};
}

Swing load_swing(const Json& json, const std::string& where) {
    const auto read = [&](const char* key) -> const Json& { return json_member(json, key, where); };
    Swing swing;
    swing.collider = json_text(read("collider"), where + ".collider");
    swing.middle = json_point(read("middle"), where + ".middle");
    swing.swing = json_point(read("swing"), where + ".swing");
    swing.period = json_number(read("period"), where + ".period", shortest_swing, longest_swing);
    try {
        require(swing);
    } catch (const std::invalid_argument& error) {
        fail(where, error.what());
    }
    return swing;
}

std::vector<Swing> load_swings(const Json& json, const std::string& where, const NamedWorld& world) {
    if (!json.is_array()) fail(where, "expected a list, found " + json_summary(json));
    if (json.size() > max_lab_colliders) {
        fail(where, "has " + std::to_string(json.size()) + " swings; the most is " +
                        std::to_string(max_lab_colliders));
    }
    std::vector<Swing> swings;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string here = where + "." + std::to_string(i);
        swings.push_back(load_swing(json[i], here));
        const std::string& name = swings.back().collider;
        if (world.find_collider(name) == nullptr)
            fail(here + ".collider", "there is no collider " + json_summary(Json(name)));
        for (std::size_t before = 0; before < i; ++before) {
            if (swings[before].collider == name)
                fail(here + ".collider", json_summary(Json(name)) + " swings twice");
        }
    }
    return swings;
}

Json save_selection(const std::optional<RopeSelection>& selection) {
    if (!selection) return nullptr;
    if (!selection->collider.empty()) return Json{{"collider", selection->collider}};
    return Json{{"rope", selection->body}, {"particle", selection->particle}};
}

std::optional<RopeSelection> load_selection(const Json& json, const std::string& where,
                                            const NamedWorld& world) {
    if (json.is_null()) return std::nullopt;
    RopeSelection selection;
    if (json.is_object() && json.contains("collider")) {
        selection.collider = json_text(json["collider"], where + ".collider");
        if (world.find_collider(selection.collider) == nullptr)
            fail(where + ".collider", "there is no collider " + json_summary(json["collider"]));
        return selection;
    }
    selection.body = json_text(json_member(json, "rope", where), where + ".rope");
    const rope::Body* body = world.find(selection.body);
    if (body == nullptr) fail(where + ".rope", "there is no rope " + json_summary(json["rope"]));
    const int last = body->count == 0 ? 0 : static_cast<int>(body->count) - 1;
    selection.particle = static_cast<std::size_t>(
        json_integer(json_member(json, "particle", where), where + ".particle", 0, last));
    return selection;
}

Json save_jitter(const Jitter& jitter) {
    return Json{{"dial", number(jitter.dial)},
                {"frames", jitter.frames},
                {"owed", jitter.owed},
                {"frame", jitter.frame}};
}

Jitter load_jitter(const Json& json, const std::string& where) {
    const auto read = [&](const char* key) -> const Json& { return json_member(json, key, where); };
    Jitter jitter;
    jitter.dial = json_number(read("dial"), where + ".dial", 0.0f, 1.0f);
    jitter.frames = static_cast<std::uint32_t>(json_count(read("frames"), where + ".frames", 0xffffffffu));
    jitter.owed = json_real(read("owed"), where + ".owed", 0.0, 10.0);
    jitter.frame = json_real(read("frame"), where + ".frame", 0.0, longest_jitter_frame);
    return jitter;
}

RopeView load_view(const Json& json, const std::string& where) {
    const auto read = [&](const char* key) -> const Json& { return json_member(json, key, where); };
    RopeView view;
    view.particles = json_bool(read("particles"), where + ".particles");
    // Version 1 of scene files called it stress.
    const char* const strain = json.contains("strain") ? "strain" : "stress" /* version 1 */;
    view.strain = json_bool(read(strain), where + "." + strain);
    view.sides = json_integer(read("sides"), where + ".sides", fewest_sides, most_sides);
    return view;
}

/// The world without what a drag holds.
Json save_released(const RopePart& part) {
    const auto held = held_particle(part);
    if (!held) return save_world(*part.world);
    NamedWorld released = *part.world;
    released.unpin(*held);
    return save_world(released);
}

}  // namespace

Json RopePart::save() const {
    Json moving = Json::array();
    for (const Swing& swing : swings) moving.push_back(save_swing(swing));
    return Json{{"time", time},
                {"tool", tool_name(tool)},
                {"selected", save_selection(selection)},
                {"view", {{"particles", view.particles}, {"strain", view.strain}, {"sides", view.sides}}},
                {"jitter", save_jitter(jitter)},
                {"swings", std::move(moving)},
                {"world", save_released(*this)}};
}

std::shared_ptr<Part> RopePart::load(const Json& json, const std::string& where) const {
    const auto read = [&](const char* key) -> const Json& { return json_member(json, key, where); };
    auto part = std::make_shared<RopePart>();
    std::string place = where;  // of what the core may find wrong
    try {
        part->time = json_real(read("time"), where + ".time", 0.0, 1e9);
        place = where + ".tool";
        part->tool = tool_from_name(json_text(read("tool"), place));
        part->view = load_view(read("view"), where + ".view");
        const char* const key = json.contains("jitter") ? "jitter" : "torture";  // as version 1 called it
        part->jitter = load_jitter(read(key), where + "." + key);
        place = where + ".world";
        part->world = std::make_shared<const NamedWorld>(load_world(read("world"), place));
        check_work(*part->world);
        part->swings = load_swings(read("swings"), where + ".swings", *part->world);
        part->selection = load_selection(read("selected"), where + ".selected", *part->world);
    } catch (const std::logic_error& error) {  // the core's own words, told where in the file
        fail(place, error.what());
    }
    return part;
}

}  // namespace tendril::app
