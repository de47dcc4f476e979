#include "app/labs/chain/study.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/document/json_complete.hpp"
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
}

void Study::rewind(Chain& chain, ReachSettings& settings) const {
    if (!open()) return;
    require_ok(chain.set_positions(start));
    settings.state = start_state;
}

void Study::refresh(const Chain& chain, const ReachSettings& settings, glm::vec3 target,
                    ChainRuntime& runtime) {
    trace.reset();
    race.reset();
    if (!open()) return;
    Chain begin = chain;
    ReachSettings turned = settings;
    rewind(begin, turned);
    if (kind == Kind::Race) {
        race = std::make_shared<const Race>(run_race(begin, turned, target, racers, runtime));
        return;
    }
    trace = std::make_shared<const Trace>(record_trace(begin, turned, target, runtime));
    step = std::min(step, trace->frames());
}

std::size_t Study::bytes() const {
    std::size_t sum =
        (start.size() + last_start.size()) * sizeof(glm::vec3) + bytes_of(start_state) + bytes_of(last_state);
    if (trace) sum += trace->steps.size() * (sizeof(ik::Step) + sizeof(std::size_t));
    if (race) {
        for (const Racer& racer : race->racers) {
            sum += racer.joints.size() * sizeof(glm::vec3) + racer.residuals.size() * sizeof(float);
        }
    }
    return sum;
}

bool Study::operator==(const Study& other) const {
    return kind == other.kind && start == other.start && start_state == other.start_state &&
           step == other.step && racers == other.racers && side_by_side == other.side_by_side;
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

Study load_study(const Json& json, const std::string& where, const Chain& chain) {
    Study study;
    const std::string kind = json_text(json_member(json, "kind", where), where + ".kind");
    if (kind != "race" && kind != "microscope") {
        throw std::runtime_error(where + ".kind must be race or microscope, got \"" + kind + "\"");
    }
    study.begin(kind == "race" ? Study::Kind::Race : Study::Kind::Microscope, Study::From::Here, chain, {});
    const Json& start = json_member(json, "start", where);
    if (!start.is_array() || start.size() != chain.size()) {
        throw std::runtime_error(where + ".start must be a list of " + std::to_string(chain.size()) +
                                 " positions, one a segment");
    }
    for (std::size_t i = 0; i < start.size(); ++i) {
        study.start[i] = json_point(start[i], where + ".start." + std::to_string(i));
    }
    study.start_state = load_state(json, where, study.start);
    study.step = static_cast<std::size_t>(
        json_integer(json_member(json, "step", where), where + ".step", 0, max_trace_steps));
    study.racers.fill(false);
    const Json& solvers = json_member(json, "solvers", where);
    if (!solvers.is_array()) throw std::runtime_error(where + ".solvers must be a list");
    for (const Json& each : solvers) {
        const std::string name = json_text(each, where + ".solvers");
        const auto method = ik::method_named(name);
        if (!method) throw std::runtime_error(where + ".solvers: there is no solver \"" + name + "\"");
        study.racers[static_cast<std::size_t>(*method)] = true;
    }
    study.side_by_side = json_bool(json_member(json, "side_by_side", where), where + ".side_by_side");
    return study;
}

}  // namespace tendril::app
