// The loop of a real window: samples events, runs due ticks, draws only if something may have changed, and
// saves settings and autosaves.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>

#include "app/app.hpp"

namespace tendril::app {

class LiveLoop {
  public:
    struct Options {
        bool config = true;  ///< read and write settings, autosave, offer autosaves left by a crash
        const std::atomic<bool>& ending;
    };
    LiveLoop(App& app, Window& window, const Options& options);
    ~LiveLoop();

    /// Runs until the user quits, the script fails or `frames` ticks have passed.
    void run(Player& player, std::optional<int> frames);
    /// run() in parts, for a system that calls the program for each frame: begin(), pass() while it returns
    /// true, end().
    void begin();
    bool pass(Player& player, std::optional<int> frames);
    void end();
    /// Pictures drawn so far; an idle window draws none.
    int frames_drawn() const { return frames_drawn_; }

    /// One iteration of run(): takes the events, runs the ticks due `elapsed` seconds after the last call,
    /// and draws if anything changed. Public for tests without a window system.
    void turn(std::vector<Event> events, double elapsed, Player& player);
    /// Seconds that run() may sleep before something is due.
    double patience(const Player& player) const;

  private:
    void sample(std::vector<Event> events);
    bool take_ticks(Player& player);
    void tick(Player& player);
    void paste(const Player& player);
    void save_settings_and_autosave();
    void note_pace(double elapsed, double dropped);

    class KeptAtExit;

    App& app_;
    Window& window_;
    Options options_;
    std::deque<Event> queue_;
    double credit_ = 0.0;  ///< seconds that have passed but were not yet ticked
    int ticks_ = 0;
    int frames_drawn_ = 0;
    std::chrono::steady_clock::time_point last_pass_{};
    bool ctrl_ = false;
    std::optional<Autosave> autosave_;
    std::unique_ptr<KeptAtExit> kept_at_exit_;
    Settings kept_;
};

}  // namespace tendril::app
