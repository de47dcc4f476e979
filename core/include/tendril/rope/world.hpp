// Ropes, sheets and hair among colliders.
//
//     rope::World world;
//     world.add_rope({.name = "line", .from = {0, 2, 0}, .to = {1, 2, 0}, .length = 1.5f,
//                     .pin_start = true, .pin_end = true});
//     world.add_collider("ball", rope::Sphere{{0.5f, 1, 0}, 0.3f});
//     for (;;) {
//         world.advance(frame_seconds);
//         draw(world.positions());
//     }
//
// Units are metres, kilograms and seconds. Particles are kept in double precision: a rope works a thousand
// kilometres from the origin as it does near it. The same calls give the same bits with every compiler and
// every vector unit.
//
// Editing calls throw std::invalid_argument or std::out_of_range with the value in the message and leave the
// world as it was. advance() allocates nothing once a world has its shape, unless more colliders are near than
// ever before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/rope/body.hpp"
#include "tendril/rope/collider.hpp"
#include "tendril/rope/settings.hpp"

namespace tendril::rope {

inline constexpr std::size_t max_particles = 1'000'000;

/// A particle that is held.
struct Pin {
    std::size_t particle = 0;
    glm::dvec3 goal{0.0};  ///< where it is going, or where in its collider's frame of centre it is held
    double seconds = 0.0;  ///< of simulated time until it is there; 0: it stays there
    std::string collider;  ///< that it moves with; empty: none
};

/// Everything that a world remembers, and nothing that follows from it: what to save, and to compare.
struct State {
    Settings settings;
    std::vector<Body> bodies;
    std::vector<Link> links;
    std::vector<glm::dvec3> position;
    std::vector<glm::dvec3> moved;   ///< by the last substep, metres
    std::vector<glm::dvec3> before;  ///< `moved` of the substep before the last, for the energy
    std::vector<double> mass;        ///< kg, over 0
    std::vector<Pin> pins;           ///< by particle
    std::vector<Collider> colliders;
    double remainder = 0.0;  ///< seconds that are not simulated yet
    double moved_in = 0.0;   ///< seconds in which `moved` was moved; 0: nothing has moved yet
    std::uint64_t substeps = 0, dropped = 0;
};

/// What one call of advance() did.
struct Advance {
    int substeps = 0;
    std::uint64_t dropped = 0;  ///< substeps that there was no time for
    int passes = 0;  ///< of the solver over all links, in all substeps; Direct may look at one run more often
    std::uint64_t work = 0;  ///< links solved and distances to colliders looked at: what the time goes into
    int shortened = 0;             ///< substeps whose passes max_pass_work cut
    std::uint64_t unresolved = 0;  ///< times a particle was left inside colliders: there was no way out, or
                                   ///< looking for it took too long
};

class World {
  public:
    World();
    /// Throws std::invalid_argument where the state holds together badly: lists of different lengths, links
    /// to particles that there are not, numbers out of range, a name twice.
    explicit World(State state);
    World(const World&);
    World(World&&) noexcept;
    World& operator=(const World&);
    World& operator=(World&&) noexcept;
    ~World();

    const State& state() const noexcept { return state_; }
    const Settings& settings() const noexcept { return state_.settings; }
    void set_settings(const Settings& settings);

    void clear() noexcept;  ///< no body, no collider; the settings stay
    /// Each gives back the body's name.
    std::string add_rope(const RopeShape& shape);
    std::string add_sheet(const SheetShape& shape);
    std::string add_lock(const LockShape& shape);
    void remove(std::string_view body);

    /// Null where there is none of that name.
    const Body* find(std::string_view body) const noexcept;
    /// The number of a body's particle. Throws where there is no such body or particle.
    std::size_t particle(std::string_view body, std::size_t index) const;

    /// Holds a particle and takes it to `at` evenly in the next `seconds` of simulated time; 0: within the
    /// next substep.
    void pin(std::size_t particle, const glm::vec3& at, double seconds = 0.0);
    /// Holds a particle where it is, moving with a collider.
    void attach(std::size_t particle, std::string_view collider);
    void unpin(std::size_t particle);
    bool pinned(std::size_t particle) const noexcept;

    /// Parts a rope: segment `segment` goes, what is behind it becomes a rope of its own, whose name is given
    /// back.
    std::string cut(std::string_view rope, std::size_t segment);

    void add_collider(std::string name, const Shape& shape);
    /// Takes a collider to `to` evenly in the next `seconds` of simulated time, 0: within the next substep;
    /// it carries what it meets.
    void move_collider(std::string_view name, const glm::vec3& to, double seconds = 0.0);
    void set_collider(std::string_view name, const Shape& shape);  ///< there at once
    /// What is attached to it is let go.
    void remove_collider(std::string_view name);
    const Collider* find_collider(std::string_view name) const noexcept;

    /// Frees the memory that advance() works with, for a world that is only kept: many times its state's.
    void trim() noexcept;

    /// Lets `seconds` pass, 0 or more; what is over settings().longest_frame, or over so many substeps, is
    /// dropped and counted.
    Advance advance(double seconds, std::uint64_t most_substeps = std::uint64_t{1} << 40);

    std::size_t size() const noexcept { return state_.position.size(); }
    glm::vec3 position(std::size_t particle) const noexcept { return glm::vec3(state_.position[particle]); }
    /// Of a body's particles, m/s.
    glm::vec3 velocity(std::size_t particle) const noexcept;
    /// Body::stretch.
    double stretch(const Body& body) const noexcept { return body.stretch; }
    /// The largest relative length error of a body's stretch links as they are now. It has in it what pushing
    /// out of colliders added, which Body::stretch has not.
    double length_error(const Body& body) const noexcept;
    double length_error() const noexcept;  ///< of all bodies
    /// Kinetic energy, by central differences, and potential, joules, as of one substep ago; potential is 0
    /// where the coordinates are. What is in elastic links counts, as they are now.
    double energy(const Body& body) const noexcept;
    double energy() const noexcept;  ///< of all bodies
    /// The sum of a body's rest lengths, metres; of a sheet and a lock that of one row or strand.
    double length(const Body& body) const noexcept;

    /// One of ik::vector_units(), or "none", for comparing; the widest where left empty. The bits are the
    /// same.
    void use_vector_unit(std::string_view name);

    struct Plan;     // of the library's own
    struct Scratch;  // likewise

  private:
    void built() noexcept;
    void reshaped() noexcept;
    Collider& collider(const char* operation, std::string_view name);

    State state_;
    std::shared_ptr<const Plan> plan_;  ///< how the links are solved; follows from them
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace tendril::rope
