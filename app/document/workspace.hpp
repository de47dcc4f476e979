// All that commands can change: the document and what surrounds it while the program runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/document/camera_pose.hpp"
#include "app/document/card_progress.hpp"
#include "app/document/document.hpp"
#include "app/document/history.hpp"
#include "app/document/rewind.hpp"
#include "app/document/runtime.hpp"
#include "app/document/settings.hpp"
#include "app/document/video_request.hpp"

namespace tendril::app {

inline constexpr double tick_seconds = 1.0 / 60.0;

struct Clock {
    bool playing = true;
    std::uint64_t tick = 0;      ///< simulated ticks so far
    int steps_due = 0;           ///< ticks to take at once, though paused
    float speed = 1.0f;          ///< slow motion: seconds that pass in a lab in a second of time
    double passed = 0.0;         ///< ticks that have passed in the labs, by speed
    bool replaying = false;      ///< the last seconds are shown again, at this speed
    std::uint64_t replayed = 0;  ///< up to this moment
    bool measured = false;  ///< what simulating takes is measured: in a live window, where it does no harm

    /// Of a lab that moves by whole ticks: how many pass in the next one.
    int whole_ticks() const;
};

inline constexpr double slowest = 0.05, fastest = 2.0;

enum class ToastKind { Info, Refusal };

struct Toast {
    std::string text;
    ToastKind kind = ToastKind::Info;
    int ticks_left = 0;
};

/// What a crash left.
struct Recoverable {
    std::filesystem::path file;
    std::string title;  ///< for people: "arm.json, 2026-11-21 14:03"
};

inline constexpr int smallest_picture = 16, largest_picture = 8192;  ///< pixels, each way

/// A picture of the view, on its way to a file or to the clipboard.
struct PictureRequest {
    std::filesystem::path path;  ///< empty: to the clipboard
    glm::ivec2 size{0};          ///< pixels; 0: as large as the view
    bool transparent = false;
};

/// What the window shows for the moment.
struct UiState {
    bool help = false;
    bool palette = false;
    bool settings = false;
    enum class FileDialog { None, Open, SaveAs, SaveAndQuit, Video } file_dialog = FileDialog::None;
    std::vector<Toast> toasts;
    std::vector<Recoverable> recoverable;  ///< until it is answered
    glm::vec2 view_size{1000.0f, 700.0f};  ///< the 3D view, or its first pane, in window coordinates
    glm::ivec2 picture_size{1000, 700};    ///< pixels of a picture of the whole view
    std::optional<std::string> copied;     ///< text on its way to the clipboard
    std::optional<PictureRequest> picture;
    std::optional<VideoRequest> video;     ///< asked for, and not begun
    std::optional<VideoProgress> filming;  ///< the video that is being written
    bool ends_filming = false;             ///< it is no longer wanted
    std::optional<Incident> incident;      ///< the one that is shown: what was before it over what came of it
    std::map<std::string, CardProgress> cards;  ///< of things to try, by lab
    bool asks_to_quit = false;                  ///< what becomes of unsaved work
    bool quit = false;

    /// Something lies over the scene that Esc closes.
    bool covered() const {
        return help || palette || settings || asks_to_quit || file_dialog != FileDialog::None;
    }
};

struct Workspace {
    Document document;
    Runtimes runtimes;      ///< what the labs work with; throw them away at any time
    Document blank;         ///< what scene.new starts from
    std::string lab;        ///< the lab that is open
    CameraPose first_view;  ///< what scene.new looks from, in a lab that has no view of its own
    std::map<std::string, CameraPose> first_views;  ///< each lab's
    CameraPose camera;
    std::map<std::string, CameraPose> cameras;  ///< of the labs that were open before
    Clock clock;
    Rewind rewind;                 ///< of the open lab
    std::uint64_t beginnings = 0;  ///< counts the scenes that began: new ones, and those that were opened
    std::uint64_t moment =
        0;  ///< counts what rewind remembers: ticks that were simulated, and changes by hand
    struct Past {
        Rewind rewind;
        std::uint64_t moment = 0;
        std::shared_ptr<const Part> left{};  ///< the lab's part when it was closed; the past is dropped if it has changed
    };
    std::map<std::string, Past> pasts;  ///< of the labs that were open before
    std::uint64_t edition = 0;          ///< which of the changes that can be undone was the last
    std::uint64_t editions = 0;         ///< counts all editions; numbers are never reused
    History history;
    bool gesture_begins = true;  ///< the command that runs is alone, or the first of its drag
    Settings settings;
    std::filesystem::path config;  ///< the folder of what is kept from session to session; empty: none
    bool keeps = false;            ///< there, without being told: in a live window
    UiState ui;
    std::filesystem::path path;  ///< the scene's file, empty while it has none
    Document saved;              ///< as it was last saved or opened

    /// Opens a lab, seen as it was last seen.
    void open_lab(const std::string& name);
    const CameraPose& first_view_of(const std::string& name) const;
    /// Time and cameras as they are for a scene that has just begun.
    void start_anew();
    /// Clears the last ten seconds of every lab.
    void forget_pasts();
    /// Keeps the open lab's part as it is now, for time.seek.
    void remember_moment() { rewind.remember(moment, edition, document.parts().at(lab), clock.tick); }
    /// The open lab was changed by hand, and no tick was simulated: a moment passes all the same.
    void pass_change();
    /// Goes back (or forward again) to the moment that is remembered nearest, and pauses. To go back over a
    /// change is a change itself: undoing it leads to where one came from.
    void go_to_moment(std::uint64_t ticks_back);
    MomentId moment_id() const { return {moment, edition}; }
    void begin_edition() { edition = ++editions; }
    /// The open lab's part just before an incident and just after it, as far as they are remembered.
    struct BeforeAndAfter {
        std::shared_ptr<const Part> before, after;
    };
    BeforeAndAfter around(const Incident& incident) const;
    Place place() const { return {lab, path, camera}; }
    bool modified() const { return document != saved; }
    void toast(std::string text, ToastKind kind = ToastKind::Info);
};

}  // namespace tendril::app
