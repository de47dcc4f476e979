// Shared by tests of the Rig lab.
#pragma once

#include <string>

#include "app/labs/rig/rig_lab.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

inline Json transform(double x, double y, double z) {
    return {{"translation", {x, y, z}}};
}

class RigTest : public LabTest {
  protected:
    RigTest() : LabTest(rig_lab) { run("rig.clear"); }

    const RigPart& part() const { return rig_part(workspace); }
    void element(const char* name, const char* parent = "", const Json& local = Json::object()) {
        Json arguments{{"name", name}, {"kind", "bone"}, {"local", local}};
        if (*parent != '\0') arguments["parent"] = parent;
        run("rig.element.add", arguments);
    }
    void control(const char* name, const char* kind, const Json& more = Json::object()) {
        Json arguments{{"name", name}, {"kind", "control"}, {"control", kind}};
        arguments.update(more);
        run("rig.element.add", arguments);
    }
    void set(const char* name, const Json& value) {
        run("rig.control.set", {{"name", name}, {"value", value}});
    }
    void unit(const Json& unit) { run("rig.unit.add", unit); }
    void solve(const char* direction = "forward") { run("rig.solve", {{"direction", direction}}); }
    void tick(int count = 1) {
        for (int i = 0; i < count; ++i)
            if (lab().moving(workspace)) lab().step(workspace);
    }

    Json list(const char* name) const { return state().at(name); }
    Json named(const char* in, const std::string& name) const {
        for (const Json& each : this->list(in))
            if (each.at("name") == name) return each;
        ADD_FAILURE() << "there is no " << name << " in " << in;
        return {};
    }
    glm::dvec3 translation(const std::string& name, const char* space = "global") const {
        const Json at = named("elements", name).at(space).at("translation");
        return {at[0].get<double>(), at[1].get<double>(), at[2].get<double>()};
    }
    glm::dquat rotation(const std::string& name, const char* space = "global") const {
        const Json q = named("elements", name).at(space).at("rotation");
        return {q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>()};
    }
    Json output(const std::string& unit, const char* output = "result") const {
        return named("units", unit).at("outputs").at(output);
    }
};

}  // namespace tendril::app
