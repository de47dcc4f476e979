// The Rope lab's picture, as plain as can be: links as lines, colliders as what they are.
#include <glm/geometric.hpp>

#include "app/labs/rope/rope_lab.hpp"

namespace tendril::app {
namespace {

class Drawing {
  public:
    Drawing(const View& view, DrawList& list)
        : view_(view), list_(list), part_(rope_part(view.workspace)), world_(*part_.world) {}

    void run() {
        colliders();
        links();
        particles();
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    bool lit(PickId pick) const { return view_.hovered == pick || view_.dragged == pick; }

    void colliders() {
        const auto& all = world_.state().colliders;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const PickId pick = collider_pick(i);
            const bool chosen = part_.choice && part_.choice->collider == all[i].name;
            const glm::vec3 colour = chosen      ? view_.palette.selection
                                     : lit(pick) ? view_.palette.accent
                                                 : view_.palette.joint;
            Stroke* stroke = shape(all[i].shape, glm::vec4(colour, 1.0f));
            if (stroke == nullptr) continue;
            stroke->shadow = true;
            stroke->pick = pick;
        }
    }

    /// Null for what has no end.
    Stroke* shape(const rope::Shape& shape, glm::vec4 colour) {
        if (const auto* sphere = std::get_if<rope::Sphere>(&shape))
            return &list_.sphere(sphere->centre, sphere->radius, Unit::Metres, colour);
        if (const auto* capsule = std::get_if<rope::Capsule>(&shape))
            return &list_.bone(capsule->a, capsule->b, capsule->radius, capsule->radius, colour);
        if (const auto* box = std::get_if<rope::Box>(&shape)) return &edges(*box, colour);
        return nullptr;
    }

    Stroke& edges(const rope::Box& box, glm::vec4 colour) {
        const auto corner = [&](int bits) {
            const glm::vec3 sign(bits & 1 ? 1 : -1, bits & 2 ? 1 : -1, bits & 4 ? 1 : -1);
            return box.centre + box.rotation * (sign * box.half_extents);
        };
        for (int from = 0; from < 8; ++from)
            for (const int axis : {1, 2, 4})
                if ((from & axis) == 0) list_.line(corner(from), corner(from | axis), px(1.5f), colour);
        const float size = rope::size(box);
        return list_.sphere(box.centre, size, Unit::Metres, colour);
    }

    void links() {
        const auto& state = world_.state();
        list_.strokes.reserve(list_.strokes.size() + state.links.size() + 64);
        std::size_t at = 0;
        std::vector<float> radius(world_.size());
        for (const rope::Body& body : state.bodies)
            for (std::size_t i = 0; i < body.count; ++i) radius[body.first + i] = body.radius;
        for (const rope::Link& link : state.links) {
            if (link.kind != rope::Link::Kind::Stretch) continue;
            at = link.a;
            Stroke& stroke = list_.bone(world_.position(link.a), world_.position(link.b), radius[at],
                                        radius[at], glm::vec4(view_.palette.link, 1.0f));
            stroke.shadow = true;
            stroke.pick = particle_pick(link.a);
        }
    }

    void particles() {
        const std::size_t stride = handle_stride(world_);
        std::vector<bool> pinned(world_.size());
        for (const rope::Pin& pin : world_.state().pins) pinned[pin.particle] = true;
        for (const rope::Body& body : world_.state().bodies) {
            for (std::size_t i = 0; i < body.count; ++i) {
                const std::size_t particle = body.first + i;
                const PickId pick = particle_pick(particle);
                const bool chosen = part_.choice && part_.choice->collider.empty() &&
                                    part_.choice->body == body.name && part_.choice->particle == i;
                const bool shown =
                    pinned[particle] || chosen || lit(pick) || (part_.view.particles && i % stride == 0);
                if (!shown) continue;
                const glm::vec3 colour = chosen             ? view_.palette.selection
                                         : pinned[particle] ? view_.palette.target
                                                            : view_.palette.joint;
                Stroke& ball = list_.sphere(world_.position(particle), px(pinned[particle] ? 5.0f : 4.0f),
                                            Unit::Pixels, glm::vec4(colour, 1.0f));
                ball.pick = pick;
                ball.rank = 1;
            }
        }
    }

    const View& view_;
    DrawList& list_;
    const RopePart& part_;
    const rope::World& world_;
};

}  // namespace

void RopeLab::draw(const View& view, DrawList& list) const {
    Drawing(view, list).run();
}

std::vector<LegendRow> RopeLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    return {{"pinned", colours.target}, {"selection", colours.selection}};
}

}  // namespace tendril::app
