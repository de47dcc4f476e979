// A part that belongs to no real lab, for tests of properties of every part.
#pragma once

#include "app/document/workspace.hpp"
#include "app/io/json_complete.hpp"

namespace tendril::test {

struct TestPart : app::Part {
    std::string title;
    std::vector<float> values;
    glm::vec3 target{0.0f};

    std::shared_ptr<app::Part> clone() const override { return std::make_shared<TestPart>(*this); }
    app::Json save() const override {
        app::Json list = app::Json::array();
        for (const float value : values) list.push_back(app::number(value));
        return {{"title", title}, {"values", std::move(list)}, {"target", app::point(target)}};
    }
    std::shared_ptr<app::Part> load(const app::Json& json, const std::string& where) const override {
        auto part = std::make_shared<TestPart>();
        part->title = app::json_text(app::json_member(json, "title", where), where + ".title");
        const app::Json& list = app::json_member(json, "values", where);
        if (!list.is_array()) throw std::runtime_error(where + ".values: expected a list");
        for (std::size_t i = 0; i < list.size(); ++i)
            part->values.push_back(app::json_number(list[i], where + ".values." + std::to_string(i)));
        part->target = app::json_point(app::json_member(json, "target", where), where + ".target");
        return part;
    }
    std::size_t bytes() const override { return sizeof(TestPart) + values.size() * sizeof(float); }
};

inline std::shared_ptr<TestPart> make_part(std::string title, std::vector<float> values = {}) {
    auto part = std::make_shared<TestPart>();
    part->title = std::move(title);
    part->values = std::move(values);
    return part;
}

/// Two labs, "arm" and "rope", with "arm" open and everything blank.
inline app::Workspace make_workspace() {
    app::Workspace workspace;
    workspace.blank.set("arm", make_part("blank arm", {1.0f, 2.0f}));
    workspace.blank.set("rope", make_part("blank rope"));
    workspace.document = workspace.saved = workspace.blank;
    workspace.lab = "arm";
    return workspace;
}

}  // namespace tendril::test
