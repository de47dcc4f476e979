// Drawing of the Rope lab: ropes as tubes, cloth, hair, colliders and pins.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "app/labs/kit/named_world.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_time.hpp"
#include "app/view/surfaces.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

constexpr float plane_radius = 3.0f;       ///< visible radius of an infinite plane, metres
constexpr double heavy_from = 4.0;         ///< multiple of the mass of a rope's lightest particle
constexpr double weight_density = 2500.0;  ///< kg/m^3, the density of stone
constexpr glm::vec4 unseen{0.0f};          ///< for invisible strokes that only catch the pointer

class Drawing {
  public:
    Drawing(const View& view, DrawList& list)
        : view_(view), list_(list), part_(rope_part(view.workspace)), world_(world_in(part_, view.pane)) {
        const PickId first = pick_in(view.pane, 0);
        const auto here = [&](PickId pick) {
            return pick >= first && pick < first + picks_in_pane ? pick - first : no_pick;
        };
        hovered_ = here(view.hovered);
        dragged_ = here(view.dragged);
    }

    void run() {
        const std::size_t before = list_.strokes.size();
        for (std::size_t i = 0; i < world_.state().colliders.size(); ++i) collider(i);
        positions_ = world_.positions();
        colours_ = particle_colours(world_, view_.palette, part_.view.strain, part_.view.colours());
        if (!part_.view.strain) mark_selection();
        for (const rope::Body& body : world_.state().bodies) {
            const bool coloured = part_.view.strain || marked(body);
            if (body.kind != rope::Body::Kind::Cloth)
                draw_strands(list_, view_.camera, as_drawn(body), positions_, colours_, part_.view.sides);
            else
                draw_cloth(list_, view_.camera, world_, body, positions_,
                           coloured ? std::span<const glm::vec3>(colours_) : std::span<const glm::vec3>(),
                           view_.palette, part_.view.colours());
        }
        weights();
        catchable_links();
        for (std::size_t i = 0; i < world_.state().ties.size(); ++i) tie(i);
        particles();
        labels();
        for (Stroke& stroke : std::span(list_.strokes).subspan(before))
            if (stroke.pick != no_pick) stroke.pick = pick_in(view_.pane, stroke.pick);
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    float radius(const rope::Body& body) const {
        return body.kind == rope::Body::Kind::Cloth ? body.radius : part_.view.thickness * body.radius;
    }
    rope::Body as_drawn(rope::Body body) const {
        body.radius = radius(body);
        return body;
    }
    bool lit(PickId pick) const { return hovered_ == pick || dragged_ == pick; }
    bool chosen(const rope::Body& body) const {
        return view_.handles && part_.selection && part_.selection->of_particles() &&
               part_.selection->body == world_.name(body);
    }
    bool chosen(const rope::Body& body, std::size_t i) const {
        return chosen(body) && part_.selection->particles.has(i);
    }

    /// True if its particles show the selection; if all of it is selected, the body's colour does.
    bool shows_selected(const rope::Body& body) const {
        return chosen(body) && (body.count == 1 || part_.selection->particles.all().size() < body.count);
    }
    /// True if the body is marked. A body with its own colour keeps it if its particles show the selection.
    bool marked(const rope::Body& body) const {
        return chosen(body) &&
               (colour_of(world_, body, part_.view.colours()) == BodyColour::ByKind || !shows_selected(body));
    }

    glm::vec3 collider_colour(std::size_t i) const {
        const bool selected = view_.handles && part_.selection &&
                              part_.selection->collider == world_.name(world_.state().colliders[i]);
        if (selected) return glm::mix(view_.palette.ghost, view_.palette.selection, 0.5f);
        return lit(collider_pick(i)) ? view_.palette.accent : view_.palette.ghost;
    }

    void collider(std::size_t i) {
        const rope::Shape shape = world_.shape(world_.state().colliders[i]);
        const glm::vec3 colour = collider_colour(i);
        const PickId pick = collider_pick(i);
        if (const auto* sphere = std::get_if<rope::Sphere>(&shape)) {
            solid(list_.sphere(sphere->centre, sphere->radius, Unit::Metres, glm::vec4(colour, 1.0f)), pick);
        } else if (const auto* capsule = std::get_if<rope::Capsule>(&shape)) {
            solid(
                list_.bone(capsule->a, capsule->b, capsule->radius, capsule->radius, glm::vec4(colour, 1.0f)),
                pick);
        } else if (const auto* block = std::get_if<rope::Box>(&shape)) {
            box(list_, view_.camera, block->centre, block->half_extents, block->rotation, colour);
            catchable_box(*block, pick);
        } else if (const auto* plane = std::get_if<rope::Plane>(&shape)) {
            plane_patch(list_, view_.camera, plane->point, plane->normal, plane_radius, colour);
            // A grip in the centre of the plane, except on the ground, where it would get in the way.
            if (!view_.handles || (plane->point.y == 0.0f && glm::normalize(plane->normal).y > 0.999f))
                return;
            solid(list_.sphere(plane->point, px(5.0f), Unit::Pixels, glm::vec4(colour, 1.0f)), pick);
        }
    }
    static void solid(Stroke& stroke, PickId pick) {
        stroke.shadow = true;
        stroke.pick = pick;
    }
    /// Invisible capsules along all except its thinnest sides approximate the box.
    void catchable_box(const rope::Box& block, PickId pick) {
        const glm::vec3 half = block.half_extents;
        const float thick = std::min({half.x, half.y, half.z});
        for (int axis = 0; axis < 3; ++axis) {
            if (half[axis] == thick && axis > 0) continue;
            glm::vec3 along(0.0f);
            along[axis] = half[axis] - thick;
            along = block.rotation * along;
            list_.bone(block.centre - along, block.centre + along, thick, thick, unseen).pick = pick;
        }
    }

    void mark_selection() {
        for (const rope::Body& body : world_.state().bodies) {
            if (!marked(body)) continue;
            for (std::size_t i = body.first; i < body.first + body.count; ++i)
                colours_[i] = glm::mix(colours_[i], view_.palette.selection, 0.35f);
        }
    }

    /// Particles much heavier than their neighbours, as a pendulum's bob, are balls, sized by their mass.
    void weights() {
        const std::vector<double>& mass = world_.state().mass;
        for (const rope::Body& body : world_.state().bodies) {
            if (body.kind != rope::Body::Kind::Rope) continue;
            const auto first = mass.begin() + static_cast<std::ptrdiff_t>(body.first);
            const double lightest = *std::min_element(first, first + static_cast<std::ptrdiff_t>(body.count));
            for (std::size_t i = body.first; i < body.first + body.count; ++i) {
                if (mass[i] < heavy_from * lightest) continue;
                const auto ball = static_cast<float>(
                    math::exponential(math::logarithm(0.75 * mass[i] / (math::pi * weight_density)) / 3.0));
                if (ball <= radius(body)) continue;
                const PickId pick = particle_pick(i);
                const glm::vec3 colour = lit(pick) ? view_.palette.accent : colours_[i];
                solid(list_.sphere(positions_[i], ball, Unit::Metres, glm::vec4(colour, 1.0f)), pick);
            }
        }
    }

    /// Each half of a link picks the particle at its end. With the cut tool, a link picks its first particle.
    void catchable_links() {
        const bool cuts = part_.tool == RopeTool::Cut;
        const rope::State& state = world_.state();
        list_.strokes.reserve(list_.strokes.size() + 2 * state.links.size());
        std::size_t b = 0;
        for (const rope::Link& link : state.links) {
            b = body_with(state, link.a, b);
            const rope::Body& body = state.bodies[b];
            if (link.kind != rope::Link::Kind::Stretch || body.kind == rope::Body::Kind::Hair) continue;
            const glm::vec3 from = positions_[link.a], to = positions_[link.b], middle = 0.5f * (from + to);
            catchable(from, cuts ? to : middle, radius(body), link.a);
            if (!cuts) catchable(middle, to, radius(body), link.b);
            const bool last = link.b + 1 == body.first + body.count && hovered_ == particle_pick(link.b);
            const bool hit = hovered_ == particle_pick(link.a) || last;
            if (cuts && hit && body.kind == rope::Body::Kind::Rope) {
                const float thick = 1.15f * radius(body);
                list_.bone(from, to, thick, thick, glm::vec4(view_.palette.limit, 1.0f));
            }
        }
    }
    void catchable(glm::vec3 from, glm::vec3 to, float radius, std::size_t particle) {
        Stroke& stroke = list_.bone(from, to, radius, radius, unseen);
        stroke.pick = particle_pick(particle);
    }

    /// A thin link with a knot at each end; one knot if the particles coincide.
    void tie(std::size_t i) {
        const rope::Tie& tie = world_.state().ties[i];
        const PickId pick = tie_pick(i);
        const bool selected = view_.handles && part_.selection && part_.selection->tie == world_.name(tie);
        const glm::vec4 colour(selected    ? view_.palette.selection
                               : lit(pick) ? view_.palette.accent
                                           : glm::mix(view_.palette.joint, view_.palette.text, 0.35f),
                               1.0f);
        const glm::vec3 a = positions_[tie.a], b = positions_[tie.b];
        const float thick = std::max(thickness(tie.a), thickness(tie.b));
        solid(list_.sphere(a, 1.4f * thick, Unit::Metres, colour), pick);
        if (tie.now < thick) return;
        solid(list_.sphere(b, 1.4f * thick, Unit::Metres, colour), pick);
        solid(list_.bone(a, b, 0.6f * thick, 0.6f * thick, colour), pick);
    }
    float thickness(std::size_t particle) const {
        const rope::Body& body = *picked_particle(world_, particle_pick(particle))->body;
        return std::max(radius(body), px(2.0f) * view_.camera.metres_per_pixel(positions_[particle]));
    }

    void particles() {
        std::vector<bool> pinned(world_.size());
        for (const rope::Pin& pin : world_.state().pins)
            pinned[pin.particle] = view_.handles && !pin.collider;
        const bool cuts = part_.tool == RopeTool::Cut;
        for (const rope::Body& body : world_.state().bodies) {
            const bool some = shows_selected(body);
            for (std::size_t i = 0; i < body.count; ++i) {
                const std::size_t particle = body.first + i;
                const PickId pick = particle_pick(particle);
                const bool alone = body.count == 1;  // the remainder of a rope cut near its end
                const bool selected = some && chosen(body, i), under_mouse = !cuts && lit(pick);
                if (!(pinned[particle] || selected || under_mouse || part_.view.particles || alone)) continue;
                const glm::vec3 colour = selected            ? view_.palette.selection
                                         : pinned[particle]  ? view_.palette.target
                                         : under_mouse       ? view_.palette.accent
                                         : part_.view.strain ? colours_[particle]
                                                             : view_.palette.joint;
                Stroke& ball = list_.sphere(positions_[particle], ball_radius(body, particle), Unit::Pixels,
                                            glm::vec4(colour, 1.0f));
                ball.pick = pick;
                ball.rank = pinned[particle] ? 2 : 1;
            }
        }
    }
    /// In pixels: slightly more than the rope's thickness, so that the ball is visible.
    float ball_radius(const rope::Body& body, std::size_t particle) const {
        const float thick = radius(body) / view_.camera.metres_per_pixel(positions_[particle]);
        return std::clamp(1.3f * thick, px(3.0f), std::max(px(6.0f), 1.3f * thick));
    }

    void labels() {
        const bool always = view_.workspace.settings.labels == LabelMode::Always;
        const PickId shown = dragged_ != no_pick ? dragged_ : hovered_;
        const auto add = [&](glm::vec3 at, const std::string& text, bool under_mouse) {
            list_.labels.push_back({.at = at,
                                    .clearance = px(12.0f),
                                    .text = text,
                                    .colour = view_.palette.text,
                                    .rank = under_mouse ? 1 : 0});
        };
        const rope::State& state = world_.state();
        for (std::size_t i = 0; i < state.colliders.size(); ++i) {
            const bool under_mouse = shown == collider_pick(i);
            if (under_mouse || always)
                add(rope::centre(world_.shape(state.colliders[i])), world_.name(state.colliders[i]),
                    under_mouse);
        }
        for (const rope::Body& body : state.bodies)
            if (always) add(positions_[body.first], world_.name(body), false);
        for (std::size_t i = 0; i < state.ties.size(); ++i)
            if (shown == tie_pick(i)) add(positions_[state.ties[i].a], world_.name(state.ties[i]), true);
        if (const auto place = picked_particle(world_, shown)) {
            const std::size_t particle = place->body->first + place->index;
            add(positions_[particle],
                world_.name(*place->body) + ", particle " + std::to_string(place->index), true);
        }
    }

    const View& view_;
    DrawList& list_;
    const RopePart& part_;
    const NamedWorld& world_;
    PickId hovered_ = no_pick, dragged_ = no_pick;  ///< in this pane
    std::vector<glm::vec3> positions_, colours_;
};

}  // namespace

