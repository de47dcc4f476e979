#include "app/labs/chain/chain_part.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vector_relational.hpp>
#include <stdexcept>

#include "app/labs/chain/presets.hpp"

namespace tendril::app {
namespace {

struct ModeText {
    Mode mode;
    const char* name;
    const char* title;
    const char* help;
};
constexpr ModeText mode_texts[] = {
    {Mode::Forward, "forward", "Forward", "Pulls by the head: it goes to the target, the rest trails."},
    {Mode::Backward, "backward", "Backward", "Pulls by the tail: it goes to the target, the rest trails."},
    {Mode::Fixed, "fixed", "Fixed", "The head reaches for the target; the tail stays where it is."},
    {Mode::WithIndex, "with_index", "With index", "Pulls by one segment; both sides trail."},
};

const ModeText& text_of(Mode mode) {
    return *std::find_if(std::begin(mode_texts), std::end(mode_texts),
                         [&](const auto& t) { return t.mode == mode; });
}

constexpr const char* motion_names[] = {"still", "circle", "figure_eight", "sweep"};

}  // namespace

const char* mode_name(Mode mode) {
    return text_of(mode).name;
}
const char* mode_title(Mode mode) {
    return text_of(mode).title;
}
const char* mode_help(Mode mode) {
    return text_of(mode).help;
}

Mode mode_from_name(const std::string& name) {
    for (const auto& text : mode_texts) {
        if (name == text.name) return text.mode;
    }
    throw std::invalid_argument("unknown mode \"" + name + "\"");
}

const char* motion_name(Motion::Path path) {
    return motion_names[static_cast<std::size_t>(path)];
}

Motion::Path motion_from_name(const std::string& name) {
    for (const Motion::Path path : all_motions) {
        if (name == motion_name(path)) return path;
    }
    throw std::invalid_argument("unknown path \"" + name + "\"");
}

std::uint32_t ticks_per_round(const Motion& motion) {
    return static_cast<std::uint32_t>(std::max(1L, std::lround(motion.period * 60.0f)));
}

glm::vec3 motion_point(const Motion& motion, std::uint32_t ticks) {
    const std::uint32_t round = ticks_per_round(motion);
    const float angle = glm::two_pi<float>() * static_cast<float>(ticks % round) / static_cast<float>(round);
    const float c = std::cos(angle), s = std::sin(angle);
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

ChainPart first_chain() {
    ChainPart part;
    part.chain = make_preset("start", 8, 1);
    part.target = part.chain.position(part.chain.size() - 1);
    return part;
}

bool same(const ChainPart& a, const ChainPart& b) {
    return a.mode == b.mode && a.index == b.index && a.iterations == b.iterations &&
           a.tolerance == b.tolerance && a.target == b.target && a.selected == b.selected &&
           a.motion == b.motion && a.chain == b.chain;
}

void check_range(const ChainPart& part) {
    const auto outside = [](glm::vec3 p) {
        return glm::any(glm::greaterThan(glm::abs(p), glm::vec3(max_magnitude)));
    };
    for (const Segment& segment : part.chain.segments()) {
        if (outside(segment.position))
            throw std::invalid_argument("the chain would reach farther than 1e9 m");
    }
    if (part.motion.path == Motion::Path::Still) return;
    const glm::vec3 span(part.motion.radius);
    if (outside(part.motion.centre - span) || outside(part.motion.centre + span)) {
        throw std::invalid_argument("the target's path would reach farther than 1e9 m");
    }
}

void reach_for(ChainPart& part, glm::vec3 target) {
    const int iterations = part.iterations[static_cast<std::size_t>(part.mode)];
    switch (part.mode) {
        case Mode::Forward:
            part.chain.forward(target);
            break;
        case Mode::Backward:
            part.chain.backward(target);
            break;
        case Mode::Fixed:
            part.chain.fixed(target, {.iterations = iterations, .tolerance = part.tolerance});
            break;
        case Mode::WithIndex:
            if (!part.chain.empty()) part.chain.with_index(part.index, target);
            break;
    }
    part.target = target;
}

float length_error(const Chain& chain, std::size_t index) {
    if (index == 0) return 0.0f;
    const auto segments = chain.segments();
    return std::abs(glm::distance(segments[index].position, segments[index - 1].position) -
                    segments[index].length);
}

Json ChainPart::save() const {
    Json segments = Json::array();
    for (const Segment& segment : chain.segments()) {
        segments.push_back({{"position", point(segment.position)}, {"length", number(segment.length)}});
    }
    Json json{{"mode", mode_name(mode)}, {"index", index}};
    for (const Mode each : all_modes)
        json["iterations"][mode_name(each)] = iterations[static_cast<std::size_t>(each)];
    json["tolerance"] = number(tolerance);
    json["target"] = point(target);
    json["selected"] = selected ? Json(*selected) : Json(nullptr);
    json["default_direction"] = point(chain.default_direction());
    json["motion"] = {{"path", motion_name(motion.path)},
                      {"centre", point(motion.centre)},
                      {"radius", number(motion.radius)},
                      {"period", number(motion.period)},
                      {"ticks", motion.ticks}};
    json["segments"] = std::move(segments);
    return json;
}

namespace {

std::vector<Segment> load_segments(const Json& json, const std::string& where) {
    if (!json.is_array()) throw std::runtime_error(where + " must be a list");
    if (json.size() > max_segments) {
        throw std::runtime_error(where + " has " + std::to_string(json.size()) + " segments; the most is " +
                                 std::to_string(max_segments));
    }
    std::vector<Segment> segments;
    segments.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string here = where + "." + std::to_string(i);
        segments.push_back({json_point(json_member(json[i], "position", here), here + ".position"),
                            json_number(json_member(json[i], "length", here), here + ".length")});
        if (segments.back().length < 0.0f) {
            throw std::runtime_error(here + ".length must be at least 0, got " +
                                     number(segments.back().length).dump());
        }
    }
    return segments;
}

Motion load_motion(const Json& json, const std::string& where) {
    Motion motion;
    motion.path = motion_from_name(json_text(json_member(json, "path", where), where + ".path"));
    motion.centre = json_point(json_member(json, "centre", where), where + ".centre");
    motion.radius = json_number(json_member(json, "radius", where), where + ".radius");
    motion.period = json_number(json_member(json, "period", where), where + ".period");
    if (motion.radius < 0.0f || motion.radius > 1e4f)
        throw std::runtime_error(where + ".radius must be 0 to 1e4");
    if (motion.period < 0.1f || motion.period > 600.0f)
        throw std::runtime_error(where + ".period must be 0.1 to 600");
    const int most = static_cast<int>(ticks_per_round(motion)) - 1;
    motion.ticks = static_cast<std::uint32_t>(
        json_integer(json_member(json, "ticks", where), where + ".ticks", 0, most));
    return motion;
}

}  // namespace

std::shared_ptr<Part> ChainPart::load(const Json& json, const std::string& where) const {
    auto part = std::make_shared<ChainPart>();
    try {
        part->mode = mode_from_name(json_text(json_member(json, "mode", where), where + ".mode"));
        const Json& repeats = json_member(json, "iterations", where);
        for (const Mode each : all_modes) {
            const std::string here = where + ".iterations";
            part->iterations[static_cast<std::size_t>(each)] = json_integer(
                json_member(repeats, mode_name(each), here), here + "." + mode_name(each), 1, max_iterations);
        }
        part->tolerance = json_number(json_member(json, "tolerance", where), where + ".tolerance");
        if (part->tolerance < 0.0f) throw std::runtime_error(where + ".tolerance must be at least 0");
        part->target = json_point(json_member(json, "target", where), where + ".target");
        part->motion = load_motion(json_member(json, "motion", where), where + ".motion");
        part->chain = Chain::from_segments(
            load_segments(json_member(json, "segments", where), where + ".segments"),
            json_point(json_member(json, "default_direction", where), where + ".default_direction"));

        const int last = std::max(0, static_cast<int>(part->chain.size()) - 1);
        part->index = static_cast<std::size_t>(
            json_integer(json_member(json, "index", where), where + ".index", 0, last));
        const Json& chosen = json_member(json, "selected", where);
        check_range(*part);
        if (!chosen.is_null() && !part->chain.empty()) {
            part->selected = static_cast<std::size_t>(json_integer(chosen, where + ".selected", 0, last));
        }
    } catch (const std::logic_error& error) {  // the core's own words, told where in the file
        throw std::runtime_error(where + ": " + error.what());
    }
    return part;
}

}  // namespace tendril::app
