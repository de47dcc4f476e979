#include "app/labs/chain/engine_trace.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/document/text.hpp"
#include "app/document/units.hpp"
#include "app/io/trace/trace.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_runtime.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/cures.hpp"
#include "app/labs/chain/draw.hpp"

namespace tendril::app {
namespace {

/// The ghost and the chain have parted company: of the reach.
constexpr float parted_share = 0.05f;

/// The frames that the strip can hold, in metres, and what was found in them.
struct TracedWindow {
    std::vector<TracedFrame> frames;
    std::uint64_t first = 0;  ///< number of frames.front()
    std::uint64_t all = 0;    ///< frames of this chain in the file
    std::vector<ik::ChainIncident> incidents;
    std::string chain, understood;
    std::vector<std::string> notes;
};

struct TraceSource {
    std::string path, text;  ///< a file, or pasted text
    ConventionChoice choice;

    std::unique_ptr<std::istream> open() const {
        if (path.empty()) return std::make_unique<std::istringstream>(text);
        auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
        if (!*file) throw Refused(path + ": cannot be read");
        return file;
    }
};

/// The chain with that name or, without one, the first in which something was found.
const TraceFindings::Chain& chosen_chain(const TraceFindings& findings, const std::string& name) {
    if (name.empty()) {
        const auto found = std::ranges::find_if(
            findings.chains, [](const TraceFindings::Chain& each) { return !each.incidents.empty(); });
        return found == findings.chains.end() ? findings.chains.front() : *found;
    }
    std::string names;
    for (const auto& each : findings.chains) {
        if (each.name == name) return each;
        names += (names.empty() ? "" : ", ") + each.name;
    }
    throw Refused("chain: the trace has no \"" + name + "\"; it has " + names);
}

TracedWindow read_window(const TraceSource& source, const std::string& chain,
                         std::optional<std::uint64_t> from) {
    TracedWindow window;
    {
        const auto in = source.open();
        TraceReader reader(*in, source.choice);
        const TraceFindings findings = find_incidents(reader);
        const TraceFindings::Chain& chosen = chosen_chain(findings, chain);
        window.chain = chosen.name;
        window.all = chosen.frames;
        window.incidents = chosen.incidents;
        window.understood = reader.conventions().text();
        window.notes = reader.notes();
    }
    // A long trace is shown around the first incident.
    const std::uint64_t half = Rewind::max_ticks / 2;
    const std::uint64_t first = window.incidents.empty() ? 0 : window.incidents.front().frame;
    const std::uint64_t around = window.all <= Rewind::max_ticks || first < half ? 0 : first - half;
    window.first = std::min(from.value_or(around), window.all - 1);
    const auto in = source.open();
    TraceReader reader(*in, source.choice);
    TracedFrame frame;
    for (std::uint64_t number = 0; window.frames.size() < Rewind::max_ticks && reader.next(frame);) {
        if (frame.chain != window.chain) continue;
        if (number++ >= window.first) window.frames.push_back(frame);
    }
    return window;
}

bool all_finite(const std::vector<glm::vec3>& points) {
    return std::ranges::all_of(
        points, [](glm::vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

/// Where a frame is not finite, the last one that was goes on.
void hold_finite(std::vector<TracedFrame>& frames) {
    const auto first =
        std::ranges::find_if(frames, [](const TracedFrame& each) { return all_finite(each.joints); });
    if (first == frames.end()) throw Refused("the trace has no frame whose joints are all finite");
    const TracedFrame* last = &*first;
    for (TracedFrame& frame : frames) {
        if (!all_finite(frame.joints)) frame.joints = last->joints;
        if (frame.target && !all_finite({*frame.target})) frame.target = last->target;
        if (frame.pole && !all_finite({*frame.pole})) frame.pole = last->pole;
        last = &frame;
    }
}

Chain chain_of_frame(const TracedFrame& frame) {
    std::vector<Segment> segments;
    // As in presets, the root has the length of the first bone.
    for (std::size_t i = 0; i < frame.joints.size(); ++i) {
        const std::size_t bone = std::max<std::size_t>(i, 1);
        segments.push_back({frame.joints[i], glm::distance(frame.joints[bone - 1], frame.joints[bone])});
    }
    return require_value(Chain::from_segments(std::move(segments)));
}

/// The lab's solver, led through the frames from the first one's pose.
class Ghost {
  public:
    Ghost(const ChainPart& like, ChainRuntime& runtime) : part_(like), runtime_(runtime) {}

    std::vector<glm::vec3> follow(const TracedFrame& frame) {
        if (!begun_) part_.chain = chain_of_frame(frame);
        begun_ = true;
        const glm::vec3 by = frame.joints.front() - part_.chain.position(0);
        if (by != glm::vec3(0.0f)) {
            std::vector<glm::vec3> moved = positions(part_.chain);
            for (glm::vec3& joint : moved) joint += by;
            require_ok(part_.chain.set_positions(moved));
        }
        part_.reach.pole = frame.pole;
        reach_for(part_, frame.target.value_or(frame.joints.back()), runtime_);
        return positions(part_.chain);
    }

  private:
    ChainPart part_;
    ChainRuntime& runtime_;
    bool begun_ = false;
};

/// "frame 60: flip, turned 128 degrees: the target's line passed the pole"
std::string told(const ik::ChainIncident& incident) {
    std::string text = "frame " + std::to_string(incident.frame) + ": ";
    text += incident.kind == ik::IncidentKind::TargetJump ? "target jump" : ik::name(incident.kind);
    const std::string unit = ik::unit(incident.kind);
    if (unit == "metres") text += ", " + fixed_text(1000.0 * incident.amount, 1) + " mm";
    if (unit == "degrees") text += ", " + fixed_text(incident.amount, 0) + " degrees";
    if (unit == "frames") text += ", " + count_text(static_cast<std::size_t>(incident.amount), "frame");
    return text + ": " + incident.cause;
}

/// For the strip: between the moment before its frame and that one.
Incident incident_of(const ik::ChainIncident& found, std::uint64_t first,
                     const std::vector<std::shared_ptr<const ChainPart>>& moments) {
    const std::uint64_t at = found.frame - first;
    const ChainPart& after = *moments[at];
    const ChainPart& before = *moments[at > 0 ? at - 1 : 0];
    Incident incident{.kind = found.kind == ik::IncidentKind::Flip    ? Incident::Kind::Flip
                              : found.kind == ik::IncidentKind::Limit ? Incident::Kind::Limit
                                                                      : Incident::Kind::Status,
                      .tick = at > 0 ? at - 1 : 0,
                      .joint = found.joint == ik::no_joint ? after.chain.size() - 1 : found.joint,
                      .degrees = static_cast<float>(std::abs(found.amount)),
                      .cause = found.cause};
    if (found.kind != ik::IncidentKind::Flip) {
        incident.cause = told(found);
        if (found.kind != ik::IncidentKind::Limit) incident.degrees = 0.0f;
        return incident;
    }
    const FlipAdvice advice = flip_advice(found.flip, after.reach.pole.has_value());
    incident.cure = advice.cure;
    incident.button = flip_cure(advice.button, before, after);
    return incident;
}

void show_trace(Workspace& workspace, TracedWindow window, const std::string& name) {
    hold_finite(window.frames);
    ChainRuntime& runtime = workspace.runtimes.of<ChainRuntime>(chain_lab);
    ChainPart base = first_chain();
    base.reach.method =
        dynamic_cast<const ChainPart&>(*workspace.document.parts().at(chain_lab)).reach.method;
    base.mode = ChainMode::Reach;
    Ghost ghost(base, runtime);
    std::vector<std::shared_ptr<const ChainPart>> moments;
    std::optional<std::uint64_t> parted;
    for (const TracedFrame& frame : window.frames) {
        auto part = std::make_shared<ChainPart>(base);
        part->chain = chain_of_frame(frame);
        part->target = frame.target.value_or(frame.joints.back());
        part->reach.pole = frame.pole;
        auto traced = std::make_shared<TracedPose>(TracedPose{positions(part->chain), ghost.follow(frame)});
        float apart = 0.0f;
        for (std::size_t i = 0; i < traced->joints.size(); ++i)
            apart = std::max(apart, glm::distance(traced->joints[i], traced->ghost[i]));
        if (!parted && apart > parted_share * part->chain.reach()) parted = moments.size();
        part->traced = std::move(traced);
        check_range(*part);
        moments.push_back(std::move(part));
    }
    workspace.open_lab(chain_lab);
    ++workspace.beginnings;  // the strip holds the trace, not what was before it
    workspace.rewind.clear();
    workspace.discarded.reset();
    workspace.clock.playing = false;
    workspace.moment = 0;
    for (std::size_t i = 0; i + 1 < moments.size(); ++i)
        workspace.rewind.remember(i, workspace.edition, moments[i], i);
    workspace.moment = moments.size() - 1;
    workspace.clock.tick = moments.size() - 1;
    workspace.document.set(chain_lab, moments.back());
    std::size_t shown = 0;
    for (const ik::ChainIncident& each : window.incidents) {
        if (each.frame < window.first || each.frame >= window.first + moments.size()) continue;
        workspace.rewind.note(incident_of(each, window.first, moments));
        ++shown;
    }
    if (parted)
        workspace.rewind.note({.kind = Incident::Kind::Status,
                               .tick = *parted > 0 ? *parted - 1 : 0,
                               .joint = moments.front()->chain.size() - 1,
                               .cause = "Tendril's solve goes another way"});
    frame_unless_seen(workspace, ChainLab().bounds(workspace, false));
    const auto first_found = std::ranges::find_if(
        window.incidents, [&](const ik::ChainIncident& each) { return each.frame >= window.first; });
    std::string said = name + ": " + count_text(window.all, "frame") + ", " + window.understood + ", " +
                       count_text(window.incidents.size(), "incident");
    if (window.all > moments.size())
        said += "; shown: frames " + std::to_string(window.first) + " to " +
                std::to_string(window.first + moments.size() - 1) + " with " + std::to_string(shown);
    if (first_found != window.incidents.end()) said += ". " + capitalised(told(*first_found));
    workspace.toast(said);
    for (const std::string& note : window.notes) workspace.toast(note, ToastKind::Refusal);
}

std::string text_or_none(const Arguments& given, const char* name) {
    return given.has(name) ? given.text(name) : std::string();
}

void open_trace(Workspace& workspace, const Arguments& given) {
    const TraceSource source{.path = text_or_none(given, "path"),
                             .text = text_or_none(given, "text"),
                             .choice = {.up = text_or_none(given, "up"),
                                        .handed = text_or_none(given, "handed"),
                                        .unit = text_or_none(given, "unit"),
                                        .rotations = {}}};
    if (source.path.empty() == source.text.empty()) throw Refused("expected either path or text");
    const std::string name =
        source.path.empty() ? "Pasted" : std::filesystem::path(source.path).filename().string();
    std::optional<std::uint64_t> from;
    if (given.has("from")) from = static_cast<std::uint64_t>(given.number("from"));
    try {
        show_trace(workspace, read_window(source, text_or_none(given, "chain"), from), name);
    } catch (const Refused&) {
        throw;
    } catch (const std::exception& error) {
        throw Refused(name + ": " + error.what());
    }
}

}  // namespace

bool begins_like_trace(std::string_view text) {
    if (text.find("\"joints\"") != text.npos || text.find("\"tendril\"") != text.npos) return true;
    const std::string_view first = text.substr(0, text.find('\n'));
    if (begins_table(first) && std::ranges::count(first, ',') >= 5) return true;
    // A log: three vectors in a row.
    try {
        std::istringstream in{std::string(text)};
        RawFrame frame;
        return open_raw_trace(in)->next(frame) && frame.joints.size() >= 2;
    } catch (const std::runtime_error&) {
        return false;
    }
}

bool holds_trace(const std::string& text) {
    try {
        std::istringstream in(text);
        const auto raw = open_raw_trace(in);
        RawFrame first, second;
        if (!raw->next(first) || first.joints.size() < 2) return false;
        return first.target || (raw->next(second) && second.joints.size() == first.joints.size());
    } catch (const std::runtime_error&) {
        return false;
    }
}

const std::vector<glm::vec3>* traced_ghost(const ChainPart& part) {
    if (!part.traced || part.study.open() || part.traced->joints.size() != part.chain.size()) return nullptr;
    for (std::size_t i = 0; i < part.chain.size(); ++i)
        if (part.chain.position(i) != part.traced->joints[i]) return nullptr;
    return &part.traced->ghost;
}

void draw_traced_ghost(const View& view, const ChainPart& part, DrawList& list) {
    const auto* const ghost = traced_ghost(part);
    if (ghost == nullptr) return;
    const glm::vec4 colour(solver_colour(view.palette, part.reach.method), 0.6f);
    for (std::size_t i = 1; i < ghost->size(); ++i)
        list.line((*ghost)[i - 1], (*ghost)[i], 3.0f * view.scale, colour);
    for (const glm::vec3 joint : *ghost) list.sphere(joint, 4.5f * view.scale, Unit::Pixels, colour);
}

void add_trace_commands(CommandTable& table) {
    Command command = chain_command(
        "chain.trace", "Open an engine's trace",
        {text_argument("path", false, "JSON Lines, CSV or a log with positions in it"),
         text_argument("text", false, "the same, as pasted text"),
         text_argument("chain", false, "one of several; default: the first in which something was found"),
         integer_argument("from", "the first frame shown; default: around the first incident", 0, 1e15),
         choice_argument("up", false, "the up axis; default: as the file says, or guessed",
                         trace_ups.names()),
         choice_argument("handed", false, "the handedness", trace_hands.names()),
         choice_argument("unit", false, "the unit", trace_units.names())},
        "Shows what an engine's chain did, frame by frame, with what went wrong and why", ChainChange());
    command.apply = open_trace;
    table.add(std::move(command));
}

}  // namespace tendril::app
