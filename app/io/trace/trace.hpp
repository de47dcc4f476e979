// Reads a trace: what an engine's chains did, frame by frame. JSON Lines, CSV, tables, or text with vectors
// in it; the space is converted to Tendril's. Streams: memory does not grow with the number of frames. The
// formats: `tendril trace --help`.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tendril/ik/incident.hpp>
#include <vector>

#include "app/io/trace/conventions.hpp"
#include "app/io/trace/raw.hpp"
#include "app/io/trace/retrace.hpp"

namespace tendril::app {

/// The last digits of coordinates, which may have a number of decimals or of significant digits: learned for
/// each power of ten, where enough different ones were seen.
class Rounding {
  public:
    void add(double value);
    /// How far a coordinate may be off: half a unit of its last digit.
    double of(double value) const;

  private:
    static constexpr std::size_t enough = 4;  ///< that all end in 0 by chance: 1e-4
    struct Digits {
        int decimals = 0;
        std::set<double> values{};  ///< some
    };
    int all_ = 0;  ///< decimals, the most
    std::map<int, Digits> sizes_;
};

class TraceReader {
  public:
    /// Reads the first frames. Throws std::runtime_error if there are none, or they are damaged: "line 3:
    /// expected ...". `fps` overrides the file.
    explicit TraceReader(std::istream& in, const ConventionChoice& choice = {},
                         std::optional<double> fps = {});

    /// False after the last frame, and where the rest is damaged, which is then a note.
    bool next(TracedFrame& frame);

    const Conventions& conventions() const { return conventions_; }
    double fps() const { return fps_; }
    bool fps_known() const { return fps_known_; }  ///< given, or from the times
    const TraceHeader& header() const { return raw_->header; }
    /// For display: what was left out, where reading stopped.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    bool next_raw(RawFrame& frame);
    void find_rate();
    void find_end_effectors();

    std::unique_ptr<RawTrace> raw_;
    std::deque<RawFrame> first_;
    Conventions conventions_;
    std::map<std::string, std::size_t> joints_;  ///< of each chain
    std::optional<std::size_t> given_end_;       ///< of the chains that have so many joints
    std::map<std::string, std::size_t>
        ends_;  ///< the end effector of a chain, found, unless it is the last joint
    std::vector<std::string> notes_;
    double fps_ = 60.0;
    Rounding rounding_;
    bool fps_known_ = false, damaged_ = false;
};

struct TracedIncident : ik::ChainIncident {
    PreventedFlip prevented{};  ///< of a flip

    /// "Frame 60: flip at joint 1 (elbow), 128 degrees". Bones as in the header; may be empty.
    std::string title(const std::vector<std::string>& bones, const Conventions& space) const;
    /// The title, and why.
    std::string text(const std::vector<std::string>& bones, const Conventions& space) const {
        return title(bones, space) + ": " + cause;
    }
};

/// What was found in a trace, chain by chain.
struct TraceFindings {
    struct Chain {
        std::string name;  ///< empty if it has none
        std::vector<TracedIncident> incidents;
        std::uint64_t frames = 0, left_off = 0;
    };
    std::vector<Chain> chains;
    std::size_t count() const;
};
/// Reads to the end. Calls `progress` now and then.
TraceFindings find_incidents(TraceReader& reader, const std::function<void()>& progress = {});

}  // namespace tendril::app
