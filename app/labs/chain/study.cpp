#include "app/labs/chain/study.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/require.hpp"

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
    if (kind != as) step = 0;
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

void Study::play(double seconds, std::size_t last) {
    const double before = passed;
    passed += static_cast<double>(pace) * seconds;
    step = std::min(last, step + static_cast<std::size_t>(std::floor(passed) - std::floor(before)));
    if (step == last) pace = 0.0f;
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

Json save_study(const Study& study) {
    Json json{{"kind", study.kind == Study::Kind::Race ? "race" : "microscope"}, {"step", study.step}};
    for (const glm::vec3& at : study.start) json["start"].push_back(point(at));
    save_state(json, study.start_state, study.start);
    json["solvers"] = Json::array();
    for (const ik::Method method : ik::all_methods) {
        if (study.racers[static_cast<std::size_t>(method)]) json["solvers"].push_back(ik::name(method));
    }
    json["side_by_side"] = study.side_by_side;
    return json;
}

Study load_study(const JsonPlace& place, const Chain& chain) {
    Study study;
    const JsonPlace kind = place["kind"];
    if (kind.text() != "race" && kind.text() != "microscope")
        kind.fail("must be race or microscope, got \"" + kind.text() + "\"");
    study.begin(kind.text() == "race" ? Study::Kind::Race : Study::Kind::Microscope, Study::From::Here, chain,
                {});
    const JsonPlace start = place["start"];
    start.check_size(chain.size(), "positions, one a segment");
    for (std::size_t i = 0; i < chain.size(); ++i) study.start[i] = start.element(i).point();
    study.start_state = load_state(place, study.start);
    study.step = static_cast<std::size_t>(place["step"].integer(0, max_trace_steps));
    study.racers.fill(false);
    place["solvers"].for_each("solvers", ik::all_methods.size(), [&](const JsonPlace& each) {
        const auto method = ik::method_named(each.text());
        if (!method) each.fail("there is no solver \"" + each.text() + "\"");
        study.racers[static_cast<std::size_t>(*method)] = true;
    });
    study.side_by_side = place["side_by_side"].flag();
    return study;
}

}  // namespace tendril::app
