// Traces as JSON: one object a line, or a list of poses.
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/document/json_scan.hpp"
#include "app/document/list_reader.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {
namespace {

/// JSON has no NaN, but what engines write has: each becomes null outside of strings.
std::string without_nan(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == '"') {
            const std::size_t end = string_end(text, at);
            result.append(text.substr(at, end - at));
            at = end;
            continue;
        }
        const bool word = c == 'n' || c == 'N' || c == 'i' || c == 'I' ||
                          (c == '-' && at + 1 < text.size() && (text[at + 1] < '0' || text[at + 1] > '9')) ||
                          text.substr(at).starts_with("1.#");
        std::string_view rest = text.substr(at);
        const auto number = word ? take_number(rest) : std::nullopt;
        if (number) {
            // 1e999 is refused by the parser; null is as good, for nothing tells NaN from infinity here.
            result += "null";
            at = text.size() - rest.size();
        } else {
            result.push_back(c);
            ++at;
        }
    }
    return result;
}

Json parse_line(std::string_view text, std::size_t line) {
    try {
        return parse_json(text);
    } catch (const ParseError&) {
        try {
            return parse_json(without_nan(text));
        } catch (const ParseError& error) {
            fail_line(line, "damaged JSON; expected a frame such as {\"joints\": [[0, 0, 0], [1, 0, 0]]}: " +
                                error.reason);
        }
    }
}

/// null and text such as "NaN" are not a number, which is a value here.
double loose_number(const JsonPlace& place) {
    const Json& json = place.json();
    if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) {
        const std::string word = json.get<std::string>();
        std::string_view rest = word;
        if (const auto number = take_number(rest); number && rest.empty()) return *number;
    }
    place.fail("expected a number, found " + json_summary(json));
}

glm::dvec3 loose_point(const JsonPlace& place) {
    for (const char* key : {"position", "translation"})
        if (const auto at = place.json().is_object() ? place.optional(key) : std::nullopt)
            return loose_point(*at);
    if (place.json().is_object())
        return {loose_number(place["x"]), loose_number(place["y"]), loose_number(place["z"])};
    place.check_size(3, "x, y and z");
    return {loose_number(place.element(0)), loose_number(place.element(1)), loose_number(place.element(2))};
}

glm::dvec4 loose_rotation(const JsonPlace& place) {
    place.check_size(4, "a quaternion's numbers");
    return {loose_number(place.element(0)), loose_number(place.element(1)), loose_number(place.element(2)),
            loose_number(place.element(3))};
}

std::vector<glm::dvec3> loose_points(const JsonPlace& place) {
    std::vector<glm::dvec3> points;
    place.for_each("joints", max_trace_joints,
                   [&](const JsonPlace& each) { points.push_back(loose_point(each)); });
    return points;
}

/// By joint: null, the largest angle, [smallest, largest], or an object that may name its joint.
std::vector<ik::BendLimit> read_limits(const JsonPlace& place) {
    std::vector<ik::BendLimit> limits;
    std::size_t index = 0;
    place.for_each("limits", max_trace_joints, [&](const JsonPlace& each) {
        ik::BendLimit limit{.joint = index++};
        const Json& json = each.json();
        if (json.is_null()) return;
        if (json.is_number()) {
            limit.max = each.number(0.0f, 180.0f);
        } else if (json.is_array()) {
            each.check_size(2, "smallest and largest angle");
            limit.min = each.element(0).number(-180.0f, 180.0f);
            limit.max = each.element(1).number(-180.0f, 180.0f);
        } else {
            if (const auto joint = each.optional("joint")) limit.joint = joint->index(max_trace_joints);
            if (const auto low = each.optional("min_deg")) limit.min = low->number(-180.0f, 180.0f);
            if (const auto high = each.optional("max_deg")) limit.max = high->number(-180.0f, 180.0f);
        }
        limits.push_back(limit);
    });
    return limits;
}

std::string text_of(const JsonPlace& place, const char* key) {
    const auto found = place.optional(key);
    return found ? found->text() : std::string();
}

void read_header(TraceHeader& header, const JsonPlace& place) {
    if (const auto kind = place.optional("tendril"); kind && kind->text() != "trace")
        kind->fail("expected \"trace\", found " + json_summary(kind->json()));
    header.up = text_of(place, "up");
    header.handed = text_of(place, "handed");
    header.unit = text_of(place, "unit");
    header.rotations = text_of(place, "rotations");
    header.engine = text_of(place, "engine");
    if (const auto fps = place.optional("fps")) header.fps = fps->real(0.001, 1e6);
    if (const auto joint = place.optional("target_joint"))
        header.target_joint = joint->index(max_trace_joints);
    if (const auto bones = place.optional("bones"))
        bones->for_each("bones", max_trace_joints,
                        [&](const JsonPlace& each) { header.bones.push_back(each.text()); });
    if (const auto limits = place.optional("limits")) header.limits = read_limits(*limits);
}

