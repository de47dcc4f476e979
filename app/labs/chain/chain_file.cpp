// The Chain lab in a scene file.
#include <algorithm>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/chain_runtime.hpp"

#include "app/labs/kit/require.hpp"

namespace tendril::app {

Json ChainPart::save() const {
    Json segments = Json::array();
    for (const Segment& segment : chain.segments()) {
        segments.push_back({{"position", point(segment.position)}, {"length", number(segment.length)}});
    }
    Json json{{"mode", mode_name(mode)}, {"index", index}};
    for (std::size_t i = 0; i < iterations.size(); ++i)
        json["iterations"][mode_name(all_modes[i])] = iterations[i];
    json["tolerance"] = number(tolerance);
    json["target"] = point(target);
    json["selected"] = selected ? Json(*selected) : Json(nullptr);
    json["default_direction"] = point(chain.default_direction());
    json["motion"] = {{"path", motion_name(motion.path)},
                      {"centre", point(motion.centre)},
                      {"radius", number(motion.radius)},
                      {"period", number(motion.period)},
                      {"ticks", motion.ticks}};
    json["segments"] = std::move(segments);
    json["reach"] = save_reach(reach, chain);
    if (study.open()) json["study"] = save_study(study);
    return json;
}

namespace {

std::vector<Segment> load_segments(const Json& json, const std::string& where) {
    if (!json.is_array()) throw std::runtime_error(where + " must be a list");
    if (json.size() > max_segments) {
        throw std::runtime_error(where + " has " + std::to_string(json.size()) + " segments; the most is " +
                                 std::to_string(max_segments));
    }
    std::vector<Segment> segments;
    segments.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string here = where + "." + std::to_string(i);
        segments.push_back({json_point(json_member(json[i], "position", here), here + ".position"),
                            json_number(json_member(json[i], "length", here), here + ".length")});
        if (segments.back().length < 0.0f) {
            throw std::runtime_error(here + ".length must be at least 0, got " +
                                     number(segments.back().length).dump());
        }
    }
    return segments;
}

Motion load_motion(const Json& json, const std::string& where) {
    Motion motion;
    motion.path = motion_from_name(json_text(json_member(json, "path", where), where + ".path"));
    motion.centre = json_point(json_member(json, "centre", where), where + ".centre");
    motion.radius = json_number(json_member(json, "radius", where), where + ".radius");
    motion.period = json_number(json_member(json, "period", where), where + ".period");
    if (motion.radius < 0.0f || motion.radius > 1e4f)
        throw std::runtime_error(where + ".radius must be 0 to 1e4");
    if (motion.period < 0.1f || motion.period > 600.0f)
        throw std::runtime_error(where + ".period must be 0.1 to 600");
    const int most = static_cast<int>(ticks_per_round(motion)) - 1;
    motion.ticks = static_cast<std::uint32_t>(
        json_integer(json_member(json, "ticks", where), where + ".ticks", 0, most));
    return motion;
}

/// The rotations of version 1, [w, x, y, z], as [x, y, z, w] and in a solver's state; `owner` is what has
/// them.
void upgrade_rotations(Json& part, const char* owner) {
    if (!part.is_object() || !part.contains(owner) || !part[owner].is_object()) return;
    const auto found = part[owner].find("rotations");
    if (found == part[owner].end()) return;
    Json rotations = std::move(*found);
    part[owner].erase(found);
    if (rotations.is_array()) {
        for (Json& rotation : rotations) {
            if (!rotation.is_array() || rotation.size() != 4) continue;
            rotation = Json::array({rotation[1], rotation[2], rotation[3], rotation[0]});
        }
    }
    part[owner]["state"] = {{"rotations", std::move(rotations)}};
}

}  // namespace

void ChainPart::upgrade(Json& json, int version) const {
    if (version >= 2) return;
    upgrade_rotations(json, "reach");
    upgrade_rotations(json, "study");
}

std::shared_ptr<Part> ChainPart::load(const Json& json, const std::string& where) const {
    auto part = std::make_shared<ChainPart>();
    try {
        part->mode = mode_from_name(json_text(json_member(json, "mode", where), where + ".mode"));
        const Json& repeats = json_member(json, "iterations", where);
        for (std::size_t i = 0; i < part->iterations.size(); ++i) {
            const std::string here = where + ".iterations", name = mode_name(all_modes[i]);
            part->iterations[i] =
                json_integer(json_member(repeats, name.c_str(), here), here + "." + name, 1, max_iterations);
        }
        part->tolerance = json_number(json_member(json, "tolerance", where), where + ".tolerance");
        if (part->tolerance < 0.0f) throw std::runtime_error(where + ".tolerance must be at least 0");
        part->target = json_point(json_member(json, "target", where), where + ".target");
        part->motion = load_motion(json_member(json, "motion", where), where + ".motion");
        part->chain = require_value(Chain::from_segments(
            load_segments(json_member(json, "segments", where), where + ".segments"),
            json_point(json_member(json, "default_direction", where), where + ".default_direction")));

        const int last = std::max(0, static_cast<int>(part->chain.size()) - 1);
        part->index = static_cast<std::size_t>(
            json_integer(json_member(json, "index", where), where + ".index", 0, last));
        // Scenes from before there was a Reach mode have no such part.
        if (json.contains("reach")) part->reach = load_reach(json["reach"], where + ".reach", part->chain);
        if (json.contains("study") && part->mode != ChainMode::Reach) {
            throw std::runtime_error(where + ".study is for mode reach, not " + mode_name(part->mode));
        }
        if (json.contains("study")) part->study = load_study(json["study"], where + ".study", part->chain);
        ChainRuntime runtime;  // a part belongs to no workspace yet
        part->study.refresh(part->chain, part->reach, part->target, runtime);
        const Json& chosen = json_member(json, "selected", where);
        check_range(*part);
        if (!chosen.is_null() && !part->chain.empty()) {
            part->selected = static_cast<std::size_t>(json_integer(chosen, where + ".selected", 0, last));
        }
    } catch (const std::logic_error& error) {  // the core's own words, told where in the file
        throw std::runtime_error(where + ": " + error.what());
    }
    return part;
}

}  // namespace tendril::app
