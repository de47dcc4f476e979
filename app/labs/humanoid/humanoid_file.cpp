// The Humanoid lab in a scene file: the character's file name and all that the user has set. Loading reads
// the character's file again.
#include <filesystem>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/humanoid/clip/clip_lint.hpp"
#include "app/labs/humanoid/clip/motions.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

/// The saved path may not exist on another machine; then tries the file name alone.
SharedCharacter read_again(const JsonPlace& place, const std::string& file) {
    const auto path = place.optional("path");
    const bool elsewhere = path && !std::filesystem::exists(path->text());
    try {
        SharedCharacter loaded = load_character(path && !elsewhere ? path->text() : file);
        if (loaded->file == file) return loaded;
        auto named = std::make_shared<LoadedCharacter>(*loaded);
        named->file = file;
        return named;
    } catch (const std::exception& error) {
        place["file"].fail(error.what());
    }
}

/// With the unit and the axes of the scene; older scenes have no axes.
SharedCharacter read_as_saved(const JsonPlace& place, SharedCharacter character) {
    double metres = character->character.scale;
    FileSpace space = character->character.space;
    if (const auto scale = place.optional("scale")) metres = scale->real(min_unit, max_unit);
    if (const auto saved = place.optional("space")) load_fields(*saved, space);
    if (metres == character->character.scale && space == character->character.space) return character;
    try {
        return read_as(*character, metres, space);
    } catch (const std::exception& error) {
        place["file"].fail(error.what());
    }
}

/// The bones that the user has mapped to other nodes.
Json corrections(const HumanoidPart& part) {
    Json bones = Json::object();
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const std::int32_t node = part.map->bones[i].node;
        if (node == part.loaded->matched.bones[i].node) continue;
        bones[humanoid::name(static_cast<Bone>(i))] =
            node < 0 ? Json(nullptr) : Json(part.skeleton()[static_cast<std::size_t>(node)].name);
    }
    return bones;
}

void read_corrections(const JsonPlace& place, HumanoidPart& part) {
    if (!place.json().is_object()) place.fail("expected an object of bones");
    // Bones that lose their node come first, so that the node is free.
    for (const bool picked : {false, true}) {
        for (const auto& [name, value] : place.json().items()) {
            const auto bone = humanoid::bone_named(name);
            if (!bone) place.fail("there is no bone \"" + name + "\"");
            if (value.is_null() == picked) continue;
            if (!picked) {
                set_bone(part, *bone, std::nullopt);
                continue;
            }
            const JsonPlace at = place[name.c_str()];
            const auto node = part.skeleton().find(at.text());
            if (!node) at.fail("the character has no node \"" + at.text() + "\"");
            set_bone(part, *bone, node);
        }
    }
    try {
        check_bones(part);
    } catch (const std::invalid_argument& why) {
        place.fail(why.what());
    }
}

Json save_playback(const HumanoidPart& part) {
    const Playback& playback = part.playback;
    Json json = Json::object();
    if (playback.clip) {
        json["name"] = part.clip()->name;
        json["index"] = *playback.clip;
    }
    json["playing"] = playback.playing;
    json["time"] = playback.time;
    json["rounds"] = playback.rounds;
    json.update(save_fields(playback));
    return json;
}

/// Clip names may be ambiguous: the stored index decides, if the clip there still has the name.
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
    if (const auto playing = place.optional("playing")) playback.playing = playing->flag();
    load_fields(place, playback);
    if (!playback.clip) return playback;
    const double duration = character.clips()[*playback.clip].duration;
    if (const auto time = place.optional("time")) playback.time = time->real(0.0, duration);
    if (const auto rounds = place.optional("rounds"))
        playback.rounds = static_cast<std::int64_t>(rounds->count(max_rounds));
    return playback;
}

Json cures_json(const std::vector<ClipCure>& cures) {
    Json list = Json::array();
    for (const ClipCure& each : cures) {
        list.push_back({{"clip", each.clip}});
        if (each.fault) list.back()["kind"] = humanoid::name(*each.fault);
        if (!each.node.empty()) list.back()["node"] = each.node;
        if (each.frame) list.back()["frame"] = *each.frame;
    }
    return list;
}

/// Repeats the cures, in order, on the character as read from its file.
void read_cures(const JsonPlace& place, HumanoidPart& part) {
    constexpr std::size_t max_cures = 10'000;
    place.for_each("cures", max_cures, [&](const JsonPlace& each) {
        ClipCure cure{.clip = each["clip"].text()};
        if (const auto kind = each.optional("kind")) {
            cure.fault = fault_named(kind->text());
            if (!cure.fault) kind->fail("there is no such fault");
        }
        if (const auto node = each.optional("node")) cure.node = node->text();
        if (const auto frame = each.optional("frame")) cure.frame = frame->index(humanoid::max_lint_frames);
        try {
            part.loaded = cured(part, cure).loaded;
        } catch (const std::invalid_argument& error) {
            each.fail(error.what());
        }
    });
}

}  // namespace

Json HumanoidPart::save() const {
    Json json{{"file", loaded->file}};
    if (!loaded->file.empty()) {
        json["path"] = loaded->path;
        json["scale"] = loaded->character.scale;
        json["space"] = save_fields(loaded->character.space);
    }
    json["bones"] = corrections(*this);
    if (!loaded->motions.empty()) json["motions"] = motions_json(*loaded);
    if (!loaded->cures.empty()) json["cures"] = cures_json(loaded->cures);
    json["clip"] = save_playback(*this);
    json["t_pose"] = t_pose;
    json["ik"] = ik_json(*this);
    if (!springs.empty()) json["springs"] = springs_json(*this);
    if (!curves.empty()) json["curves"] = curves_json(*this);
    if (!attachments.list.empty()) json["attachments"] = attachments_json(attachments);
    json["quiet_ticks"] = quiet_ticks;
    if (flips != FlipRule()) json["flips"] = save_flip_rule(flips);
    json["selected"] = save_selection(selection, skeleton());
    json["view"] = save_fields(view);
    return json;
}

std::shared_ptr<Part> HumanoidPart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    const std::string file = place["file"].text();
    SharedCharacter character = file.empty() ? load_character(file) : read_again(place, file);
    character = read_as_saved(place, std::move(character));
    auto part = std::make_shared<HumanoidPart>(std::move(character));
    if (const auto bones = place.optional("bones")) read_corrections(*bones, *part);
    if (const auto motions = place.optional("motions")) read_motions(*motions, *part);
    if (const auto cures = place.optional("cures")) read_cures(*cures, *part);
    if (const auto clip = place.optional("clip")) part->playback = read_playback(*clip, *part->loaded);
    measure_pace(*part);
    if (const auto on = place.optional("t_pose")) part->t_pose = on->flag();
    if (const auto ik_place = place.optional("ik")) read_ik(*ik_place, *part);
    if (const auto swinging = place.optional("springs")) read_springs(*swinging, *part);
    if (const auto curved = place.optional("curves")) read_curves(*curved, *part);
    if (const auto hanging = place.optional("attachments"))
        part->attachments = read_attachments(*hanging, part->skeleton());
    if (const auto ticks = place.optional("quiet_ticks")) part->quiet_ticks = ticks->integer(0, 1'000'000);
    if (const auto rule = place.optional("flips")) part->flips = load_flip_rule(*rule);
    if (const auto selected = place.optional("selected"))
        part->selection = load_selection(*selected, part->skeleton());
    if (const auto shown = place.optional("view")) load_fields(*shown, part->view);
    return part;
}

}  // namespace tendril::app
