#include "app/labs/humanoid/character/loaded_character.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "app/io/character/character.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/system/environment.hpp"

namespace tendril::app {
namespace {

SharedCharacter shared(const OutsideFile& file, Character character) {
    auto loaded = std::make_shared<LoadedCharacter>();
    static_cast<OutsideFile&>(*loaded) = file;
    loaded->character = std::move(character);
    const humanoid::Skeleton& skeleton = loaded->skeleton();
    loaded->matched = bone_map(loaded->character);
    loaded->rest.resize(skeleton.size());
    humanoid::place(skeleton, humanoid::rest_pose(skeleton), loaded->rest);
    loaded->bounds = bounds_at_rest(loaded->character, loaded->rest);
    return loaded;
}

const SharedCharacter& source_of(const SharedCharacter& character) {
    return character->source ? character->source : character;
}

/// Replaces the clip of that name, or adds it.
void apply(const ClipEdit& edit, LoadedCharacter& loaded, std::size_t own_clips) {
    Character& character = loaded.character;
    std::vector<humanoid::Clip>& clips = character.clips;
    const auto place = std::ranges::find(clips, edit.clip->name, &humanoid::Clip::name);
    const bool own = place < clips.begin() + static_cast<std::ptrdiff_t>(own_clips);
    const auto now = [&](const humanoid::Clip& clip) {
        return edit.as.scale == character.scale && edit.as.space == character.space
                   ? clip
                   : read_as_now(clip, edit.as.scale, edit.as.space, character, own);
    };
    const bool added = place == clips.end();
    if (!added || edit.unfixed)
        loaded.unfixed.try_emplace(
            edit.clip->name, std::make_shared<const humanoid::Clip>(added ? now(*edit.unfixed) : *place));
    if (added) return clips.push_back(now(*edit.clip));
    *place = now(*edit.clip);
}

}  // namespace

std::size_t LoadedCharacter::clip_called(const std::string& name) const {
    const auto found = std::ranges::find(clips(), name, &humanoid::Clip::name);
    if (found != clips().end()) return static_cast<std::size_t>(found - clips().begin());
    throw std::invalid_argument("the character has no clip \"" + name + "\"");
}

const humanoid::Clip& LoadedCharacter::clip_unfixed(std::size_t clip) const {
    const auto before = unfixed.find(clips()[clip].name);
    return before == unfixed.end() ? clips()[clip] : *before->second;
}

SharedCharacter load_character(const std::string& path, LoadProgress* progress, const std::string& file) {
    if (path.empty()) {
        static const SharedCharacter figure = shared({}, stick_figure());
        return figure;
    }
    Character character = read_character(path, progress);
    return shared(outside_file(path, file), std::move(character));
}

SharedCharacter read_as(const SharedCharacter& character, double metres, const FileSpace& space) {
    if (metres == character->character.scale && space == character->character.space) return character;
    const SharedCharacter& source = source_of(character);
    Character copy = source->character;
    read_as(copy, metres, space);
    auto loaded = std::make_shared<LoadedCharacter>(*shared(*source, std::move(copy)));
    for (const ClipEdit& each : character->edits) apply(each, *loaded, source->clips().size());
    loaded->edits = character->edits;
    loaded->source = source;
    return loaded;
}

SharedCharacter edited(const SharedCharacter& character, ClipEdit edit) {
    auto loaded = std::make_shared<LoadedCharacter>(*character);
    loaded->source = source_of(character);
    apply(edit, *loaded, loaded->source->clips().size());
    loaded->edits.push_back(std::move(edit));
    return loaded;
}

humanoid::BoneMap corrected(const LoadedCharacter& character, const Corrections& corrections) {
    const humanoid::BoneMap& matched = character.matched;
    humanoid::BoneMap map = matched;
    for (const auto& [bone, node] : corrections)
        if (node != matched[bone].node)
            map[bone] = {node, node < 0 ? 0.0 : 1.0, node < 0 ? "removed by hand" : "picked by hand"};
    for (const auto& [bone, node] : corrections) {
        if (node < 0 || map[bone].node != node) continue;
        for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
            humanoid::BoneMatch& other = map.bones[i];
            if (i != static_cast<std::size_t>(bone) &&
                (other.node == node || (other.node < 0 && matched.bones[i].node == node)))
                other = {-1, 0.0, "its node was picked for " + std::string(humanoid::name(bone))};
        }
    }
    humanoid::review(map, character.skeleton());
    return map;
}

Loading::~Loading() {
    cancel();
    for (const auto& each : cancelled_) each->thread.join();
}

void Loading::begin(Work work) {
    cancel();
    job_ = std::make_unique<Job>();
    job_->work = std::move(work);
    job_->thread = std::thread([&job = *job_] {
        try {
            job.change = job.work.run(job.progress);
        } catch (...) {
            job.refused = std::current_exception();
        }
        job.done = true;
    });
}

void Loading::cancel() {
    if (job_) {
        job_->progress.cancel();
        cancelled_.push_back(std::move(job_));
    }
    std::erase_if(cancelled_, [](const auto& each) {
        if (!each->done) return false;
        each->thread.join();
        return true;
    });
}

Loading::Change Loading::take() {
    const std::unique_ptr<Job> job = std::move(job_);
    job->thread.join();
    if (job->refused) std::rethrow_exception(job->refused);
    return std::move(job->change);
}

bool loads_beside(const Workspace& workspace, const std::string& file) {
    std::error_code unknown;
    return workspace.clock.measured && has_threads &&
           std::filesystem::file_size(file, unknown) >= Loading::large_file && !unknown;
}

}  // namespace tendril::app
