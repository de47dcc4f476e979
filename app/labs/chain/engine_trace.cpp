#include "app/labs/chain/engine_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/solver_text.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/system/file.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

constexpr std::uint64_t max_from = 2'000'000'000;

/// The fields of a trace's view that set how Tendril solves it.
std::span<const Field> solve_fields() {
    return fields<TraceView>().first(4);
}

std::unique_ptr<std::istream> open_source(const ShownTrace& trace) {
    if (trace.path.empty()) return std::make_unique<std::istringstream>(trace.text);
    const auto pipe = await_pipe(trace.path);
    auto file = std::make_unique<std::ifstream>(trace.path, std::ios::binary);
    if (!*file) throw Refused(trace.path + ": cannot be read");
    return file;
}

/// The chain of that name; if the name is empty, the first chain with an incident.
const TraceFindings::Chain& chosen_chain(const TraceFindings& findings, std::string_view name) {
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
    throw Refused("chain: the trace has no \"" + std::string(name) + "\"; it has " + names);
}

bool joints_are_finite(const TracedFrame& frame) {
    return std::ranges::all_of(frame.joints, is_finite_point);
}

/// Replaces joints, targets and pole targets that are not finite by the last finite ones. Before the first,
/// joints use the first finite ones, and target and pole target are omitted.
void hold_finite(std::vector<TracedFrame>& frames) {
    const auto first = std::ranges::find_if(frames, joints_are_finite);
    if (first == frames.end()) throw Refused("the trace has no frame whose joints are all finite");
    const TracedFrame* last = &*first;
    std::optional<glm::vec3> target, pole;
    const auto hold = [](std::optional<glm::vec3>& point, std::optional<glm::vec3>& before) {
        if (!point) return;
        if (is_finite_point(*point)) before = point;
        point = before;
    };
    for (TracedFrame& frame : frames) {
        if (!joints_are_finite(frame)) frame.joints = last->joints;
        hold(frame.target, target);
        hold(frame.pole, pole);
        last = &frame;
    }
}

/// Finds the incidents of the whole trace.
void find_all(ShownTrace& trace, const std::string& chain) {
    const auto in = open_source(trace);
    TraceReader reader(*in, trace.choice);
    const TraceFindings findings = find_incidents(reader);
    const TraceFindings::Chain& chosen = chosen_chain(findings, chain);
    trace.chain = chosen.name;
    trace.all = chosen.frames;
    trace.incidents = chosen.incidents;
    trace.conventions = reader.conventions();
    trace.bones = reader.header().bones;
    trace.notes = reader.notes();
    TraceView& view = trace.view;
    view.up = trace.conventions.up.value;
    view.handed = trace.conventions.handed.value;
    view.unit = trace.conventions.unit.value;
    view.rotations = trace.conventions.rotations.value;
}

/// Keeps as many frames as the strip holds, from `from` on or, without it, around the first incident.
void load_frames(ShownTrace& trace, std::optional<std::uint64_t> from) {
    const std::uint64_t half = Rewind::max_ticks / 2;
    const std::uint64_t first = trace.incidents.empty() ? 0 : trace.incidents.front().frame;
    const std::uint64_t around = trace.all <= Rewind::max_ticks || first < half ? 0 : first - half;
    const std::uint64_t begin = std::min({from.value_or(around), trace.all - 1, max_from});
    const auto in = open_source(trace);
    TraceReader reader(*in, trace.choice);
    TracedFrame frame;
    trace.frames.clear();
    for (std::uint64_t number = 0; trace.frames.size() < Rewind::max_ticks && reader.next(frame);) {
        if (frame.chain != trace.chain) continue;
        if (number++ >= begin) trace.frames.push_back(frame);
    }
    hold_finite(trace.frames);
    trace.view.from = static_cast<int>(begin);
}

