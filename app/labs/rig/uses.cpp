#include "app/labs/rig/uses.hpp"

#include <tendril/rig/fields.hpp>

namespace tendril::app {
namespace {

class Search {
  public:
    Search(Named kind, const std::set<std::string>& names) : kind_(kind), names_(names) {}

    std::optional<Use> found;

    void units(const std::vector<rig::Unit>& list) {
        for (const rig::Unit& unit : list) {
            if (found) return;
            unit_ = &unit;
            field("weight", unit.weight);
            field("when", unit.when);
            std::visit([&](const auto& operation) { all("", operation); }, unit.operation);
        }
    }

  private:
    template <class T>
    void all(const std::string& place, const T& of) {
        rig::fields(of, [&](const char* name, const auto& member) { field(place + name, member); });
        if constexpr (std::is_same_v<T, rig::SetCurve>) take("curve", Named::Curve, of.curve);
    }

    void field(const std::string& place, const rig::Item& item) {
        if (const auto* element = std::get_if<std::string>(&item.which))
            take(place, Named::Element, *element);
    }
    template <class T>
    void field(const std::string& place, const rig::Input<T>& input) {
        if (const auto* from = std::get_if<rig::FromElement>(&input.source)) field(place, from->element);
        if (const auto* from = std::get_if<rig::FromUnit>(&input.source))
            take(place, Named::Unit, from->unit);
    }
    template <class T>
    void field(const std::string& place, const std::optional<T>& inputs) {
        if (inputs) field(place, *inputs);
    }
    void field(const std::string& place, const rig::AimInputs& inputs) { all(place + ".", inputs); }
    void field(const std::string& place, const std::vector<rig::ParentInputs>& parents) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            all(place + "[" + std::to_string(i) + "].", parents[i]);
    }
    void field(const std::string& place, const std::vector<std::string>& roots) {
        for (const std::string& root : roots) take(place, Named::Element, root);
    }
    void field(const std::string&, const rig::Body& body) { units(body.units()); }
    void field(const std::string&, const auto&) {}  // names nothing

    void take(const std::string& place, Named kind, const std::string& name) {
        if (!found && kind == kind_ && names_.contains(name)) found = {unit_->name, place, name};
    }

    Named kind_;
    const std::set<std::string>& names_;
    const rig::Unit* unit_ = nullptr;
};

}  // namespace

std::optional<Use> first_use(const std::vector<rig::Unit>& units, Named kind,
                             const std::set<std::string>& names) {
    Search search(kind, names);
    search.units(units);
    return search.found;
}

}  // namespace tendril::app
