// Shared by tests of all labs: a blank workspace, and commands by name.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/document/workspace.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {

class LabTest : public testing::Test {
  protected:
    explicit LabTest(const char* lab, Labs all = Labs());
    ~LabTest() override;

    Labs labs;

  private:
    std::unique_ptr<const CommandTable> table_;

  protected:
    const CommandTable& table;
    Workspace workspace;
    const test::TempFolder folder_;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    /// Writes a file into the folder; returns its path.
    std::string write(const std::string& name, std::string_view bytes) const {
        test::write(folder_ / name, bytes);
        return path(name);
    }

    const Lab& lab() const { return *labs.find(lab_); }
    Json state() const { return lab().state(workspace); }
    /// The lab's part of a scene file.
    Json saved() const { return save_scene(workspace).at("labs").at(lab_); }
    /// The workspace after saving and loading.
    Workspace reopened() const;
    /// As in a script: long work is completed.
    void run(const char* name, const Json& arguments = Json::object(), Gesture gesture = 0);
    /// As in the window: long work continues in ticks.
    void begin(const char* name, const Json& arguments = Json::object());
    /// Runs ticks, whether or not anything moves.
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) lab().step(workspace);
    }
    /// Runs ticks while something moves.
    void tick(int count = 1) {
        for (int i = 0; i < count; ++i)
            if (lab().moving(workspace)) lab().step(workspace);
    }
    void remember() {
        workspace.remember_moment();
        ++workspace.moment;
    }
    static glm::dvec3 vector(const Json& at) {
        return {at[0].get<double>(), at[1].get<double>(), at[2].get<double>()};
    }
    static glm::dquat quaternion(const Json& q) {
        return {q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>()};
    }
    /// Runs what a click, a drag or a panel emits.
    void emit(const std::function<void(Emit&)>& act, Gesture gesture = 0);
    /// The lab's part, and the incidents since it was another.
    std::shared_ptr<const Part> now() const { return workspace.document.parts().at(lab_); }
    std::vector<Incident> since(const std::shared_ptr<const Part>& before) const {
        return lab().review(workspace, *before, *now());
    }
    /// Runs a command; returns the incidents that it leads to.
    std::vector<Incident> incidents_of(const char* name, const Json& arguments, Gesture gesture = 0);
    void run_in(Workspace& other, const char* name, const Json& arguments) const;
    /// Runs a command that must be refused, checks that nothing changed, and returns the message.
    std::string refused(const char* name, const Json& arguments = Json::object());
    /// The same, with a message that says each of these in any order.
    void expect_refused(const char* name, const Json& arguments, const std::vector<std::string>& says);
    /// The same, with a message that has these words in this order; see says.hpp.
    void refuses(const char* name, const Json& arguments, const std::string& words);
    /// Expects the latest toast to have these words in this order.
    void tells(const std::string& words) const;
    /// Opens the scene with this value at a JSON pointer in the lab. Returns the reason for a refusal;
    /// "blank: " and the reason if the lab starts blank; or nothing.
    std::string opened_with(const std::string& at, const Json& value) const;
    void expect_scene_refused(const std::string& at, const Json& value, const std::string& says) const;

  private:
    const char* lab_;
};

}  // namespace tendril::app
