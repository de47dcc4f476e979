#include "app/labs/rope/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <set>
#include <span>
#include <utility>

#include "app/io/text.hpp"
#include "app/labs/rope/rope_lab.hpp"

namespace tendril::app {

Particles measured_particles(const NamedWorld& world, const std::optional<RopeSelection>& selection) {
    if (!selection || selection->body.empty()) return Particles(world.size(), true);
    const rope::Body* const body = world.find(selection->body);
    if (body == nullptr) return {};
    Particles measured(world.size(), false);
    bool any = false;
    for (const std::size_t i : selection->particles.all()) {
        if (i >= body->count) continue;
        measured[body->first + i] = any = true;
    }
    return any ? measured : Particles{};
}

float strongest_tension(const NamedWorld& world, const Particles& particles) {
    float strongest = 0.0f;
    for (const rope::Link& link : world.state().links)
        if (link.kind == rope::Link::Kind::Stretch && (particles[link.a] || particles[link.b]))
            strongest = std::max(strongest, link.tension);
    return strongest;
}

float highest_speed(const NamedWorld& world, const Particles& particles) {
    float highest = 0.0f;
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles[i]) highest = std::max(highest, glm::length(world.velocity(i)));
    return highest;
}

RopeSample sample_of(const NamedWorld& world) {
    RopeSample sample;
    for (const rope::Body& body : world.state().bodies)
        sample.stretch = std::max(sample.stretch, body.stretch);
    sample.error = static_cast<float>(world.length_error());
    sample.energy = static_cast<float>(world.energy());
    return sample;
}

RopeSample sample_of(const RopePart& part, const RopeReport& report) {
    RopeSample sample = sample_of(*part.world);
    const double frame = part.jitter.frame > 0.0 ? part.jitter.frame : tick_seconds;
    sample.frame = static_cast<float>(1e3 * frame);
    sample.report = report;
    return sample;
}

namespace {

std::span<const RopeSample> of_last_second(const std::vector<RopeSample>& samples) {
    constexpr auto ticks = static_cast<std::size_t>(1.0 / tick_seconds + 0.5);
    return std::span(samples).last(std::min(samples.size(), ticks));
}

// Finds pins that are farther apart than the length between them, and the resulting tensions.
//
// Pins and the ends of ties are the nodes of a graph. Its edges are the ties, and the stretches of rope,
// strand or cloth between two nodes of a body. The shortest path between two pins is their maximum distance.

constexpr std::size_t max_pins = 32;         ///< per body, compared with others
constexpr std::size_t max_cloth_nodes = 64;  ///< per cloth: each pair of nodes has an edge
constexpr double too_short = 1.001;          ///< the pins' distance divided by the length between them
constexpr double no_way = std::numeric_limits<double>::infinity();

/// The distances along rows and columns that links allow between a body's particles.
class Threads {
  public:
    explicit Threads(const rope::State& state)
        : along_(state.position.size(), no_way), down_(state.position.size(), no_way) {
        const rope::Settings& settings = state.settings;
        const bool elastic = settings.compliance > 0.0f && settings.solver != rope::Solver::Relaxation;
        std::size_t b = 0;
        for (const rope::Link& link : state.links) {
            if (link.kind != rope::Link::Kind::Stretch || link.compliance > 0.0f || elastic) continue;
            while (link.a < state.bodies[b].first) --b;  // links of a body are nearly always contiguous
            while (link.a - state.bodies[b].first >= state.bodies[b].count) ++b;
            const rope::Body& body = state.bodies[b];
            if (link.b - body.first >= body.count) continue;
            const std::size_t from = std::min(link.a, link.b), to = std::max(link.a, link.b);
            const std::size_t step = body.cell(to - body.first) - body.cell(from - body.first);
            if (step == body.row)
                down_[from] = link.rest;
            else if (step == 1)
                along_[from] = link.rest;
        }
    }
    /// The maximum distance between two particles of a body.
    double between(const rope::Body& body, std::size_t a, std::size_t b) const {
        const std::size_t row = body.row > 0 ? body.row : body.count;
        const std::size_t from = body.cell(a - body.first), to = body.cell(b - body.first);
        if (body.kind == rope::Body::Kind::Hair && from / row != to / row) return no_way;
        const std::size_t left = std::min(from % row, to % row), right = std::max(from % row, to % row);
        const auto at = [&](const std::vector<double>& list, std::size_t cell) {
            const std::size_t i = body.particle_in(cell);
            return i < body.count ? list[body.first + i] : no_way;
        };
        double length = 0.0;
        for (std::size_t i = left; i < right; ++i) length += at(along_, from / row * row + i);
        for (std::size_t i = from; i / row < to / row; i += row) length += at(down_, i);
        return length;
    }

