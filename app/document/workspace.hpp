// Everything that commands can change: the document, and the program's state around it, with the progress of
// cards and videos.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/document/camera_pose.hpp"
#include "app/document/document.hpp"
#include "app/document/history.hpp"
#include "app/document/rewind.hpp"
#include "app/document/runtime.hpp"
#include "app/document/settings.hpp"
#include "app/io/json.hpp"
#include "app/io/outputs.hpp"

namespace tendril::app {

struct Workspace;

// Pictures and videos of the view: what was requested, and the progress of a video.

/// How the view is drawn.
struct PictureLook {
    glm::ivec2 size{0};  ///< pixels; 0: as large as the view
    bool transparent = false;
    bool paper = false;          ///< in the light theme's colours, on white unless transparent
    bool handles = false;        ///< with the handles, and the selection marked
    std::optional<bool> labels;  ///< with its labels, titles and legend; empty: if the lab wants them
};

/// A picture on its way to a file or to the clipboard.
struct PictureRequest : PictureLook {
    std::filesystem::path path;  ///< empty: to the clipboard
};

/// A video: of the last seconds, or of frames that a lab shows one by one.
struct VideoRequest : PictureLook {
    std::filesystem::path path;
    std::string command = "view.video";  ///< the command that asked for it, for messages
    int from = 0;                        ///< ticks of 1/60 s before the newest moment in Rewind
    int to = 0;                          ///< likewise, less than `from`
    int every = 2;                       ///< ticks from one frame to the next
    double speed = 1.0;                  ///< playback speed; 0.5 is slow motion

    /// Set for frames that a lab shows instead of the last seconds: their number, and the function that shows
    /// one in a copy of the workspace. It returns false if the frame looks like the one before.
    int shown_frames = 0;
    std::function<bool(Workspace&, int frame)> show{};

    int frames() const { return show ? shown_frames : (from - to) / every + 1; }
};

/// Progress of the video being written.
struct VideoProgress {
    std::string name;  ///< the file's name
    int done = 0, frames = 0;
};

// Cards of things to try: the user's progress on each lab's cards in this session. Whether a card is shown is
// a setting, so that a hidden card stays hidden and a recording reproduces it.

/// Progress of a step that asks the user to repeat a drag after curing the incident that the drag caused.
struct RepeatedDrag {
    struct Point {
        std::uint64_t moment = 0;
        glm::vec3 at{0.0f};
    };
    std::vector<Point> path{};               ///< the step's drags since another command changed the scene
    std::optional<std::uint64_t> caused{};   ///< the moment of the last incident caused by a drag
    SharedJson incident{};                   ///< the incident to cure, as in the state
    glm::vec3 place{0.0f}, direction{0.0f};  ///< of the drag, when it caused the incident
    bool cured = false;
};

struct CardProgress {
    std::size_t card = 0;      ///< index among the lab's cards
    std::vector<bool> done{};  ///< for each step; empty until the first command
    /// For each step: the moment when its command ran. Empty until then, and again once another command has
    /// changed the scene.
    std::vector<std::optional<std::uint64_t>> tried{};
    std::vector<RepeatedDrag> drags{};   ///< for each step
    std::shared_ptr<const Part> seen{};  ///< the part at the last check
    std::uint64_t ticks_to_wait = 0;     ///< until the next check
};

bool card_shown(const Settings& settings, const std::string& lab);
void show_card(Settings& settings, const std::string& lab, bool shown);
/// True if the user ever showed or hid the card.
bool card_known(const Settings& settings, const std::string& lab);

inline constexpr double tick_seconds = 1.0 / 60.0;

struct Clock {
    bool playing = true;
    bool looks_back = false;     ///< paused by going to an earlier moment: only the open lab is paused
    bool held = false;           ///< paused by hand: all labs are; up to date when a lab is closed
    std::uint64_t tick = 0;      ///< simulated ticks so far
    int steps_due = 0;           ///< ticks to take even while paused
    float speed = 1.0f;          ///< seconds that pass in a lab per second
    double passed = 0.0;         ///< ticks that have passed in the labs, scaled by speed
    bool replaying = false;      ///< the last seconds are replaying at this speed
    std::uint64_t replayed = 0;  ///< replays up to this moment
    bool measured = false;       ///< measure the cost of simulating: only in a live window

    /// How many whole ticks of lab time the next tick completes, for a lab that cannot simulate part of a
    /// tick.
    int whole_ticks() const;
};

inline constexpr double slowest = 0.05, fastest = 2.0;

enum class ToastKind { Info, Refusal };

struct Toast {
    std::string text;
    ToastKind kind = ToastKind::Info;
    int ticks_left = 0;
};

/// An autosave left behind by a crash.
struct Recoverable {
    std::filesystem::path file;
    std::string title;  ///< as shown: "arm.json, 2026-11-21 14:03"
};

/// One of the ways to open a file that has several.
struct FileWay {
    std::string title, help;
    std::string command;  ///< opens the file, given as `path`
};

inline constexpr int min_picture = 16, max_picture = 8192;  ///< pixels, each way

/// Transient state of the window.
struct UiState {
    bool help = false;
    bool palette = false;
    bool settings = false;
    enum class FileDialog { None, Open, SaveAs, SaveAndQuit, Picture, Video } file_dialog = FileDialog::None;
    bool plays_after_dialog = false;  ///< the simulation resumes when the dialog closes
    std::string browses_for;          ///< the command for the chosen file; empty: its kind's
    struct FileQuestion {
        std::string path;
        std::vector<FileWay> ways{};  ///< none: nothing is asked
    } file_question;
    std::vector<Toast> toasts;
    std::vector<Recoverable> recoverable;  ///< until the user answers
    glm::vec2 view_size{1000.0f, 700.0f};  ///< the 3D view, or its first pane, in window coordinates
    glm::ivec2 picture_size{1000, 700};    ///< size of a picture of the whole view, pixels
    std::optional<std::string> copied;     ///< text on its way to the clipboard
    bool pastes = false;                   ///< paste the clipboard's text, as Ctrl+V does
    std::optional<PictureRequest> picture;
    std::optional<VideoRequest> video;          ///< requested, not started
    std::optional<VideoProgress> filming;       ///< the video being written
    bool ends_filming = false;                  ///< stop writing it
    std::optional<Incident> incident;           ///< the pose before it is shown over the pose after it
    bool incident_chosen = false;               ///< by the user: the inspector scrolls to it
    std::map<std::string, CardProgress> cards;  ///< things to try, by lab
    std::string hidden_gizmo;                   ///< hidden by Esc, until a handle is pressed or selected
    bool asks_to_quit = false;                  ///< the question about unsaved work is open
    bool quit = false;

