#include "app/shell/picture_options.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/labs/kit/film.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

void PictureOptions::start(const Workspace& workspace, bool labels, bool video, int loop) {
    video_ = video;
    labels_ = labels;
    const Rewind& past = workspace.rewind;
    const std::uint64_t now = past.empty() ? 0 : std::max(past.newest(), workspace.moment);
    const std::uint64_t ticks = past.empty() ? 0 : std::min(now - past.oldest(), Rewind::max_ticks);
    remembered_ = static_cast<float>(static_cast<double>(ticks) * tick_seconds);
    loop_ = loop;
    from_ = remembered_;
    to_ = 0.0f;
    view_ = workspace.ui.picture_size;
    for (std::size_t i = 0; i < why_not_.size(); ++i) why_not_[i] = why_no_video(video_kinds[i]);
    if (!why_not_[static_cast<std::size_t>(format_)].empty()) format_ = 0;
}

void PictureOptions::frame() {
    if (video_) video_rows();
    size_rows();
    look_rows();
}

int PictureOptions::every() const {
    const double speed = turns() ? 1.0 : static_cast<double>(speed_);
    return smooth_ == 1 && speed <= kind().max_rate * tick_seconds + 1e-6 ? 1 : 2;
}

/// The frame after the last would be the first again.
void PictureOptions::take_loop() {
    const int remembered = static_cast<int>(std::lround(static_cast<double>(remembered_) / tick_seconds));
    int from = (loop_ + every() - 1) / every() * every();
    if (from > remembered) from -= every();
    from_ = static_cast<float>(from * tick_seconds);
    to_ = from > every() ? static_cast<float>(every() * tick_seconds) : 0.0f;
}

void PictureOptions::video_rows() {
    if (loop_ > 0) take_loop();
    static constexpr const char* contents[] = {"the last seconds", "a full turn of the camera"};
    static constexpr const char* rates[] = {"30 a second", "60 a second"};
    std::array<const char*, video_kinds.size()> titles{}, why{};
    for (std::size_t i = 0; i < titles.size(); ++i) {
        titles[i] = video_kinds[i].title;
        why[i] = why_not_[i].empty() ? nullptr : why_not_[i].c_str();
    }
    choice_field("format", format_, titles.data(), static_cast<int>(titles.size()), why.data());
    explain(
        "Animated PNG is lossless and can be transparent, GIF has 256 colours a frame, MP4 is the smallest.");
    const char* const nothing[] = {remembered_ > 0.0f ? nullptr : "Nothing has moved yet.", nullptr};
    int shown = turns();
    if (choice_field("shows", shown, contents, 2, nothing)) shows_ = shown;
    explain("The last seconds as they were, or the present moment while the camera turns once about it.");
    if (turns()) {
        integer_field("turn, frames", turn_frames_, 2, 3600);
        explain("How many frames the turn has.");
    } else {
        if (number_field("from, seconds back", from_, 0.02f, 0.0f, remembered_, "%.2f s")) loop_ = 0;
        explain("Where the video begins: this long before the latest moment.");
        if (number_field("to, seconds back", to_, 0.02f, 0.0f, remembered_, "%.2f s")) loop_ = 0;
        explain("Where the video ends: this long before the latest moment.");
        number_field("speed", speed_, 0.01f, static_cast<float>(slowest), static_cast<float>(fastest),
                     "%.2f");
        explain("1 is real time, below it is slow motion.");
    }
    choice_field("frames", smooth_, rates, 2);
    explain("How smooth it is. 60 a second makes the file about twice as large; a GIF has 30.");
}

void PictureOptions::size_rows() {
    const char* const names[] = {"width, pixels", "height, pixels"};
    for (int i = 0; i < 2; ++i) {
        int shown = size_[i] > 0 ? size_[i] : view_[i];
        const bool changed = integer_field(names[i], shown, min_picture, max_picture);
        explain("16 to 8192, even for MP4; default: as large as the view.");
        if (!changed) continue;
        size_[i] = shown;
        if (keeps_proportions_)
            size_[1 - i] = std::clamp(static_cast<int>(std::lround(static_cast<double>(shown) * view_[1 - i] /
                                                                   std::max(1, view_[i]))),
                                      min_picture, max_picture);
        if (size_ == view_) size_ = {0, 0};
    }
    ImGui::Checkbox("Keep proportions", &keeps_proportions_);
    explain("Width and height change together, in the proportions of the view.");
}

void PictureOptions::look_rows() {
    static constexpr const char* backgrounds[] = {"as on screen", "white", "transparent"};
    const std::string opaque = kind().transparent ? "" : no_transparency(kind()) + ".";
    const char* const why[] = {nullptr, nullptr, opaque.empty() ? nullptr : opaque.c_str()};
    int shown = background();
    if (choice_field("background", shown, backgrounds, 3, why)) background_ = shown;
    explain("Transparent: only the objects in the scene, to lay over something else.");
    bool dark = paper();
    ImGui::BeginDisabled(background() != Transparent);
    if (ImGui::Checkbox("Dark labels and lines, for paper", &dark)) paper_ = dark;
    ImGui::EndDisabled();
    explain("Uses the colours of the light theme. White always does.");
    ImGui::Checkbox("Labels and legend", &labels_);
    explain("Shows the labels of the view and its legend too.");
    ImGui::Checkbox("Handles and selection", &handles_);
    explain("Shows the handles that you drag, and marks the selection.");
}

std::filesystem::path PictureOptions::with_ending(std::filesystem::path path) const {
    return video_kind(path)           ? path.replace_extension(ending())
           : path.extension().empty() ? path += ending()
                                      : path;
}

ArgumentList PictureOptions::arguments(const std::filesystem::path& path) const {
    ArgumentList list{{"labels", labels_}};
    if (!path.empty()) list.push_back({"path", path.string()});
    glm::ivec2 size = size_;
    if (video_ && kind().even) size -= size % 2;
    if (size.x > 0) list.push_back({"width", size.x});
    if (size.y > 0) list.push_back({"height", size.y});
    if (background() == Transparent) list.push_back({"transparent", true});
    if (paper()) list.push_back({"paper", true});
    if (handles_) list.push_back({"handles", true});
    if (!video_) return list;
    list.push_back({"every", every()});
    if (turns()) {
        list.push_back({"frames", turn_frames_});
        return list;
    }
    if (from_ < remembered_) list.push_back({"from", from_});
    if (to_ > 0.0f) list.push_back({"to", to_});
    if (speed_ != 1.0f) list.push_back({"speed", speed_});
    return list;
}

std::string picture_name(const Workspace& workspace, const std::filesystem::path& folder) {
    const std::string stem = workspace.path.empty() ? "tendril" : workspace.path.stem().string();
    for (int i = 1;; ++i) {
        const std::string name = stem + "-" + std::to_string(i);
        std::error_code ignored;
        if (std::ranges::none_of(video_kinds, [&](const VideoKind& kind) {
                return std::filesystem::exists(folder / (name + kind.ending), ignored);
            }))
            return name;
    }
}

}  // namespace tendril::app