  private:
    std::vector<double> along_, down_;  ///< rest lengths of the links from each particle
};

class PinGraph {
  public:
    explicit PinGraph(const NamedWorld& world) : world_(world), state_(world.state()) {
        if (state_.pins.size() < 2) return;
        const Threads threads(state_);
        std::set<std::uint32_t> ends;
        for (const rope::Tie& tie : state_.ties) ends.insert({tie.a, tie.b});
        auto pin = state_.pins.begin();
        auto end = ends.begin();
        for (const rope::Body& body : state_.bodies) {
            const std::size_t first = node_.size();
            for (std::size_t pins = 0; pin != state_.pins.end() && pin->particle - body.first < body.count;
                 ++pin)
                if (pins++ < max_pins) node_.push_back({static_cast<std::uint32_t>(pin->particle), true});
            const std::size_t pinned = node_.size();
            for (; end != ends.end() && *end - body.first < body.count; ++end) {
                const bool is_pin = std::any_of(node_.begin() + static_cast<std::ptrdiff_t>(first),
                                                node_.begin() + static_cast<std::ptrdiff_t>(pinned),
                                                [&](const Node& each) { return each.particle == *end; });
                if (!is_pin) node_.push_back({*end, false});
            }
            join(threads, body, first);
        }
        for (std::size_t i = 0; i < node_.size(); ++i) index_.emplace_back(node_[i].particle, i);
        std::sort(index_.begin(), index_.end());
        for (const rope::Tie& tie : state_.ties) join(find(tie.a), find(tie.b), tie.length);
    }

    std::vector<OverPulled> worst_of_each_pin() {
        std::vector<OverPulled> found;
        length_.assign(node_.size(), no_way);
        before_.assign(node_.size(), 0);
        for (std::size_t i = 0; i < node_.size(); ++i)
            if (node_[i].pinned) search(i, found);
        std::ranges::stable_sort(found, std::greater(),
                                 [](const OverPulled& each) { return each.apart - each.length; });
        return found;
    }

  private:
    struct Node {
        std::uint32_t particle;
        bool pinned;
        std::vector<std::pair<std::size_t, double>> edges{};
    };
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    std::size_t find(std::uint32_t particle) const {
        const auto at = std::lower_bound(index_.begin(), index_.end(), std::pair(particle, std::size_t{0}));
        return at != index_.end() && at->first == particle ? at->second : none;
    }
    void join(std::size_t a, std::size_t b, double length) {
        if (a == none || b == none || length == no_way) return;
        node_[a].edges.emplace_back(b, length);
        node_[b].edges.emplace_back(a, length);
    }
    /// Joins the nodes of a body from `first` on: neighbours on a strand, all of a cloth.
    void join(const Threads& threads, const rope::Body& body, std::size_t first) {
        const auto from = node_.begin() + static_cast<std::ptrdiff_t>(first);
        const bool cloth = body.kind == rope::Body::Kind::Cloth;
        if (cloth && node_.size() - first > max_cloth_nodes) node_.resize(first + max_cloth_nodes);
        std::sort(from, node_.end(), [](const Node& a, const Node& b) { return a.particle < b.particle; });
        for (std::size_t a = first; a < node_.size(); ++a) {
            const std::size_t end = cloth ? node_.size() : std::min(a + 2, node_.size());
            for (std::size_t b = a + 1; b < end; ++b)
                join(a, b, threads.between(body, node_[a].particle, node_[b].particle));
        }
    }

    /// Searches from one pin to those after it (E. W. Dijkstra, 1959).
    void search(std::size_t start, std::vector<OverPulled>& found) {
        using Reached = std::pair<double, std::size_t>;
        std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
        std::vector<std::size_t> seen{start};
        length_[start] = 0.0;
        next.emplace(0.0, start);
        std::size_t worst = none;
        double excess = 0.0;
        while (!next.empty()) {
            const Reached at = next.top();
            next.pop();
            const std::size_t node = at.second;
            if (at.first > length_[node]) continue;
            if (node_[node].pinned && node > start && apart(start, node) > too_short * at.first &&
                apart(start, node) - at.first > excess) {
                worst = node;
                excess = apart(start, node) - at.first;
            }
            for (const auto& edge : node_[node].edges) {
                const double length = at.first + edge.second;
                if (length >= length_[edge.first]) continue;
                if (length_[edge.first] == no_way) seen.push_back(edge.first);
                length_[edge.first] = length;
                before_[edge.first] = node;
                next.emplace(length, edge.first);
            }
        }
        if (worst != none) {
            OverPulled pulled{body_name(start), body_name(worst), apart(start, worst), length_[worst], {}};
            for (std::size_t node = worst; node != start; node = before_[node])
                pulled.way.push_back(node_[node].particle);
            pulled.way.push_back(node_[start].particle);
            found.push_back(std::move(pulled));
        }
        for (const std::size_t each : seen) length_[each] = no_way;
    }
    double apart(std::size_t a, std::size_t b) const {
        return glm::distance(state_.position[node_[a].particle], state_.position[node_[b].particle]);
    }
    const std::string& body_name(std::size_t node) const {
        return world_.name(*picked_particle(world_, particle_pick(node_[node].particle))->body);
    }

