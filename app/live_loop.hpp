// The loop of a real window: samples events, takes due ticks, draws only when something may have changed, and
// looks after settings and autosave.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <optional>

#include "app/app.hpp"

namespace tendril::app {

class LiveLoop {
  public:
    struct Options {
        bool config = true;  ///< read and write settings, autosave, offer what a crash left
        const std::atomic<bool>& ending;
    };
    LiveLoop(App& app, Window& window, const Options& options);

    /// Runs until the person, the script's failure or `frames` ticks end it.
    void run(Player& player, std::optional<int> frames);
    /// Pictures drawn so far: an idle window adds none.
    int frames_drawn() const { return frames_drawn_; }

    /// Takes what `events` brought and the ticks that are due `elapsed` seconds after the last call, and
    /// draws if that changed anything. What run() does again and again, for tests that have no window system.
    void turn(std::vector<Event> events, double elapsed, Player& player);
    /// How long run() may sleep before something is due.
    double patience(const Player& player) const;

  private:
    void sample(std::vector<Event> events);
    bool take_ticks(Player& player);
    void tick(Player& player);
    void keep_house();

    App& app_;
    Window& window_;
    Options options_;
    std::deque<Event> queue_;
    double credit_ = 0.0;  ///< seconds of time that passed and was not yet ticked
    int ticks_ = 0;
    int frames_drawn_ = 0;
    bool ctrl_ = false;
    std::optional<Autosave> autosave_;
    Settings kept_;
};

}  // namespace tendril::app
