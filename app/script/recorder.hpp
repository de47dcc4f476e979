// Writes down what a person does, as a script: one line per event and command, `wait` for the ticks between.
//
// What parse_script reads back is the very same events, to the last bit. The end of the program is not
// written: a script ends where its lines do.
#pragma once

#include <string>

#include "app/script/script.hpp"

namespace tendril::app {

class Recorder {
  public:
    explicit Recorder(const RecordingStart& start);

    void event(const Event& event);  ///< a tick that took this event
    void idle_tick();                ///< a tick that took none
    void command(const std::string& name, const Json& arguments, bool refused);  ///< one not born of an event
    /// The whole script so far.
    std::string text() const;

  private:
    void flush_wait();
    void line(const Json& json);
    std::string text_;
    int waiting_ = 0;
};

/// The script line of an event; null for one that leaves none (a key without a name, the window's close
/// button).
Json event_line(const Event& event);

}  // namespace tendril::app
