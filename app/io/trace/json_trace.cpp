// Traces as JSON objects with a list of joints.
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/io/json_scan.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {
namespace {

/// JSON has no NaN, but engines write it: replaces each outside strings by null.
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
            // The parser refuses 1e999; write null, since NaN and infinity are the same here.
            result += "null";
            at = text.size() - rest.size();
        } else {
            result.push_back(c);
            ++at;
        }
    }
    return result;
}

Json parse_object(std::string_view text, std::size_t line) {
    try {
        return parse_json(without_nan(text));
    } catch (const ParseError& error) {
        fail_line(
            line + static_cast<std::size_t>(error.line) - 1,
            "damaged JSON; expected a frame such as {\"joints\": [[0, 0, 0], [1, 0, 0]]}: " + error.reason);
    }
}

/// null and text such as "NaN" are read as NaN, a valid value here.
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
    for (const char* key : {"position", "translation", "pos", "p"})
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

/// Per joint: null, the largest angle, [smallest, largest], or an object that may name its joint.
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
    place["joints"].for_each("joints", max_trace_joints,
                             [&](const JsonPlace& each) { frame.joints.push_back(loose_point(each)); });
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

/// Objects, one after another or in a list. Each may span many lines.
class JsonTrace final : public RawTrace {
  public:
    explicit JsonTrace(Lines lines) : RawTrace(std::move(lines)) {}

    bool next(RawFrame& frame) override {
        for (std::string text; read_object(text); begun_ = true) {
            const Json json = parse_object(text, line_);
            frame = {.line = line_};
            try {
                const JsonPlace place(json, "");
                if (begun_ || json.contains("joints")) {
                    read_frame(frame, header, place);
                    return begun_ = true;
                }
                read_header(header, place);
            } catch (const std::runtime_error& error) {
                fail_line(line_, error.what());
            }
        }
        return false;
    }

  private:
    bool read_object(std::string& text) {
        text.clear();
        for (int depth = 0;;) {
            if (at_ >= rest_.size()) {
                constexpr std::size_t longest = 16u << 20;
                if (text.size() > longest) fail_line(line_, "a frame is longer than 16 MiB");
                if (!lines_.next(rest_)) return !text.empty();
                if (!text.empty()) text += '\n';
                at_ = 0;
                continue;
            }
            const char c = rest_[at_];
            const std::size_t begin = at_;
            at_ = c == '"' ? string_end(rest_, at_) : at_ + 1;
            if (text.empty() && std::string_view(" \t,[]").find(c) != std::string_view::npos) continue;
            if (text.empty()) line_ = line();
            text.append(rest_, begin, at_ - begin);
            depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
            if (depth <= 0) return true;
        }
    }

    std::string rest_;  ///< the rest of the current line
    std::size_t at_ = 0, line_ = 0;
    bool begun_ = false;
};

}  // namespace

std::unique_ptr<RawTrace> open_json_trace(Lines lines) {
    return std::make_unique<JsonTrace>(std::move(lines));
}

}  // namespace tendril::app
