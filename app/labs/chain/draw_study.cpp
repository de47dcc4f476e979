#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

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
        const bool alone = moves.size() == 1;
        for (const ik::Step& move : moves) moved(move, alone);
        if (!alone || moves.front().neighbour == ik::no_joint) return;
        const ik::Step& move = moves.front();
        const glm::vec3 centre = trace.pose(step)[move.neighbour];
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

    void pose(const std::vector<glm::vec3>& joints, glm::vec4 colour, float width) {
        for (std::size_t i = 1; i < joints.size(); ++i)
            list_.line(joints[i - 1], joints[i], px(width), colour);
        for (const glm::vec3& joint : joints) list_.sphere(joint, px(width + 1.0f), Unit::Pixels, colour);
    }

    /// The start, and the ends of the last few iterations; older ones are fainter.
    void ghosts(const Trace& trace, std::size_t step) {
        pose(trace.start, ghost(0.8f), 2.0f);
        const int now = trace.iteration(step);
        for (int i = std::max(1, now - max_ghosts); i < now; ++i) {
            const float age = static_cast<float>(now - i) / static_cast<float>(max_ghosts + 1);
            pose(trace.pose(trace.end_of_iteration(i)), ghost(0.75f * (1.0f - age)), 1.5f);
        }
    }

    void moved(const ik::Step& move, bool alone) {
        const glm::vec4 accent(view_.palette.accent, 1.0f);
        list_.sphere(move.from, px(5.0f), Unit::Pixels, ghost(0.9f));
        if (glm::distance(move.from, move.to) > 1e-5f) list_.line(move.from, move.to, px(3.0f), accent);
        list_.ring(move.to, px(12.0f), px(2.0f), accent).layer = Layer::Overlay;
        if (alone) label(move.to, std::to_string(move.joint));
    }

    /// The line along which the joint slides: from its neighbour through its old position.
    void slide(glm::vec3 neighbour, const ik::Step& move) {
        const glm::vec3 towards = move.from - neighbour;
        const float away = glm::length(towards), bone = glm::distance(neighbour, move.to);
        if (away < 1e-5f) return;
        const glm::vec3 end = neighbour + towards / away * (std::max(away, bone) + 0.25f * bone);
        dashes(neighbour, end, faded(view_.palette, view_.palette.accent, 0.8f));
    }

    void dashes(glm::vec3 from, glm::vec3 to, glm::vec4 colour) {
        constexpr int dashes = 24;
        for (int i = 0; i < dashes; ++i) {
            const float a = static_cast<float>(i) / dashes, b = a + 0.5f / dashes;
            list_.line(from + (to - from) * a, from + (to - from) * b, px(1.5f), colour);
        }
    }

    /// A sphere as three circles, in the coordinate planes.
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

namespace {

constexpr float same_pixels = 3.0f;    ///< chains closer than this overlap
constexpr float strand_pixels = 4.5f;  ///< spacing of overlapping chains

class RaceDrawing {
  public:
    RaceDrawing(const View& view, const ShownChain& shown, DrawList& list)
        : view_(view), race_(*shown.race), study_(shown.part.study), step_(shown.step()), list_(list) {}

