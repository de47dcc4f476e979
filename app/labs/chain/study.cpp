#include "app/labs/chain/study.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <tendril/ik/solver.hpp>

#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/io/solver_text.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/arguments.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Study>() noexcept {
    using app::Study;
    static constexpr Field rows[] = {
        field<&Study::side_by_side>("side_by_side"),
        field<&Study::pace>("pace", {0.0, static_cast<double>(app::fastest_pace)}, "1/s"),
        field<&Study::passed>("passed", {0.0, 1e12})};
    return rows;
}

namespace tendril::app {
namespace {

std::vector<glm::vec3> straight(const Chain& chain) {
    Chain line = require_value(Chain::from_segments({}, chain.default_direction()));
    for (const Segment& segment : chain.segments()) require_ok(line.add(segment.length));
    std::vector<glm::vec3> joints = positions(line);
    for (glm::vec3& joint : joints) joint += chain.position(0);
    return joints;
}

}  // namespace

void Study::begin(Kind as, std::optional<From> from, const Chain& chain, const ReachSettings& settings) {
    if (chain.size() < 2) throw std::invalid_argument("there is nothing to solve: the chain has no bone");
    if (chain.size() > max_studied_segments) {
        throw std::invalid_argument("chains of up to " + std::to_string(max_studied_segments) +
                                    " segments can be studied; this one has " + std::to_string(chain.size()));
    }
    if (from || !open()) {
        const bool last = from.value_or(From::Last) == From::Last && last_start.size() == chain.size();
        start = from == From::Straight ? straight(chain) : last ? last_start : positions(chain);
        start_state = from == From::Straight ? ik::State() : last ? last_state : settings.state;
    }
    if (kind != as) step = as == Kind::Race ? race_end : 0;
    kind = as;
}

void Study::note_start(const Chain& chain, const ReachSettings& settings) {
    if (!gesture_begins && last_start.size() == chain.size()) return;
    gesture_begins = false;
    last_start.clear();
    last_state = {};
    if (chain.size() > max_studied_segments) return;
    last_start = positions(chain);
    last_state = settings.state;
}

void Study::close() {
    kind = Kind::None;
    start.clear();
    start_state = {};
    step = 0;
    pace = 0.0f;
}

void Study::go_to(std::size_t to, std::size_t last) {
    step = to < last ? to : kind == Kind::Race ? race_end : last;
}

void Study::play(double seconds, std::size_t last) {
    const double before = passed;
    passed += static_cast<double>(pace) * seconds;
    go_to(step + static_cast<std::size_t>(std::floor(passed) - std::floor(before)), last);
    if (step >= last) pace = 0.0f;
}

float race_pace(std::size_t iterations) {
    constexpr float usual = 4.0f, shortest_seconds = 3.0f, longest_seconds = 11.0f;
    const auto all = static_cast<float>(iterations);
    return std::clamp(all / std::clamp(all / usual, shortest_seconds, longest_seconds), slowest_pace,
                      fastest_pace);
}

void Study::rewind(Chain& chain, ReachSettings& settings) const {
    if (!open()) return;
    require_ok(chain.set_positions(start));
    settings.state = start_state;
}

Studied work_out(const Study& study, Chain chain, ReachSettings settings, glm::vec3 target,
                 ChainRuntime& runtime) {
    study.rewind(chain, settings);
    switch (study.kind) {
        case Study::Kind::None:
            break;
        case Study::Kind::Microscope:
            return {std::make_shared<const Trace>(record_trace(chain, settings, target, runtime)), nullptr};
        case Study::Kind::Race:
            return {nullptr,
                    std::make_shared<const Race>(run_race(chain, settings, target, study.racers, runtime))};
    }
    return {};
}

std::size_t Study::bytes() const {
    return (start.size() + last_start.size()) * sizeof(glm::vec3) + bytes_of(start_state) +
           bytes_of(last_state);
}

bool Study::operator==(const Study& other) const {
    return kind == other.kind && start == other.start && start_state == other.start_state &&
           step == other.step && pace == other.pace && passed == other.passed && racers == other.racers &&
           side_by_side == other.side_by_side;
}

Json save_start(const std::vector<glm::vec3>& joints, const ik::State& state) {
    Json json{{"start", points_json(joints)}};
    save_state(json, state, joints);
    return json;
}

void load_start(const JsonPlace& place, const Chain& chain, std::vector<glm::vec3>& joints,
                ik::State& state) {
    const JsonPlace start = place["start"];
    start.check_size(chain.size(), "positions, one for each segment");
    joints.clear();
    for (std::size_t i = 0; i < chain.size(); ++i) joints.push_back(start.element(i).point());
    state = load_state(place, joints);
}

Json save_study(const Study& study) {
    const bool race = study.kind == Study::Kind::Race;
    Json json = save_start(study.start, study.start_state);
    json.update(save_fields(study));
    json["kind"] = race ? "race" : "microscope";
    json["step"] = race ? 0 : study.step;
    if (race && study.step != Study::race_end) json["iteration"] = study.step;
    json["solvers"] = Json::array();
    for (const ik::Method method : ik::all_methods) {
        if (study.racers[static_cast<std::size_t>(method)]) json["solvers"].push_back(ik::name(method));
    }
    return json;
}

Study load_study(const JsonPlace& place, const Chain& chain) {
    Study study;
    const JsonPlace kind = place["kind"];
    if (kind.text() != "race" && kind.text() != "microscope")
        kind.fail("must be race or microscope, got \"" + kind.text() + "\"");
    study.begin(kind.text() == "race" ? Study::Kind::Race : Study::Kind::Microscope, Study::From::Here, chain,
                {});
    load_start(place, chain, study.start, study.start_state);
    load_fields(place, study);
    const auto step = static_cast<std::size_t>(place["step"].integer(0, max_trace_steps));
    if (study.kind == Study::Kind::Microscope) study.step = step;
    if (const auto iteration = place.optional("iteration"); iteration && study.kind == Study::Kind::Race)
        study.step = static_cast<std::size_t>(iteration->integer(0, max_iterations));
    study.racers.fill(false);
    place["solvers"].for_each("solvers", ik::all_methods.size(), [&](const JsonPlace& each) {
        study.racers[static_cast<std::size_t>(method_from_name(each.text(), each.where()))] = true;
    });
    return study;
}

namespace {

class Recorder final : public ik::Observer {
  public:
    explicit Recorder(Trace& trace) : trace_(trace) {}
    void step(const ik::Step& step) noexcept override {
        if (trace_.steps.size() >= static_cast<std::size_t>(max_trace_steps)) {
            trace_.cut = true;
            return;
        }
        if (trace_.steps.empty() || trace_.steps.back().order != step.order) {
            trace_.frame_begins.push_back(trace_.steps.size());
        }
        trace_.steps.push_back(step);
    }
    void iteration_done(int, float residual) noexcept override {
        if (!trace_.cut) trace_.residuals.push_back(residual);
    }

