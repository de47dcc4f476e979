#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

#include <algorithm>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/kit/code_text.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

constexpr std::size_t max_line = 110;

std::string bone_text(std::size_t bone) {
    return std::string("humanoid::Bone::") + humanoid::name(static_cast<Bone>(bone));
}

std::string transform_text(const rig::Transform& transform) {
    std::string text = '{' + braced(transform.translation) + ", " + braced(transform.rotation);
    if (transform.scale != glm::dvec3(1.0)) text += ", " + braced(transform.scale);
    return text + '}';
}

/// hills() of ik_settings.hpp.
constexpr const char* hills_text =
    R"(    humanoid::HeightField field{.x = -20.0, .z = -20.0, .cell = 0.25, .columns = 161, .heights = {}};
    for (int row = 0; row < 161; ++row)
        for (int column = 0; column < 161; ++column) {
            const double x = -20.0 + 0.25 * column, z = -20.0 + 0.25 * row;
            const double flat = std::clamp(std::sqrt(x * x + z * z) - 0.3, 0.0, 1.0);
            field.heights.push_back(flat * (0.10 * math::sine(1.3 * z + 0.4 * x) + 0.06 * math::sine(1.9 * x - 0.5 * z) +
                                            0.03 * math::sine(3.1 * z + 1.1)));
        }
    const humanoid::Ground ground = *humanoid::Ground::terrain(field);
)";

class HumanoidProgram {
  public:
    HumanoidProgram(const HumanoidPart& part, Solvers& solvers)
        : part_(part), solvers_(solvers), body_(solvers.body(part) != nullptr) {}

    std::string text() {
        head();
        nodes();
        line("int main() {");
        make();
        ground();
        feet();
        body();
        gaze();
        hands();
        curves();
        springs();
        frame();
        line("}");
        return std::move(code_);
    }