/// A button that shows Tendril's solve with that change.
Cure cure_of(const Prevention& prevention, const Conventions& space) {
    CommandCall call{"chain.trace", {}};
    const Json solve = save_fields({solve_fields(), &prevention.solve});
    for (const auto& [name, value] : solve.items()) call.arguments.push_back({name, SharedJson(value)});
    const std::string text = prevention.text(space);
    return {"Show",
            "Runs chain.trace. Tendril's solve does not flip with this: " + text + '.',
            {std::move(call)},
            capitalised(text)};
}

/// The incident for the strip: between its frame's moment and the one before.
Incident incident_of(const TracedIncident& found, const ShownTrace& trace,
                     const std::vector<std::shared_ptr<const ChainPart>>& moments) {
    const std::uint64_t at = found.frame - static_cast<std::uint64_t>(trace.view.from);
    const ChainPart& after = *moments[at];
    Incident incident{.kind = found.kind == ik::IncidentKind::Flip    ? Incident::Kind::Flip
                              : found.kind == ik::IncidentKind::Limit ? Incident::Kind::Limit
                                                                      : Incident::Kind::Status,
                      .tick = at > 0 ? at - 1 : 0,
                      .joint = found.joint == ik::no_joint ? after.chain.size() - 1 : found.joint,
                      .degrees = static_cast<float>(std::abs(found.amount)),
                      .cause = found.cause,
                      .title = found.title(trace.bones, trace.conventions)};
    if (found.kind != ik::IncidentKind::Flip) {
        if (found.kind != ik::IncidentKind::Limit) incident.degrees = 0.0f;
        return incident;
    }
    incident.cure = flip_advice(found.flip, after.reach.options.pole.has_value()).cure;
    if (!found.prevented.tried) return incident;
    const std::size_t count = found.prevented.by.size();
    incident.cure = capitalised(found.prevented.text()) + (count == 0   ? "."
                                                           : count == 1 ? ". This prevents it:"
                                                                        : ". Each of these prevents it:");
    for (const Prevention& each : found.prevented.by)
        incident.buttons.push_back(cure_of(each, trace.conventions));
    return incident;
}

/// The trace's frames as moments, each with Tendril's solve beside it.
class Moments {
  public:
    explicit Moments(std::shared_ptr<const ShownTrace> trace) {
        const TraceSolve& solve = trace->view;
        Retrace ghost(solve);
        ik::IncidentFinder flips({.end_effector = trace->frames.front().end});
        for (const TracedFrame& frame : trace->frames) {
            auto part = std::make_shared<ChainPart>(first_chain());
            part->mode = ChainMode::Reach;
            part->chain = chain_through(frame.joints);
            part->target = frame.goal();
            part->reach.method = solve.method;
            part->reach.options = solve.options(frame);
            auto traced = std::make_shared<TracedPose>(
                TracedPose{positions(part->chain), ghost.follow(frame), trace,
                           static_cast<std::uint64_t>(trace->view.from) + all.size()});
            flips.add({.joints = traced->ghost, .target = part->target, .pole = part->reach.options.pole});
            part->traced = std::move(traced);
            check_range(*part);
            all.push_back(std::move(part));
        }
        for (const ik::ChainIncident& each : flips.incidents())
            if (each.kind == ik::IncidentKind::Flip && !flip) flip = each.frame;
    }

    std::vector<std::shared_ptr<const ChainPart>> all;
    std::optional<std::uint64_t> flip;  ///< first frame where Tendril's solve flips
};

/// The first incident in the displayed frames.
const TracedIncident* first_shown(const ShownTrace& trace) {
    const auto from = static_cast<std::uint64_t>(trace.view.from);
    for (const TracedIncident& each : trace.incidents)
        if (each.frame >= from && each.frame < from + trace.frames.size()) return &each;
    return nullptr;
}

std::string shown_text(const ShownTrace& trace, std::size_t shown) {
    const auto first = static_cast<std::uint64_t>(trace.view.from);
    std::string said = trace.name + ": " + count_text(trace.all, "frame") + ", " + trace.conventions.text() +
                       ", " + count_text(trace.incidents.size(), "incident");
    if (trace.all > trace.frames.size())
        said += "; shown: frames " + std::to_string(first) + " to " +
                std::to_string(first + trace.frames.size() - 1) + " with " + std::to_string(shown);
    const TracedIncident* const found = first_shown(trace);
    return found == nullptr ? said : said + ". " + found->text(trace.bones, trace.conventions);
}

