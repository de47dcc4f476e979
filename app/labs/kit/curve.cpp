#include "app/labs/kit/curve.hpp"

#include <algorithm>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveShape>() noexcept {
    using app::CurveShape, app::field_in, ik::CurveOptions;
    static const Field rows[] = {field_in<&CurveShape::options, &CurveOptions::kind>(),
                                 field_in<&CurveShape::options, &CurveOptions::fit>(),
                                 field_in<&CurveShape::options, &CurveOptions::max_factor>(),
                                 field_in<&CurveShape::options, &CurveOptions::weight>(),
                                 field<&CurveShape::falloff>("falloff", {-1.0, 1.0}),
                                 field_in<&CurveShape::options, &CurveOptions::roll_start>(),
                                 field_in<&CurveShape::options, &CurveOptions::roll_end>()};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<CurveShape>() {
    static constexpr FieldText texts[] = {
        {.name = "kind",
         .label = "curve",
         .help = "How the curve passes its control points.",
         .listed = true,
         .choices = curve_kinds.rows},
        {.name = "fit",
         .label = "fit to the curve",
         .help = "Scales all bones by one factor, so that the tip lies on the last control point."},
        {.name = "max_factor",
         .label = "at most",
         .help = "The largest factor of the fit; its inverse is the smallest.",
         .more = true},
        {.name = "weight",
         .label = "weight",
         .help = "How far the bones turn from the chain's previous pose to the curve.",
         .step = 0.005f},
        {.name = "falloff",
         .label = "falloff",
         .help = "How much less the first bones follow the curve than the last; below 0: the last less than "
                 "the first.",
         .step = 0.005f,
         .more = true},
        {.name = "roll_start",
         .label = "roll at the root",
         .help = "How far the first bone is rolled about itself.",
         .step = 0.5f,
         .decimals = 0},
        {.name = "roll_end",
         .label = "roll at the tip",
         .help = "How far the last bone is rolled; between them the roll is spread by length.",
         .step = 0.5f,
         .decimals = 0}};
    return texts;
}

ik::CurveOptions CurveShape::with(std::span<const float> weights) const {
    ik::CurveOptions all = options;
    all.weights = weights;
    return all;
}

std::vector<float> curve_weights(const CurveShape& shape, std::size_t bones) {
    std::vector<float> weights;
    if (shape.falloff == 0.0f || bones < 2) return weights;
    for (std::size_t i = 0; i < bones; ++i) {
        const float along = static_cast<float>(i) / static_cast<float>(bones - 1);
        weights.push_back(1.0f -
                          (shape.falloff > 0.0f ? shape.falloff * (1.0f - along) : -shape.falloff * along));
    }
    return weights;
}

std::vector<glm::vec3> with_point_at(std::span<const glm::vec3> points, ik::CurveKind kind, float at) {
    std::vector<glm::vec3> more(points.begin(), points.end());
    more.insert(more.begin() + static_cast<std::ptrdiff_t>(at) + 1, ik::curve_point(points, kind, at));
    return more;
}

Json points_json(std::span<const glm::vec3> points) {
    Json list = Json::array();
    for (const glm::vec3& each : points) list.push_back(point(each));
    return list;
}

std::vector<glm::vec3> read_control_points(const JsonPlace& list, std::size_t most) {
    std::vector<glm::vec3> points;
    const std::size_t size = list.list_size("control points", most);
    for (std::size_t i = 0; i < size; ++i) points.push_back(list.element(i).point());
    return points;
}

glm::vec3 curve_colour(const Palette& palette) {
    return palette.theme == Theme::Light ? rgb(0xB2558A) : rgb(0xCC79A7);
}

namespace {

/// Between two control points, a curve with many of them has fewer strokes.
std::size_t strokes_per_span(std::size_t points) {
    return std::clamp<std::size_t>(2048 / std::max<std::size_t>(points - 1, 1), 2, 24);
}

}  // namespace

std::size_t CurvePen::strokes(std::size_t points) {
    return points < 2 ? 0 : strokes_per_span(points) * (points - 1);
}

std::optional<float> CurvePen::place(std::size_t stroke, std::size_t points) {
    if (stroke >= strokes(points)) return std::nullopt;
    return (static_cast<float>(stroke) + 0.5f) / static_cast<float>(strokes_per_span(points));
}

void CurvePen::line() const {
    const std::size_t all = strokes(points_.size()), each = strokes_per_span(points_.size());
    const bool hovered = view_.hovered >= first_ && view_.hovered < first_ + static_cast<PickId>(all);
    const glm::vec4 colour = faded(view_.palette, curve_colour(view_.palette), hovered ? 1.0f : 0.75f);
    const auto place_of = [&](std::size_t i) {
        return ik::curve_point(points_, kind_, static_cast<float>(i) / static_cast<float>(each));
    };
    glm::vec3 from = place_of(0);
    for (std::size_t i = 0; i < all; ++i) {
        const glm::vec3 to = place_of(i + 1);
        // Thick bones hide the curve: also draw it in front of them, thinner and fainter.
        list_.line(from, to, px(hovered ? 2.0f : 1.25f), faded(view_.palette, glm::vec3(colour), 0.55f))
            .layer = Layer::Overlay;
        Stroke& stroke = list_.line(from, to, px(hovered ? 3.0f : 2.0f), colour);
        stroke.pick = first_ + static_cast<PickId>(i);
        stroke.rank = 1;  // picked before the bones, which lie along the curve
        from = to;
    }
    if (kind_ == ik::CurveKind::Hermite) return;
    // A B-spline passes beside its points: these lines show which part each point belongs to.
    for (std::size_t i = 1; i < points_.size(); ++i)
        list_.line(points_[i - 1], points_[i], px(1.0f),
                   faded(view_.palette, curve_colour(view_.palette), 0.3f));
}

void CurvePen::control(std::size_t index, PickId pick, bool selected, bool active) const {
    if (!view_.handles) return;
    const bool hovered = view_.hovered == pick || view_.dragged == pick;
    const bool last = index + 1 == points_.size();
    const glm::vec3 colour = last ? end_ : curve_colour(view_.palette);
    Stroke& ball = list_.sphere(points_[index], px((last ? 7.5f : 6.0f) + (hovered ? 1.5f : 0.0f)),
                                Unit::Pixels, glm::vec4(colour, 1.0f));
    ball.shadow = true;
    ball.layer = Layer::Overlay;
    ball.pick = pick;
    ball.rank = rank_;
    if (!selected && !hovered && !last) return;
    list_
        .ring(points_[index], px(last ? 14.0f : 11.0f), px(active ? 2.5f : 1.5f),
              glm::vec4(selected ? view_.palette.selection : colour, 1.0f))
        .layer = Layer::Overlay;
}

}  // namespace tendril::app
