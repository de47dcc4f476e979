#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

LabTest::LabTest(const char* lab, Labs all)
    : labs(std::move(all)),
      table_(std::make_unique<CommandTable>(make_command_table(labs))),
      table(*table_),
      workspace(make_blank_workspace(labs)),
      lab_(lab) {
    run("lab.open", {{"name", lab}});
}

LabTest::~LabTest() = default;

void LabTest::run(const char* name, const Json& arguments, Gesture gesture) {
    table.run(workspace, name, arguments, gesture);
    if (const auto& finish = table.find(name)->finish) finish(workspace);
}

void LabTest::begin(const char* name, const Json& arguments) {
    table.run(workspace, name, arguments);
}

void LabTest::emit(const std::function<void(Emit&)>& act, Gesture gesture) {
    Emit emitted;
    act(emitted);
    for (const Emitted& each : emitted.take()) run(each.name.c_str(), *each.arguments, gesture);
}

std::vector<Incident> LabTest::incidents_of(const char* name, const Json& arguments, Gesture gesture) {
    const auto before = now();
    run(name, arguments, gesture);
    return since(before);
}

void LabTest::run_in(Workspace& other, const char* name, const Json& arguments) const {
    table.run(other, name, arguments);
}

Workspace LabTest::reopened() const {
    Workspace other = make_blank_workspace(labs);
    load_scene(other, save_scene(workspace));
    return other;
}

std::string LabTest::refused(const char* name, const Json& arguments) {
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

void LabTest::expect_refused(const char* name, const Json& arguments, const std::vector<std::string>& says) {
    const std::string message = refused(name, arguments);
    for (const std::string& each : says)
        EXPECT_NE(message.find(each), std::string::npos) << message << "\n  does not say " << each;
}

void LabTest::refuses(const char* name, const Json& arguments, const std::string& words) {
    EXPECT_TRUE(test::says(refused(name, arguments), words)) << name << " " << arguments;
}

void LabTest::tells(const std::string& words) const {
    ASSERT_FALSE(workspace.ui.toasts.empty()) << words;
    EXPECT_TRUE(test::says(workspace.ui.toasts.back().text, words));
}

std::string LabTest::opened_with(const std::string& at, const Json& value) const {
    Json scene = save_scene(workspace);
    scene["labs"][lab_][Json::json_pointer(at)] = value;
    Workspace other = make_blank_workspace(labs);
    const Document before = other.document;
    try {
        std::string why;
        for (const LabNote& each : load_scene(other, scene)) why += "blank: " + each.text;
        EXPECT_TRUE(why.empty() || save_scene(other).at("labs") == scene.at("labs")) << "its JSON is kept";
        return why;
    } catch (const std::runtime_error& error) {
        EXPECT_TRUE(other.document == before);
        return error.what();
    }
}

void LabTest::expect_scene_refused(const std::string& at, const Json& value, const std::string& says) const {
    const std::string message = opened_with(at, value);
    EXPECT_TRUE(message.starts_with("labs.") && message.find(says) != std::string::npos)
        << at << " as " << value << ": " << message << "\n  does not say " << says;
}

}  // namespace tendril::app
