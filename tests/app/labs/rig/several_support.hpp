// Shared by tests of several selected elements.
#pragma once

#include <string>
#include <vector>

#include "rig_support.hpp"

namespace tendril::app {

using Names = std::vector<std::string>;

class SeveralElements : public RigTest {
  protected:
    Names selected() const { return state().at("selection").get<Names>(); }
    std::string active() const { return state().at("selected").at("element"); }
    void select(const Names& names, bool add = false) {
        run("rig.select", {{"elements", names}, {"add", add}});
    }
    void add(const std::string& name) { run("rig.select", {{"element", name}, {"add", true}}); }
    void set_all(const Names& names, const Json& value) {
        run("rig.control.set", {{"names", names}, {"value", value}});
    }
    Json value(const std::string& name) const { return named("elements", name).at("value"); }
    Json local(const std::string& name) const {
        return named("elements", name).at("local").at("translation");
    }
    std::size_t steps() const { return workspace.history.size(); }

    /// Two positions, two numbers, and a bone with two descendants in a row.
    void controls_and_bones() {
        control("left", "position", {{"maximum", {1, 1, 1}}, {"minimum", {-1, -1, -1}}});
        control("right", "position");
        control("dial", "float", {{"minimum", 0}, {"maximum", 1}});
        control("knob", "float");
        element("a", "", transform(0, 1, 0));
        element("b", "a", transform(0, 2, 0));
        element("c", "b", transform(0, 3, 0));
    }
};

}  // namespace tendril::app