    /// True if something that Esc closes is open over the scene.
    bool covered() const {
        return help || palette || settings || asks_to_quit || file_dialog != FileDialog::None ||
               !file_question.ways.empty();
    }
};

struct Workspace {
    Document document;
    Runtimes runtimes;      ///< the labs' scratch memory; may be discarded at any time
    Document blank;         ///< scene.new starts from this
    std::string lab;        ///< the open lab
    CameraPose first_view;  ///< the camera after scene.new, in a lab without a view of its own
    std::map<std::string, CameraPose> first_views;  ///< each lab's first view
    CameraPose camera;
    std::map<std::string, CameraPose> cameras;  ///< the closed labs' cameras
    Clock clock;
    Rewind rewind;                 ///< the open lab's
    std::uint64_t beginnings = 0;  ///< counts scenes begun, new or opened
    std::uint64_t moment = 0;      ///< counts simulated ticks and changes by hand, which rewind remembers
    struct Past {
        Rewind rewind;
        std::uint64_t moment = 0;
        std::shared_ptr<const Part>
            left{};  ///< the lab's part when it was closed; the past is dropped if it has changed
        bool looks_back = false;  ///< the lab is paused at an earlier moment
    };
    std::map<std::string, Past> pasts;  ///< the closed labs'
    /// The moments that the last edit at an earlier moment discarded, until undo leads back there.
    struct Discarded {
        Rewind rewind;
        std::shared_ptr<const Part> part;  ///< the open lab's part before the edit
        MomentId moment;
    };
    std::optional<Discarded> discarded;
    std::uint64_t edition = 0;   ///< the edition of the last undoable change
    std::uint64_t editions = 0;  ///< counts all editions; numbers are never reused
    History history;
    bool gesture_begins = true;  ///< the running command is the first of its drag, or not part of one
    Settings settings;
    std::filesystem::path config;  ///< folder for data kept between sessions; empty: none
    bool keeps = false;            ///< autosave: only in a live window
    bool names_pictures = false;   ///< gives new pictures a name: only in a live window
    UiState ui;
    std::filesystem::path path;       ///< the scene's file; empty if it has none
    std::filesystem::path recovered;  ///< the autosave that holds this work; empty: the program's own
    Outputs outputs;                  ///< used through writes(), except for the session's options
    Document saved;                   ///< the document as last saved or opened
    std::set<std::string> openings;   ///< labs whose opening still moves by itself: nothing to save

    /// Opens a lab with the camera it had when it was last open.
    void open_lab(const std::string& name);
    const CameraPose& first_view_of(const std::string& name) const;
    /// Resets time and cameras for a new scene.
    void start_anew();
    /// Clears the last ten seconds of every lab.
    void forget_pasts();
    /// Remembers the open lab's part for time.seek.
    void remember_moment() { rewind.remember(moment, edition, document.parts().at(lab), clock.tick); }
    /// Counts a moment for a change by hand without a simulated tick.
    void pass_change();
    /// Makes these labs the openings. A lab that was or becomes one counts as saved.
    void set_openings(std::set<std::string> labs);
    /// Forgets this moment and the later ones, which an edit of `part` invalidates; undo brings them back.
    void discard_later(const std::shared_ptr<const Part>& part);
    /// Brings back the moments that the edit of exactly this part discarded. Returns whether there were any.
    bool restore_later(const std::shared_ptr<const Part>& part);
    /// The ticks that an edit here would discard; 0 at the latest moment.
    std::uint64_t later_ticks() const {
        return rewind.empty() || rewind.newest() < moment ? 0 : rewind.newest() - moment;
    }
    /// Goes to the nearest remembered moment and pauses. Going back over a change can itself be undone.
    void go_to_moment(std::uint64_t ticks_back);
    MomentId moment_id() const { return {moment, edition}; }
    void begin_edition() { edition = ++editions; }
    /// The open lab's part just before and just after an incident; null if not remembered.
    struct BeforeAndAfter {
        std::shared_ptr<const Part> before, after;
    };
    BeforeAndAfter around(const Incident& incident) const;
    Place place() const { return {lab, path, camera, std::nullopt, openings, recovered}; }
    bool modified() const { return document != saved; }
    /// Every file is written through this: it knows which files the document reads.
    Outputs& writes();
    /// Closes the file dialog and resumes what it paused.
    void close_file_dialog();
    void toast(std::string text, ToastKind kind = ToastKind::Info);
};

}  // namespace tendril::app