  private:
    void line(const std::string& text) { (code_ += text) += '\n'; }
    void say(const std::string& text) { line(text.empty() ? text : "    " + text); }
    /// Writes `opening`, the entries separated by commas, and `closing`, filling each line.
    void list(const std::string& opening, const std::vector<std::string>& entries,
              const std::string& closing) {
        std::string row = "    " + opening;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const std::string next = entries[i] + (i + 1 < entries.size() ? "," : closing);
            if (row.size() + 1 + next.size() > max_line)
                line(std::exchange(row, "        " + next));
            else
                row += (i == 0 ? "" : " ") + next;
        }
        line(entries.empty() ? row + closing : row);
    }
    /// Makes a solver, or ends the program with the reason.
    void make_solver(const std::string& type, const std::string& name, const std::string& arguments) {
        say("Expected<humanoid::" + type + "> " + name + " = humanoid::" + type + "::make(" + arguments +
            ");");
        say("if (!" + name + ") return std::puts(" + name + ".message()), 1;");
    }

    bool hilly() const { return feet_on() && part_.ik.ground.kind == humanoid::GroundKind::Terrain; }
    bool uses_map() const {
        return body_on() || feet_on() || gaze_on() || hands_on() || !part_.springs.empty();
    }
    bool hands_on() const { return part_.ik.hand_ik.on && solvers_.hands(part_) != nullptr; }
    bool gaze_on() const { return part_.ik.look_at.on && solvers_.look_at(part_) != nullptr; }
    bool feet_on() const { return part_.ik.foot_ik.on && solvers_.feet(part_) != nullptr; }
    std::vector<humanoid::BodyTarget> targets() const { return body_targets(part_.ik); }
    bool acts() const { return body_acts(part_, part_.ik_state); }
    bool body_on() const { return body_ && (acts() || part_.ik.self_collision); }

    void head() {
        const std::string file = std::filesystem::path(part_.loaded->file).filename().string();
        line("// A character of " + std::to_string(part_.skeleton().size()) +
             " nodes, exported from Tendril. Solves one frame.");
        if (!file.empty()) line("// From " + string_text(file));
        line("//");
        line("// CMake: find_package(tendril REQUIRED)");
        line("//        target_link_libraries(your_program PRIVATE tendril::core)");
        if (hilly()) line("#include <algorithm>");
        if (hilly()) line("#include <cmath>");
        line("#include <cstdio>");
        line("#include <iterator>");
        if (!part_.curves.empty()) line("#include <tendril/humanoid/bent_chain.hpp>");
        if (hilly()) line("#include <tendril/elementary.hpp>");
        if (body_on()) line("#include <tendril/humanoid/body.hpp>");
        if (uses_map()) line("#include <tendril/humanoid/bone_map.hpp>");
        if (feet_on()) line("#include <tendril/humanoid/feet.hpp>");
        if (hands_on()) line("#include <tendril/humanoid/hands.hpp>");
        if (body_on() && part_.ik.hold) line("#include <tendril/humanoid/hold.hpp>");
        if (gaze_on()) line("#include <tendril/humanoid/look_at.hpp>");
        line("#include <tendril/humanoid/skeleton.hpp>");
        if (!part_.springs.empty()) line("#include <tendril/humanoid/spring_chain.hpp>");
        line("#include <utility>");
        line("#include <vector>");
        line("");
        line("using namespace tendril;");
        line("");
    }

    void nodes() {
        line("struct NodeRow {");
        say("const char* name;");
        say("int parent;           // -1: a root");
        say("rig::Transform rest;  // local: metres; w, x, y, z; scale");
        line("};");
        line("const NodeRow node_rows[] = {");
        for (const humanoid::Node& node : part_.skeleton().nodes())
            say('{' + string_text(node.name) + ", " + std::to_string(node.parent) + ", " +
                transform_text(node.rest) + "},");
        line("};");
        line("");
        const std::vector<rig::Transform> pose = unsolved_pose(part_);
        posed_ = pose != humanoid::rest_pose(part_.skeleton());
        if (!posed_) return;
        line("// The animation at this moment, local to the parents.");
        line("const rig::Transform pose_rows[] = {");
        for (const rig::Transform& each : pose) say(transform_text(each) + ',');
        line("};");
        line("");
    }

    void make() {
        say("std::vector<humanoid::Node> nodes;");
        say("for (const NodeRow& row : node_rows) nodes.push_back({row.name, row.parent, row.rest});");
        make_solver("Skeleton", "skeleton", "std::move(nodes)");
        if (!uses_map()) return;
        say("");
        say("humanoid::BoneMap map;");
        for (std::size_t i = 0; i < humanoid::bone_count; ++i)
            if (const auto node = part_.map->bones[i].node; node >= 0)
                say("map[" + bone_text(i) + "].node = " + std::to_string(node) + ";  // " +
                    Json(part_.skeleton()[static_cast<std::size_t>(node)].name)
                        .dump(-1, ' ', false, Json::error_handler_t::replace));
        say("humanoid::review(map, *skeleton);");
    }

    void ground() {
        if (!feet_on()) return;
        const GroundSetting& setting = part_.ik.ground;
        const auto made = [&](const std::string& how) {
            say("const humanoid::Ground ground = *humanoid::Ground::" + how + ';');
        };
        say("");
        switch (setting.kind) {
            case humanoid::GroundKind::None:
                return say("const humanoid::Ground ground;  // none");
            case humanoid::GroundKind::Flat:
                return made("flat()");
            case humanoid::GroundKind::Slope:
                return made("slope(" + double_text(glm::radians(setting.angle_deg)) + ")");
            case humanoid::GroundKind::Stairs:
                return made("stairs(" + double_text(setting.step_height) + ", " +
                            double_text(setting.step_depth) + ')');
            case humanoid::GroundKind::Mesh:
                say("// Pass the triangles of " +
                    string_text(std::filesystem::path(setting.mesh->path).filename().string()) +
                    " to humanoid::Ground::mesh().");
                return say("const humanoid::Ground ground;");
            case humanoid::GroundKind::Terrain:
                break;
        }
        code_ += hills_text;
    }

    humanoid::FeetState feet_state() {
        IkState state = part_.ik_state;
        return solve_pose(part_, solvers_, 0.0, state).feet_state;
    }

    void feet() {
        if (!feet_on()) return;
        const humanoid::FeetOptions options = feet_options(part_, solvers_);
        const humanoid::Soles& soles = solvers_.feet(part_)->soles();
        const bool learned = !(soles == *humanoid::find_soles(part_.skeleton(), *part_.map));
        if (learned) {
            say("// The soles as the clip has them.");
            say("humanoid::Soles soles = *humanoid::find_soles(*skeleton, map);");
            for (std::size_t i = 0; i < 2; ++i) {
                const std::string foot = "soles.feet[" + std::to_string(i) + "].";
                say(foot + "heel = " + braced(soles.feet[i].heel) + ';');
                say(foot + "toe = " + braced(soles.feet[i].toe) + ';');
            }
        }
        make_solver("Feet", "feet", learned ? "*skeleton, map, soles" : "*skeleton, map");
        list("const humanoid::FeetOptions feet_options{", member_texts(options), "};");
        const humanoid::FeetState state = feet_state();
        say("humanoid::FeetState feet_state" + struct_text(state, "        ") + ';');
    }

    void limits() {
        const humanoid::BodyLimits in_force = solvers_.limits(part_).in_force(part_.ik);
        const humanoid::BodyLimits adult = humanoid::default_limits(part_.skeleton(), *part_.map);
        const bool from_adult = part_.ik.limits != LimitsFrom::None;
        const humanoid::BodyLimits base = from_adult ? adult : humanoid::no_limits();
        say(std::string("humanoid::BodyLimits limits = humanoid::") +
            (from_adult ? "default_limits(*skeleton, map);" : "no_limits();"));
        for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
            if (in_force[i] == base[i]) continue;
            const std::string name = "limits[static_cast<std::size_t>(" + bone_text(i) + ")]";
            if (in_force[i].kind == ik::JointKind::Free)
                say(name + " = {};");
            else
                code_ += limit_text(name, in_force[i], "    ");
        }
    }

    /// Members of a BodyTarget or a HandTarget.
    static std::vector<std::string> target_members(const auto& target) {
        std::vector<std::string> members{".position = " + braced(target.position)};
        if (target.rotation) members.push_back(".rotation = glm::dquat" + braced(*target.rotation));
        members.push_back(".weight = " + double_text(target.weight));
        return members;
    }

    void body() {
        if (!body_on()) return;
        say("");
        limits();
        const std::vector<humanoid::BodyCapsule>& capsules = solvers_.capsules(part_);
        std::vector<std::string> rows;
        for (const humanoid::BodyCapsule& each : capsules)
            rows.push_back('{' + bone_text(static_cast<std::size_t>(each.bone)) + ", " + braced(each.from) +
                           ", " + braced(each.to) + ", " + double_text(each.radius) + '}');
        if (!rows.empty()) list("const humanoid::BodyCapsule capsules[] = {", rows, "};");
        make_solver("Body", "body",
                    rows.empty() ? "*skeleton, map, limits" : "*skeleton, map, limits, capsules");
        say("std::vector<humanoid::BodyTarget> targets;");
        for (const humanoid::BodyTarget& target : targets()) {
            std::vector<std::string> members = target_members(target);
            members.insert(members.begin(),
                           ".effector = humanoid::Effector::" + pascal_text(humanoid::name(target.effector)));
            list("targets.push_back({", members, "});");
        }
        const humanoid::BodyOptions options = body_options(part_, solvers_);
        if (options.balance) {
            std::vector<std::string> members = member_texts(options);
            if (humanoid::FootstepsState steps = part_.ik_state.steps; steps.away()) {
                std::string feet = ".feet = {";  // the shifts of feet that have stepped
                for (const humanoid::FootShift& each :
                     humanoid::advance_steps(steps, solvers_.feet(part_)->soles(), 0.0))
                    feet += (feet.back() == '{' ? "humanoid::FootShift{" : ", humanoid::FootShift{") +
                            braced(each.stand) + ", " + double_text(each.lift) + '}';
                members.push_back(feet + '}');
            }
            if (options.ground != nullptr) members.push_back(".ground = &ground");
            list("const humanoid::BodyOptions body_options{", members, "};");
        }
        say("humanoid::BodyState body_state;");
        body_state(part_.ik_state.body);
        hold();
    }

    void hold() {
        if (!part_.ik.hold) return;
        say("const humanoid::Grip grips[] = {  // where the hands hold the " +
            std::string(held_kinds.title(part_.ik.hold->kind)) + ", in its frame");
        for (const humanoid::Grip& each :
             held_grips(*part_.ik.hold, *solvers_.body(part_), part_.loaded->height())) {
            say("    {humanoid::Effector::" + pascal_text(humanoid::name(each.hand)) + ", " +
                braced(each.position) + ',');
            say("     glm::dquat" + braced(*each.rotation) + ", " + braced(each.axis) + "},");
        }
        say("};");
        if (part_.ik.hold->with_body) {
            const std::size_t hips = *part_.node_of(humanoid::Bone::Hips);
            say("// Where it is asked to be, from the hips and turned with them.");
            say("const humanoid::ObjectPose from_hips{" + braced(part_.ik.hold->position) + ',');
            say("                                     " + braced(part_.ik.hold->rotation) + "};");
            say("const std::size_t hips = *skeleton->find(" + string_text(part_.skeleton()[hips].name) +
                ");");
            say("const glm::dquat hips_at_rest" + braced(part_.loaded->rest[hips].rotation()) + ';');
        } else {
            say("const humanoid::ObjectPose asked{" + braced(part_.ik.hold->position) + ',');
            say("                                 " + braced(part_.ik.hold->rotation) + "};");
        }
        say("humanoid::HoldState hold_state;");
    }

    void asked() {
        if (!part_.ik.hold || !part_.ik.hold->with_body) return;
        say("humanoid::place(*skeleton, pose, placed);");
        say("const glm::dquat turn = rig::normalised(placed[hips].rotation() * "
            "glm::conjugate(hips_at_rest));");
        say("const humanoid::ObjectPose asked{placed[hips].position + turn * from_hips.position,");
        say("                                 rig::normalised(turn * from_hips.rotation)};");
    }

    void body_state(const humanoid::BodyState& state) {
        if (state == humanoid::BodyState()) return;
        say("// Where the last solve ended.");
        list("body_state = {", member_texts(state), "};");
    }

    void gaze() {
        if (!gaze_on()) return;
        const humanoid::LookAtOptions options = look_options(part_, body_on() && acts());
        say("");
        make_solver("LookAt", "look", "*skeleton, map");
        list("const humanoid::LookAtOptions look_options{", member_texts(options), "};");
        say("humanoid::LookAtState look_state" + struct_text(part_.ik_state.look) + ';');
    }

    void hands() {
        if (!hands_on()) return;
        say("");
        make_solver("Hands", "hands", "*skeleton, map");
        say("humanoid::HandTargets hand_targets{};");
        const humanoid::HandTargets all = hand_targets(part_);
        for (std::size_t hand = 0; hand < 2; ++hand) {
            if (part_.ik.hand_target(hand) == nullptr) continue;
            list("hand_targets[" + std::to_string(hand) + "] = {", target_members(all[hand]),
                 hand == 0 ? "};  // left" : "};  // right");
        }
        list("const humanoid::HandsOptions hands_options{", member_texts(part_.ik.hand_ik.options), "};");
        say("humanoid::HandsState hands_state" + struct_text(part_.ik_state.hands, "        ") + ';');
    }

    void curves() {
        const BentChains& chains = solvers_.curves(part_);
        for (std::size_t i = 0; i < chains.size(); ++i) {
            if (chains[i] == nullptr) continue;
            const BoneCurve& curve = part_.curves[i];
            const std::string name = "curve_" + std::to_string(i);
            const auto found = [](const std::string& node) {
                return "*skeleton->find(" + string_text(node) + ')';
            };
            say("");
            make_solver("BentChain", name, "*skeleton, " + found(curve.first) + ", " + found(curve.last));
            std::vector<std::string> points, factors;
            for (const glm::vec3& each : curve.shape.points) points.push_back(braced(each));
            say("// Control points, in the space of the node that the chain hangs on; metres.");
            list("const glm::vec3 " + name + "_points[] = {", points, "};");
            const std::vector<float> weights = curve_weights(curve.shape, chains[i]->bones());
            for (const float each : weights) factors.push_back(literal(each));
            if (!factors.empty()) list("const float " + name + "_weights[] = {", factors, "};");
            std::vector<std::string> members = member_texts(curve.shape.options);
            if (!factors.empty()) members.push_back(".weights = " + name + "_weights");
            list("const ik::CurveOptions " + name + "_options{", members, "};");
        }
    }

    void springs() {
        const SpringChains& chains = solvers_.springs(part_);
        for (std::size_t i = 0; i < chains.size(); ++i) {
            if (chains[i] == nullptr) continue;
            const std::string name = "spring_" + std::to_string(i);
            say("");
            make_solver("SpringChain", name,
                        "*skeleton, map, *skeleton->find(" + string_text(part_.springs[i].node) + ')');
            list("const humanoid::SpringOptions " + name + "_options{",
                 member_texts(part_.springs[i].options), "};");
            say("humanoid::SpringChainState " + name + "_state;");
            if (i >= part_.ik_state.springs.size()) continue;
            for (const humanoid::SpringMass& mass : part_.ik_state.springs[i].masses)
                list(name + "_state.masses.push_back({", member_texts(mass), "});");
        }
    }

    void swing() {
        const SpringChains& chains = solvers_.springs(part_);
        bool placed = false;
        for (std::size_t i = 0; i < chains.size(); ++i) {
            if (chains[i] == nullptr) continue;
            const std::string name = "spring_" + std::to_string(i);
            const NamedSpring* const file = colliding(part_, part_.springs[i]);
            if (file != nullptr) {
                if (!std::exchange(placed, true)) say("humanoid::place(*skeleton, pose, placed);");
                std::vector<std::string> rows;
                for (const SpringCollider& each : file->colliders) {
                    const std::string at = "placed[*skeleton->find(" +
                                           string_text(part_.skeleton()[each.node].name) + ")].apply(";
                    rows.push_back("{" + at + braced(each.from) + "), " + at + braced(each.to) + "), " +
                                   double_text(each.radius) + "}");
                }
                list("const humanoid::PlacedCapsule " + name + "_colliders[] = {", rows, "};");
            }
            say(name + "->step(pose, " + name + "_options, dt, " + name + "_state" +
                (file != nullptr ? ", " + name + "_colliders" : "") + ");");
        }
    }

    void frame() {
        say("");
        say("// In each frame: the animation's pose, then what changes it, in this order.");
        if (part_.ik_state.release.left > 0.0)
            say("// A target was just released; the lab fades the difference out, this program does not.");
        const SpringChains& chains = solvers_.springs(part_);
        const bool swings = std::ranges::any_of(chains, [](const auto& chain) { return chain != nullptr; });
        if (feet_on() || hands_on() || gaze_on() || swings)
            say("const double dt = 0.0;  // seconds since the last frame");
        say(posed_ ? "std::vector<rig::Transform> pose(std::begin(pose_rows), std::end(pose_rows));"
                   : "std::vector<rig::Transform> pose = humanoid::rest_pose(*skeleton);");
        const auto solve = [&] {
            const std::string options = part_.ik.balance.body.balance ? ", body_options" : "";
            if (part_.ik.hold)
                say("if (const auto solved = humanoid::hold(*body, pose, targets, {grips, asked}, "
                    "body_state, hold_state" +
                    (options.empty() ? options : ", {.body = body_options}") + "); !solved)");
            else
                say("if (const auto solved = body->solve(pose, targets, body_state" + options +
                    "); !solved)");
            say("    std::puts(solved.message());");
        };
        for (std::size_t i = 0; i < part_.curves.size(); ++i)
            if (const std::string name = "curve_" + std::to_string(i); solvers_.curves(part_)[i] != nullptr)
                say(name + "->bend(pose, " + name + "_points, " + name + "_options);");
        if (feet_on()) say("feet->step(pose, ground, dt, feet_state, feet_options);");
        say("std::vector<humanoid::Placement> placed(skeleton->size());");
        if (body_on() && acts()) asked(), solve();
        if (gaze_on()) say("look->step(pose, look_options, dt, look_state);");
        if (hands_on()) say("hands->step(pose, hand_targets, dt, hands_state, hands_options);");
        if (body_on() && !acts()) solve();
        swing();
        say("humanoid::place(*skeleton, pose, placed);");
        say("for (const humanoid::Placement& each : placed)");
        say("    std::printf(\"%.17g %.17g %.17g\\n\", each.position.x, each.position.y, each.position.z);");
    }

    const HumanoidPart& part_;
    Solvers& solvers_;
    const bool body_;
    bool posed_ = false;
    std::string code_;
};

}  // namespace

std::string humanoid_code(const HumanoidPart& part, Solvers& solvers) {
    return HumanoidProgram(part, solvers).text();
}

}  // namespace tendril::app
