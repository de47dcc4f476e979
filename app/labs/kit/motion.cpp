#include "app/labs/kit/motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/vector_relational.hpp>
#include <stdexcept>
#include <tendril/magnitude.hpp>

#include "app/document/workspace.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "tendril/elementary.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Motion>() noexcept {
    using app::Motion;
    static constexpr auto paths = app::motion_paths.name_array();
    static constexpr Field rows[] = {
        field<&Motion::path>("path", paths),
        field<&Motion::centre>("centre", {-max_magnitude, max_magnitude}, "m"),
        field<&Motion::radius>("radius", {0.0, app::max_motion_radius}, "m"),
        field<&Motion::period>("period", {app::min_period, app::max_period}, "s"),
        field<&Motion::ticks>("ticks", {0.0, 36'000.0})};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<Motion>() {
    static constexpr FieldText texts[] = {
        {.name = "path",
         .label = "motion",
         .help = "A path that the target follows while the simulation runs. It shows how a solver follows "
                 "motion.",
         .listed = true,
         .choices = motion_paths.rows},
        {.name = "radius", .label = "radius", .help = "How far the path goes to each side of its centre."},
        {.name = "period",
         .label = "period",
         .help = "How long one round takes. Shorter is faster.",
         .step = 0.02f}};
    return texts;
}

double round_angle(double seconds, float period) {
    const double rounds = seconds / static_cast<double>(period);
    return glm::two_pi<double>() * (rounds - std::floor(rounds));
}

void check_path(glm::vec3 centre, glm::vec3 span, const char* what) {
    const glm::vec3 farthest = glm::abs(centre) + glm::abs(span);
    if (!glm::all(glm::lessThanEqual(farthest, glm::vec3(max_magnitude))))
        throw std::invalid_argument(std::string(what) + " would reach farther than 1e9 m");
}

std::uint32_t ticks_per_round(const Motion& motion) {
    return static_cast<std::uint32_t>(std::max(1L, std::lround(motion.period * 60.0f)));
}

glm::vec3 motion_point(const Motion& motion, std::uint32_t ticks) {
    const std::uint32_t round = ticks_per_round(motion);
    const float angle = glm::two_pi<float>() * static_cast<float>(ticks % round) / static_cast<float>(round);
    const float c = math::cosine(angle), s = math::sine(angle);
    switch (motion.path) {
        case Motion::Path::Still:
            break;
        case Motion::Path::Circle:
            return motion.centre + motion.radius * glm::vec3(c, s, 0.0f);
        case Motion::Path::FigureEight:
            return motion.centre + motion.radius * glm::vec3(c, s * c, 0.5f * s);
        case Motion::Path::Sweep:
            return motion.centre + motion.radius * glm::vec3(s, 0.0f, 0.0f);
    }
    return motion.centre;
}

Motion load_motion(const JsonPlace& place) {
    Motion motion;
    load_all_fields(place, motion);
    place["ticks"].integer(0, static_cast<int>(ticks_per_round(motion)) - 1);
    return motion;
}

}  // namespace tendril::app
