#include "app/labs/humanoid/humanoid_commands.hpp"

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/arguments.hpp"

// Commands on selection and view, which leave no undo step, and on the flip rule.

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::HumanoidView>() noexcept {
    using namespace app;
    static constexpr auto skins = skin_looks.name_array();
    static constexpr auto ways = skinnings.name_array();
    static constexpr auto joints = limits_shown.name_array();
    static constexpr auto clips = judged_clips.name_array();
    static constexpr Field rows[] = {
        field<&HumanoidView::ghost>("ghost"),           field<&HumanoidView::follow>("follow"),
        field<&HumanoidView::skin>("skin", skins),      field<&HumanoidView::skinning>("skinning", ways),
        field<&HumanoidView::limits>("limits", joints), field<&HumanoidView::judged>("judged", clips)};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<HumanoidView>() {
    static constexpr FieldText texts[] = {
        {.name = "ghost", .label = "Ghost", .help = "The pose before fixes and IK, in grey."},
        {.name = "skin",
         .label = "skin",
         .help = "How the skin is drawn: not at all, solid, or so that bones show through",
         .listed = true,
         .choices = skin_looks.rows},
        {.name = "skinning",
         .label = "skinning",
         .help = "How the skin follows twisted arms. Linear blending shrinks it to a thread at wrist and "
                 "shoulder; twist spread turns it evenly along forearm and upper arm. Bones with their own "
                 "twist nodes use those instead",
         .listed = true,
         .choices = skinnings.rows},
        {.name = "limits",
         .label = "limits of",
         .help = "How far joints turn: an adult's range, with the clips' range over it",
         .listed = true,
         .choices = limits_shown.rows},
        {.name = "judged",
         .label = "judge",
         .help = "The clip with only its fixes, or the result after IK, which is shown and exported",
         .listed = true,
         .choices = judged_clips.rows},
        {.name = "follow",
         .label = "Camera follows",
         .help = "The camera follows the character as it walks."}};
    return texts;
}

namespace {

void select(HumanoidPart& part, const Arguments& given) {
    const bool add = given.has("add") && given.boolean("add");
    if (!given.has("node") && !given.has("nodes")) {
        if (!add) part.selection.clear();
        return;
    }
    const std::vector<std::size_t> nodes = nodes_named(part, given);
    if (given.has("node") && add)
        part.selection.toggle(nodes.front());
    else
        part.selection.take(nodes, add);
}

}  // namespace

void add_humanoid_look_commands(CommandTable& table) {
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.select", "Select nodes",
        {node_argument("node", false, "by name; if all are omitted, nothing is selected"),
         name_list_argument("nodes", "node"),
         switch_argument("add",
                         "true: adds to the selection, or with node removes one that is already in it")},
        "Selects nodes of the character", select, Effect::Look));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.view", "Set how the character is shown", field_arguments<HumanoidView>(),
        "Sets how the character is shown; omitted settings are kept",
        [](HumanoidPart& part, const Arguments& given) { set_fields(given, part.view); }, Effect::Look));
    table.add(flip_command<HumanoidPart>(humanoid_lab, "humanoid.flips"));
    table.add(
        {.name = "humanoid.copy",
         .title = "Copy the character as C++",
         .arguments = {},
         .help = "Copies the character and its IK to the clipboard as a C++ program that uses the library",
         .effect = Effect::Look,
         .apply = [](Workspace& workspace, const Arguments&) {
             workspace.ui.copied =
                 humanoid_code(humanoid_part(workspace), humanoid_runtime(workspace).solvers);
             workspace.toast("The character is on the clipboard as C++" +
                             left_out_text(humanoid_part(workspace), false));
         }});
}

}  // namespace tendril::app