/// Puts the trace on the strip and shows its first fault; with `same_frames`, keeps the strip's moment.
void show_trace(Workspace& workspace, const std::shared_ptr<const ShownTrace>& trace, bool same_frames) {
    Moments moments(trace);
    const std::uint64_t last = moments.all.size() - 1;
    const TracedIncident* const wrong = first_shown(*trace);
    const std::uint64_t at = same_frames ? std::min<std::uint64_t>(workspace.moment, last)
                             : wrong     ? wrong->frame - static_cast<std::uint64_t>(trace->view.from)
                                         : last;
    workspace.open_lab(chain_lab);
    ++workspace.beginnings;  // the strip now holds the trace, not the past before it
    workspace.rewind.clear();
    workspace.discarded.reset();
    workspace.clock.playing = false;
    for (std::size_t i = 0; i < moments.all.size(); ++i)
        if (i < last || at < last) workspace.rewind.remember(i, workspace.edition, moments.all[i], i);
    workspace.moment = at;
    workspace.clock.tick = at;
    workspace.document.set(chain_lab, moments.all[at]);
    const auto first = static_cast<std::uint64_t>(trace->view.from);
    std::size_t shown = 0;
    for (const TracedIncident& each : trace->incidents) {
        if (each.frame < first || each.frame > first + last) continue;
        workspace.rewind.note(incident_of(each, *trace, moments.all));
        ++shown;
    }
    if (!same_frames) {
        workspace.ui.incident.reset();
        workspace.ui.incident_chosen = false;  // the title names the incident
        if (wrong != nullptr) workspace.ui.incident = incident_of(*wrong, *trace, moments.all);
    }
    if (same_frames) {
        const std::string solve = std::string("Tendril's solve, ") + solver_title(trace->view.method) + ": ";
        const auto& pole = moments.all[at]->reach.options.pole;
        const bool moved = trace->view.pole_by != glm::vec3(0.0f);
        workspace.toast(
            solve + (moments.flip ? "flips at frame " + std::to_string(first + *moments.flip) : "no flip") +
            (moved ? ", pole target at " + trace->conventions.place(*pole) : ""));
        return;
    }
    const Bounds bounds = ChainLab().bounds(workspace, false);
    workspace.camera =
        framed(workspace.camera, {{0.0f, 0.0f}, workspace.ui.view_size}, bounds.centre, bounds.radius);
    workspace.toast(shown_text(*trace, shown));
    for (const std::string& note : trace->notes) workspace.toast(note, ToastKind::Refusal);
}

/// Takes the given arguments for reading the trace; returns whether there are any.
bool take_choice(ConventionChoice& choice, const Arguments& given) {
    bool any = false;
    const auto take = [&](const char* name, std::string& into) {
        if (!given.has(name)) return;
        into = given.text(name);
        any = true;
    };
    take("up", choice.up);
    take("handed", choice.handed);
    take("unit", choice.unit);
    take("rotations", choice.rotations);
    return any;
}

void open_trace(Workspace& workspace, const Arguments& given) {
    const std::string path = text_or_none(given, "path"), text = text_or_none(given, "text");
    const bool opens = !path.empty() || !text.empty();
    const TracedPose* const pose = traced_pose(chain_part(workspace));
    if (!path.empty() && !text.empty()) throw Refused("expected either path or text");
    if (!opens && pose == nullptr) throw Refused("no trace is shown: expected path or text");
    auto trace = opens ? std::make_shared<ShownTrace>() : std::make_shared<ShownTrace>(*pose->trace);
    if (opens) {
        trace->path = path;
        trace->text = text;
        trace->name = path.empty() ? "Pasted" : std::filesystem::path(path).filename().string();
    }
    set_fields(given, trace->view);
    const bool reads = take_choice(trace->choice, given) || opens || given.has("chain");
    const bool loads = reads || given.has("from");
    try {
        std::optional<std::uint64_t> from;
        if (!opens || given.has("from")) from = static_cast<std::uint64_t>(trace->view.from);
        if (reads) find_all(*trace, given.has("chain") ? given.text("chain") : trace->chain);
        if (loads) load_frames(*trace, from);
        show_trace(workspace, trace, !loads);
    } catch (const Refused&) {
        throw;
    } catch (const std::exception& error) {
        throw Refused(trace->name + ": " + error.what());
    }
}

}  // namespace