    void run() {
        const glm::vec4 ghost = faded(view_.palette, view_.palette.ghost, 0.8f);
        for (std::size_t i = 1; i < study_.start.size(); ++i)
            list_.line(study_.start[i - 1], study_.start[i], px(2.0f), ghost);
        for (std::size_t i = 0; i < race_.racers.size(); ++i) {
            if (study_.side_by_side && i != view_.pane) continue;
            chains_.push_back({race_.racers[i].method, racer_at(race_.racers[i], step_).joints});
        }
        project();
        for (std::size_t c = 0; c < chains_.size(); ++c) chain(c);
        if (!study_.side_by_side)
            for (std::size_t c = 0; c < chains_.size(); ++c) name_at_tip(c);
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    std::span<const glm::vec3> joints(std::size_t c) const { return chains_[c].joints; }

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

    /// Lateral offset, in pixels, of the bone that ends at `joint`: overlapping chains are drawn side by
    /// side, like the strands of a ribbon.
    float aside(std::size_t c, std::size_t joint) const {
        int before = 0, after = 0;
        for (std::size_t d = 0; d < chains_.size(); ++d) {
            if (d == c || !same_joint(c, d, joint - 1) || !same_joint(c, d, joint)) continue;
            (d < c ? before : after) += 1;
        }
        return 0.5f * px(strand_pixels) * static_cast<float>(before - after);
    }

    /// Unit vector across the bone that ends at `joint`, as seen on screen; zero if the bone is seen end-on.
    glm::vec3 sideways(std::size_t c, std::size_t joint) const {
        const glm::vec3 from = joints(c)[joint - 1], to = joints(c)[joint];
        const glm::vec3 across = glm::cross(view_.camera.forward(), to - from);
        const float length = glm::length(across);
        if (!(length > 1e-6f * glm::distance(from, to))) return glm::vec3(0.0f);
        return across / length;
    }

    /// Offset from the joint to the mitre with the adjacent bone of the same chain, so that both keep their
    /// distance from the middle. `bone` ends or starts at the joint.
    glm::vec3 corner(std::size_t c, std::size_t joint, std::size_t bone) const {
        const float metres = aside(c, bone) * view_.camera.metres_per_pixel(joints(c)[joint]);
        const glm::vec3 own = sideways(c, bone);
        const std::size_t other = bone == joint ? joint + 1 : joint;
        if (other == 0 || other >= joints(c).size() || aside(c, other) != aside(c, bone)) return metres * own;
        const glm::vec3 next = sideways(c, other);
        if (next == glm::vec3(0.0f) || own == glm::vec3(0.0f)) return metres * own;
        const glm::vec3 mean = 0.5f * (own + next);
        return metres / std::max(glm::dot(mean, mean), 0.25f) * mean;  // limits the mitre of a sharp corner
    }

    void chain(std::size_t c) {
        const glm::vec4 colour(solver_colour(view_.palette, chains_[c].method), 1.0f);
        const std::span<const glm::vec3> at = joints(c);
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (i > 0) {
                list_.line(at[i - 1] + corner(c, i - 1, i), at[i] + corner(c, i, i), px(3.0f), colour)
                    .shadow = true;
            }
            joint(c, i, colour);
        }
    }

    /// Chains that share a joint position share one ball.
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

    /// Chains with the same tip share one label, with a line for each name.
    void name_at_tip(std::size_t c) {
        const std::size_t tip = joints(c).size() - 1;
        std::string names;
        for (std::size_t d = 0; d < chains_.size(); ++d) {
            if (d != c && !same_joint(c, d, tip)) continue;
            if (d < c) return;
            names += (names.empty() ? "" : "\n") + std::string(solver_title(chains_[d].method));
        }
        const bool alone = names == solver_title(chains_[c].method);
        list_.labels.push_back(
            {.at = joints(c)[tip],
             .clearance = px(12.0f),
             .text = std::move(names),
             .colour = alone ? solver_colour(view_.palette, chains_[c].method) : view_.palette.text,
             .rank = 2});
    }

    const View& view_;
    const Race& race_;
    const Study& study_;
    std::size_t step_;
    DrawList& list_;
    struct Posed {
        ik::Method method;
        std::span<const glm::vec3> joints;
    };
    std::vector<Posed> chains_;
    std::vector<std::vector<glm::vec2>> pixels_;  ///< pixels of the joints of chains_
};

}  // namespace

void draw_race(const View& view, const ShownChain& shown, DrawList& list) {
    RaceDrawing(view, shown, list).run();
}

std::vector<PaneTitle> race_panes(const ShownChain& shown, const Palette& palette) {
    std::vector<PaneTitle> titles;
    if (!shown.race || !shown.part.study.side_by_side) return titles;
    for (const Racer& racer : shown.race->racers) {
        const RacerAt at = racer_at(racer, shown.step());
        titles.push_back({std::string(solver_title(racer.method)) + ": " + progress_text(at),
                          error_text(racer, at), solver_colour(palette, racer.method)});
    }
    return titles;
}

}  // namespace tendril::app
