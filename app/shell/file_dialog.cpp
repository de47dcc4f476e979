#include "app/shell/file_dialog.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/common.hpp>
#include <utility>

#include "app/labs/kit/film.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/shell.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

namespace fs = std::filesystem;

bool FileDialog::is_listed(const fs::path& file) const {
    const fs::path ending = file.extension();
    if (filming()) return video_kind(file) != nullptr;
    if (picturing()) return ending == ".png";
    if (saving()) return ending == ".json";
    if (filter_ > 0) return has_ending(kinds_[static_cast<std::size_t>(filter_ - 1)], file);
    return std::ranges::any_of(kinds_, [&](const FileKind& kind) { return has_ending(kind, file); });
}

void FileDialog::open_folder(const fs::path& folder) {
    std::error_code error;
    fs::directory_iterator each(folder, error);
    if (error) {
        error_ = folder.string() + ": " + error.message();
        return;
    }
    folder_ = folder;
    error_.clear();
    entries_.clear();
    for (; each != fs::directory_iterator(); each.increment(error)) {
        if (error) break;
        const std::string name = each->path().filename().string();
        const bool is_folder = each->is_directory(error);
        if (name.starts_with('.') || (!is_folder && !is_listed(each->path()))) continue;
        entries_.push_back({name, is_folder});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : a.name < b.name;
    });
}

/// The command closes the dialog if it succeeds: a refused name stays for editing.
void FileDialog::send(const fs::path& path, Emit& emit) {
    if (picturing()) return emit(picture_.command(), picture_.arguments(path));
    if (saving()) return emit("scene.save", {{"path", path.string()}});
    opened_ = path.parent_path();
    ArgumentList given{{"path", path.string()}, {"ask", true}};
    if (!by_.empty()) given.push_back({"by", by_});
    emit("file.open", given);
}

void FileDialog::take(Emit& emit) {
    if (name_[0] == '\0') return;
    fs::path path = fs::path(name_.data()).is_absolute() ? fs::path(name_.data()) : folder_ / name_.data();
    std::error_code error;
    if (fs::is_directory(path, error)) {
        open_folder(path);
        name_.fill('\0');
        return;
    }
    if (picturing())
        path = picture_.with_ending(path);
    else if (saving() && path.extension().empty())
        path += ".json";
    send(path, emit);
}

void FileDialog::start(const Workspace& workspace, const Labs& labs) {
    kinds_.clear();
    by_ = workspace.ui.browses_for;
    for (FileRoute& route : file_routes(labs))
        if (by_.empty() || (route.lab != nullptr && by_.starts_with(route.lab->name() + '.')))
            kinds_.push_back(std::move(route.kind));
    const auto own = [&](const FileKind& kind) { return kind.command == by_; };
    if (std::ranges::any_of(kinds_, own))
        std::erase_if(kinds_, std::not_fn(own));
    else if (!by_.empty())  // bone maps are recognised by their beginning, and opened by their own command
        std::erase_if(kinds_, [](const FileKind& kind) { return kind.begins != nullptr; });
    filter_ = 0;
    std::error_code error;
    const fs::path home =
        workspace.path.empty() ? fs::current_path(error) : fs::absolute(workspace.path).parent_path();
    if (std::exchange(home_, home) != home) opened_.clear();
    open_folder(!saving() && fs::is_directory(opened_, error) ? opened_ : home);
    const Lab& lab = *labs.find(workspace.lab);
    if (picturing())
        picture_.start(workspace, lab.labels_pictures(workspace), filming(), lab.loop_ticks(workspace));
    const std::string name = picturing() ? picture_name(workspace, folder_)
                             : saving()  ? workspace.path.filename().string()
                                         : std::string();
    std::snprintf(name_.data(), name_.size(), "%s", name.c_str());
}

void FileDialog::show_filter() {
    std::vector<std::string> texts{by_.empty() ? "every kind of file" : "all of these"};
    for (const FileKind& kind : kinds_) texts.push_back(kind_text(kind));
    std::vector<const char*> titles;
    for (const std::string& text : texts) titles.push_back(text.c_str());
    if (choice_field("show", filter_, titles.data(), static_cast<int>(titles.size()))) open_folder(folder_);
    explain("Which kinds of files are listed");
}