void read_frame(RawFrame& frame, TraceHeader& header, const JsonPlace& place) {
    if (place.json().is_array()) {
        frame.joints = loose_points(place);
        return;
    }
    frame.joints = loose_points(place["joints"]);
    frame.chain = text_of(place, "chain");
    if (const auto time = place.optional("t")) frame.time = loose_number(*time);
    if (const auto dt = place.optional("dt")) frame.dt = loose_number(*dt);
    if (const auto target = place.optional("target")) frame.target = loose_point(*target);
    if (const auto pole = place.optional("pole")) frame.pole = loose_point(*pole);
    if (const auto rotations = place.optional("rotations"))
        rotations->for_each("rotations", max_trace_joints,
                            [&](const JsonPlace& each) { frame.rotations.push_back(loose_rotation(each)); });
    if (const auto limits = place.optional("limits"); limits && header.limits.empty())
        header.limits = read_limits(*limits);
}

bool is_frame(const Json& json) {
    return json.is_array() || (json.is_object() && json.contains("joints"));
}

class JsonLines final : public RawTrace {
  public:
    JsonLines(std::istream& in, std::string first, std::size_t at) : in_(in), text_(std::move(first)) {
        line = at;
        const Json json = parse_line(text_, line);
        if (is_frame(json)) return;
        at_json([&] { read_header(header, JsonPlace(json, "")); });
        waiting_ = false;
    }

    bool next(RawFrame& frame) override {
        if (!waiting_) {
            do {
                if (!read_line(in_, text_, line)) return false;
            } while (text_.find_first_not_of(" \t") == text_.npos);
        }
        waiting_ = false;
        const Json json = parse_line(text_, line);
        frame = {.line = line};
        at_json([&] { read_frame(frame, header, JsonPlace(json, "")); });
        return true;
    }

  private:
    void at_json(auto read) {
        try {
            read();
        } catch (const std::runtime_error& error) {
            fail_line(line, error.what());
        }
    }

    std::istream& in_;
    std::string text_;
    bool waiting_ = true;  ///< text_ is a frame that was not handed out
};

/// A list of frames, or of the points of one pose, with any line breaks.
class JsonList final : public RawTrace {
  public:
    JsonList(std::istream& in, std::string first, std::size_t at) : text_(std::move(first)) {
        text_.push_back('\n');
        while (text_.size() < max_file_bytes && in) {
            const std::size_t size = text_.size();
            text_.resize(size + (1u << 16));
            in.read(text_.data() + size, 1 << 16);
            text_.resize(size + static_cast<std::size_t>(in.gcount()));
        }
        if (text_.size() >= max_file_bytes)
            throw std::runtime_error("is a JSON list of over 64 MiB: write one frame a line instead");
        text_.insert(0, at - 1, '\n');
        try {
            parse_json(std::string_view(text_));
        } catch (const ParseError&) {
            text_ = without_nan(text_);
        }
        list_.emplace(text_, "frames");
        line = at;
    }

    bool next(RawFrame& frame) override {
        Json json;
        try {
            if (done_ || !list_->next(json)) return false;
        } catch (const ParseError& error) {
            fail_line(static_cast<std::size_t>(error.line),
                      "the list of frames is damaged or incomplete here: " + error.reason);
        }
        line = static_cast<std::size_t>(list_->line_of(list_->place()));
        frame = {.line = line};
        try {
            if (is_point(json)) {
                do {
                    frame.joints.push_back(loose_point(JsonPlace(json, list_->place())));
                } while (frame.joints.size() < max_trace_joints && list_->next(json));
                done_ = true;
                return true;
            }
            if (!is_frame(json) && list_->index() == 0) {
                read_header(header, JsonPlace(json, list_->place()));
                return next(frame);
            }
            read_frame(frame, header, JsonPlace(json, list_->place()));
        } catch (const std::runtime_error& error) {
            fail_line(line, error.what());
        }
        return true;
    }

  private:
    static bool is_point(const Json& json) {
        if (json.is_object()) return json.contains("x") && json.contains("y") && json.contains("z");
        return json.is_array() && json.size() == 3 && !json[0].is_structured();
    }

    std::string text_;
    std::optional<ListReader> list_;
    bool done_ = false;
};

}  // namespace

std::unique_ptr<RawTrace> open_json_trace(std::istream& in, std::string first, std::size_t line) {
    const std::size_t at = first.find_first_not_of(" \t");
    // A line that is a pose of its own, `[[0, 0, 0], [1, 0, 0]]`, may be followed by others.
    if (first[at] == '{') return std::make_unique<JsonLines>(in, std::move(first), line);
    const bool whole =
        skip_value(first, at) >= first.find_last_not_of(" \t,") && first.find("]]") != first.npos;
    if (whole && in.peek() != std::char_traits<char>::eof() && first.find('{') == first.npos)
        return std::make_unique<JsonLines>(in, std::move(first), line);
    return std::make_unique<JsonList>(in, std::move(first), line);
}

}  // namespace tendril::app
