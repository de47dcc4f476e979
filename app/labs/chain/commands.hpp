// The Chain lab's commands, chain.*, and declarations that their files share: drags, presets, and the export
// as C++.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tendril/chain/chain.hpp>
#include <vector>

#include "app/document/command.hpp"
#include "app/io/json.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/reach.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {

// Dragging joints. In mode Reach, each dragged joint is an effector of its own.
//
// The bones from the root to the dragged joint are solved for the drag point; the bones beyond it then reach
// for the target. So dragging an elbow swings it while the hand stays on the target, like an IK goal in
// Blender or an IK handle in Maya, and dragging it back restores the tip; bones that were merely moved
// along rigidly would not return. Root and target stay. Dragging the tip leaves the target alone; dragging
// the root moves the whole chain, which then reaches for the target again. Several dragged joints are solved
// from the root outwards, each section from the end of the one before. Joint limits always hold. The pole
// target acts only when the whole chain is solved (root and tip): it sets where the bend of the whole chain
// faces, and would fight the mouse at any joint between.

struct JointPull {
    std::size_t joint = 0;
    glm::vec3 to{0.0f};  ///< metres
};

/// `pulls`: at least one, in ascending order of existing joints without duplicates. Throws
/// std::invalid_argument if the solver refuses.
void drag_joints(Chain& chain, ReachSettings& settings, std::span<const JointPull> pulls, glm::vec3 target,
                 ChainRuntime& runtime);

/// For the trailing modes: the first pulled joint goes to its point, the others get as near as the bones
/// between allow, and both ends trail. Refuses the same input as Chain::with_index.
Result trail_joints(Chain& chain, std::span<const JointPull> pulls);

/// The handle of a limit's end in the plane; none if there is no such limit, or it is fixed at present.
std::optional<Handle> limit_handle(const ChainPart& part, const LimitEnd& end);

using ChainChange = void (*)(ChainPart&, const Arguments&);
/// A change that also solves, with the lab's solvers.
using ChainSolve = std::function<void(ChainPart&, const Arguments&, ChainRuntime&)>;

/// A command that edits a copy of the lab's part.
Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainChange change, Effect effect = Effect::Edit);
Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainSolve change, Effect effect = Effect::Edit);

Argument index_argument(bool required, const char* help);

std::size_t index_of(const Arguments& given);
/// Throws Refused if there is no such segment.
void check_index(const ChainPart& part, std::size_t index);

/// An optional list of joints, for a command that sets the same value on all of them.
Argument joints_argument();
/// The joints that `index` or `joints` names, in the order given. Throws Refused if both or neither are
/// given, or if a joint does not exist.
std::vector<std::size_t> joints_of(const Arguments& given, const ChainPart& part);

/// The same, ascending and without duplicates; never empty.
std::vector<std::size_t> joints_to_set(const Arguments& given, const ChainPart& part);

/// Pulls joints as chain.pull does; `pulls` is ascending, without duplicates.
void pull_joints(ChainPart& part, const std::vector<JointPull>& pulls, ChainRuntime& runtime);
/// A chain with one joint at each point.
Chain chain_through(const std::vector<glm::vec3>& points);
/// In mode Reach, solves again for the current target.
void reach_again(ChainPart& part, ChainRuntime& runtime);

/// Throws Refused if no race is open.
void check_race(const ChainPart& part);

void add_shape_commands(CommandTable& table);
void add_mode_commands(CommandTable& table);
void add_reach_commands(CommandTable& table);
void add_curve_command(CommandTable& table);
void add_study_commands(CommandTable& table);
/// race.copy, race.save and race.record.
void add_race_file_commands(CommandTable& table);
void add_copy_commands(CommandTable& table);
void add_paste_command(CommandTable& table);
/// chain.save_trace: writes the strip's moments in the format that `tendril trace` reads.
void add_save_trace_command(CommandTable& table);

/// True if a file's text begins like a trace, for Lab::files().
bool begins_like_trace(std::string_view text);

void add_chain_commands(CommandTable& table);

// Export: the chain, its mode and its options as a C++ program that uses tendril::core.

/// A complete C++ program. It builds the chain (while a study is open, its start), moves it once to the
/// target as the lab does, and prints the position of each segment exactly.
std::string chain_code(const ChainPart& part);

/// Longer lists are written as tables of plain numbers: shorter, and fast to compile.
inline constexpr std::size_t max_listed = 64;

// Preset chains, from presets.json: the bones, and the members of a scene that come with them.

/// Its segments follow `steps`, the last of which repeats, or a path of that name, or rise to `height`.
struct Preset {
    std::string name, title;
    int count = 1;     ///< default number of segments
    int of = 3;        ///< buttons in its row of the panel; 0: among the rows of mode Curve
    std::string what;  ///< after the number of joints, in its tooltip
    glm::vec3 head{0.0f};
    std::vector<glm::vec3> steps;  ///< metres
    std::string path;
    float height = 0.0f;  ///< metres
    /// "curve", or "reach" with "target" or "target_from_tip". The last of its limits repeats.
    std::shared_ptr<const Json> scene;

    /// Whether it comes with a curve, and whether it stays in a plane.
    bool curved() const;
    bool planar() const;
};

const std::vector<Preset>& presets();
/// Throws std::invalid_argument for an unknown name.
const Preset& preset_named(const std::string& name);
/// Only the path "random" uses `seed`.
Chain make_preset(const Preset& preset, std::size_t count, std::uint32_t seed = 1);
/// Gives a part with the preset's chain its mode, settings and target.
///
/// In the opening view, target, pole target and shoulder of "reaching_arm" have the same depth, so a drag of
/// the target in the view plane passes over the pole target, and the elbow flips. The target of "straight" is
/// on the chain's own line, three quarters of a bone before the tip: both passes of FABRIK (2011) shift the
/// joints along the line and back, and the chain stays as it is, to the last bit. With the target nearer to
/// the root it would fold onto the line, and could end on the target by chance. From 750 bones on, the gap is
/// within the default tolerance.
void take_scene(ChainPart& part, const Preset& preset, ChainRuntime& runtime);

}  // namespace tendril::app
