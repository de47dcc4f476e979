#include "app/io/solver_text.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"

namespace tendril::app {

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
