// What the tests of the Chain lab's commands share.
#pragma once

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {

class ChainTest : public testing::Test {
  protected:
    Labs labs;
    CommandTable table = make_command_table(labs);
    Workspace workspace = make_blank_workspace(labs);

    const ChainPart& part() const { return chain_part(workspace); }
    Json state() const { return labs.find(chain_lab)->state(workspace); }
    void run(const char* name, Json arguments = Json::object(), Gesture gesture = 0) {
        table.run(workspace, name, arguments, gesture);
    }
    /// Runs what must be refused; gives the message, having checked that nothing changed.
    std::string refused(const char* name, const Json& arguments = Json::object()) {
        const Json scene = save_scene(workspace);
        const std::size_t history = workspace.history.size();
        try {
            table.run(workspace, name, arguments);
        } catch (const Refused& refusal) {
            EXPECT_EQ(save_scene(workspace), scene) << name << " changed something, though refused";
            EXPECT_EQ(workspace.history.size(), history);
            return refusal.what();
        }
        ADD_FAILURE() << name << " " << arguments << " was accepted";
        return {};
    }
    /// A chain of so many bones of a metre along +X, in mode reach.
    void reach_with(int bones) {
        run("chain.preset", {{"name", "start"}, {"count", bones + 1}});
        run("chain.mode", {{"mode", "reach"}});
    }
    float tip_distance() const {
        return glm::distance(part().chain.position(part().chain.size() - 1), part().target);
    }
};

}  // namespace tendril::app
