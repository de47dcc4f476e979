// What the tests of every lab share: a blank workspace, and commands run in it.
#pragma once

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {

class LabTest : public testing::Test {
  protected:
    explicit LabTest(const char* lab) : lab_(lab) { run("lab.open", {{"name", lab}}); }

    Labs labs;
    CommandTable table = make_command_table(labs);
    Workspace workspace = make_blank_workspace(labs);

    const Lab& lab() const { return *labs.find(lab_); }
    Json state() const { return lab().state(workspace); }
    void run(const char* name, Json arguments = Json::object(), Gesture gesture = 0) {
        table.run(workspace, name, arguments, gesture);
    }
    /// Runs what must be refused; gives the message, having checked that nothing changed.
    std::string refused(const char* name, const Json& arguments = Json::object()) {
        const Document before = workspace.document;
        const Json scene = save_scene(workspace);
        const std::size_t history = workspace.history.size();
        try {
            table.run(workspace, name, arguments);
        } catch (const Refused& refusal) {
            EXPECT_TRUE(workspace.document == before) << name << " changed something, though refused";
            EXPECT_EQ(save_scene(workspace), scene) << name << " changed something, though refused";
            EXPECT_EQ(workspace.history.size(), history);
            return refusal.what();
        }
        ADD_FAILURE() << name << " " << arguments << " was accepted";
        return {};
    }

  private:
    const char* lab_;
};

}  // namespace tendril::app
