// What the tests of the Rope lab share.
#pragma once

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/labs.hpp"
#include "app/labs/rope/rope_lab.hpp"

namespace tendril::app {

class RopeTest : public testing::Test {
  protected:
    Labs labs;
    CommandTable table = make_command_table(labs);
    Workspace workspace = make_blank_workspace(labs);

    RopeTest() { run("lab.open", {{"name", "rope"}}); }

    const Lab& lab() const { return *labs.find(rope_lab); }
    const RopePart& part() const { return rope_part(workspace); }
    const NamedWorld& world() const { return *part().world; }
    Json state() const { return lab().state(workspace); }
    void run(const char* name, Json arguments = Json::object(), Gesture gesture = 0) {
        table.run(workspace, name, arguments, gesture);
    }
    /// Ticks, whether or not anything moves.
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) lab().step(workspace);
    }
    /// Runs what must be refused; gives the message, having checked that nothing changed.
    std::string refused(const char* name, const Json& arguments = Json::object()) {
        const Document before = workspace.document;
        const std::size_t history = workspace.history.size();
        try {
            table.run(workspace, name, arguments);
        } catch (const Refused& refusal) {
            EXPECT_TRUE(workspace.document == before) << name << " changed something, though refused";
            EXPECT_EQ(workspace.history.size(), history);
            return refusal.what();
        }
        ADD_FAILURE() << name << " " << arguments << " was accepted";
        return {};
    }
    /// Nothing but a rope of so many segments, a metre long, from the origin's upside along +X.
    void single_rope(int segments = 8) {
        run("rope.clear");
        run("rope.add", {{"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"segments", segments}});
    }
};

}  // namespace tendril::app
