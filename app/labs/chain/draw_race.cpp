#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/labs/chain/colours.hpp"
#include "app/labs/chain/draw.hpp"

namespace tendril::app {
namespace {

constexpr float same_pixels = 3.0f;    ///< nearer than this, two chains cover each other
constexpr float strand_pixels = 4.5f;  ///< from one strand to the next, where several run along together

class RaceDrawing {
  public:
    RaceDrawing(const View& view, const ShownChain& shown, DrawList& list)
        : view_(view), race_(*shown.race), study_(shown.part.study), list_(list) {}

    void run() {
        const glm::vec4 ghost = faded(view_.palette, view_.palette.ghost, 0.8f);
        for (std::size_t i = 1; i < study_.start.size(); ++i)
            list_.line(study_.start[i - 1], study_.start[i], px(2.0f), ghost);
        for (std::size_t i = 0; i < race_.racers.size(); ++i) {
            if (study_.side_by_side && i != view_.pane) continue;
            chains_.push_back(&race_.racers[i]);
        }
        project();
        for (std::size_t c = 0; c < chains_.size(); ++c) chain(c);
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    const std::vector<glm::vec3>& joints(std::size_t c) const { return chains_[c]->joints; }

    void project() {
        for (std::size_t c = 0; c < chains_.size(); ++c) {
            std::vector<glm::vec2> pixels;
            for (const glm::vec3& joint : joints(c))
                pixels.push_back(view_.camera.project(joint).value_or(glm::vec2(NAN)));
            pixels_.push_back(std::move(pixels));
        }
    }

    bool same_joint(std::size_t c, std::size_t d, std::size_t joint) const {
        return joint < pixels_[d].size() &&
               glm::distance(pixels_[c][joint], pixels_[d][joint]) < px(same_pixels);
    }

    /// How far to the side the bone that leads to a joint is drawn, pixels: chains that cover each other run
    /// along side by side, like the strands of a ribbon.
    float aside(std::size_t c, std::size_t joint) const {
        int before = 0, after = 0;
        for (std::size_t d = 0; d < chains_.size(); ++d) {
            if (d == c || !same_joint(c, d, joint - 1) || !same_joint(c, d, joint)) continue;
            (d < c ? before : after) += 1;
        }
        return 0.5f * px(strand_pixels) * static_cast<float>(before - after);
    }

    /// To the side of the bone that leads to a joint, as the eye sees it, of length 1; zero where it is seen
    /// end on.
    glm::vec3 sideways(std::size_t c, std::size_t joint) const {
        const glm::vec3 from = joints(c)[joint - 1], to = joints(c)[joint];
        const glm::vec3 across = glm::cross(view_.camera.forward(), to - from);
        const float length = glm::length(across);
        if (!(length > 1e-6f * glm::distance(from, to))) return glm::vec3(0.0f);
        return across / length;
    }

    /// From the joint to where the strand meets the next bone's of the same chain: at a corner both keep
    /// their distance from the middle. `bone` leads to the joint or from it.
    glm::vec3 corner(std::size_t c, std::size_t joint, std::size_t bone) const {
        const float metres = aside(c, bone) * view_.camera.metres_per_pixel(joints(c)[joint]);
        const glm::vec3 own = sideways(c, bone);
        const std::size_t other = bone == joint ? joint + 1 : joint;
        if (other == 0 || other >= joints(c).size() || aside(c, other) != aside(c, bone)) return metres * own;
        const glm::vec3 next = sideways(c, other);
        if (next == glm::vec3(0.0f) || own == glm::vec3(0.0f)) return metres * own;
        const glm::vec3 mean = 0.5f * (own + next);
        return metres / std::max(glm::dot(mean, mean), 0.25f) * mean;  // a sharp corner is cut short
    }

    void chain(std::size_t c) {
        const glm::vec4 colour(solver_colour(view_.palette, chains_[c]->method), 1.0f);
        const std::vector<glm::vec3>& at = joints(c);
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (i > 0) {
                list_.line(at[i - 1] + corner(c, i - 1, i), at[i] + corner(c, i, i), px(3.0f), colour)
                    .shadow = true;
            }
            joint(c, i, colour);
        }
    }

    /// One ball for all that have their joint there.
    void joint(std::size_t c, std::size_t i, glm::vec4 colour) {
        bool shared = false;
        for (std::size_t d = 0; d < chains_.size(); ++d) {
            if (d == c || !same_joint(c, d, i)) continue;
            if (d < c) return;
            shared = true;
        }
        const glm::vec3 paint = i == 0   ? view_.palette.head
                                : shared ? view_.palette.neutral
                                         : glm::vec3(colour);
        list_.sphere(joints(c)[i], px(i == 0 ? 7.0f : 5.0f), Unit::Pixels, glm::vec4(paint, 1.0f)).shadow =
            true;
    }

    const View& view_;
    const Race& race_;
    const Study& study_;
    DrawList& list_;
    std::vector<const Racer*> chains_;
    std::vector<std::vector<glm::vec2>> pixels_;  ///< of chains_' joints
};

}  // namespace

void draw_race(const View& view, const ShownChain& shown, DrawList& list) {
    RaceDrawing(view, shown, list).run();
}

std::vector<PaneTitle> race_panes(const ShownChain& shown, const Palette& palette) {
    std::vector<PaneTitle> titles;
    if (!shown.race || !shown.part.study.side_by_side) return titles;
    for (const Racer& racer : shown.race->racers) {
        char text[96];
        std::snprintf(text, sizeof text, "%s: %d", solver_title(racer.method), racer.report.iterations);
        titles.push_back({text, end_text(racer), solver_colour(palette, racer.method)});
    }
    return titles;
}

}  // namespace tendril::app
