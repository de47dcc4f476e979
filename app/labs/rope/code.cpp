#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_lab.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_line = 100;

std::string link_text(const rope::Link& link) {
    constexpr const char* kinds[] = {"Stretch", "Shear", "Bend"};
    return '{' + std::to_string(link.a) + ", " + std::to_string(link.b) + ", " + literal(link.rest) + ", " +
           kinds[static_cast<std::size_t>(link.kind)] + ", " + literal(link.compliance) + ", " +
           literal(link.tension) + '}';
}

std::string particle_text(const rope::State& state, std::size_t i) {
    return '{' + braced(state.position[i]) + ", " + braced(state.displacement[i]) + ", " +
           double_text(state.mass[i]) + '}';
}

std::string shape_text(const rope::Collider& collider) {
    return "rope::" + pascal_text(rope::kind(collider.shape)) + struct_text(shape_fields(collider));
}

/// The index in state.colliders, whose order number_slots() follows.
std::size_t place_of(const rope::State& state, rope::ColliderId collider) {
    const auto found = std::ranges::find(state.colliders, collider, &rope::Collider::id);
    return static_cast<std::size_t>(found - state.colliders.begin());
}

class RopeProgram {
  public:
    explicit RopeProgram(const RopePart& part) : part_(part), world_(*released(part)) {}

    std::string text() {
        head();
        tables();
        line("rope::State exported_state() {");
        state();
        line("}");
        line("");
        line("int main() {");
        main();
        line("}");
        return std::move(code_);
    }

  private:
    void line(const std::string& text) { (code_ += text) += '\n'; }
    void say(const std::string& text) { line("    " + text); }

    void head() {
        const rope::State& state = world_.state();
        line("// A rope world of " + std::to_string(state.position.size()) +
             " particles, exported from Tendril. Simulates one second.");
        line("//");
        line("// CMake: find_package(tendril REQUIRED)");
        line("//        target_link_libraries(your_program PRIVATE tendril::core)");
        line("#include <cstdio>");
        line("#include <iterator>");
        if (!part_.swings.empty()) line("#include <tendril/elementary.hpp>");
        line("#include <tendril/rope/world.hpp>");
        line("");
        line("using namespace tendril;");
        line("");
    }