const TracedPose* traced_pose(const ChainPart& part) {
    if (!part.traced || part.study.open() || part.traced->joints.size() != part.chain.size()) return nullptr;
    for (std::size_t i = 0; i < part.chain.size(); ++i)
        if (part.chain.position(i) != part.traced->joints[i]) return nullptr;
    return part.traced.get();
}

void draw_traced_ghost(const View& view, const ChainPart& part, DrawList& list) {
    const TracedPose* const pose = traced_pose(part);
    if (pose == nullptr) return;
    const std::vector<glm::vec3>& ghost = pose->ghost;
    const glm::vec4 colour(solver_colour(view.palette, pose->trace->view.method), 0.6f);
    for (std::size_t i = 1; i < ghost.size(); ++i)
        list.line(ghost[i - 1], ghost[i], 3.0f * view.scale, colour);
    for (const glm::vec3 joint : ghost) list.sphere(joint, 4.5f * view.scale, Unit::Pixels, colour);
}

Verdict trace_verdict(const TracedPose& pose) {
    const TracedIncident* found = first_shown(*pose.trace);
    for (const TracedIncident& each : pose.trace->incidents)
        if (each.frame <= pose.frame && pose.frame <= each.last_frame) found = &each;
    if (found == nullptr) return {"No incidents in these frames", Verdict::Kind::Good};
    return {found->title(pose.trace->bones, pose.trace->conventions), Verdict::Kind::Bad,
            capitalised(found->cause) + "."};
}

std::vector<glm::vec3> traced_points(const TracedPose& pose) {
    std::vector<glm::vec3> all;
    for (const TracedFrame& frame : pose.trace->frames) {
        all.insert(all.end(), frame.joints.begin(), frame.joints.end());
        all.push_back(frame.goal());
    }
    return all;
}

ChainPart part_as_written(const ChainPart& part, const TracedPose& pose) {
    const ShownTrace& trace = *pose.trace;
    const TracedFrame& first = trace.frames.front();
    const auto written = [&](glm::vec3 p) { return glm::vec3(trace.conventions.written(p)); };
    // The ghost moves with the root.
    const glm::vec3 by = pose.joints.front() - first.joints.front();
    std::vector<glm::vec3> joints;
    for (std::size_t i = 0; i <= first.end_effector(); ++i) joints.push_back(written(first.joints[i] + by));
    ChainPart there = part;
    there.chain = chain_through(joints);
    there.target = written(part.target);
    if (auto& pole = there.reach.options.pole) pole = written(*pole);
    there.reach.limits = trace.view.limits(std::span(first.joints).first(joints.size()));
    if (trace.view.hinge > 0) {
        glm::vec3& axis = there.reach.limits[static_cast<std::size_t>(trace.view.hinge)].axis;
        axis = glm::normalize(written(axis));
        if (trace.conventions.handed.value == TraceHand::Left) axis = -axis;  // mirroring reverses the angle
    }
    return there;
}

void trace_rows(const TracedPose& pose, MoreRows& more, Emit& emit) {
    const ShownTrace& trace = *pose.trace;
    note(trace.conventions.text());
    FieldRows rows(trace.view, "chain.trace", emit);
    rows.under(more).rows("up", "handed", "unit");
    if (trace.conventions.has_rotations) rows.row("rotations");
    for (const Field& field : solve_fields()) rows.row(field.name);
    if (trace.all <= trace.frames.size()) return;
    rows.row("from");
    const auto from = static_cast<std::uint64_t>(trace.view.from);
    const std::uint64_t page = Rewind::max_ticks / 2, end = from + trace.frames.size();
    if (row_button("Earlier", 2, from > 0, "Shows the frames before these"))
        emit("chain.trace", {{"from", from - std::min(from, page)}});
    if (row_button("Later", 2, end < trace.all, "Shows the frames after these"))
        emit("chain.trace", {{"from", from + page}});
    end_row();
}

