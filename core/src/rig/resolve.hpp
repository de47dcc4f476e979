// Finds what the inputs of units name, and refuses what is not there or does not fit. Not installed.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/rig/definition.hpp"
#include "tendril/rig/fields.hpp"

namespace tendril::rig {

/// Where in its list what has that name is.
using Names = std::map<std::string, std::size_t, std::less<>>;

/// Goes through the units of a rig in the order in which they run, filling in what their inputs name.
class Resolver {
  public:
    Resolver(const Definition& definition, const Names& elements, const Names& curves)
        : definition_(definition), elements_(elements), curves_(curves) {}

    /// The first refusal, or fine.
    Result resolve(std::vector<Unit>& units);
    /// Every unit, those in bodies after the for-each that has them, and what each hands out.
    std::vector<std::string> names;
    std::vector<std::vector<Output>> outputs;

  private:
    struct Found {
        std::size_t index;
        const std::vector<Unit>* body;  ///< that it stands in, if any
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
    std::map<std::string, Found, std::less<>> units_;  ///< that run before this one
    std::set<std::string> taken_;                      ///< names
    const std::vector<Unit>* for_each_ = nullptr;      ///< the body that is being resolved
    std::vector<Type> any_types_;  ///< of the inputs of the unit that take any: a spring's target and force
    std::string place_;            ///< `unit "look"`
    Result refusal_;
};

/// Whether an input of the one type can be given a value of the other: the same, a bool as 0 or 1, the
/// translation or the rotation of a transform.
bool converts(Type from, Type to) noexcept;

}  // namespace tendril::rig
