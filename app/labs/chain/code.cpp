
#include <algorithm>
#include <string_view>
#include <tendril/ik/solver.hpp>
#include <utility>

#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/engine_trace.hpp"
#include "app/labs/kit/code_text.hpp"

namespace tendril::app {
namespace {

/// The library's defaults, which the program need not set.
const ik::Options plain_options;

/// "static const float NAME[] = {...};", four numbers per line.
std::string number_table(const char* name, const std::vector<float>& numbers) {
    std::string text = "static const float " + std::string(name) + "[] = {\n";
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += i % 4 == 0 ? "    " : " ";
        text += literal(numbers[i]);
        text += i % 4 == 3 ? ",\n" : ",";
    }
    return text + "};\n";
}

std::vector<float> segment_numbers(const Chain& chain) {
    std::vector<float> numbers;
    for (const auto& [position, length] : chain.segments())
        numbers.insert(numbers.end(), {position.x, position.y, position.z, length});
    return numbers;
}

std::vector<float> rotation_numbers(const std::vector<glm::quat>& rotations) {
    std::vector<float> numbers;
    for (const glm::quat& q : rotations) numbers.insert(numbers.end(), {q.w, q.x, q.y, q.z});
    return numbers;
}

/// A type JointLimit {joint, limit} and a table joint_limits of the limits that are not free.
std::string limit_table(const std::vector<ik::Limit>& limits) {
    std::string text =
        "struct JointLimit {\n"
        "    std::size_t joint;\n"
        "    ik::Limit limit;\n"
        "};\n"
        "static const JointLimit joint_limits[] = {\n";
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const ik::Limit& limit = limits[i];
        if (limit == ik::Limit{}) continue;
        text += "    {" + std::to_string(i) + ", {" + comma_list(limit_members(limit)) + "}},\n";
    }
    return text + "};\n";
}

class ChainProgram {
  public:
    explicit ChainProgram(const ChainPart& part) : part_(part) {
        if (const TracedPose* const pose = traced_pose(part)) {
            part_ = part_as_written(part, *pose);
            const Conventions& space = pose->trace->conventions;
            unit_ = trace_units.title(space.unit.value);
            unit_symbol_ = trace_units.name(space.unit.value);
            origin_ = "// Starts with the bones as in frame " + std::to_string(pose->trace->view.from) +
                      " of " + printable(pose->trace->name) + ", in its axes and unit (" +
                      trace_ups.title(space.up.value) + ", " + trace_hands.title(space.handed.value) + ", " +
                      unit_ + "), with the target of frame " + std::to_string(pose->frame) + '.';
            const double moved = static_cast<double>(glm::length(pose->trace->view.pole_by));
            if (moved > 0.0 && pose->trace->frames.front().pole)
                origin_ += " Its pole target is " + space.length(moved) + " from the trace's.";
        }
        if (part_.mode == ChainMode::Curve) part_.chain = Chain(part_.along.given);
        part_.study.rewind(part_.chain, part_.reach);
    }
    std::string text();

  private:
    bool follows() const { return part_.mode == ChainMode::Curve && part_.chain.size() >= 2; }
    bool solves() const { return part_.mode == ChainMode::Reach && part_.chain.size() >= 2; }
    std::size_t limit_count() const;
    bool tables() const { return part_.chain.size() > max_listed; }

    void head();
    void chain();
    void move();
    void pull();
    void reach();
    void curve();
    void limits();
    void rotations();
    void memory();
    /// Empty without limits: only limits need rotations.
    std::vector<glm::quat> rotations_to_write() const {
        return part_.reach.limits.empty() ? std::vector<glm::quat>() : part_.reach.state.rotations;
    }
    void options();
    void plane();
    void end();

    void line(std::string_view text) { (code_ += text) += '\n'; }
    /// A statement in main.
    void say(std::string_view text) { ((code_ += "    ") += text) += '\n'; }
    /// A call that returns a Result.
    void say_checked(const std::string& call) {
        say("if (const tendril::Result result = " + call + "; !result) std::puts(result.message());");
    }

    ChainPart part_;
    std::string code_, unit_ = "metres", unit_symbol_ = "m", origin_{};
};

std::string ChainProgram::text() {
    head();
    if (part_.chain.size() > max_listed) line(number_table("segment_numbers", segment_numbers(part_.chain)));
    if (limit_count() > max_listed) line(limit_table(part_.reach.limits));
    if (solves() && rotations_to_write().size() > max_listed)
        line(number_table("rotation_numbers", rotation_numbers(rotations_to_write())));
    line("int main() {");
    chain();
    move();
    end();
    return std::move(code_);
}

std::size_t ChainProgram::limit_count() const {
    if (!solves()) return 0;
    const auto& limits = part_.reach.limits;
    return static_cast<std::size_t>(
        std::count_if(limits.begin(), limits.end(), [](const auto& limit) { return limit != ik::Limit{}; }));
}

