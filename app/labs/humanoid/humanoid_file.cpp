// The Humanoid lab in a scene file: the character's file, which loading reads again, and the settings.
#include <optional>

#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/humanoid/clip/clip_lint.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {
namespace {

Json corrections_json(const Corrections& corrections, const humanoid::Skeleton& skeleton) {
    Json bones = Json::object();
    for (const auto& [bone, node] : corrections)
        bones[humanoid::name(bone)] =
            node < 0 ? Json(nullptr) : Json(skeleton[static_cast<std::size_t>(node)].name);
    return bones;
}

Corrections read_corrections(const JsonPlace& place, const humanoid::Skeleton& skeleton) {
    if (!place.json().is_object()) place.fail("expected an object of bones");
    Corrections corrections;
    for (const auto& [name, value] : place.json().items()) {
        const auto bone = humanoid::bone_named(name);
        if (!bone) place.fail("there is no bone \"" + name + "\"");
        corrections[*bone] = -1;
        if (value.is_null()) continue;
        const JsonPlace at = place[name.c_str()];
        const auto node = skeleton.find(at.text());
        if (!node) at.fail("the character has no node \"" + at.text() + "\"");
        corrections[*bone] = static_cast<std::int32_t>(*node);
    }
    return corrections;
}

Json reading_json(const Reading& reading, const humanoid::Skeleton& skeleton) {
    return {{"scale", reading.scale},
            {"space", save_fields(reading.space)},
            {"bones", corrections_json(reading.bones, skeleton)},
            {"limits", limits_from.name(reading.limits)}};
}

/// Settings missing from the file stay as in `reading`.
Reading read_reading(const JsonPlace& place, Reading reading, const humanoid::Skeleton& skeleton) {
    if (const auto scale = place.optional("scale")) reading.scale = scale->real(min_unit, max_unit);
    if (const auto space = place.optional("space")) load_known_fields(*space, reading.space);
    if (const auto bones = place.optional("bones")) reading.bones = read_corrections(*bones, skeleton);
    if (const auto limits = place.optional("limits")) reading.limits = limits->choice(limits_from);
    return reading;
}

/// Reads the part's character with these settings.
void take(const JsonPlace& place, HumanoidPart& part, const Reading& reading) {
    const char* key = "file";
    try {
        part.loaded = read_as(part.loaded, reading.scale, reading.space);
        part.ik.limits = reading.limits;
        key = "bones";
        correct(part, reading.bones);
    } catch (const std::exception& error) {
        (place.has(key) ? place[key] : place).fail(error.what());
    }
}

Json save_playback(const HumanoidPart& part) {
    const Playback& playback = part.playback;
    Json json = Json::object();
    if (playback.clip) {
        json["name"] = part.clip()->name;
        json["index"] = *playback.clip;
    }
    json.update(save_fields(playback));
    return json;
}

/// Clip names may repeat: use the stored index if the clip there still has the name.
std::size_t read_clip(const JsonPlace& place, const LoadedCharacter& character) {
    const std::string name = place["name"].text();
    const std::vector<humanoid::Clip>& clips = character.clips();
    if (const auto index = place.optional("index")) {
        const std::size_t at = index->index(1'000'000);
        if (at < clips.size() && clips[at].name == name) return at;
    }
    for (std::size_t i = 0; i < clips.size(); ++i)
        if (clips[i].name == name) return i;
    place["name"].fail("the character has no clip \"" + name + "\"");
}

Playback read_playback(const JsonPlace& place, const LoadedCharacter& character) {
    Playback playback;
    if (place.has("name")) playback.clip = read_clip(place, character);
    load_known_fields(place, playback, {"name", "index", "carry_targets"});  // carry_targets: in older files
    if (!playback.clip)
        playback.time = 0.0, playback.rounds = 0;
    else if (const auto time = place.optional("time"))
        time->real(0.0, character.clips()[*playback.clip].duration);
    return playback;
}

Json edits_json(const LoadedCharacter& character) {
    Json list = Json::array();
    for (const ClipEdit& each : character.edits) {
        Json json = reading_json(each.as, character.skeleton());
        if (const auto* motion = std::get_if<LoadedMotion>(&each.what)) {
            json.update(save_outside_file(*motion));
            json["clip"] = motion->clip;
            if (motion->source) {
                json["source"] = reading_json(motion->source_as, motion->source->skeleton());
                json["source"]["edits"] = edits_json(*motion->source);
            }
        } else {
            const ClipCure& cure = std::get<ClipCure>(each.what);
            json["clip"] = cure.clip;
            if (cure.fault) json["kind"] = humanoid::name(*cure.fault);
            if (!cure.node.empty()) json["node"] = cure.node;
            if (cure.frame) json["frame"] = *cure.frame;
        }
        list.push_back(std::move(json));
    }
    return list;
}

ClipCure read_cure(const JsonPlace& place) {
    ClipCure cure{.clip = place["clip"].text()};
    if (const auto kind = place.optional("kind")) {
        cure.fault = fault_named(kind->text());
        if (!cure.fault) kind->fail("there is no such fault");
    }
    if (const auto node = place.optional("node")) cure.node = node->text();
    if (const auto frame = place.optional("frame")) cure.frame = frame->index(humanoid::max_lint_frames);
    return cure;
}

void read_edits(const JsonPlace& place, HumanoidPart& part);

/// The part that a motion was retargeted from.
HumanoidPart read_source(const JsonPlace& place) {
    HumanoidPart source(read_outside_file(place, [](const std::string& path, const std::string& file) {
        return load_character(path, nullptr, file);
    }));
    const auto as = place.optional("source");
    if (!as) return source;
    check_members(*as, {"scale", "space", "bones", "limits", "edits"});
    take(*as, source, read_reading(*as, reading_of(source), source.skeleton()));
    read_edits(*as, source);
    return source;
}

void read_edit(const JsonPlace& place, HumanoidPart& part) {
    const ClipCure cure = read_cure(place);
    std::optional<HumanoidPart> source;
    if (place.has("file")) source = read_source(place);
    try {
        part.loaded = source ? with_motion(part, *source, cure.clip).loaded : cured(part, cure).loaded;
    } catch (const std::exception& error) {
        place["clip"].fail(error.what());
    }
}

/// Repeats the edits, each with the character's settings at that time. Older scenes have "motions" and
/// "cures" in that order, without settings: these use the scene's, with the default limits.
void read_edits(const JsonPlace& place, HumanoidPart& part) {
    constexpr std::size_t max_edits = 10'000;
    const Reading now = reading_of(part);
    for (const char* key : {"motions", "cures", "edits"}) {
        const auto edits = place.optional(key);
        if (!edits) continue;
        edits->for_each(key, max_edits, [&](const JsonPlace& each) {
            check_members(each, {"file", "path", "crc32", "scale", "space", "bones", "limits", "clip", "kind",
                                 "node", "frame", "source"});
            take(each, part, read_reading(each, now, part.skeleton()));
            read_edit(each, part);
        });
    }
    take(place, part, now);
}

}  // namespace