    const NamedWorld& world_;
    const rope::State& state_;
    std::vector<Node> node_;                                    ///< by body, then by particle
    std::vector<std::pair<std::uint32_t, std::size_t>> index_;  ///< particle, node; ascending
    std::vector<double> length_;                                ///< distances in the search, by node
    std::vector<std::size_t> before_;
};

/// True if the path between pins that are too far apart leads through two of these particles.
template <class Inside>
bool is_pulled(const std::vector<OverPulled>& all, Inside inside) {
    return std::ranges::any_of(
        all, [&](const OverPulled& each) { return std::ranges::count_if(each.way, inside) > 1; });
}
auto ends_of(const rope::Tie& tie) {
    return [&tie](std::size_t i) { return i == tie.a || i == tie.b; };
}

constexpr const char* unbounded = "without limit";

}  // namespace

RopeReport last_second(const std::vector<RopeSample>& samples) {
    RopeReport sum;
    for (const RopeSample& each : of_last_second(samples)) {
        const RopeReport& tick = each.report;
        sum.inside = tick.inside;
        sum.unconverged += tick.unconverged;
        sum.suspended += tick.suspended;
        sum.substeps += tick.substeps;
        sum.dropped += tick.dropped;
        sum.torn += tick.torn;
        sum.contact_loss += tick.contact_loss;
    }
    return sum;
}

double cost_of_tick(const std::vector<RopeSample>& samples) {
    double sum = 0.0, measured = 0.0;
    for (const RopeSample& each : of_last_second(samples)) {
        if (each.cost <= 0.0f) continue;
        sum += static_cast<double>(each.cost);
        ++measured;
    }
    return 1e-6 * sum / std::max(measured, 1.0);
}

std::string cost_text(const std::vector<RopeSample>& samples) {
    const double cost = cost_of_tick(samples);
    return cost > 0.0 ? si_text(cost, "s") : "";
}

std::string share_text(float share) {
    const double percent = 100.0 * static_cast<double>(share);
    return percent < 0.01 ? "< 0.01 %" : fixed_text(percent, 2) + " %";
}

std::string force_text(float newtons) {
    const auto value = static_cast<double>(newtons);
    return value < 1e4 ? fixed_text(value, 2) + " N" : si_text(value, "N");
}

std::vector<OverPulled> over_pulled(const NamedWorld& world) {
    return PinGraph(world).worst_of_each_pin();
}

std::optional<float> measured_tension(const rope::Tie& tie, const std::vector<OverPulled>& pulled) {
    if (tie.now != tie.length || is_pulled(pulled, ends_of(tie))) return std::nullopt;
    return tie.tension;
}

std::string tension_text(const NamedWorld& world, const rope::Tie& tie) {
    if (is_pulled(over_pulled(world), ends_of(tie))) return unbounded;
    const double left = static_cast<double>(tie.now) - static_cast<double>(tie.length);
    if (left != 0.0)
        return std::string(left > 0.0 ? "closing, " : "opening, ") + length_text(std::abs(left)) + " to go";
    return force_text(tie.tension);
}

std::string tension_text(const NamedWorld& world, const RopeSelection& selection) {
    const rope::Body* const body = world.find(selection.body);
    const auto in_body = [&](std::size_t i) { return i - body->first < body->count; };
    if (body != nullptr && is_pulled(over_pulled(world), in_body)) return unbounded;
    return force_text(strongest_tension(world, measured_particles(world, selection)));
}

std::string tearing_text(const NamedWorld& world, const rope::Body& body) {
    const rope::Settings& settings = world.settings();
    if (body.kind != rope::Body::Kind::Rope || !(body.tear > 0.0f) ||
        settings.solver == rope::Solver::Relaxation)
        return "";
    const double soft =
        world.world().compliance(body, rope::Link::Kind::Stretch) + static_cast<double>(settings.compliance);
    if (soft > 0.0) return force_text(static_cast<float>(body.tear / soft));
    return settings.solver == rope::Solver::Direct ? "only by its pins" : "";
}

std::string torn_text(const std::vector<RopeTear>& tears) {
    const RopeTear& first = tears.front();
    std::string text = first.body + " tore at particle " + std::to_string(first.particle);
    if (first.tension > 0.0f) text += " at " + force_text(first.tension);
    if (tears.size() > 1) text += "; so did " + count_text(tears.size() - 1, "other");
    return text;
}

}  // namespace tendril::app
