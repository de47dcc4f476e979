// A curve through control points that a chain of bones follows (tendril/ik/curve.hpp): its settings, drawing
// and picking.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <tendril/ik/curve.hpp>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/json_place.hpp"
#include "app/io/names.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

inline constexpr EnumNames<ik::CurveKind, 2> curve_kinds{
    "kind of curve",
    {{"hermite", "Through points", "Passes through every control point."},
     {"b_spline", "B-spline", "Smoother; passes through the first and the last, and near the others."}}};

struct CurveShape {
    std::vector<glm::vec3> points;  ///< metres
    ik::CurveOptions options{};     ///< without weights
    /// -1 to 1: how much less the first bones follow the curve than the last; negative: the reverse.
    float falloff = 0.0f;

    bool operator==(const CurveShape&) const = default;
    /// Refers to `weights`.
    ik::CurveOptions with(std::span<const float> weights) const;
};

/// The fraction of each bone's rotation to the curve; empty: the whole rotation.
std::vector<float> curve_weights(const CurveShape& shape, std::size_t bones);

/// Adds a control point at parameter `at` of ik::curve_point(); the shape stays nearly the same.
std::vector<glm::vec3> with_point_at(std::span<const glm::vec3> points, ik::CurveKind kind, float at);

Json points_json(std::span<const glm::vec3> points);
/// At most `most`. Throws std::runtime_error that begins with the JSON path.
std::vector<glm::vec3> read_control_points(const JsonPlace& list, std::size_t most);

glm::vec3 curve_colour(const Palette& palette);

/// Draws a curve, in strokes that are picked one by one, and its control points.
class CurvePen {
  public:
    /// Points are in world space. The strokes' picks count from `first`. `end`: colour of the last control
    /// point; `rank`: the control points' Stroke::rank.
    CurvePen(const View& view, std::span<const glm::vec3> points, ik::CurveKind kind, PickId first,
             glm::vec3 end, std::int16_t rank, DrawList& list)
        : view_(view), points_(points), kind_(kind), first_(first), end_(end), rank_(rank), list_(list) {}

    void line() const;
    /// A ball; the last one is larger.
    void control(std::size_t index, PickId pick, bool selected = false, bool active = false) const;

    /// The number of picks that the curve uses.
    static std::size_t strokes(std::size_t points);
    /// The parameter of ik::curve_point() at a stroke, counted from the first.
    static std::optional<float> place(std::size_t stroke, std::size_t points);

  private:
    float px(float pixels) const { return pixels * view_.scale; }

    const View& view_;
    std::span<const glm::vec3> points_;
    ik::CurveKind kind_;
    PickId first_;
    glm::vec3 end_;
    std::int16_t rank_;
    DrawList& list_;
};

}  // namespace tendril::app

/// All members except its points.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveShape>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::CurveShape>();
