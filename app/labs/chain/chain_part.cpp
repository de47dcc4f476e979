#include "app/labs/chain/chain_part.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <stdexcept>
#include <tendril/ik/solver.hpp>
#include <utility>

#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/engine_trace.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
ChainPart first_chain() {
    ChainPart part;
    part.chain = make_preset(preset_named("start"), 8);
    part.target = part.chain.position(part.chain.size() - 1);
    return part;
}

bool operator==(const ChainPart& a, const ChainPart& b) {
    const auto same = [&](const Field& field) { return same_field(field, &a, &b); };
    return std::ranges::all_of(fields<ChainPart>(), same) && a.selection == b.selection &&
           a.chosen_point == b.chosen_point && a.chain == b.chain && a.reach == b.reach &&
           a.result == b.result && a.study == b.study && a.curve == b.curve && a.along == b.along;
}

void check_range(const ChainPart& part) {
    const auto outside = [](glm::vec3 p) {
        return glm::any(glm::greaterThan(glm::abs(p), glm::vec3(max_magnitude)));
    };
    for (const Chain* const chain : {&part.chain, &part.along.given})
        for (const Segment& segment : chain->segments())
            if (outside(segment.position))
                throw std::invalid_argument("the chain would reach farther than 1e9 m");
    if (is_limited(part.reach) && part.chain.size() > max_limited_segments) {
        throw std::invalid_argument("chains of up to " + std::to_string(max_limited_segments) +
                                    " segments can have limits; this one has " +
                                    std::to_string(part.chain.size()));
    }
    if (part.motion.path == Motion::Path::Still) return;
    check_path(part.motion.centre, glm::vec3(part.motion.radius), "the target's path");
}

int iterations_of(const ChainPart& part, ChainMode mode) {
    if (mode == ChainMode::Curve) return 1;
    return mode == ChainMode::Reach ? part.reach.options.max_iterations
                                    : part.iterations[static_cast<std::size_t>(mode)];
}
int& iterations_of(ChainPart& part, ChainMode mode) {
    return mode == ChainMode::Reach ? part.reach.options.max_iterations
                                    : part.iterations[static_cast<std::size_t>(mode)];
}

std::size_t led_joint(const ChainPart& part) {
    if (part.mode == ChainMode::Backward) return part.chain.size() - 1;
    return part.mode == ChainMode::WithIndex ? part.index : 0;
}

void put_target_on_led_joint(ChainPart& part) {
    if (part.mode == ChainMode::Reach || part.mode == ChainMode::Curve || part.chain.empty() ||
        part.motion.path != Motion::Path::Still)
        return;
    part.target = part.chain.position(led_joint(part));
}

void enter_mode(ChainPart& part, ChainMode mode) {
    if (part.mode == mode) return;
    if (part.mode == ChainMode::Reach) part.reach_target = part.target;
    // Keeps the pose, with the bones' own lengths.
    if (part.mode == ChainMode::Curve) require_ok(part.chain.set_positions(positions(part.along.given)));
    const bool from_tip = part.mode == ChainMode::Backward;  // its target is on the tip, or leads it
    part.mode = mode;
    part.result.reset();
    put_target_on_led_joint(part);
    if (mode != ChainMode::Reach) return;
    const auto kept = std::exchange(part.reach_target, std::nullopt);
    if (part.chain.empty() || part.motion.path != Motion::Path::Still) return;
    if (kept)
        part.target = *kept;
    else if (!from_tip)
        part.target = part.chain.position(part.chain.size() - 1);
}

void reach_for(ChainPart& part, glm::vec3 target, ChainRuntime& runtime) {
    part.result.reset();
    if (part.mode != ChainMode::Reach) target = in_plane(part.chain, part.reach, target);
    switch (part.mode) {
        case ChainMode::Forward:
            require_ok(part.chain.forward(target));
            break;
        case ChainMode::Backward:
            require_ok(part.chain.backward(target));
            break;
        case ChainMode::Fixed:
            require_ok(part.chain
                           .fixed(target, {.iterations = iterations_of(part, ChainMode::Fixed),
                                           .tolerance = part.tolerance})
                           .accepted);
            break;
        case ChainMode::WithIndex:
            if (!part.chain.empty()) require_ok(part.chain.with_index(part.index, target));
            break;
        case ChainMode::Reach:
            part.study.rewind(part.chain, part.reach);
            part.study.note_start(part.chain, part.reach);
            part.result = solve_reach(part.chain, part.reach, target, runtime);
            break;
        case ChainMode::Curve:
            if (!part.curve.points.empty()) part.curve.points.back() = target;
            break;
    }
    part.target = target;
}

