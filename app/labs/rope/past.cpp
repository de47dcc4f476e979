// The Rope lab's last ten seconds: plots of tension, length error, energy and speed, and past poses.
#include "app/labs/rope/past.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "app/labs/kit/world_drawing.hpp"
#include "app/labs/rope/numbers.hpp"

namespace tendril::app {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t max_threads = 200;  ///< per past pose
constexpr std::size_t max_lines = 400;    ///< per past pose

enum class Number { Tension, Error, Energy, Speed };  // in the order of rope_past()

const RopePart& ropes_of(const SharedPart& part) {
    return dynamic_cast<const RopePart&>(*part);
}

double value_of(Number what, const NamedWorld& world, const std::optional<RopeSelection>& selection) {
    const Particles particles = measured_particles(world, selection);
    if (particles.empty()) return nothing;
    const rope::Body* const body = selection ? world.find(selection->body) : nullptr;
    switch (what) {
        case Number::Tension:
            return static_cast<double>(strongest_tension(world, particles));
        case Number::Error:
            return 100.0 * (body != nullptr ? world.length_error(*body) : world.length_error());
        case Number::Energy:
            return body != nullptr ? world.energy(*body) : world.energy();
        case Number::Speed:
            return static_cast<double>(highest_speed(world, particles));
    }
    return nothing;
}

/// "rope 2, particle 7", "3 particles of rope 2", or "rope 2" for values of a whole body.
std::string measured_name(Number what, const RopeSelection& selection) {
    if (what == Number::Error || what == Number::Energy) return selection.body;
    if (!selection.particles.several())
        return selection.body + ", particle " + std::to_string(selection.particle());
    return std::to_string(selection.particles.all().size()) + " particles of " + selection.body;
}

struct Told {
    const char* of_some;
    const char* of_all;
    const char* unit;
    float lowest_range;
};
Told told(Number what) {
    switch (what) {
        case Number::Tension:
            return {"tension at ", "strongest tension", "N", 0.1f};
        case Number::Error:
            return {"length error of ", "length error", "%", 0.01f};
        case Number::Energy:
            return {"energy of ", "energy", "J", 0.01f};
        default:
            return {"speed of ", "highest speed", "m/s", 0.1f};
    }
}

bool same_particles(const Part& then, const Part& now) {
    const auto masses = [](const Part& part) -> const auto& {
        return dynamic_cast<const RopePart&>(part).world->state().mass;
    };
    return masses(then) == masses(now);
}

/// `wanted` indices from 0 to `count` - 1, evenly spread.
std::set<std::size_t> spread(std::size_t count, std::size_t wanted) {
    std::set<std::size_t> places;
    for (std::size_t i = 0; i < wanted; ++i) places.insert(i * (count - 1) / (wanted - 1));
    return places;
}

/// A row of particles.
struct Thread {
    std::vector<std::size_t> particles{};  ///< indices in the world; a gap's is not linked
    /// Marks the particles with a link to the next; empty: all.
    std::vector<bool> linked{};

    bool whole(std::size_t from, std::size_t to) const {
        return linked.empty() ||
               std::all_of(linked.begin() + static_cast<std::ptrdiff_t>(from),
                           linked.begin() + static_cast<std::ptrdiff_t>(to), [](bool each) { return each; });
    }
};

void add_cloth(const NamedWorld& world, const rope::Body& cloth, std::vector<Thread>& threads) {
    constexpr std::size_t shown = 5;
    const std::size_t columns = cloth.row, rows = cloth.rows();
    const GridLinks links = grid_links(world, cloth);
    const auto add = [&](std::size_t from, std::size_t step, std::size_t count,
                         const std::vector<std::uint8_t>& of) {
        Thread& thread = threads.emplace_back();
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t cell = from + i * step;
            thread.particles.push_back(cloth.first + cloth.particle_in(cell));
            thread.linked.push_back(of[cell] != 0);
        }
    };
    for (const std::size_t row : spread(rows, shown)) add(row * columns, 1, columns, links.along);
    for (const std::size_t column : spread(columns, shown)) add(column, columns, rows, links.down);
}

std::vector<Thread> threads_of(const NamedWorld& world) {
    std::vector<Thread> threads;
    for (const rope::Body& body : world.state().bodies) {
        if (body.kind == rope::Body::Kind::Cloth) {
            add_cloth(world, body, threads);
            continue;
        }
        for (std::size_t i = 0; i < body.count; i += body.row) {
            Thread& thread = threads.emplace_back();
            thread.particles.resize(body.row);
            std::iota(thread.particles.begin(), thread.particles.end(), body.first + i);
        }
    }
    return threads;
}

}  // namespace

PastView rope_past() {
    return past_view(
        rope_lab, "scene",
        {{"tension", "tension"}, {"error", "length error"}, {"energy", "energy"}, {"speed", "speed"}},
        same_particles);
}

std::optional<PastCurve> rope_past_curve(const Workspace& workspace) {
    const PastView view = rope_past();
    if (!view.plots(workspace.settings)) return std::nullopt;
    const auto what = static_cast<Number>(view.chosen(workspace.settings));
    std::optional<RopeSelection> selection = rope_part(workspace).selection;
    if (selection && !selection->of_particles()) selection.reset();
    // An emptied world shows no removed ropes.
    const bool empty = rope_part(workspace).world->state().bodies.empty();
    const Told words = told(what);
    const std::string name = selection ? words.of_some + measured_name(what, *selection) : words.of_all;
    std::string of = empty ? "nothing" : name;
    if (selection)
        for (const std::size_t each : selection->particles.all()) of += " " + std::to_string(each);
    return PastCurve{.name = name,
                     .of = of,
                     .unit = words.unit,
                     .lowest_range = words.lowest_range,
                     .missing = "There was no rope: add one.",
                     .value = [what, selection, empty](const SharedPart& part) {
                         return empty ? nothing : value_of(what, *ropes_of(part).world, selection);
                     }};
}

PoseLines rope_lines(const SharedPart& part) {
    const NamedWorld& world = *ropes_of(part).world;
    const std::vector<Thread> threads = threads_of(world);
    PoseLines lines;
    if (threads.empty()) return lines;
    const std::size_t every = (threads.size() + max_threads - 1) / max_threads;
    const std::size_t each = max_lines / ((threads.size() + every - 1) / every);
    const std::vector<glm::vec3> positions = world.positions();
    for (std::size_t t = 0; t < threads.size(); t += every) {
        const Thread& thread = threads[t];
        const std::size_t links = thread.particles.size() - 1, strokes = std::min(links, each);
        for (std::size_t i = 0; i < strokes; ++i) {
            const std::size_t from = i * links / strokes, to = (i + 1) * links / strokes;
            if (thread.whole(from, to))
                lines.emplace_back(positions[thread.particles[from]], positions[thread.particles[to]]);
        }
    }
    return lines;
}

}  // namespace tendril::app