Json HumanoidPart::save() const {
    Json json = save_outside_file(*loaded);
    if (!loaded->file.empty()) {
        json["scale"] = loaded->character.scale;
        json["space"] = save_fields(loaded->character.space);
    }
    json["bones"] = corrections_json(corrections_of(*map, *loaded), skeleton());
    if (!loaded->edits.empty()) json["edits"] = edits_json(*loaded);
    json["clip"] = save_playback(*this);
    json["t_pose"] = t_pose;
    json["ik"] = ik_json(*this);
    if (!springs.empty()) json["springs"] = springs_json(*this);
    if (!curves.empty()) json["curves"] = curves_json(*this);
    if (!attachments.list.empty() || attachments.world->settings() != attachment_settings)
        json["attachments"] = attachments_json(attachments);
    json["quiet_ticks"] = quiet_ticks;
    if (flips != FlipRule()) json["flips"] = save_fields(flips);
    json["selected"] = save_selection(selection, skeleton());
    json["view"] = save_fields(view);
    return json;
}

std::shared_ptr<Part> HumanoidPart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    load_known_fields(
        place, {},
        {"file", "path", "crc32", "scale", "space", "bones", "edits", "clip", "t_pose", "ik", "springs",
         "curves", "attachments", "quiet_ticks", "flips", "selected", "view", "motions", "cures"});
    auto part = std::make_shared<HumanoidPart>(
        read_outside_file(place, [](const std::string& path, const std::string& file) {
            return load_character(path, nullptr, file);
        }));
    take(place, *part, read_reading(place, reading_of(*part), part->skeleton()));
    read_edits(place, *part);
    if (const auto clip = place.optional("clip")) part->playback = read_playback(*clip, *part->loaded);
    measure_pace(*part);
    if (const auto on = place.optional("t_pose")) part->t_pose = on->flag();
    if (const auto ik_place = place.optional("ik")) read_ik(*ik_place, *part);
    if (const auto swinging = place.optional("springs")) read_springs(*swinging, *part);
    if (const auto curved = place.optional("curves")) read_curves(*curved, *part);
    if (const auto hanging = place.optional("attachments"))
        part->attachments = read_attachments(*hanging, part->skeleton());
    if (const auto ticks = place.optional("quiet_ticks")) part->quiet_ticks = ticks->integer(0, 1'000'000);
    if (const auto rule = place.optional("flips")) load_known_fields(*rule, part->flips);
    if (const auto selected = place.optional("selected"))
        part->selection = load_selection(*selected, part->skeleton());
    if (const auto shown = place.optional("view")) load_known_fields(*shown, part->view);
    return part;
}

}  // namespace tendril::app
