// Resolves the names in the inputs of units, and refuses what is missing or has the wrong type. Not
// installed.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/rig/definition.hpp"
#include "tendril/rig/fields.hpp"

namespace tendril::rig {

/// List indices by name.
using Names = std::map<std::string, std::size_t, std::less<>>;

/// Walks the units of a rig in the order in which they run and resolves the names in their inputs.
class Resolver {
  public:
    Resolver(const Definition& definition, const Names& elements, const Names& curves)
        : definition_(definition), elements_(elements), curves_(curves) {}

    /// The first refusal, or success.
    Result resolve(std::vector<Unit>& units);
    /// The names of all units, those in bodies after their for-each, and the outputs of each.
    std::vector<std::string> names;
    std::vector<std::vector<Output>> outputs;

  private:
    struct Found {
        std::size_t index;
        const std::vector<Unit>* body;  ///< that contains it, if any
    };

    void unit(Unit& unit);
    void spring(std::vector<Output>& handed_out);
    void refuse(const std::string& what);
    void field(const std::string& name, Item& item);
    void field(const std::string& name, AimInputs& inputs);
    void field(const std::string& name, std::vector<ParentInputs>& parents);
    void field(const std::string& name, Body& body);
    void field(const std::string& name, std::vector<std::string>& roots);
    void field(const std::string&, std::string&) {}
    void field(const std::string& name, std::array<double, 2>& range);
    void field(const std::string& name, Space& space);
    void field(const std::string& name, signal::Curve& curve);
    void field(const std::string&, TransformFilter&) {}
    void field(const std::string&, AimTarget&) {}
    void field(const std::string&, bool&) {}
    template <class T>
    void field(const std::string& name, std::optional<T>& maybe) {
        if (maybe) field(name, *maybe);
    }
    template <class T>
    void field(const std::string& name, Input<T>& input);

    Type type_of_source(const std::string& name, FromElement& from);
    Type type_of_source(const std::string& name, FromUnit& from);
    Type type_of_source(const std::string& name, Each& each);
    void check_literal(const std::string& name, const Value& value);

    const Definition& definition_;
    const Names &elements_, &curves_;
    std::map<std::string, Found, std::less<>> units_;  ///< that run before the current one
    std::set<std::string> taken_;                      ///< unit names in use
    const std::vector<Unit>* for_each_ = nullptr;      ///< the body being resolved
    std::vector<Type> any_types_;  ///< of the unit's inputs that take any type: a spring's target and force
    std::string place_;            ///< `unit "look"`
    Result refusal_;
};

/// Whether an input of one type accepts a value of the other: the same type, a bool as 0 or 1, the
/// translation or the rotation of a transform.
bool converts(Type from, Type to) noexcept;

}  // namespace tendril::rig