void ChainProgram::head() {
    line("// A chain of " + std::to_string(part_.chain.size()) + " segments, exported from Tendril. " +
         chain_modes.help(part_.mode));
    if (!origin_.empty()) line(origin_);
    line("//");
    line("// CMake: find_package(tendril REQUIRED)");
    line("//        target_link_libraries(your_program PRIVATE tendril::core)");
    if (tables()) line("#include <cstddef>");
    line("#include <cstdio>");
    if (tables()) line("#include <iterator>");
    line("#include <tendril/chain/chain.hpp>");
    if (follows()) line("#include <tendril/ik/curve.hpp>");
    if (solves()) line("#include <tendril/ik/solver.hpp>");
    line("#include <vector>\n");
    if (solves() || follows()) line("namespace ik = tendril::ik;\n");
}

void ChainProgram::chain() {
    say("// Where each segment is, and how far it is from the one before; " + unit_ + '.');
    const auto segments = part_.chain.segments();
    if (segments.size() > max_listed) {
        say("std::vector<tendril::Segment> segments;");
        say("for (std::size_t i = 0; i < std::size(segment_numbers); i += 4) {");
        say("    const float* const n = segment_numbers + i;");
        say("    segments.push_back({{n[0], n[1], n[2]}, n[3]});");
        say("}");
    } else {
        say("const std::vector<tendril::Segment> segments{");
        for (const Segment& each : segments)
            say("    {" + braced(each.position) + ", " + literal(each.length) + "},");
        say("};");
    }
    say("// A bone without a direction of its own lies along this one.");
    say("const glm::vec3 default_direction" + braced(part_.chain.default_direction()) + ";");
    say("tendril::Chain chain = tendril::Chain::from_segments(segments, default_direction).value();\n");
    if (!follows()) say("const glm::vec3 target" + braced(part_.target) + ";");
}

void ChainProgram::move() {
    if (solves())
        reach();
    else if (follows())
        curve();
    else
        pull();
}

void ChainProgram::pull() {
    switch (part_.mode) {
        case ChainMode::Forward:
            return say_checked("chain.forward(target)");
        case ChainMode::Backward:
            return say_checked("chain.backward(target)");
        case ChainMode::Fixed:
            return say_checked("chain.fixed(target, {.iterations = " +
                               std::to_string(iterations_of(part_, ChainMode::Fixed)) +
                               ", .tolerance = " + literal(part_.tolerance) + "}).accepted");
        case ChainMode::WithIndex:
            if (part_.chain.empty())
                return say("static_cast<void>(target);  // an empty chain has none to pull");
            return say_checked("chain.with_index(" + std::to_string(part_.index) + ", target)");
        case ChainMode::Curve:
        case ChainMode::Reach:
            return say("static_cast<void>(target);  // fewer than two segments have no bone to turn");
    }
}

void ChainProgram::reach() {
    options();
    limits();
    line("");
    say("// Make both once. The solver is scratch memory, and solving allocates nothing. The state goes "
        "with");
    say("// the chain from frame to frame: how bones are twisted, on which side of its pole target the "
        "chain");
    say("// is, and how the last solve within limits went.");
    say("ik::Solver solver(chain);");
    say("ik::State state = solver.initial_state();");
    rotations();
    memory();
    line("");
    say("// From here on once a frame, with the same solver, state and options.");
    say("const ik::Report report = solver.solve(ik::Method::" + pascal_text(ik::name(part_.reach.method)) +
        ", chain, state, target, options);");
    say("std::printf(\"%s after %d iterations, %g " + unit_symbol_ +
        " from the target\\n\", ik::name(report.status),");
    say("            report.iterations, report.residual);");
}

void ChainProgram::curve() {
    const CurveSettings& chosen = part_.curve;
    const std::vector<float> weights = curve_weights(chosen, part_.chain.size() - 1);
    say("// The curve's control points; metres.");
    say("const std::vector<glm::vec3> points{");
    for (const glm::vec3& each : chosen.points) say("    " + braced(each) + ",");
    say("};");
    if (!weights.empty()) {
        say("const std::vector<float> weights{");
        for (const float each : weights) say("    " + literal(each) + ",");
        say("};");
    }
    say("ik::CurveOptions options;");
    for (const std::string& each : member_texts(chosen.options)) say("options" + each + ";");
    if (!weights.empty()) say("options.weights = weights;");
    line("");
    say("// Make these once. State and memory go with the joints from frame to frame.");
    say("std::vector<float> lengths;");
    say("std::vector<glm::vec3> joints;");
    say("for (const tendril::Segment& each : chain.segments()) {");
    say("    if (!joints.empty()) lengths.push_back(each.length);");
    say("    joints.push_back(each.position);");
    say("}");
    say("const std::vector<glm::vec3> rest(lengths.size(), default_direction);");
    say("ik::State state(lengths.size());");
    say("ik::CurveMemory memory(lengths.size());");
    line("");
    say("// From here on once a frame. The rotations are in the state.");
    say("const ik::CurveReport report =");
    say("    ik::place_along(points, {lengths, rest}, joints, state, memory, options);");
    say("std::printf(\"%s, bones scaled by %g\\n\", ik::name(report.status), report.factor);");
}

