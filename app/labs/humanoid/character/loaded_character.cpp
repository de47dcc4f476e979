#include "app/labs/humanoid/character/loaded_character.hpp"

#include <filesystem>
#include <utility>

#include "app/io/character/read.hpp"
#include "app/io/character/stick_figure.hpp"

namespace tendril::app {
namespace {

SharedCharacter shared(std::string file, std::string path, Character character) {
    auto loaded = std::make_shared<LoadedCharacter>();
    loaded->file = std::move(file);
    loaded->path = std::move(path);
    loaded->character = std::move(character);
    const humanoid::Skeleton& skeleton = loaded->skeleton();
    loaded->matched = bone_map(loaded->character);
    loaded->rest.resize(skeleton.size());
    humanoid::place(skeleton, humanoid::rest_pose(skeleton), loaded->rest);
    loaded->bounds = bounds_at_rest(loaded->character, loaded->rest);
    return loaded;
}

}  // namespace

SharedCharacter load_character(const std::string& file, LoadProgress* progress) {
    if (file.empty()) {
        static const SharedCharacter figure = shared({}, {}, stick_figure());
        return figure;
    }
    return shared(file, std::filesystem::absolute(file).lexically_normal().string(),
                  read_character(file, progress));
}

SharedCharacter read_as(const LoadedCharacter& character, double metres, const FileSpace& space) {
    Character copy = character.character;
    read_as(copy, metres, space);
    auto loaded = std::make_shared<LoadedCharacter>(*shared(character.file, character.path, std::move(copy)));
    loaded->motions = character.motions;
    loaded->cures = character.cures;
    return loaded;
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
    return workspace.clock.measured && std::filesystem::file_size(file, unknown) >= Loading::large_file &&
           !unknown;
}

}  // namespace tendril::app
