// Records the user's actions as a script: one line per event and command, `wait` for the ticks between.
//
// parse_script restores exactly the same events, bit for bit. The end of the program is not recorded: a
// script ends with its last line.
#pragma once

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

}  // namespace tendril::app
