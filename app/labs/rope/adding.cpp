// What the Rope lab's panel adds: where there is free space, and selected at once.
#include <imgui.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "app/labs/rope/panels.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// "ball", "ball 2", ...: the first name that is not taken.
template <class Taken>
std::string free_name(const std::string& kind, Taken taken) {
    std::string name = kind;
    for (int i = 2; taken(name); ++i) name = kind + " " + std::to_string(i);
    return name;
}

/// The middle of the view, or as near to it as nothing is in the way: to the right of it and nearer, one
/// after the other.
glm::vec3 free_place(const Workspace& workspace) {
    constexpr float apart = 0.35f;  // metres
    const rope::State& state = rope_part(workspace).world->state();
    const auto taken = [&](glm::vec3 at) {
        const auto near = [&](glm::vec3 other) { return glm::distance(at, other) < apart; };
        return std::any_of(state.colliders.begin(), state.colliders.end(),
                           [&](const rope::Collider& each) { return near(rope::centre(each.shape)); }) ||
               std::any_of(state.bodies.begin(), state.bodies.end(), [&](const rope::Body& body) {
                   return near(glm::vec3(state.position[body.first + body.count / 2]));
               });
    };
    const glm::vec3 middle = workspace.camera.target;
    for (int ring = 0; ring < 40; ++ring) {
        for (int side = 0; side <= ring; ++side) {
            const float right = static_cast<float>(ring - side), nearer = static_cast<float>(side);
            const glm::vec3 at = middle + 2.0f * apart * glm::vec3(right, 0.0f, nearer);
            if (!taken(at)) return at;
        }
    }
    return middle;
}

class Adding {
  public:
    Adding(const Workspace& workspace, Emit& emit)
        : workspace_(workspace), part_(rope_part(workspace)), emit_(emit) {}

    void bodies() {
        if (row_button("Rope", 3, true, "A rope that hangs between two pins")) {
            const glm::vec3 at = free_place(workspace_);
            body("rope.add", "rope",
                 {{"from", at + glm::vec3(-0.6f, 0.6f, 0.0f)},
                  {"to", at + glm::vec3(0.6f, 0.6f, 0.0f)},
                  {"length", 1.7f},
                  {"segments", 48},
                  {"pin_start", true},
                  {"pin_end", true}});
        }
        if (row_button("Cloth", 3, true, "A cloth that hangs by two corners")) {
            const glm::vec3 at = free_place(workspace_);
            body("rope.cloth.add", "cloth",
                 {{"corner", at + glm::vec3(-0.5f, 0.8f, 0.0f)},
                  {"along", glm::vec3(1, 0, 0)},
                  {"down", glm::vec3(0.0f, -0.6f, 0.8f)},
                  {"pins", "corners"}});
        }
        const bool on_collider = part_.selection && !part_.selection->collider.empty();
        if (row_button("Hair", 3, true, "Strands of hair: on the selected collider, or from a point")) {
            ArgumentList arguments{{"strands", 48}, {"length", 0.6f}};
            if (on_collider)
                arguments.push_back({"attach", part_.selection->collider});
            else
                arguments.push_back({"centre", free_place(workspace_) + glm::vec3(0.0f, 0.5f, 0.0f)});
            body("rope.hair.add", "hair", std::move(arguments));
        }
        end_row();
    }

    void colliders() {
        using Shape = ArgumentList (*)(glm::vec3);
        const auto row = [&](const char* title, const char* name, const char* kind, Shape shape) {
            const bool plane = std::string(kind) == "plane";
            const char* const tip =
                plane ? "A plane at the height of the grid" : "A collider near the middle of the view";
            if (row_button(title, 4, true, tip)) collider(name, kind, shape(free_place(workspace_)));
        };
        row("Ball", "ball", "sphere", [](glm::vec3 at) {
            return ArgumentList{{"centre", at}, {"radius", 0.25f}};
        });
        row("Bar", "bar", "capsule", [](glm::vec3 at) {
            const glm::vec3 half(0.0f, 0.0f, 0.5f);
            return ArgumentList{{"a", at - half}, {"b", at + half}, {"radius", 0.1f}};
        });
        row("Box", "box", "box", [](glm::vec3 at) {
            return ArgumentList{{"centre", at}, {"half_extents", glm::vec3(0.25f)}};
        });
        row("Floor", "floor", "plane", [](glm::vec3) {
            return ArgumentList{{"point", glm::vec3(0.0f)}, {"normal", glm::vec3(0, 1, 0)}};
        });
        end_row();
    }

  private:
    void body(const char* command, const char* kind, ArgumentList arguments) {
        const auto taken = [&](const std::string& n) { return part_.world->find(n) != nullptr; };
        const std::string name = free_name(kind, taken);
        arguments.push_back({"name", name});
        emit_(command, arguments);
        emit_("rope.select", {{"rope", name}, {"particle", 0}});
    }
    void collider(const char* name, const char* kind, const ArgumentList& shape) {
        const auto taken = [&](const std::string& n) { return part_.world->find_collider(n) != nullptr; };
        const std::string free = free_name(name, taken);
        ArgumentList arguments{{"name", free}, {"kind", kind}};
        arguments.insert(arguments.end(), shape.begin(), shape.end());
        emit_("rope.collider.add", arguments);
        emit_("rope.select", {{"collider", free}});
    }

    const Workspace& workspace_;
    const RopePart& part_;
    Emit& emit_;
};

}  // namespace

void adding_rows(const Workspace& workspace, Emit& emit) {
    ImGui::PushID("add");  // a scene and a button of this section may have the same title
    Adding adding(workspace, emit);
    adding.bodies();
    adding.colliders();
    ImGui::PopID();
}

}  // namespace tendril::app
