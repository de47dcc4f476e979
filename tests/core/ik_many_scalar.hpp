// Solves a crowd one by one with the scalar solver, for comparison.
#pragma once

#include "ik_many_support.hpp"
#include "ik_support.hpp"

namespace tendril::test {

inline ManyReport many_report(const ik::Report& report) {
    return {report.status, false, report.iterations, report.residual};
}

inline Answer solve_each(const Crowd& crowd, const ManyOptions& many,
                         ik::Method method = ik::Method::Fabrik) {
    ik::Options options{.tolerance = many.tolerance,
                        .max_iterations = many.max_iterations,
                        .every_iteration = many.every_iteration};
    Answer answer;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        Joints joints = crowd.joints[i];
        KeptSolver solver(crowd.lengths[i]);
        answer.reports.push_back(many_report(solver.solve(method, joints, crowd.targets[i], options)));
        answer.joints.push_back(std::move(joints));
    }
    return answer;
}

}  // namespace tendril::test
