// Clips: which one, which moment of it, and how it plays.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/arguments.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Playback>() noexcept {
    using app::Playback;
    static constexpr Field rows[] = {field<&Playback::speed>("speed", {0.0, app::fastest_clip}),
                                     field<&Playback::loop>("loop"), field<&Playback::in_place>("in_place")};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<Playback>() {
    static constexpr FieldText texts[] = {
        {.name = "speed",
         .label = "speed",
         .help = "How fast the clip plays. At 1, or 100 %, it is as it was recorded.",
         .step = 0.5f,
         .decimals = 0,
         .scale = 100.0,
         .unit = "%"},
        {.name = "loop",
         .label = "Loop",
         .help = "A walk goes on from where its last round ended. Else it stops at its end."},
        {.name = "in_place",
         .label = "In place",
         .help = "The hips stay above the point where the clip begins."}};
    return texts;
}

namespace {

std::size_t chosen_clip(const LoadedCharacter& character, const Arguments& given) {
    const std::vector<humanoid::Clip>& clips = character.clips();
    if (clips.empty()) throw std::invalid_argument("the character has no clips");
    if (given.has("index")) {
        const auto index = static_cast<std::size_t>(given.integer("index"));
        if (index < clips.size()) return index;
        throw std::invalid_argument("index must be 0 to " + std::to_string(clips.size() - 1) + ", got " +
                                    std::to_string(index));
    }
    const std::string name = given.text("name");
    const auto found = std::ranges::find(clips, name, &humanoid::Clip::name);
    if (found != clips.end()) return static_cast<std::size_t>(found - clips.begin());
    throw std::invalid_argument("the character has no clip \"" + name + "\"");
}

glm::vec3 hips_at(const Workspace& workspace) {
    return shown_pose(workspace).point(humanoid_part(workspace).node_of(humanoid::Bone::Hips).value_or(0));
}

void choose(Playback& playback, std::optional<std::size_t> clip) {
    if (playback.clip == clip) return;
    playback.clip = clip;
    playback.time = 0.0;
    playback.rounds = 0;
    if (!clip) playback.playing = false;
}

void set_clip(HumanoidPart& part, const Arguments& given) {
    Playback& playback = part.playback;
    const Playback before = playback;
    if (given.has("name") && given.has("index"))
        throw std::invalid_argument("give either a name or an index");
    const bool none = given.has("name") && given.text("name").empty();
    if (none)
        choose(playback, std::nullopt);
    else if (given.has("name") || given.has("index"))
        choose(playback, chosen_clip(*part.loaded, given));
    set_fields(given, playback);
    const bool play = given.has("play") && given.boolean("play");
    if (!playback.clip && (play || given.has("time"))) throw std::invalid_argument("no clip is chosen");
    if (given.has("time")) go_to(playback, *part.loaded, given.real("time"));
    if (given.has("play")) playback.playing = play;
    // Played again from its end, it begins anew.
    if (play && !given.has("time") && !playback.loop && playback.time >= part.clip()->duration)
        go_to(playback, *part.loaded, 0.0);
    if (!(playback == before)) part.quiet_ticks = 0;
}

}  // namespace

void add_clip_commands(CommandTable& table) {
    std::vector<Argument> arguments{
        clip_argument("name", "which clip; empty: the rest pose"),
        integer_argument("index", "instead of the name, counted from 0", 0, 1e6),
        switch_argument("play", "or pause"),
        number_argument("time", "seconds from its beginning; over its duration, in a later round", 0.0, 1e6)};
    for (Argument& each : field_arguments<Playback>()) arguments.push_back(std::move(each));
    Command clip = part_command<HumanoidPart>(
        humanoid_lab, "humanoid.clip", "Choose and play a clip", std::move(arguments),
        "Chooses a clip, its moment and how it plays; what is left out stays", set_clip);
    // Clips begin anywhere: the camera goes along with the character, as it does while one plays.
    clip.apply = [set = clip.apply](Workspace& workspace, const Arguments& given) {
        const glm::vec3 before = hips_at(workspace);
        set(workspace, given);
        if (workspace.lab != humanoid_lab || !humanoid_part(workspace).view.follow) return;
        glm::vec3 way = hips_at(workspace) - before;
        // A captured figure rests with its hips at the origin; one that crouches stays where it is in the
        // picture.
        if (std::abs(way.y) < 0.3f) way.y = 0.0f;
        workspace.camera.target += way;
    };
    table.add(std::move(clip));
}

}  // namespace tendril::app
