// The frame: events in, commands out, document changed, lab stepped, picture drawn. The real window and the
// one off screen run this very same code; only where events come from and where pixels go differs.
//
// Time passes in ticks of 1/60 s. A tick takes at most one event, so a recording, which is a list of events
// and of empty ticks, plays back exactly.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/autosave.hpp"
#include "app/io/image.hpp"
#include "app/labs/card.hpp"
#include "app/labs/labs.hpp"
#include "app/script/player.hpp"
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
    /// `window` must outlive the app, with its context current. Where `complain`, refusals also go to stderr.
    /// `labs`: the program's, unless a test has more.
    explicit App(Window& window, bool complain = false, Labs labs = Labs());
    ~App() override;

    Workspace& workspace() { return workspace_; }
    const CommandTable& commands() const { return *commands_; }
    const Labs& labs() const { return labs_; }

    /// Lays out what was opened without a command, as a tick would: so that the state has handles where the
    /// picture has them.
    void settle();
    /// What a recording starts from: taken on from there, and written down from now on.
    void start_from(const RecordingStart& start);
    /// `live`: in a window.
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
    /// The picture as it is when everything has come to rest, without dither, which a file would have to
    /// hold.
    Image screenshot();
    /// Whether the next tick may look different from this one without any event.
    bool needs_ticks() const;
    bool quit() const { return workspace_.ui.quit; }
    /// It started from what was recorded in a window.
    bool replays() const { return replays_; }
    /// Whether it is time for a VideoEnd.
    bool video_ended() const;
    /// A person is in the middle of a drag.
    bool busy() const;
    int draw_calls() const { return renderer_.draw_calls(); }

  private:
    const Lab& lab() const { return *labs_.find(workspace_.lab); }
    float ui_scale() const { return base_scale_ * workspace_.settings.text_scale; }
    /// A pass of the user interface. A tick takes an event and lets time pass. What an event opened settles
    /// in a second pass. A picture is drawn of what is there, and changes nothing.
    enum class Pass { Tick, Settle, Picture };
    /// Runs the user interface and builds the picture, once.
    void compose(const Event* event, Pass pass);
    void divide_view();
    const Pane& pane_at_hand();
    void draw_panes();
    Json panes_state() const;
    Pointer::Scene pointed_at(const Pane& pane, const Camera& camera) const;
    void take_event(const Event& event, Emit& emit);
    void take_shortcut(Emit& emit);
    void take_file(const std::string& path, Emit& emit);
    void refuse(const std::string& why);
    void run_emitted(Emit& emit);
    void run_command(const std::string& name, const Json& arguments, Gesture gesture);
    void note_refusal(const std::string& why);
    void review(const std::shared_ptr<const Part>& before, std::uint64_t moment);
    /// Writes, copies or begins what was asked for of the view. Throws Refused where it cannot.
    void take_pictures();
    void take_picture(const PictureRequest& wanted);
    void begin_video(const VideoRequest& wanted);
    /// The next frames of the video. `ends`: waits for the file after the last one. Throws Refused where it
    /// cannot be written: then there is none.
    void write_video(bool ends);
    /// `ended`: what writes the file says that it is done.
    void pass_video(bool ended = false);
    void drop_video();
    /// How a picture of that many pixels, or with 0 as many as the view has, shows the view.
    PictureView picture_view(glm::ivec2 size) const;
    void advance_time();
    void replay();
    void step_lab();
    void update_window();
    /// The open lab's card, where it is shown.
    const Card* shown_card() const;
    void watch_shown_card();
    /// Whether the next tick looks whether a step of it has happened.
    bool card_is_due() const;
    Json card_state() const;
    /// What the lab says of itself, with camera and time.
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
    std::vector<Pane> panes_;  ///< of the last picture; one at least
    std::size_t pane_ = 0;     ///< where the hand is, or was
    Layout layout_;
    std::optional<Recorder> recorder_;
    bool replays_ = false;
    std::unique_ptr<VideoTake> video_;  ///< the one that is being written
    glm::ivec2 size_{0};  ///< the window's; changed by events alone, so that a recording has every change
    float base_scale_ = 1.0f;  ///< the window's wish for the size of text and widgets
    Gesture gesture_ = 1;
    int settling_ = 0;  ///< ticks in which the panels may still change after the last event
    std::string title_;
};

}  // namespace tendril::app
