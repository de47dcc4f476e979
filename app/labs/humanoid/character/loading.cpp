#include "app/labs/humanoid/character/loading.hpp"

#include <filesystem>
#include <utility>

namespace tendril::app {

void Loading::begin(const std::string& file) {
    cancel();
    file_ = file;
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
