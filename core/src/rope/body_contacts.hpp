// Contacts between the bodies of an island, and of a body with itself (tendril/rope/collision.hpp). Not
// installed.
//
// 1. find() lists pairs of segments that may come near each other in the substep: chunks by sweeping along
//    an axis, then segments by balls around them. A pair is a contact if it is nearer than its neighbours,
//    and presses or would.
// 2. solve(): every chain with a contact takes a step of Newton's method (chain_newton.hpp) in turn, with the
//    others where they are now, or will be if nothing presses; then each contact adds what is left of its
//    gap, times a stiffness, to its multiplier. With the stiffness of about what the chains themselves offer
//    sideways both converge within a few rounds.
// 3. keep_apart() makes sure that no two segments cross on the straight way from the start of the substep to
//    the solver's result.
#pragma once

#include <algorithm>

#include "rope/chain_newton.hpp"
#include "rope/geometry.hpp"
#include "rope/scratch.hpp"

namespace tendril::rope {
namespace detail {

struct NearestOfSegments {
    double at_a = 0.0, at_b = 0.0;  ///< 0 to 1
    dvec3 between{0.0};             ///< from a's point to b's
};

/// C. Ericson, "Real-Time Collision Detection", 2005, 5.1.9.
inline NearestOfSegments nearest_of_segments(const dvec3& a0, const dvec3& a1, const dvec3& b0,
                                             const dvec3& b1) noexcept {
    const dvec3 u = a1 - a0, v = b1 - b0, r = a0 - b0;
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
    const double apart = uu * vv - uv * uv;
    double s = apart > 1e-12 * uu * vv ? std::clamp((uv * vr - ur * vv) / apart, 0.0, 1.0) : 0.5;
    double t = vv > 0.0 ? (uv * s + vr) / vv : 0.0;
    if (t < 0.0 || t > 1.0 || !(apart > 1e-12 * uu * vv)) {
        t = std::clamp(t, 0.0, 1.0);
        s = uu > 0.0 ? std::clamp((uv * t - ur) / uu, 0.0, 1.0) : 0.0;
    }
    return {s, t, (b0 + t * v) - (a0 + s * u)};
}

}  // namespace detail

class BodyContacts : IslandStep {
  public:
    /// Of an island with collisions.
    explicit BodyContacts(const IslandStep& step)
        : IslandStep(step), s_(scratch_.body_contacts[island_.contacts - 1]) {}

    void find();  ///< once particles have moved freely
    /// Solves chains in contact; Scratch::chain_solved says which.
    void solve();
    void project();  ///< for solvers that take one link after the other: once through all contacts
    void keep_apart();

  private:
    using Contact = BodyContactScratch::Contact;
    using Pair = BodyContactScratch::Pair;
    using Side = BodyContactScratch::Side;
    /// Of a contact, with its segments somewhere.
    struct Response {
        glm::dvec3 force{0.0};                        ///< on b
        glm::dvec3 normal{0.0};                       ///< from a to b
        double gap = 0.0, along = 0.0, across = 0.0;  ///< stiffness along the normal, and along the surface
        double at_a = 0.0, at_b = 0.0;
    };
    struct Ends {
        glm::dvec3 a0, a1, b0, b1;
    };
    struct Crossing {
        double at_a = 0.0, at_b = 0.0;
    };

    // body_search.cpp
    void search(const std::vector<glm::dvec3>& ends);
    void bound_chunks(const std::vector<glm::dvec3>& ends);
    void search_chunks(std::uint32_t c, std::uint32_t d);
    void consider(const BodyContactScratch::Ball& a, const BodyContactScratch::Ball& b);
    bool may_meet(std::uint32_t c, std::uint32_t d) const;
    bool lowest(const Pair& pair) const;
    void choose_contacts();
    void continue_forces();

    // body_contacts.cpp
    Ends ends_of(std::uint32_t a, std::uint32_t b, const std::vector<glm::dvec3>& at) const;
    void order_sides();
    void choose_stiffness();
    double offered(std::size_t side) const;
    glm::dvec3 expected(std::uint32_t chain, std::uint32_t node) const;
    Response respond(const Contact& contact, const Ends& at) const;
    Response respond(const Contact& contact) const;
    void press(std::uint32_t chain, std::span<const Side> sides);
    double update_forces();
    std::span<const Side> sides_of(std::uint32_t chain) const;
    ContactScratch& memory(std::uint32_t chain) const { return scratch_.chain_contacts[chain]; }

    // body_passing.cpp
    bool outran() const;
    bool crosses(const Ends& from, const Ends& to, const glm::dvec3& normal, int depth,
                 Crossing& where) const;
    bool crosses(const Pair& pair, Crossing& where) const;
    void part(const Pair& pair, const Crossing& where);

    BodyContactScratch& s_;
};

}  // namespace tendril::rope