void RopeLab::draw(const View& view, DrawList& list) const {
    draw_past_ghosts(view, rope_past(), list);
    Drawing(view, list).run();
}

std::vector<LegendRow> RopeLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<LegendRow> rows{{.name = "pinned", .colour = colours.target, .handle = true},
                                {.name = "selection", .colour = colours.selection, .handle = true}};
    add_ghost_legend(workspace, rope_past(), rows);
    const RopePart& part = rope_part(workspace);
    if (!part.view.strain) {
        const KindColours kinds = part.view.colours();
        for (const BodyColour colour : body_colours.values()) {
            std::vector<const rope::Body*> bodies;
            for (const rope::Body& body : part.world->state().bodies)
                if (colour_of(*part.world, body, kinds) == colour) bodies.push_back(&body);
            if (colour == BodyColour::ByKind || bodies.empty()) continue;
            std::string name = part.world->name(*bodies.front());
            if (bodies.size() > 1) name += " and " + std::to_string(bodies.size() - 1) + " more";
            rows.push_back({name, body_colour(*part.world, *bodies.front(), colours, kinds)});
        }
    } else {
        rows.push_back({"its length", strain_colour(0.0f, colours)});
        rows.push_back({"1 % too long", strain_colour(0.01f, colours)});
        rows.push_back({"10 % too long", strain_colour(0.1f, colours)});
        rows.push_back({"10 % too short", strain_colour(-0.1f, colours)});
    }
    return rows;
}

}  // namespace tendril::app
