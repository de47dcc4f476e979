#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "app/labs/chain/colours.hpp"
#include "app/labs/chain/draw.hpp"

namespace tendril::app {
namespace {

constexpr int max_ghosts = 6;

class MicroscopeDrawing {
  public:
    MicroscopeDrawing(const View& view, const ShownChain& shown, DrawList& list)
        : view_(view), shown_(shown), part_(shown.part), list_(list) {}

    void run() {
        const Trace& trace = *shown_.trace;
        const std::size_t step = part_.study.step;
        ghosts(trace, step);
        const auto moves = trace.frame(step);
        if (moves.empty()) return;
        const std::vector<glm::vec3> pose = trace.pose(step);
        const bool alone = moves.size() == 1;
        for (const ik::Step& move : moves) moved(move, alone);
        if (!alone || moves.front().neighbour == ik::no_joint) return;
        const ik::Step& move = moves.front();
        const glm::vec3 centre = pose[move.neighbour];
        slide(centre, move);
        sphere(centre, glm::distance(centre, move.to));
        label(centre, std::to_string(move.neighbour));
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    glm::vec4 ghost(float alpha) const { return faded(view_.palette, view_.palette.ghost, alpha); }

    void label(glm::vec3 at, std::string text) {
        list_.labels.push_back({.at = at,
                                .clearance = px(12.0f),
                                .text = std::move(text),
                                .colour = view_.palette.text,
                                .rank = 3});
    }

    void polyline(const std::vector<glm::vec3>& joints, glm::vec4 colour, float width) {
        for (std::size_t i = 1; i < joints.size(); ++i) {
            list_.line(joints[i - 1], joints[i], px(width), colour);
        }
    }

    /// The start, and where the last iterations ended, the older the fainter.
    void ghosts(const Trace& trace, std::size_t step) {
        polyline(trace.start, ghost(0.8f), 2.0f);
        for (const glm::vec3& joint : trace.start) list_.sphere(joint, px(3.0f), Unit::Pixels, ghost(0.8f));
        const int now = trace.iteration(step);
        for (int i = std::max(1, now - max_ghosts); i < now; ++i) {
            const float age = static_cast<float>(now - i) / static_cast<float>(max_ghosts + 1);
            const std::vector<glm::vec3> pose = trace.pose(trace.end_of_iteration(i));
            polyline(pose, ghost(0.75f * (1.0f - age)), 1.5f);
            for (const glm::vec3& joint : pose) {
                list_.sphere(joint, px(2.5f), Unit::Pixels, ghost(0.75f * (1.0f - age)));
            }
        }
    }

    void moved(const ik::Step& move, bool alone) {
        const glm::vec4 accent(view_.palette.accent, 1.0f);
        list_.sphere(move.from, px(5.0f), Unit::Pixels, ghost(0.9f));
        if (glm::distance(move.from, move.to) > 1e-5f) list_.line(move.from, move.to, px(3.0f), accent);
        list_.ring(move.to, px(12.0f), px(2.0f), accent).layer = Layer::Overlay;
        if (alone) label(move.to, std::to_string(move.joint));
    }

    /// The line on which the joint slides: from its neighbour through where it was.
    void slide(glm::vec3 neighbour, const ik::Step& move) {
        const glm::vec3 towards = move.from - neighbour;
        const float away = glm::length(towards), bone = glm::distance(neighbour, move.to);
        if (away < 1e-5f) return;
        const glm::vec3 end = neighbour + towards / away * (1.25f * std::max(away, bone));
        dashes(neighbour, end, faded(view_.palette, view_.palette.accent, 0.8f));
    }

    void dashes(glm::vec3 from, glm::vec3 to, glm::vec4 colour) {
        constexpr int dashes = 24;
        for (int i = 0; i < dashes; ++i) {
            const float a = static_cast<float>(i) / dashes, b = a + 0.5f / dashes;
            list_.line(from + (to - from) * a, from + (to - from) * b, px(1.5f), colour);
        }
    }

    /// Three circles of a sphere: those in the planes of the axes.
    void sphere(glm::vec3 centre, float radius) {
        const glm::vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int plane = 0; plane < 3; ++plane) {
            draw_circle(list_, centre, radius, axes[plane], axes[(plane + 1) % 3], px(1.0f),
                        faded(view_.palette, view_.palette.accent, 0.45f));
        }
    }

    const View& view_;
    const ShownChain& shown_;
    const ChainPart& part_;
    DrawList& list_;
};

}  // namespace

void draw_microscope(const View& view, const ShownChain& shown, DrawList& list) {
    MicroscopeDrawing(view, shown, list).run();
}

}  // namespace tendril::app
