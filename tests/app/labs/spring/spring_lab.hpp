// A small lab: a ball on a spring. It is not in the program; app/labs/README.md explains it, and the tests
// show that a lab needs only a folder and one line.
#pragma once

#include "app/labs/lab.hpp"

namespace tendril::test {

struct SpringPart final : app::Part {
    glm::vec3 anchor{0.0f, 2.0f, 0.0f};  ///< metres
    glm::vec3 ball{0.5f, 1.0f, 0.0f};
    glm::vec3 velocity{0.0f};  ///< metres a second

    std::shared_ptr<Part> clone() const override { return std::make_shared<SpringPart>(*this); }
    app::Json save() const override;
    std::shared_ptr<Part> load(const app::Json& json, const std::string& where) const override;
    std::size_t bytes() const override { return sizeof(*this); }
    bool operator==(const SpringPart& other) const {
        return anchor == other.anchor && ball == other.ball && velocity == other.velocity;
    }
};

class SpringLab final : public app::Lab {
  public:
    std::string name() const override { return "spring"; }
    std::string title() const override { return "Spring"; }
    std::shared_ptr<app::Part> blank() const override { return std::make_shared<SpringPart>(); }
    void add_commands(app::CommandTable& table) const override;
    void draw(const app::View& view, app::DrawList& list) const override;

    bool moving(const app::Workspace&) const override { return true; }
    void step(app::Workspace& workspace) const override;
    std::vector<app::Handle> handles(const app::Workspace& workspace) const override;
    void drag(const app::Workspace&, app::PickId pick, const app::Handle::Frame& to,
              app::Emit& emit) const override;
    std::vector<app::Shortcut> shortcuts() const override;
    std::vector<app::MouseHelp> mouse_help() const override;
};

}  // namespace tendril::test
