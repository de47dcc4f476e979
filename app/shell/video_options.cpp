#include "app/shell/video_options.hpp"

#include <imgui.h>

#include <algorithm>

#include "app/io/mp4.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/lists.hpp"

namespace tendril::app {
namespace {

/// `pixels` is 0 while the size follows the view.
void size_field(const char* name, int& pixels, int view, const char* help) {
    int shown = pixels > 0 ? pixels : view;
    if (integer_field(name, shown, min_picture, max_picture)) pixels = shown == view ? 0 : shown;
    explain(help);
}

}  // namespace

void VideoOptions::start(const Workspace& workspace, bool labels) {
    labels_ = labels;
    const Rewind& past = workspace.rewind;
    const std::uint64_t now = past.empty() ? 0 : std::max(past.newest(), workspace.moment);
    const std::uint64_t ticks = past.empty() ? 0 : std::min(now - past.oldest(), Rewind::max_ticks);
    remembered_ = static_cast<float>(static_cast<double>(ticks) * tick_seconds);
    from_ = remembered_;
    to_ = 0.0f;
    view_ = workspace.ui.picture_size;
    why_no_mp4_ = why_no_mp4();
    if (!why_no_mp4_.empty()) format_ = 0;
}

void VideoOptions::frame() {
    static constexpr const char* formats[] = {"animated PNG", "MP4"};
    static constexpr const char* rates[] = {"30 a second", "60 a second"};
    const char* const why_not[] = {nullptr, why_no_mp4_.empty() ? nullptr : why_no_mp4_.c_str()};
    choice_field("format", format_, formats, 2, why_not);
    explain("Animated PNG is lossless, can be transparent, and plays in browsers. MP4 plays everywhere.");
    size_field("width, pixels", size_.x, view_.x,
               "The width of the video; default: as wide as the view. 16 to 8192, even for MP4.");
    size_field("height, pixels", size_.y, view_.y,
               "The height of the video; default: as high as the view. 16 to 8192, even for MP4.");
    number_field("from, seconds back", from_, 0.02f, 0.0f, remembered_, "%.2f s");
    explain("Where the video begins: this long before the latest moment.");
    number_field("to, seconds back", to_, 0.02f, 0.0f, remembered_, "%.2f s");
    explain("Where the video ends: this long before the latest moment.");
    choice_field("frames", smooth_, rates, 2);
    explain("How smooth it is. 60 a second makes the file about twice as large.");
    number_field("speed", speed_, 0.01f, static_cast<float>(slowest), static_cast<float>(fastest), "%.2f");
    explain("1 is real time, below it is slow motion.");
    ImGui::Checkbox("Labels and legend", &labels_);
    explain("Shows the labels of the view and its legend in the video too.");
    ImGui::BeginDisabled(mp4());
    ImGui::Checkbox("Transparent background", &transparent_);
    ImGui::EndDisabled();
    explain(mp4() ? "MP4 has no transparency, animated PNG has."
                  : "Shows only the objects in the scene, to lay over something else.");
}

std::filesystem::path VideoOptions::with_ending(std::filesystem::path path) const {
    const char* const ending = mp4() ? ".mp4" : ".png";
    // The chosen format wins, even if a file of the other kind was clicked in the list.
    if (path.extension() == ".mp4" || path.extension() == ".png") return path.replace_extension(ending);
    if (path.extension().empty()) path += ending;
    return path;
}

ArgumentList VideoOptions::arguments(const std::filesystem::path& path) const {
    ArgumentList list{{"path", path.string()}, {"every", smooth_ == 0 || (!mp4() && speed_ > 1.0f) ? 2 : 1}};
    list.push_back({"labels", labels_});
    if (size_.x > 0) list.push_back({"width", size_.x});
    if (size_.y > 0) list.push_back({"height", size_.y});
    if (from_ < remembered_) list.push_back({"from", from_});
    if (to_ > 0.0f) list.push_back({"to", to_});
    if (speed_ != 1.0f) list.push_back({"speed", speed_});
    if (transparent_ && !mp4()) list.push_back({"transparent", true});
    return list;
}

std::string video_name(const Workspace& workspace, const std::filesystem::path& folder) {
    const std::string stem = workspace.path.empty() ? "tendril" : workspace.path.stem().string();
    for (int i = 1;; ++i) {
        const std::string name = stem + "-" + std::to_string(i);
        std::error_code ignored;
        const auto taken = [&](const char* ending) {
            return std::filesystem::exists(folder / (name + ending), ignored);
        };
        if (!taken(".png") && !taken(".mp4")) return name;
    }
}

}  // namespace tendril::app
