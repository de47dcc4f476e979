// Shared by tests of the Rig lab.
#pragma once

#include "app/labs/rig/rig_lab.hpp"
#include "tests/app/labs/app_support.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

inline Json transform(double x, double y, double z) {
    return {{"translation", {x, y, z}}};
}

class RigTest : public LabTest {
  protected:
    RigTest() : LabTest(rig_lab) { run("rig.clear"); }

    const RigPart& part() const { return rig_part(workspace); }
    static void expect_near(const glm::dvec3& a, const glm::dvec3& b, double within = 1e-9) {
        EXPECT_LE(glm::length(a - b), within)
            << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
    }
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
    void unit(const char* json) { unit(Json::parse(json)); }
    void solve(const char* direction = "forward") { run("rig.solve", {{"direction", direction}}); }

    Json list(const char* name) const { return state().at(name); }
    Json named(const char* in, const std::string& name) const {
        for (const Json& each : this->list(in))
            if (each.at("name") == name) return each;
        ADD_FAILURE() << "there is no " << name << " in " << in;
        return {};
    }
    glm::dvec3 translation(const std::string& name, const char* space = "global") const {
        return vector(named("elements", name).at(space).at("translation"));
    }
    glm::dquat rotation(const std::string& name, const char* space = "global") const {
        return quaternion(named("elements", name).at(space).at("rotation"));
    }
    Json output(const std::string& unit, const char* output = "result") const {
        return named("units", unit).at("outputs").at(output);
    }
};

/// The lab in the running program, paused.
class RigAppTest : public LabAppTest {
  protected:
    RigAppTest() : LabAppTest(rig_lab) {}

    /// At an angle, without perspective.
    void look_from(int metres) {
        run("camera.set", {{"target", {0, 0, 0}},
                           {"yaw_deg", 30},
                           {"pitch_deg", 25},
                           {"distance", metres},
                           {"orthographic", true}});
    }
    bool has_handle(const std::string& name) {
        const Json state = app_.state();
        return std::ranges::any_of(state.at("handles"),
                                   [&](const Json& each) { return each.at("name") == name; });
    }
    Json element(const std::string& name) {
        const Json state = app_.state();
        for (const Json& each : state.at("elements"))
            if (each.at("name") == name) return each;
        return nullptr;
    }
};

}  // namespace tendril::app
