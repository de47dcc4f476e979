// Writes what a chain does, frame by frame, for `tendril trace`. C++11, nothing but the standard library.
// Copy it into your project; no licence text is needed.
//
//   tendril_trace::Writer trace("arm.jsonl", "y", "right", "m", 60);   // up, hand, unit, frames a second
//   trace.begin(time);
//   trace.joint(x, y, z);        // from the root to the tip
//   trace.target(x, y, z);       // where the tip should be
//   trace.pole(x, y, z);         // the pole target, if there is one
//   trace.end();
//
// Writes: {"t": 0.5, "joints": [[0, 1, 0], [0.5, 1, 0], [1, 1, 0]], "target": [1, 1, 0], "pole": [0, 1, 1]}
#pragma once

#include <cstdio>
#include <string>

namespace tendril_trace {

class Writer {
  public:
    Writer(const char* path, const char* up, const char* handed, const char* unit, double fps)
        : file_(std::fopen(path, "w")) {
        if (file_)
            std::fprintf(file_,
                         "{\"tendril\": \"trace\", \"up\": \"%s\", \"handed\": \"%s\", \"unit\": \"%s\", "
                         "\"fps\": %g}\n",
                         up, handed, unit, fps);
    }
    ~Writer() {
        if (file_) std::fclose(file_);
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    bool is_open() const { return file_ != nullptr; }

    void begin(double time) {
        line_ = "{\"t\": " + number(time) + ", \"joints\": [";
        inputs_.clear();
        first_ = true;
    }
    void joint(double x, double y, double z) {
        line_ += (first_ ? "" : ", ") + point(x, y, z);
        first_ = false;
    }
    void target(double x, double y, double z) { inputs_ += ", \"target\": " + point(x, y, z); }
    void pole(double x, double y, double z) { inputs_ += ", \"pole\": " + point(x, y, z); }
    /// Written at once, so that a crash in the next frame loses nothing.
    void end() {
        if (!file_) return;
        std::fprintf(file_, "%s]%s}\n", line_.c_str(), inputs_.c_str());
        std::fflush(file_);
    }

  private:
    static std::string number(double value) {
        char text[40];
        std::snprintf(text, sizeof text, "%.9g", value);  // NaN is written as nan, which tendril trace reads
        return text;
    }
    static std::string point(double x, double y, double z) {
        return "[" + number(x) + ", " + number(y) + ", " + number(z) + "]";
    }

    std::FILE* file_;
    std::string line_, inputs_;
    bool first_ = true;
};

}  // namespace tendril_trace
