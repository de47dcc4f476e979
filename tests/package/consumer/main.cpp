#include <algorithm>
#include <cstdio>
#include <tendril/tendril.hpp>
#include <vector>

int main() {
    tendril::Chain chain;
    bool fine = chain.set_default_direction({0, 0, -1}).ok();
    for (int i = 0; i < 3; ++i) fine = chain.add(1.0f).ok() && fine;
    fine = fine && chain.set_length(7, 1.0f).code() == tendril::ErrorCode::OutOfRange;
    fine = fine && chain.forward({1, 2, 3}).ok() && chain.backward({1, 2, 1}).ok();
    fine = fine && chain.fixed({1, 2, 3}, {.iterations = 8}).accepted.ok();
    if (!fine) return 1;
    const glm::vec3 head = chain.position(0), tail = chain.position(2);
    std::printf("tendril %s: %zu segments, reach %g, head at %.0f %.0f %.0f, tail at %.0f %.0f %.0f\n",
                tendril::version_string, chain.size(), static_cast<double>(chain.reach()),
                static_cast<double>(head.x), static_cast<double>(head.y), static_cast<double>(head.z),
                static_cast<double>(tail.x), static_cast<double>(tail.y), static_cast<double>(tail.z));

    // Internal dependencies are linked too: vector units and threads.
    tendril::ik::Batch batch = *tendril::ik::Batch::make(8, 4, 2);
    const std::vector<glm::vec3> targets(batch.size(), glm::vec3(1, 2, 1));
    std::vector<tendril::ik::ManyReport> reports(batch.size());
    tendril::ik::solve_many(batch, targets, reports);
    const auto arrived =
        std::count_if(reports.begin(), reports.end(), [](const tendril::ik::ManyReport& report) {
            return report.status == tendril::ik::Status::Converged;
        });
    std::printf("%d of %zu tips arrived\n", static_cast<int>(arrived), batch.size());

    // Single springs, by name and in a batch, give the same result.
    tendril::signal::FilterState state;
    const tendril::signal::Filter spring = tendril::signal::find_kind("spring")->blank();
    for (const double target : {0.0, 1.0}) tendril::signal::step(spring, state, target, 0.1);
    const std::vector<float> strength{4.0f}, damping{1.0f}, to{1.0f};
    std::vector<float> value{0.0f}, velocity{0.0f}, previous{0.0f};
    const tendril::Result stepped = tendril::signal::step_springs({.strength = strength,
                                                                   .critical_damping = damping,
                                                                   .target = to,
                                                                   .value = value,
                                                                   .velocity = velocity,
                                                                   .previous_target = previous},
                                                                  0.1);
    const double both[] = {tendril::signal::value(state), static_cast<double>(value[0])};
    std::printf("springs at %.3f and %.3f\n", both[0], both[1]);
    return stepped && both[0] > 0.5 && both[0] - both[1] < 1e-5 && both[1] - both[0] < 1e-5 ? 0 : 1;
}
