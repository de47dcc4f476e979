#include "tests/app/labs/spring/spring_lab.hpp"

#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::test {
namespace {

using namespace app;

constexpr const char* lab = "spring";
constexpr PickId anchor_pick = 0, ball_pick = 1;

const SpringPart& part_of(const Workspace& workspace) {
    return workspace.document.get<SpringPart>(lab);
}

}  // namespace

Json SpringPart::save() const {
    return {{"anchor", point(anchor)}, {"ball", point(ball)}, {"velocity", point(velocity)}};
}

std::shared_ptr<Part> SpringPart::load(const Json& json, const std::string& where) const {
    const auto read = [&](const char* key) {
        return json_point(json_member(json, key, where), where + "." + key);
    };
    auto part = std::make_shared<SpringPart>();
    part->anchor = read("anchor");
    part->ball = read("ball");
    part->velocity = read("velocity");
    return part;
}

void SpringLab::add_commands(CommandTable& table) const {
    const Argument to{.name = "to", .type = ArgumentType::Point, .help = "metres"};
    table.add(part_command<SpringPart>(
        lab, "spring.anchor", "Move the anchor", {to}, "Moves what the spring hangs from",
        [](SpringPart& part, const Arguments& given) { part.anchor = given.point("to"); }));
    table.add(part_command<SpringPart>(lab, "spring.ball", "Put the ball somewhere", {to},
                                       "Puts the ball somewhere, at rest",
                                       [](SpringPart& part, const Arguments& given) {
                                           part.ball = given.point("to");
                                           part.velocity = glm::vec3(0.0f);
                                       }));
}

void SpringLab::draw(const View& view, DrawList& list) const {
    const SpringPart& part = part_of(view.workspace);
    list.line(part.anchor, part.ball, 2.0f * view.scale, glm::vec4(view.palette.neutral, 1.0f));
    list.sphere(part.anchor, 6.0f * view.scale, Unit::Pixels, glm::vec4(view.palette.joint, 1.0f)).pick =
        anchor_pick;
    list.sphere(part.ball, 10.0f * view.scale, Unit::Pixels, glm::vec4(view.palette.target, 1.0f)).pick =
        ball_pick;
}

void SpringLab::step(Workspace& workspace) const {
    auto& part = workspace.document.edit<SpringPart>(lab);
    const float dt = static_cast<float>(tick_seconds) * workspace.clock.speed;
    const glm::vec3 acceleration =
        40.0f * (part.anchor - part.ball) - 2.0f * part.velocity - glm::vec3(0, 9.81f, 0);
    part.velocity += dt * acceleration;
    part.ball += dt * part.velocity;
}

std::vector<Handle> SpringLab::handles(const Workspace& workspace) const {
    const SpringPart& part = part_of(workspace);
    return {{"anchor", anchor_pick, {part.anchor}}, {"ball", ball_pick, {part.ball}}};
}

void SpringLab::drag(const Workspace&, PickId pick, const Handle::Frame& to, Emit& emit) const {
    emit.continuously(pick == ball_pick ? "spring.ball" : "spring.anchor", {{"to", to.position}});
}

std::vector<Shortcut> SpringLab::shortcuts() const {
    return {{*chord_from_name("r"),
             "spring.ball",
             {{"to", glm::vec3(0.5f, 1.0f, 0.0f)}},
             "Pull the ball aside",
             "Spring"}};
}

std::vector<MouseHelp> SpringLab::mouse_help() const {
    return {{"Left drag on the ball", "holds it there"}};
}

}  // namespace tendril::test
