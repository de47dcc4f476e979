// The Rope lab's last ten seconds: plots of tension, length error, energy and speed, and past poses.
#include "app/labs/kit/past.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "app/labs/kit/named_world.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/rope_lab.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_threads = 200;  ///< per past pose
constexpr std::size_t max_lines = 400;    ///< per past pose

/// A number of the selected particles or their body; without a selection, of all ropes.
struct Measure {
    const char *of_some, *of_all, *unit;
    float lowest_range;
    bool of_body;  ///< of a body, not of particles
    double (*value)(const NamedWorld&, const Particles&, const rope::Body*);
};
constexpr Measure measures[] = {
    {"tension at ", "strongest tension", "N", 0.1f, false,
     [](const NamedWorld& world, const Particles& particles, const rope::Body*) -> double {
         return strongest_tension(world, particles);
     }},
    {"length error of ", "length error", "%", 0.01f, true,
     [](const NamedWorld& world, const Particles&, const rope::Body* body) {
         return 100.0 * (body != nullptr ? world.length_error(*body) : world.length_error());
     }},
    {"energy of ", "energy", "J", 0.01f, true,
     [](const NamedWorld& world, const Particles&, const rope::Body* body) {
         return body != nullptr ? world.energy(*body) : world.energy();
     }},
    {"speed of ", "highest speed", "m/s", 0.1f, false,
     [](const NamedWorld& world, const Particles& particles, const rope::Body*) -> double {
         return highest_speed(world, particles);
     }}};

/// "rope 2, particle 7", "3 particles of rope 2"
std::string particles_name(const RopeSelection& selection) {
    if (!selection.particles.several())
        return selection.body + ", particle " + std::to_string(selection.particle());
    return std::to_string(selection.particles.all().size()) + " particles of " + selection.body;
}

template <std::size_t which>
PastCurve rope_curve(const Workspace& workspace) {
    constexpr const Measure& measure = measures[which];
    const RopePart& part = rope_part(workspace);
    std::optional<RopeSelection> selection = part.selection;
    if (selection && !selection->of_particles()) selection.reset();
    // Do not show removed ropes in an emptied world.
    const bool empty = part.world->state().bodies.empty();
    const std::string name =
        selection ? measure.of_some + (measure.of_body ? selection->body : particles_name(*selection))
                  : measure.of_all;
    std::string of = empty ? "nothing" : name;
    if (selection)
        for (const std::size_t each : selection->particles.all()) of += " " + std::to_string(each);
    return {.name = name,
            .unit = measure.unit,
            .lowest_range = measure.lowest_range,
            .missing = "There was no rope: add one.",
            .value =
                [selection, empty](const SharedPart& then) {
                    const NamedWorld& world = *part_as<RopePart>(then).world;
                    const Particles particles = measured_particles(world, selection);
                    if (empty || particles.empty()) return no_value;
                    return measures[which].value(world, particles,
                                                 selection ? world.find(selection->body) : nullptr);
                },
            .of = of};
}

bool same_particles(const Part& then, const Part& now) {
    const auto masses = [](const Part& part) -> const auto& {
        return part_as<RopePart>(part).world->state().mass;
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
    /// Marks the particles linked to the next one; empty: all.
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

/// Ropes and strands from end to end, and five rows and columns of each cloth. At most a few hundred lines,
/// each over several links if necessary.
PoseLines lines_of(const Workspace&, const SharedPart& part) {
    const NamedWorld& world = *part_as<RopePart>(part).world;
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

}  // namespace

/// Past poses must have the same particles: those before a cut or tear count, those of another scene do not.
const Past& rope_past() {
    static const Past past{
        .lab = rope_lab,
        .what = "scene",
        .probes = {{"tension", "tension", rope_curve<0>},
                   {"error", "length error", rope_curve<1>},
                   {"energy", "energy", rope_curve<2>},
                   {"speed", "speed", rope_curve<3>}},
        .plot_help =
            "Plotted below the scene for the last ten seconds: of the selected particles or "
            "their body, or of all ropes if none is selected",
        .ghosts_help = "Shows the ropes at every half second",
        .pose = lines_of,
        .same_joints = same_particles};
    return past;
}

}  // namespace tendril::app
