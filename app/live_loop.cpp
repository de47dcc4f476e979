#include "app/live_loop.hpp"

#include <algorithm>
#include <utility>

#include "app/document/runtime.hpp"
#include "app/io/json_complete.hpp"
#include "app/system/atomic_file.hpp"
#include "app/system/environment.hpp"

namespace tendril::app {
namespace {

constexpr double min_credit = -0.05;  ///< a burst of events may run this far ahead
constexpr double max_sleep = 1.0;     ///< limits the delay of signals and autosaves

std::filesystem::path settings_file() {
    return config_folder() / "settings.json";
}

bool is_move(const Event& event) {
    return std::holds_alternative<MouseMove>(event);
}

}  // namespace

/// While it exists, exit() keeps unsaved work: Xlib calls exit() when the display is lost.
class LiveLoop::KeptAtExit {
  public:
    KeptAtExit(Autosave& autosave, Workspace& workspace) {
        static const int registered = std::atexit([] {
            if (autosave_) autosave_->end(*workspace_, true);
        });
        static_cast<void>(registered);
        autosave_ = &autosave, workspace_ = &workspace;
    }
    ~KeptAtExit() { autosave_ = nullptr; }
    KeptAtExit(const KeptAtExit&) = delete;
    KeptAtExit& operator=(const KeptAtExit&) = delete;

