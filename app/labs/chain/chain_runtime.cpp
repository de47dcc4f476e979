#include "app/labs/chain/chain_runtime.hpp"

#include <algorithm>
#include <tendril/ik/solver.hpp>
#include <utility>

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

/// Whether both would give the same trace or race.
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