  private:
    Trace& trace_;
};

}  // namespace

std::span<const ik::Step> Trace::frame(std::size_t frame) const {
    if (frame == 0 || frame > frames()) return {};
    const std::size_t begin = frame_begins[frame - 1];
    const std::size_t end = frame < frames() ? frame_begins[frame] : steps.size();
    return std::span(steps).subspan(begin, end - begin);
}

std::vector<glm::vec3> Trace::pose(std::size_t frame) const {
    std::vector<glm::vec3> joints = start;
    const std::size_t end = frame < frames() ? frame_begins[frame] : steps.size();
    for (std::size_t i = 0; i < end; ++i) joints[steps[i].joint] = steps[i].to;
    return joints;
}

int Trace::iteration(std::size_t frame) const {
    const auto steps_of = this->frame(frame);
    return steps_of.empty() ? 0 : steps_of.front().iteration;
}

std::size_t Trace::end_of_iteration(int iteration) const {
    const std::vector<int> ends = iteration_ends(*this);
    const auto wanted = std::min(static_cast<std::size_t>(std::max(0, iteration)), ends.size() - 1);
    return static_cast<std::size_t>(ends[wanted]);
}

std::vector<int> iteration_ends(const Trace& trace) {
    std::vector<int> ends{0};
    for (std::size_t frame = 1; frame <= trace.frames(); ++frame) {
        const auto iteration = static_cast<std::size_t>(trace.iteration(frame));
        if (iteration >= ends.size()) ends.resize(iteration + 1, ends.back());
        ends.back() = static_cast<int>(frame);
    }
    return ends;
}

Trace record_trace(Chain chain, ReachSettings settings, glm::vec3 target, ChainRuntime& runtime) {
    Trace trace;
    trace.method = settings.method;
    trace.start = positions(chain);
    Recorder recorder(trace);
    ik::Solver& solver = runtime.solver(chain);
    trace.report = solver.solve(settings.method, chain, state_for(settings, solver.bones()), target,
                                solver_options(settings, solver.reach()), &recorder);
    return trace;
}

// Describing a step.

namespace {

/// "joint 2", "joints 2 to 4".
std::string joints_of(std::span<const ik::Step> steps) {
    std::size_t low = steps.front().joint, high = low;
    for (const ik::Step& step : steps) {
        low = std::min(low, step.joint);
        high = std::max(high, step.joint);
    }
    if (low == high) return "joint " + std::to_string(low);
    return "joints " + std::to_string(low) + " to " + std::to_string(high);
}

std::string pull(const Trace& trace, std::size_t frame, const ik::Step& step) {
    if (step.neighbour == ik::no_joint) {
        return step.phase == ik::Phase::ForwardReaching
                   ? "Forward reaching: the tip goes onto the target."
                   : "Backward reaching: the root goes back to its place.";
    }
    const float length = glm::distance(trace.pose(frame)[step.neighbour], step.to);
    char text[200];
    std::snprintf(text, sizeof text,
                  "%s reaching: joint %zu slides along its line to joint %zu until it is %.3f m away.",
                  step.phase == ik::Phase::ForwardReaching ? "Forward" : "Backward", step.joint,
                  step.neighbour, static_cast<double>(length));
    return text;
}

}  // namespace

std::string describe_frame(const Trace& trace, std::size_t frame) {
    const auto steps = trace.frame(frame);
    if (steps.empty()) return "The start: nothing has moved yet.";
    const ik::Step& first = steps.front();
    const std::string joints = joints_of(steps);
    const std::string about =
        first.neighbour == ik::no_joint ? "" : " about joint " + std::to_string(first.neighbour);
    switch (first.phase) {
        case ik::Phase::Prepare:
            return "Before the first iteration: the chain is prepared (" + joints + ").";
        case ik::Phase::ForwardReaching:
        case ik::Phase::BackwardReaching:
            return pull(trace, frame, first);
        case ik::Phase::Accelerate:
            return "Straightened or bent to the distance, then turned onto the target (" + joints + ").";
        case ik::Phase::Rotate:
            return "Turned" + about + ", so that the tip points at the target (" + joints + ").";
        case ik::Phase::Gradient:
            return "All joints turn a little, along the gradient that the Jacobian gives (" + joints + ").";
        case ik::Phase::Pole:
            return "The chain swivels until the elbow points at the pole target (" + joints + ").";
        case ik::Phase::Limit:
            return "Limits: " + joints + (steps.size() == 1 ? " is" : " are") +
                   " brought back within limits.";
        case ik::Phase::Analytic:
            return "Solved in closed form, without iterating (" + joints + ").";
        case ik::Phase::RestoreBest:
            return "The best pose is restored, as the last was worse (" + joints + ").";
        case ik::Phase::Blend:
            return "Blended with the given pose by the weight (" + joints + ").";
    }
    return {};
}

}  // namespace tendril::app
