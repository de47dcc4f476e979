// Records the user's actions as a script, with one line per event or command and a `wait` for the ticks
// between; and plays scripts.
//
// parse_script restores exactly the same events, bit for bit. The end of the program is not recorded: a
// script ends with its last line.
#pragma once

#include <stdexcept>
#include <string>

#include "app/script/script.hpp"

namespace tendril::app {

class Recorder {
  public:
    explicit Recorder(const RecordingStart& start);

    void event(const Event& event);                                              ///< a tick with this event
    void idle_tick();                                                            ///< a tick without event
    void command(const std::string& name, const Json& arguments, bool refused);  ///< not caused by an event
    /// The whole script so far.
    std::string text() const;

  private:
    void flush_wait();
    void line(const Json& json);
    std::string text_;
    int idle_ticks_ = 0;
};

/// The script line of an event; null for events that are not recorded (a key without a name, the window's
/// close button).
Json event_line(const Event& event);

// Plays a script on anything that takes ticks and commands.

/// Receives a script's actions: the program, or a test's substitute.
class Stage {
  public:
    virtual ~Stage() = default;
    /// Runs one tick with the event, which may be null.
    virtual void tick(const Event* event) = 0;
    /// Throws Refused.
    virtual void run(const RunCommand& command) = 0;
    /// Throws std::runtime_error if the path cannot be written.
    virtual void write_screenshot(const std::string& path) = 0;
    virtual void write_state(const std::string& path) = 0;
    virtual Json state() = 0;
};

/// A failed expectation, an unexpected refusal, or a missing expected one: "line 7: <what was found>".
class ScriptFailure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Player {
  public:
    explicit Player(Script script) : script_(std::move(script)) {}

    /// Runs lines until one tick has passed or the script has ended. Throws ScriptFailure and the stage's
    /// errors, after which the script is over.
    void advance(Stage& stage);
    bool done() const { return ticks_left_ == 0 && next_ >= script_.lines.size(); }

  private:
    /// Returns whether the line took a tick.
    bool play(const ScriptLine& line, Stage& stage);
    void end() { next_ = script_.lines.size(), ticks_left_ = 0; }

    Script script_;
    std::size_t next_ = 0;
    int ticks_left_ = 0;
};

}  // namespace tendril::app
