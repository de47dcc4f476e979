// One solve: prepared, iterated by its method, turned to its pole, reported.
#include "ik/loop.hpp"

#include <algorithm>

#include "ik/ccd.hpp"
#include "ik/fabrik.hpp"
#include "ik/jacobian.hpp"
#include "ik/rotation.hpp"

namespace tendril::ik::detail {
namespace {

/// One iteration of a method; false for those that are not there yet.
template <class Watch>
bool iterate(Method method, Problem& problem, Watch watch) noexcept {
    switch (method) {
        case Method::Fabrik:
        case Method::FabrikPlain:
            return fabrik_iteration(problem, watch), true;
        case Method::Ccd:
            return ccd_iteration(problem, watch), true;
        case Method::JacobianTranspose:
            return jacobian_transpose_iteration(problem, watch), true;
        case Method::Dls:
            return dls_iteration(problem, watch), true;
        case Method::SvdDls:
            return svd_dls_iteration(problem, watch), true;
        case Method::TwoBone:
            return false;
    }
    return false;
}

template <class Watch>
Report iterations(Method method, Problem& problem, Watch watch) noexcept {
    Report report;
    report.residual = distance(problem.joints.back(), problem.target);
    watch.iteration_done(0, report.residual);
    while (report.iterations < problem.options.max_iterations) {
        if (report.residual <= problem.tolerance && !problem.options.every_iteration) break;
        problem.iteration = ++report.iterations;
        if (!iterate(method, problem, watch)) return {Status::InvalidInput, 0, 0.0f};
        report.residual = distance(problem.joints.back(), problem.target);
        const auto done = static_cast<std::size_t>(report.iterations);
        if (done <= problem.options.residuals.size()) problem.options.residuals[done - 1] = report.residual;
        watch.iteration_done(report.iterations, report.residual);
    }
    report.status = report.residual <= problem.tolerance ? Status::Converged : Status::IterationLimit;
    return report;
}

}  // namespace

template <class Watch>
Report run(Method method, Problem& problem, Watch watch) noexcept {
    // Two bones: two_bone_solve does all by itself.
    // Limits: run_limited has a loop of its own, for each method.
    const Report report = iterations(method, problem, watch);
    // The pole: face_pole turns the chain about its line, so the residual stays.
    return report;
}

template Report run(Method, Problem&, Unwatched) noexcept;
template Report run(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
