#include "app/labs/humanoid/character/kept_maps.hpp"

#include <stdexcept>

#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

const std::filesystem::path& folder_of(const Workspace& workspace) {
    if (workspace.config.empty()) throw std::invalid_argument("there is no folder that maps are kept in");
    return workspace.config;
}

void keep(Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    humanoid_runtime(workspace).kept_maps.forget();
    keep_map(folder_of(workspace), saved_map(*part.map, part.skeleton()), part.skeleton());
}

void keep_told(Workspace& workspace, const Arguments&) {
    keep(workspace);
    workspace.toast("The bone map is kept for characters of these node names");
}

void use(Workspace& workspace, const Arguments&) {
    KeptMaps& maps = humanoid_runtime(workspace).kept_maps;
    if (const std::string& why = maps.refused(workspace); !why.empty()) throw std::invalid_argument(why);
    const SavedMap* const kept = maps.kept(workspace);
    if (kept == nullptr) throw std::invalid_argument("no map is kept for the character's node names");
    change_part<HumanoidPart>(workspace, humanoid_lab, [&](HumanoidPart& part, const HumanoidPart&) {
        take_map(part, applied(*kept, part.skeleton()));
    });
}

void forget(Workspace& workspace, const Arguments&) {
    humanoid_runtime(workspace).kept_maps.forget();
    if (!forget_kept_map(folder_of(workspace), humanoid_part(workspace).skeleton()))
        throw std::invalid_argument("no map is kept for the character's node names");
}

}  // namespace

void KeptMaps::look(const Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    if (of_ == part.loaded && folder_ == workspace.config) return;
    of_ = part.loaded;
    folder_ = workspace.config;
    kept_.reset();
    refused_.clear();
    if (folder_.empty()) return;
    try {
        kept_ = find_kept_map(folder_, part.skeleton());
    } catch (const std::exception& error) {
        refused_ = std::string("the kept bone map is left out: ") + error.what();
    }
}

const SavedMap* KeptMaps::kept(const Workspace& workspace) {
    look(workspace);
    return kept_ ? &*kept_ : nullptr;
}

const SavedMap* KeptMaps::offered(const Workspace& workspace) {
    const SavedMap* const map = kept(workspace);
    return map != nullptr && !bones_that_differ(*map, humanoid_part(workspace)).empty() ? map : nullptr;
}

const std::string& KeptMaps::refused(const Workspace& workspace) {
    look(workspace);
    return refused_;
}

std::vector<Bone> bones_that_differ(const SavedMap& map, const HumanoidPart& part) {
    std::vector<Bone> bones;
    const SavedMap now = saved_map(*part.map, part.skeleton());
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (map.bones[i] != now.bones[i]) bones.push_back(static_cast<Bone>(i));
    return bones;
}

/// Those that lose their node first: it is free then.
void take_map(HumanoidPart& part, const humanoid::BoneMap& wanted) {
    for (const bool picked : {false, true}) {
        for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
            const std::int32_t node = wanted.bones[i].node;
            if (node == part.map->bones[i].node || (picked && node < 0)) continue;
            set_bone(part, static_cast<Bone>(i),
                     picked ? std::optional(static_cast<std::size_t>(node)) : std::nullopt);
        }
    }
}

void keep_correction(Workspace& workspace) {
    if (!workspace.keeps || workspace.config.empty()) return;
    const HumanoidPart& part = humanoid_part(workspace);
    try {
        // As it was matched it needs no keeping.
        const SavedMap matched = saved_map(part.loaded->matched, part.skeleton());
        if (!bones_that_differ(matched, part).empty()) return keep(workspace);
        humanoid_runtime(workspace).kept_maps.forget();
        forget_kept_map(workspace.config, part.skeleton());
    } catch (const std::exception& error) {
        workspace.toast(std::string("The bone map is not kept: ") + error.what(), ToastKind::Refusal);
    }
}

Command keeping(Command command) {
    command.apply = [correct = command.apply](Workspace& workspace, const Arguments& given) {
        correct(workspace, given);
        keep_correction(workspace);
    };
    return command;
}

void add_kept_map_commands(CommandTable& table) {
    table.add({.name = "humanoid.map.keep",
               .title = "Keep the bone map",
               .arguments = {},
               .help = "Keeps the bone map, to be offered for characters of the same node names",
               .effect = Effect::Look,
               .apply = keep_told});
    table.add({.name = "humanoid.map.use",
               .title = "Use the kept bone map",
               .arguments = {},
               .help = "Takes the bone map that was kept for these node names",
               .effect = Effect::Edit,
               .apply = use});
    table.add({.name = "humanoid.map.forget",
               .title = "Forget the kept bone map",
               .arguments = {},
               .help = "Removes the bone map that was kept for these node names",
               .effect = Effect::Look,
               .apply = forget});
}

}  // namespace tendril::app