void ChainProgram::options() {
    const ReachSettings& chosen = part_.reach;
    ik::Options options = solver_options(chosen, ik::Solver(part_.chain).reach());
    line("");
    say("ik::Options options;");
    say("options.tolerance = " + literal(*options.tolerance) + ";  // " + unit_ +
        (chosen.options.tolerance ? "" : ": 1e-3 of the reach"));
    say("options.max_iterations = " + std::to_string(options.max_iterations) + ";");
    plane();
    options.tolerance.reset(), options.max_iterations = plain_options.max_iterations;
    options.plane.reset(), options.limits = {};
    for (const std::string& each : member_texts({fields<ik::Options>(), &options, &plain_options})) {
        const bool twist = each.starts_with(".twist");
        say("options" + each + ";" + (twist ? "  // " + degrees_text(options.twist) + " degrees" : ""));
    }
}

void ChainProgram::plane() {
    if (!part_.reach.plane) return;
    const ChainPlane& plane = *part_.reach.plane;
    const std::string side = pascal_text(ik::name(plane.bend));
    const auto& limits = plane.limits;
    if (!limits.empty()) {
        say("// For each bone the range of its angle, radians: positive to the left, 0 straight on.");
        say("const std::vector<ik::AngleLimit> angle_limits{");
        for (const ik::AngleLimit& limit : limits)
            say("    {" + literal(limit.min) + ", " + literal(limit.max) +
                ", ik::AngleFrom::" + pascal_text(ik::name(limit.from)) + "},");
        say("};");
    }
    say("// The chain stays in the plane of this normal through its root.");
    say("options.plane = ik::Plane{glm::vec3" + braced(plane.normal) + ", ik::Side::" + side +
        (limits.empty() ? "" : ", angle_limits") + "};");
}

void ChainProgram::limits() {
    if (limit_count() == 0) return;
    const auto& limits = part_.reach.limits;
    line("");
    say("// For each bone how its first joint may turn; angles in radians.");
    say("std::vector<ik::Limit> limits(" + std::to_string(limits.size()) + ");");
    if (limit_count() > max_listed) {
        say("for (const JointLimit& each : joint_limits) limits[each.joint] = each.limit;");
    } else {
        for (std::size_t i = 0; i < limits.size(); ++i)
            if (limits[i] != ik::Limit{})
                code_ += limit_text("limits[" + std::to_string(i) + "]", limits[i], "    ");
    }
    say("options.limits = limits;");
}

void ChainProgram::rotations() {
    const auto rotations = rotations_to_write();
    if (rotations.empty()) return;
    say("// How each bone was turned about itself when it was exported (w, x, y, z).");
    if (rotations.size() > max_listed) {
        say("std::vector<glm::quat> rotations;");
        say("for (std::size_t i = 0; i < std::size(rotation_numbers); i += 4) {");
        say("    const float* const n = rotation_numbers + i;");
        say("    rotations.emplace_back(n[0], n[1], n[2], n[3]);");
        say("}");
    } else {
        say("const std::vector<glm::quat> rotations{");
        for (const glm::quat& q : rotations)
            say("    {" + literal(q.w) + ", " + literal(q.x) + ", " + literal(q.y) + ", " + literal(q.z) +
                "},");
        say("};");
    }
    say("state.rotations = rotations;");
}

/// Restores the state that the last solve left, so that the next one continues from it.
void ChainProgram::memory() {
    for (const std::string& each : ik_memory_texts("state", part_.reach.state)) say(each);
    const ik::PoleMemory& pole = part_.reach.state.pole;
    if (!pole.valid) return;
    say("state.pole.joints.clear();");
    if (pole.joints == from_root(positions(part_.chain))) {
        say("for (const tendril::Segment& each : segments)");
        say("    state.pole.joints.push_back(each.position - segments.front().position);");
    } else {
        for (const glm::vec3& joint : pole.joints) say("state.pole.joints.push_back(" + braced(joint) + ");");
    }
}

void ChainProgram::end() {
    line("");
    say(follows() ? "for (const glm::vec3& at : joints) {"
                  : "for (const tendril::Segment& segment : chain.segments()) {");
    if (!follows()) say("    const glm::vec3& at = segment.position;");
    say("    std::printf(\"%.9g %.9g %.9g\\n\", at.x, at.y, at.z);");
    say("}");
    line("}");
}

}  // namespace

std::string chain_code(const ChainPart& part) {
    return ChainProgram(part).text();
}

std::string ChainLab::code(const Workspace& workspace) const {
    return chain_code(chain_part(workspace));
}

// The clipboard.

void add_copy_commands(CommandTable& table) {
    table.add("chain.copy", "Copy the chain",
              {choice_argument("as", true, "a program against the library, or the scene", {"cpp", "json"})},
              "Puts the chain on the clipboard, as code or as a scene", Effect::Look,
              [](Workspace& workspace, const Arguments& given) {
                  const bool code = given.text("as") == "cpp";
                  workspace.ui.copied = code ? chain_code(workspace.document.get<ChainPart>(chain_lab))
                                             : json_to_text(save_scene(workspace));
                  workspace.toast(code ? "The chain is on the clipboard, as C++."
                                       : "The scene is on the clipboard, as JSON.");
              });
}

}  // namespace tendril::app