void keep_step(ChainPart& part, ChainRuntime& runtime) {
    if (const auto trace = runtime.studied(part).trace)
        part.study.step = std::min(part.study.step, trace->frames());
}

/// Keeps the present selection.
std::shared_ptr<const Part> ChainPart::at_moment(std::shared_ptr<const Part> then) const {
    const auto& earlier = dynamic_cast<const ChainPart&>(*then);
    Selection now = selection;
    now.keep_below(earlier.chain.size());
    Selection controls = along.selection;
    controls.keep_below(earlier.curve.points.size());
    if (earlier.mode != ChainMode::Curve) controls.clear();
    if (now == earlier.selection && chosen_point == earlier.chosen_point &&
        controls == earlier.along.selection)
        return then;
    auto part = std::make_shared<ChainPart>(earlier);
    part->selection = std::move(now);
    part->along.selection = std::move(controls);
    part->chosen_point = chosen_point;
    if (chosen_point == ChainPoint::Pole && !part->reach.options.pole) part->chosen_point.reset();
    return part;
}

std::shared_ptr<const Part> ChainPart::without_past() const {
    if (!traced) return nullptr;
    auto rest = std::make_shared<ChainPart>(*this);
    rest->traced.reset();
    return rest;
}

std::vector<std::filesystem::path> ChainPart::files() const {
    if (!traced || traced->trace->path.empty()) return {};
    return {traced->trace->path};
}

std::size_t ChainPart::bytes() const {
    return sizeof(*this) + chain.size() * sizeof(Segment) + reach.limits.size() * sizeof(ik::Limit) +
           (reach.plane ? reach.plane->limits.size() * sizeof(ik::AngleLimit) +
                              reach.plane->aside.size() * sizeof(ik::Limit)
                        : 0) +
           bytes_of(reach.state) + along.given.size() * sizeof(Segment) +
           curve.points.size() * sizeof(glm::vec3) +
           along.memory.at.size() * (sizeof(double) + sizeof(glm::vec3)) + study.bytes() +
           selection.all().size() * sizeof(std::size_t);
}

float length_error(const Chain& chain, std::size_t index) {
    if (index == 0) return 0.0f;
    const auto segments = chain.segments();
    return std::abs(glm::distance(segments[index].position, segments[index - 1].position) -
                    segments[index].length);
}

namespace {

/// True if both would give the same trace or race.
bool same_study(const ChainPart& a, const ChainPart& b) {
    return a.study.kind == b.study.kind && a.study.start == b.study.start &&
           a.study.start_state == b.study.start_state && a.study.racers == b.study.racers &&
           a.target == b.target && a.reach == b.reach && a.chain == b.chain;
}

}  // namespace

struct ChainRuntime::Kept {
    std::vector<float> lengths;
    glm::vec3 rest_direction{};
    ik::Solver solver;
};

ChainRuntime::ChainRuntime() = default;
ChainRuntime::~ChainRuntime() = default;

ik::Solver& ChainRuntime::solver(std::span<const float> lengths, glm::vec3 rest_direction) {
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
        return kept.rest_direction == rest_direction && std::ranges::equal(kept.lengths, lengths);
    });
    if (found != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, found);
        return kept_.front().solver;
    }
    const std::vector<glm::vec3> rest(lengths.size(), rest_direction);
    auto solver = require_value(ik::Solver::make(lengths, rest));
    kept_.push_front({{lengths.begin(), lengths.end()}, rest_direction, std::move(solver)});
    if (kept_.size() > most) kept_.pop_back();
    ++made_;
    return kept_.front().solver;
}

Studied ChainRuntime::studied(const ChainPart& part) {
    if (!part.study.open()) return {};
    if (!studied_part_ || !same_study(*studied_part_, part)) {
        studied_ = work_out(part.study, part.chain, part.reach, part.target, *this);
        studied_part_ = std::make_shared<const ChainPart>(part);
    }
    return studied_;
}

ik::Solver& ChainRuntime::solver(const Chain& chain) {
    std::vector<float> lengths;
    lengths.reserve(chain.size());
    for (std::size_t i = 1; i < chain.size(); ++i) lengths.push_back(chain.segments()[i].length);
    return solver(lengths, chain.default_direction());
}

}  // namespace tendril::app
