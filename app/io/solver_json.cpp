#include "app/io/solver_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/document/text.hpp"
#include "app/fields/fields.hpp"

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

ik::Method method_from_name(const std::string& name, const std::string& where) {
    if (const auto method = ik::method_named(name)) return *method;
    throw std::runtime_error(where + ": expected one of " + method_names() + ", found " +
                             json_summary(Json(name)));
}

std::span<const char* const> solver_names() {
    static const auto names = [] {
        std::array<const char*, ik::all_methods.size()> all{};
        std::ranges::transform(ik::all_methods, all.begin(), [](ik::Method each) { return ik::name(each); });
        return all;
    }();
    return names;
}

std::string method_names() {
    return comma_list(solver_names());
}

const char* solver_title(ik::Method method) {
    static constexpr const char* titles[] = {
        "FABRIK, accelerated",      "FABRIK (2011)", "CCD", "Jacobian transpose", "Damped least squares",
        "SVD damped least squares", "Two-bone"};
    return titles[static_cast<std::size_t>(method)];
}

const char* outcome_name(ik::Status status) {
    static constexpr const char* names[] = {"converged", "out of reach",     "too close",    "at its limits",
                                            "stalled",   "did not converge", "not supported"};
    return names[static_cast<std::size_t>(status)];
}

std::string ran_text(ik::Method method, const ik::Report& report) {
    std::string text = solver_title(method);
    const bool closed = report.closed_form && report.iterations == 0 && method != ik::Method::TwoBone;
    if (closed) return text + ", solved in closed form";
    if (report.least_squares_steps > 0) text += " + least squares";
    const auto count = [&text](int number, const char* what) {
        if (number > 0) text += ", " + count_text(static_cast<std::size_t>(number), what);
    };
    count(report.perturbations, "perturbation");
    count(report.restarts, "restart");
    return text;
}

}  // namespace tendril::app