    /// Writes `opening`, the entries separated by commas, then `closing`, filling each line.
    void list(const std::string& opening, const std::vector<std::string>& entries, const std::string& closing,
              const std::string& margin = "    ") {
        std::string row = entries.empty() ? opening + closing : opening;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const std::string next = entries[i] + (i + 1 < entries.size() ? "," : closing);
            if (i > 0 && row.size() + 1 + next.size() > max_line)
                line(std::exchange(row, margin + next));
            else
                row += (i == 0 ? "" : " ") + next;
        }
        line(row);
    }
    template <class Entry>
    void table(const std::string& name, std::size_t count, Entry entry) {
        if (count == 0) return;
        std::vector<std::string> entries;
        for (std::size_t i = 0; i < count; ++i) entries.push_back(entry(i));
        line(name + " = {");
        list("    ", entries, "};");
        line("");
    }
    /// A comment with the user's name for the object.
    void name(const std::string& name) {
        say("// " + Json(name).dump(-1, ' ', false, Json::error_handler_t::replace));
    }
    /// Adds a body, collider, tie or pin: `members`, the fields of its table without their defaults, `last`.
    template <class Row>
    void add(const std::string& what, const Row& row, std::vector<std::string> members,
             const std::string& last = {}) {
        for (const Field& field : fields<Row>())
            if (field.type != FieldType::Kind)  // a collider's shape
                for (std::string& each : member_texts({{&field, 1}, &row, detail::fresh<Row>()}))
                    members.push_back(std::move(each));
        if (!last.empty()) members.push_back(last);
        list("    state." + what + ".push_back({", members, "});", "        ");
    }

    void tables() {
        const rope::State& state = world_.state();
        if (!state.position.empty()) {
            line("struct Particle {");
            say("glm::dvec3 position, displacement;  // metres; the displacement by the last substep");
            say("double mass;                        // kg");
            line("};");
        }
        table("const Particle particles[]", state.position.size(),
              [&](std::size_t i) { return particle_text(state, i); });
        if (!state.links.empty()) {
            line("using enum rope::Link::Kind;");
            line("// Two particles, the distance between them, kind, compliance, tension.");
        }
        table("const rope::Link links[]", state.links.size(),
              [&](std::size_t i) { return link_text(state.links[i]); });
    }

    void state() {
        const rope::State& state = world_.state();
        say("rope::State state;");
        list("    state.settings = {", member_texts(state.settings), "};", "        ");
        for (const rope::Body& body : state.bodies) {
            name(world_.name(body));
            add("bodies", body, {".id = {}"});
        }
        if (!state.position.empty()) {
            say("for (const Particle& each : particles) {");
            say("    state.position.push_back(each.position);");
            say("    state.displacement.push_back(each.displacement);");
            say("    state.mass.push_back(each.mass);");
            say("}");
        }
        if (!state.links.empty()) say("state.links.assign(std::begin(links), std::end(links));");
        for (const rope::Collider& collider : state.colliders) {
            name(world_.name(collider));
            add("colliders", collider, {".id = {}", ".shape = " + shape_text(collider)});
        }
        for (const rope::Tie& tie : state.ties) {
            name(world_.name(tie));
            add("ties", tie, {".id = {}"});
        }
        say("rope::number_slots(state);");
        for (const rope::Pin& pin : state.pins) {
            const std::string holder =
                pin.collider ? "state.colliders[" + std::to_string(place_of(state, pin.collider)) + "].id"
                             : "{}";
            add("pins", pin, {}, ".collider = " + holder);
        }
        for (std::size_t a = 0; a < state.bodies.size(); ++a)
            for (std::size_t b = a; b < state.bodies.size(); ++b)
                if (world_.world().collides(state.bodies[a].id, state.bodies[b].id))
                    say("state.collisions.push_back({state.bodies[" + std::to_string(a) +
                        "].id, state.bodies[" + std::to_string(b) + "].id});");
        for (const rope::BodyContact& each : state.contacts)
            list("    state.contacts.push_back({",
                 {".a = " + std::to_string(each.a), ".b = " + std::to_string(each.b),
                  ".force = " + braced(each.force)},
                 "});", "        ");
        say("state.remainder = " + double_text(state.remainder) + ';');
        say("state.displaced_in = " + double_text(state.displaced_in) + ';');
        say("return state;");
    }

    void main() {
        say("Expected<rope::World> made = rope::World::from_state(exported_state());");
        say("if (!made) return std::puts(made.error().message()), 1;");
        say("rope::World& world = *made;");
        say("rope::Workspace workspace;  // keep it from frame to frame");
        say("const double dt = 1.0 / 60.0;");
        if (!part_.swings.empty()) swing_function();
        say("for (int frame = 0; frame < 60; ++frame) {");
        if (!part_.swings.empty()) swings();
        say("    world.advance(dt, workspace);");
        say("}");
        say("for (const rope::Body& body : world.state().bodies)");
        say("    for (std::size_t i = body.first; i < body.first + body.count; ++i) {");
        say("        const glm::dvec3& at = world.position(i);");
        say("        std::printf(\"%.17g %.17g %.17g\\n\", at.x, at.y, at.z);");
        say("    }");
    }

    void swing_function() {
        say("// Sends a collider to middle + sin(2 pi time / period) * by.");
        say("const auto swing = [&](std::size_t collider, double time, const glm::vec3& middle, const "
            "glm::vec3& by,");
        say("                       float period) {");
        say("    const double rounds = time / static_cast<double>(period);");
        say("    const double angle = 6.283185307179586 * (rounds - std::floor(rounds));");
        say("    const glm::vec3 to = middle + static_cast<float>(math::sine(angle)) * by;");
        say("    const rope::ColliderId id = world.state().colliders[collider].id;");
        say("    if (const Result moved = world.move_collider(id, to, world.pending() + dt); !moved)");
        say("        std::puts(moved.message());");
        say("};");
    }
    void swings() {
        const long long tick = std::llround(part_.time / tick_seconds);
        say("    const double time = (" + std::to_string(tick + 1) + " + frame) * dt;");
        for (const Swing& swing : part_.swings)
            say("    swing(" +
                std::to_string(place_of(world_.state(), world_.find_collider(swing.collider)->id)) +
                ", time, " + braced(swing.middle) + ", " + braced(swing.swing) + ", " +
                literal(swing.period) + ");");
    }

    const RopePart& part_;
    NamedWorld world_;
    std::string code_;
};

}  // namespace

/// Complete program: the world without drags, simulated for one second in ticks of 1/60 s. Leaves out a
/// partial tick left over by slow motion or frame-time jitter.
std::string RopeLab::code(const Workspace& workspace) const {
    return RopeProgram(rope_part(workspace)).text();
}

}  // namespace tendril::app
