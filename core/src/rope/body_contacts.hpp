// Contacts between the bodies of an island, and of a body with itself (tendril/rope/collision.hpp). Not
// installed.
//
// 1. find() finds pairs that may come near each other in the substep: two segments, or a particle and a
//    triangle of a cloth. A pair of segments is a contact if it is nearer than its neighbours and touches.
// 2. solve(): each chain in contact takes a step of Newton's method (chain_newton.hpp) in turn, with the
//    others fixed; then each contact adds its remaining gap, times a stiffness, to its multiplier. With a
//    stiffness near the chains' own sideways stiffness, both converge in a few rounds.
// 3. find_self_contacts() finds the contacts within a cloth, for each step of its own solve.
// 4. project() corrects the contacts of cloth and tied bodies after their solve, and those left within a
//    cloth.
// 5. prevent_crossing() keeps pairs from crossing between the start of the substep and the solver's result.
#pragma once

#include <array>

#include "rope/chain_newton.hpp"
#include "rope/scratch.hpp"

namespace tendril::rope {

class BodyContacts : IslandStep {
  public:
    /// For an island with collisions.
    explicit BodyContacts(const IslandStep& step)
        : IslandStep(step), s_(scratch_.body_contacts[island_.contacts - 1]) {}

    void find();  ///< call once particles have moved freely
    /// Solves chains in contact; Scratch::chain_solved says which.
    void solve();
    /// Sorts the island's members by group.
    void sort_members();
    /// The contacts now pressing within a cloth, for its own solve. `stiffness`: per contact, times h^2.
    void find_self_contacts(const Body& cloth, double stiffness,
                            std::vector<ClothSelfContact>& self_contacts);
    /// One pass over the contacts to project; `all`: over all contacts, for solvers that go link by link.
    /// Returns the largest correction, relative to the thickness.
    double project(bool all);
    void begin_projection(bool all);
    void prevent_crossing();

  private:
    using Candidate = BodyContactScratch::Candidate;
    using Contact = BodyContactScratch::Contact;
    using Pair = BodyContactScratch::Pair;
    using Side = BodyContactScratch::Side;
    using Points = std::array<glm::dvec3, 4>;
    using Weights = std::array<double, 4>;
    /// Response of a contact for given positions of its features.
    struct Response {
        glm::dvec3 force{0.0};                        ///< on b
        glm::dvec3 normal{0.0};                       ///< from a to b
        double gap = 0.0, along = 0.0, across = 0.0;  ///< stiffness along the normal, and along the surface
        Weights weights{};
    };
    struct Nearest {
        Weights weights{};
        glm::dvec3 between{0.0};
    };

    // body_search.cpp
    void search(const std::vector<glm::dvec3>& ends);
    bool update_drift(const std::vector<glm::dvec3>& ends);
    bool left_search_range();
    void measure_moves();
    template <class Visit>
    void each_listed(Visit visit) const;
    double max_approach(const Candidate& pair, double Scratch::Listed::*travel) const;
    void list_candidates();
    void add_features(const Plan::Chunk& chunk);
    void search_chunks(const BodyContactScratch::Chunk& c, const BodyContactScratch::Chunk& d);
    void add_candidate(const BodyContactScratch::Feature& a, const BodyContactScratch::Feature& b);
    bool is_local_minimum(const Pair& pair) const;
    void choose_contacts();
    void warm_start();
    static Nearest nearest_of(const Candidate& pair, const Points& at);
    static Points points_of(const Candidate& pair, const std::vector<glm::dvec3>& at) {
        return {at[pair.points[0]], at[pair.points[1]], at[pair.points[2]], at[pair.points[3]]};
    }

    // body_contacts.cpp
    void order_sides();
    void choose_stiffness();
    double effective_mass(std::size_t side) const;
    glm::dvec3 expected_position(std::uint32_t chain, std::uint32_t node) const;
    Response respond(const Contact& contact, const Points& at) const;
    Response respond(const Contact& contact) const;
    void set_pushes(std::uint32_t chain, std::span<const Side> sides);
    double update_forces();
    std::uint32_t first_of(std::uint32_t body) const;
    void join(const Pair& pair);
    std::span<const Side> sides_of(std::uint32_t chain) const;
    ContactScratch& chain_scratch(std::uint32_t chain) const { return scratch_.chain_contacts[chain]; }

    // body_passing.cpp
    bool crosses(const Candidate& pair, const Points& from, const Points& to, const glm::dvec3& normal,
                 int depth, Weights& where) const;
    bool crosses(const Pair& pair, Weights& where) const;
    void separate(const Pair& pair, const Weights& where);

    BodyContactScratch& s_;
};

}  // namespace tendril::rope