std::string FileDialog::empty_message() const {
    if (std::ranges::any_of(entries_, [](const Entry& each) { return !each.folder; })) return {};
    if (picturing()) return filming() ? "No videos here yet." : "No pictures here yet.";
    if (saving()) return "No scenes here yet.";
    std::string kinds;
    for (std::size_t i = 0; i < kinds_.size(); ++i)
        if (filter_ == 0 || filter_ == static_cast<int>(i) + 1)
            kinds += (kinds.empty() ? "" : ", ") + kind_text(kinds_[i]);
    return "No files that can be opened here: " + kinds + '.';
}

bool FileDialog::list() {
    fs::path entered;
    bool chosen = false;
    for (const Entry& entry : entries_) {
        const std::string shown = entry.folder ? entry.name + "/" : entry.name;
        if (!ImGui::Selectable(shown.c_str(), entry.name == name_.data(),
                               ImGuiSelectableFlags_AllowDoubleClick)) {
            explain(entry.folder ? "Opens this folder" : "Double-click to choose it");
            continue;
        }
        if (entry.folder) {
            entered = folder_ / entry.name;
        } else {
            std::snprintf(name_.data(), name_.size(), "%s", entry.name.c_str());
            chosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        }
    }
    if (const std::string why = empty_message(); !why.empty()) note(why);
    if (!entered.empty()) open_folder(entered);
    return chosen;
}

void FileDialog::frame(const Workspace& workspace, const Labs& labs, glm::vec2 screen, float scale,
                       Emit& emit) {
    const auto wanted = workspace.ui.file_dialog;
    const bool open = wanted != UiState::FileDialog::None;
    const bool appearing = open && (shown_ != wanted || by_ != workspace.ui.browses_for);
    shown_ = wanted;
    if (!open) return;
    if (appearing) start(workspace, labs);
    const glm::vec2 size =
        glm::max(glm::vec2(520.0f, picturing() ? 280.0f + 31.0f * picture_.rows() : 420.0f) * scale,
                 glm::vec2(0.5f, 0.6f) * screen);
    if (!begin_sheet(title(), screen, size)) emit("view.close");
    if (ImGui::Button("Up")) open_folder(folder_.parent_path());
    explain("Shows the folder above this one");
    ImGui::SameLine();
    text_elided(folder_.string(), ImGui::GetContentRegionAvail().x, true);
    const float wrap = ImGui::GetContentRegionAvail().x;
    const float complaint =
        error_.empty() ? 0.0f : ImGui::CalcTextSize(error_.c_str(), nullptr, false, wrap).y;
    const float rows = picturing() ? 2.0f + picture_.rows() : saving() ? 2.0f : 3.0f;
    ImGui::BeginChild("entries", {0.0f, -rows * ImGui::GetFrameHeightWithSpacing() - complaint}, true);
    bool done = list();
    ImGui::EndChild();
    if (picturing()) picture_.frame();
    if (!saving()) show_filter();
    ImGui::SetNextItemWidth(-1.0f);
    const bool cut = !appearing && shows_cut_text("##name", name_.data());
    if (appearing) ImGui::SetKeyboardFocusHere();
    if (!cut && ImGui::InputTextWithHint("##name", "file name", name_.data(), name_.size(),
                                         ImGuiInputTextFlags_EnterReturnsTrue)) {
        done = true;
        ImGui::SetKeyboardFocusHere(-1);  // keep the focus, to edit a refused name
    }
    explain("The name of the file. Enter confirms it.");
    done |= ImGui::Button(action());
    explain(filming()     ? "Writes the video and shows its progress"
            : picturing() ? "Writes the picture to this file"
            : saving()    ? "Saves the scene to this file"
                          : "Opens this file in its lab");
    if (picturing() && !filming()) {
        ImGui::SameLine();
        if (ImGui::Button("Copy")) emit("view.copy_picture", picture_.arguments({}));
        explain("Puts the picture on the clipboard");
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) emit("view.close");
    explain("Esc: closes this and changes nothing");
    if (!error_.empty()) note(error_);
    if (done) take(emit);
    ImGui::End();
}

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
        explain("The start of the video: this long before the latest moment.");
        if (number_field("to, seconds back", to_, 0.02f, 0.0f, remembered_, "%.2f s")) loop_ = 0;
        explain("The end of the video: this long before the latest moment.");
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