void add_trace_commands(CommandTable& table) {
    std::vector<Argument> arguments = field_arguments<TraceView>();
    arguments.insert(
        arguments.begin(),
        {text_argument("path", false, "JSON Lines, CSV or a log with positions in it"),
         text_argument("text", false,
                       "the same, as pasted text; without path and text, the trace that is shown"),
         text_argument("chain", false, "one of several; default: the first in which something was found")});
    Command command = chain_command(
        "chain.trace", "Show an engine's trace", std::move(arguments),
        "Shows an engine's chain frame by frame, with each incident and its cause", ChainChange());
    command.apply = open_trace;
    table.add(std::move(command));
}

template <>
std::span<const FieldText> field_texts<TraceView>() {
    static const auto methods = [] {
        std::array<EnumRow, ik::all_methods.size()> rows{};
        for (std::size_t i = 0; i < rows.size(); ++i)
            rows[i] = {ik::name(ik::all_methods[i]), solver_title(ik::all_methods[i]),
                       solver_help(ik::all_methods[i])};
        return rows;
    }();
    static const FieldText texts[] = {
        {.name = "up",
         .label = "up",
         .help = "The axis that is up in the file. The reason is shown above.",
         .listed = true,
         .choices = trace_ups.rows},
        {.name = "handed",
         .label = "hand",
         .help = "Whether the file's axes are right-handed or left-handed. The reason is shown above.",
         .listed = true,
         .choices = trace_hands.rows},
        {.name = "unit",
         .label = "unit",
         .help = "The unit of lengths in the file. The reason is shown above.",
         .listed = true,
         .choices = trace_units.rows},
        {.name = "rotations",
         .label = "quaternions",
         .help = "The order of a quaternion's numbers in the file. The reason is shown above.",
         .listed = true,
         .choices = quaternion_orders.rows},
        {.name = "from",
         .label = "first frame",
         .help = "The first of the 600 frames that the strip shows. Default: around the first incident.",
         .step = 5.0f},
        {.name = "solver",
         .label = "ghost",
         .help = "The method with which Tendril solves the same input, from the same first pose.",
         .listed = true,
         .choices = methods},
        {.name = "soft_zone",
         .label = "soft zone",
         .help = "The zone before full reach, as a fraction of it, in which the ghost eases off instead of "
                 "snapping straight.",
         .step = 0.002f,
         .decimals = 3,
         .unit = "of reach",
         .more = true},
        {.name = "pole_by",
         .label = "pole moved by",
         .help = "How far the ghost's pole target is from the trace's. If that has none: from the root.",
         .more = true},
        {.name = "hinge",
         .label = "hinge at joint",
         .help = "This joint of the ghost bends one way only, as in the first frame.",
         .at_zero = "none",
         .more = true}};
    return texts;
}

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::TraceView>() noexcept {
    using namespace app;
    static constexpr auto ups = trace_ups.name_array();
    static constexpr auto hands = trace_hands.name_array();
    static constexpr auto units = trace_units.name_array();
    static constexpr auto orders = quaternion_orders.name_array();
    static const Field rows[] = {field<&TraceView::method>("solver", solver_names()),
                                 field<&TraceView::soft_zone>("soft_zone"),
                                 field<&TraceView::pole_by>("pole_by", {-max_magnitude, max_magnitude}, "m"),
                                 field<&TraceView::hinge>("hinge", {0.0, max_trace_joints}),
                                 field<&TraceView::up>("up", ups),
                                 field<&TraceView::handed>("handed", hands),
                                 field<&TraceView::unit>("unit", units),
                                 field<&TraceView::rotations>("rotations", orders),
                                 field<&TraceView::from>("from", {0.0, max_from})};
    return rows;
}
