#include "app/io/solver_text.hpp"

namespace tendril::app {

const char* solver_title(ik::Method method) {
    static constexpr const char* titles[] = {
        "FABRIK, accelerated",      "FABRIK (2011)", "CCD", "Jacobian transpose", "Damped least squares",
        "SVD damped least squares", "Two-bone"};
    return titles[static_cast<std::size_t>(method)];
}

std::string ran_text(ik::Method method, const ik::Report& report, bool within_limits) {
    std::string text = within_limits && method == ik::Method::Fabrik ? "FABRIK" : solver_title(method);
    const bool closed = report.closed_form && report.iterations == 0 && method != ik::Method::TwoBone;
    if (closed) return text + ", solved in closed form";
    if (report.least_squares_steps > 0) text += " + least squares";
    if (report.restarts > 0) {
        text += ", " + std::to_string(report.restarts) + (report.restarts == 1 ? " restart" : " restarts");
    }
    return text;
}

}  // namespace tendril::app
