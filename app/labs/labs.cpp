#include "app/labs/labs.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/document/command.hpp"
#include "app/labs/card.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/files.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/lab_commands.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/signal/signal_lab.hpp"

namespace tendril::app {

Labs::Labs() {
    add(std::make_unique<ChainLab>());
    add(std::make_unique<RopeLab>());
    add(std::make_unique<SignalLab>());
    add(std::make_unique<RigLab>());
    add(std::make_unique<HumanoidLab>());
    add(std::make_unique<LinkageLab>());
}

void Labs::add(std::unique_ptr<Lab> lab) {
    if (find(lab->name()) != nullptr) throw std::logic_error("lab added twice: " + lab->name());
    labs_.push_back(std::move(lab));
}

const Lab* Labs::find(std::string_view name) const {
    const auto found =
        std::find_if(labs_.begin(), labs_.end(), [&](const auto& lab) { return lab->name() == name; });
    return found == labs_.end() ? nullptr : found->get();
}

Workspace make_blank_workspace(const Labs& labs) {
    Workspace workspace;
    for (const auto& lab : labs.all()) workspace.document.set(lab->name(), lab->blank());
    workspace.blank = workspace.saved = workspace.document;
    workspace.lab = labs.all().front()->name();
    for (const auto& lab : labs.all()) workspace.first_views[lab->name()] = lab->first_view();
    workspace.camera = workspace.first_view = labs.all().front()->first_view();
    return workspace;
}

CommandTable make_command_table(const Labs& labs) {
    CommandTable table;
    add_workspace_commands(table);
    add_camera_commands(table, labs);
    add_card_commands(table);
    add_video_commands(table, labs);
    add_file_command(table, labs);
    add_closing_command(table, labs);
    for (const auto& lab : labs.all()) {
        table.begin_lab(lab->name());
        lab->add_commands(table);
        for (const LabSetting& setting : lab->all_settings()) table.add(setting_command(setting));
    }
    return table;
}

}  // namespace tendril::app
