#include "app/fields/solver_json.hpp"
#include "app/io/solver_text.hpp"

#include <cmath>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"

namespace tendril::app {
namespace {

Json finite_number(float value) {
    return std::isfinite(value) ? number(value) : Json(nullptr);
}

}  // namespace

Json limit_json(const ik::Limit& limit) {
    return save_fields({ik::limit_fields(limit.kind), &limit});
}

std::string fault_text(const char* why, const ik::Limit& limit) {
    std::string text = why;
    const char* between = ": ";
    const Json json = limit_json(limit);
    for (const auto& [name, value] : json.items()) {
        text += between + name + " " + value.dump();
        between = ", ";
    }
    return text;
}

ik::Limit limit_from_json(const Json& json, const std::string& where) {
    const JsonPlace place(json, where);
    ik::Limit limit;
    static_cast<void>(place["kind"]);  // required
    load_fields(place, {ik::limit_fields(ik::JointKind::Free), &limit});
    limit = ik::Limit::of(limit.kind);
    load_fields(place, {ik::limit_fields(limit.kind), &limit});
    if (const char* const why = ik::fault(limit)) place.fail(fault_text(why, limit));
    return limit;
}

Json report_json(ik::Method method, const ik::Report& report) {
    return {{"solver", ik::name(method)},
            {"status", ik::name(report.status)},
            {"iterations", report.iterations},
            // Refused input has no residual.
            {"residual",
             report.status == ik::Status::InvalidInput ? Json(nullptr) : finite_number(report.residual)},
            {"ran", ran_text(method, report)}};
}

}  // namespace tendril::app
