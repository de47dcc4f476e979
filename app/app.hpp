// The frame: takes events, runs commands, steps the lab and draws the picture. Windows on and off screen run
// the same code; only the source of events and the destination of pixels differ.
//
// Time passes in ticks of 1/60 s. A tick takes at most one event, so a recording, a list of events and empty
// ticks, plays back exactly.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/autosave.hpp"
#include "app/io/image.hpp"
#include "app/labs/card.hpp"
#include "app/labs/labs.hpp"
#include "app/script/recorder.hpp"
#include "app/shell/pointer.hpp"
#include "app/shell/shell.hpp"
#include "app/shell/ui.hpp"
#include "app/view/renderer.hpp"
#include "app/window/window.hpp"

namespace tendril::app {

struct PictureView;
class VideoTake;

class App final : public Stage {
  public:
    /// `window` must outlive the app, with its context current. With `complain`, refusals are also printed to
    /// stderr. `labs`: the program's; tests may add more.
    explicit App(Window& window, bool complain = false, Labs labs = Labs());
    ~App() override;

    Workspace& workspace() { return workspace_; }
    const CommandTable& commands() const { return *commands_; }
    const Labs& labs() const { return labs_; }

    /// Updates the layout as a tick would. Call it after opening something without a command, so that the
    /// state's handles match the picture.
    void settle();
    /// Takes over the state that a recording starts from.
    void start_from(const RecordingStart& start);
    /// Records from now on. `live`: in a window.
    void start_recording(bool live = false);
    /// The script so far; empty unless recording.
    std::string recording() const { return recorder_ ? recorder_->text() : std::string(); }

    // Stage
    void tick(const Event* event) override;
    void run(const RunCommand& command) override;
    void write_screenshot(const std::string& path) override;
    void write_state(const std::string& path) override;
    Json state() override;

    /// Draws the last tick's picture into the window's framebuffer.
    void draw(bool dither = true);
    /// The picture once the panels have settled, without dither, which would enlarge the file.
    Image screenshot();
    /// True if the next tick may change the picture without an event.
    bool needs_ticks() const;
    bool quit() const { return workspace_.ui.quit; }
    /// True if it replays a recording made in a window.
    bool replays() const { return replays_; }
    /// True if it is time for a VideoEnd.
    bool video_ended() const;
    /// True if the user is dragging something.
    bool busy() const;
    int draw_calls() const { return renderer_.draw_calls(); }

  private:
    const Lab& lab() const { return *labs_.find(workspace_.lab); }
    float ui_scale() const { return base_scale_ * workspace_.settings.text_scale; }
    bool moves() const;
    /// One pass of the user interface. Tick: takes an event and advances time. Settle: a second pass, for
    /// windows that the event opened. Picture: draws the present state and changes nothing.
    enum class Pass { Tick, Settle, Picture };
    /// Runs the user interface once and builds the picture.
    void compose(const Event* event, Pass pass);
    void divide_view();
    const Pane& pane_at_hand();
    void draw_panes();
    Json panes_state() const;
    Pointer::Scene pointed_at(const Pane& pane, const Camera& camera) const;
    void take_event(const Event& event, Emit& emit);
    /// Text that Ctrl+V pasted over the view goes to the open lab.
    void take_paste(const std::string& text, Emit& emit);
    void take_shortcut(Emit& emit);
    void note_typing(const Event* event);
    void refuse(const std::string& why);
    /// The source of a command. Panel: the panels and the palette. View: handles, keys, scripts and the rest.
    enum class From { View, Panel };
    void run_emitted(Emit& emit, From from);
    void run_command(const std::string& name, const Json& arguments, Gesture gesture, From from);
    void note_refusal(const std::string& why);
    /// An opening in the state where it ended.
    struct Opening {
        Document document, saved;
        Rewind rewind;
        std::uint64_t edition = 0;
    };
    /// The user takes over: stops the open lab's opening where it is. This is not an undo step, and the
    /// opening does not resume.
    std::optional<Opening> end_opening();
    /// Resumes the opening because the user's command was refused.
    void resume(Opening opening);
    void drop_incidents(const Part& before);
    void review(const std::shared_ptr<const Part>& before, std::uint64_t moment);
    /// Executes requests for pictures and videos of the view. Throws Refused if it cannot.
    void take_pictures();
    void take_picture(const PictureRequest& wanted);
    void begin_video(const VideoRequest& wanted);
    /// Writes the next frames of the video. `ends`: waits for the file after the last one. Throws Refused if
    /// the video cannot be written, and drops it.
    void write_video(bool ends);
    /// `ended`: the program that writes the file has ended.
    void pass_video(bool ended = false);
    void drop_video();
    /// The view for a picture of that size in pixels; 0: the view's own.
    PictureView picture_view(glm::ivec2 size) const;
    void advance_time();
    void replay();
    void step_lab();
    void update_window();
    /// The open lab's card, null unless shown.
    const Card* shown_card() const;
    void watch_shown_card();
    /// True if the next tick must check the card's steps.
    bool card_is_due() const;
    Json card_state() const;
    /// The lab's state, with camera and time.
    Json lab_state() const;

    Window& window_;
    bool complain_;
    Labs labs_;
    std::unique_ptr<const CommandTable> commands_;
    Shortcuts shortcuts_;
    Cards cards_;
    Workspace workspace_;
    Renderer renderer_;
    Ui ui_;
    Shell shell_;
    Input input_;
    Pointer pointer_;
    std::vector<Pane> panes_;  ///< the last picture's; at least one
    std::size_t pane_ = 0;     ///< index of the pane last used by the mouse
    Layout layout_;
    std::optional<Recorder> recorder_;
    bool replays_ = false;
    std::unique_ptr<VideoTake> video_;  ///< the video being written
    glm::ivec2 size_{0};       ///< the window's; changed only by events, so that a recording has every change
    float base_scale_ = 1.0f;  ///< the window's scale for text and widgets
    Gesture gesture_ = 1;
    int settling_ = 0;  ///< remaining ticks in which the panels may change after the last event
    std::string title_;
    bool was_typing_ = false, types_nowhere_ = false;
};

}  // namespace tendril::app