  private:
    static inline Autosave* autosave_ = nullptr;
    static inline Workspace* workspace_ = nullptr;
};

LiveLoop::LiveLoop(App& app, Window& window, const Options& options)
    : app_(app), window_(window), options_(options) {
    if (!options_.config || config_folder().empty()) {
        options_.config = false;
        return;
    }
    std::vector<std::string> complaints;
    std::error_code error;
    if (std::filesystem::exists(settings_file(), error)) {
        try {
            app_.workspace().settings = load_settings(read_json_file(settings_file()), complaints);
        } catch (const std::runtime_error& unreadable) {
            complaints.push_back(unreadable.what());
        }
    }
    for (const std::string& complaint : complaints)
        app_.workspace().toast("Settings: " + complaint, ToastKind::Refusal);
    kept_ = app_.workspace().settings;
    app_.workspace().config = config_folder();
    app_.workspace().keeps = true;
    autosave_.emplace(config_folder());
    for (const std::filesystem::path& file : Autosave::left_behind(config_folder()))
        app_.workspace().ui.recoverable.push_back({file, Autosave::title(file)});
}

LiveLoop::~LiveLoop() = default;

void LiveLoop::run(Player& player, std::optional<int> frames) {
    begin();
    while (pass(player, frames)) {
    }
    end();
}

void LiveLoop::begin() {
    if (autosave_) kept_at_exit_ = std::make_unique<KeptAtExit>(*autosave_, app_.workspace());
    app_.workspace().clock.measured = true;
    last_pass_ = std::chrono::steady_clock::now();
}

bool LiveLoop::pass(Player& player, std::optional<int> frames) {
    if (options_.ending || app_.quit() || (frames && ticks_ >= *frames)) return false;
    std::vector<Event> events;
    // With a frame count, time must pass even if nothing moves.
    window_.poll(events, frames ? 0.0 : patience(player));
    const auto now = std::chrono::steady_clock::now();
    turn(std::move(events), std::chrono::duration<double>(now - last_pass_).count(), player);
    if (frames && ticks_ < *frames && credit_ >= tick_seconds) tick(player);
    last_pass_ = now;
    save_settings_and_autosave();
    return true;
}

void LiveLoop::end() {
    // Keep unsaved work if the program was ended from outside; a user who quits was already asked.
    const bool keeps = options_.ending || (!app_.quit() && !app_.workspace().path.empty());
    if (autosave_) autosave_->end(app_.workspace(), keeps);
    kept_at_exit_.reset();
}

double LiveLoop::patience(const Player& player) const {
    if (frames_drawn_ == 0) return 0.0;
    if (queue_.empty() && player.done() && !app_.needs_ticks()) return max_sleep;
    return std::max(0.0, tick_seconds - credit_);
}

void LiveLoop::sample(std::vector<Event> events) {
    for (Event& event : events) {
        if (std::holds_alternative<Focus>(event)) ctrl_ = false;  // its release may go to another window
        if (const auto* key = std::get_if<KeyChange>(&event)) {
            if (key->key == Key::Ctrl) ctrl_ = key->down;
            if (key->key == Key::V && key->down && ctrl_) {
                queue_.push_back(TextInput{window_.clipboard()});  // a recording must include the pasted text
                continue;
            }
        }
        // If several moves arrive between two ticks, only the last counts.
        if (is_move(event) && !queue_.empty() && is_move(queue_.back())) queue_.pop_back();
        queue_.push_back(std::move(event));
    }
}

/// A paste from the menu or the palette is recorded as Ctrl+V. While a script plays, it supplies the text.
void LiveLoop::paste(const Player& player) {
    if (!std::exchange(app_.workspace().ui.pastes, false) || !player.done()) return;
    queue_.push_back(KeyChange{Key::Ctrl, true});
    queue_.push_back(TextInput{window_.clipboard()});
    queue_.push_back(KeyChange{Key::Ctrl, ctrl_});
}

void LiveLoop::tick(Player& player) {
    credit_ -= tick_seconds;
    ++ticks_;
    if (!queue_.empty()) {
        Event event = std::move(queue_.front());
        queue_.pop_front();
        // The window may have been resized further since: use its current size.
        if (auto* resize = std::get_if<Resize>(&event)) resize->size = window_.size();
        app_.tick(&event);
    } else if (!player.done()) {
        player.advance(app_);
    } else {
        app_.tick(nullptr);
    }
    paste(player);
}

bool LiveLoop::take_ticks(Player& player) {
    bool ticked = false;
    // Clicks and keys are handled at once; moves, up to a thousand per second, wait for a due tick.
    while (!queue_.empty() && !(is_move(queue_.front()) && queue_.size() == 1) && credit_ > min_credit) {
        tick(player);
        ticked = true;
    }
    while (credit_ >= tick_seconds && (!queue_.empty() || !player.done() || app_.needs_ticks())) {
        tick(player);
        ticked = true;
    }
    return ticked;
}

/// Any stall counts as a quarter of the last second, whatever its length.
void LiveLoop::note_pace(double elapsed, double dropped) {
    if (!(elapsed > 0.0)) return;
    double& pace = pace_of(app_.workspace().runtimes).kept;
    pace += std::min(elapsed, max_stall) * (1.0 - dropped / elapsed - pace);
}

void LiveLoop::turn(std::vector<Event> events, double elapsed, Player& player) {
    // Accumulate no time while idle, or the first event afterwards would trigger a burst of ticks.
    const bool resting = queue_.empty() && player.done() && !app_.needs_ticks();
    note_pace(elapsed, resting ? 0.0 : std::clamp(credit_ + elapsed - max_stall, 0.0, elapsed));
    // Each tick draws frames of a video: a burst of them would keep progress and Cancel from being drawn.
    const double most = app_.workspace().ui.filming ? tick_seconds : max_stall;
    credit_ = resting ? tick_seconds : std::min(credit_ + elapsed, most);
    // A recording being replayed has its own VideoEnd.
    const auto is_end = [](const Event& event) { return std::holds_alternative<VideoEnd>(event); };
    if (app_.video_ended() && (player.done() || !app_.replays()) && std::ranges::none_of(queue_, is_end))
        events.push_back(VideoEnd{});
    sample(std::move(events));
    if (take_ticks(player) || frames_drawn_ == 0) {
        app_.draw();
        window_.present();
        ++frames_drawn_;
    }
}

void LiveLoop::save_settings_and_autosave() {
    if (!options_.config || app_.busy()) return;
    Workspace& workspace = app_.workspace();
    autosave_->update(workspace, Autosave::Clock::now());
    if (workspace.settings == kept_) return;
    kept_ = workspace.settings;
    try {
        std::filesystem::create_directories(config_folder());
        write_file_atomically(settings_file(), save_settings(kept_).dump(2) + "\n");
    } catch (const std::exception& error) {
        workspace.toast(std::string("Settings could not be saved: ") + error.what(), ToastKind::Refusal);
    }
}

}  // namespace tendril::app
