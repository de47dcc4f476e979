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

void Loading::begin(const std::string& file, const std::string& from) {
    cancel();
    file_ = file;
    from_ = from;
    progress_ = std::make_unique<LoadProgress>();
    done_ = false;
    thread_ = std::thread([this] {
        try {
            read_ = load_character(file_, progress_.get());
        } catch (...) {
            refused_ = std::current_exception();
        }
        done_ = true;
    });
}

void Loading::cancel() {
    if (!running()) return;
    progress_->cancel();
    thread_.join();
    read_.reset();
    refused_ = nullptr;
}

SharedCharacter Loading::take() {
    thread_.join();
    if (const std::exception_ptr refused = std::exchange(refused_, nullptr)) std::rethrow_exception(refused);
    return std::exchange(read_, nullptr);
}

bool loads_beside(const Workspace& workspace, const std::string& file) {
    std::error_code unknown;
    return workspace.clock.measured && std::filesystem::file_size(file, unknown) >= Loading::large_file &&
           !unknown;
}

}  // namespace tendril::app
