#include "app/labs/rig/rates.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <tendril/rig/backward.hpp>
#include <tendril/signal/run.hpp>

#include "app/labs/rig/take.hpp"

namespace tendril::app {
namespace {

constexpr std::uint64_t most_work = 20'000'000;  ///< steps of some 30 ns
constexpr double rounding = 1e-9;

/// The take at one frame rate, stopped at the end of each frame of the slowest.
class RateTake {
  public:
    RateTake(const RigPart& part, rig::Workspace& scratch, const std::vector<double>& ends)
        : runner_(part, scratch), ends_(ends) {}
    void run_to(double end) {
        for (; next_ < ends_.size() && ends_[next_] <= end + rounding; ++next_) {
            runner_.frame(ends_[next_] - now_, ends_[next_] / tick_seconds);
            now_ = ends_[next_];
        }
    }
    rig::State& state() { return runner_.state(); }

  private:
    TakeRunner runner_;
    const std::vector<double>& ends_;
    std::size_t next_ = 0;
    double now_ = 0.0;
};

std::string name_of(const signal::FrameRate& rate) {
    return std::to_string(std::lround(rate.hz)) + (rate.jittered ? " Hz uneven" : " Hz");
}

/// Whether something is farther apart than anything before.
bool compare(const rig::Rig& rig, rig::State& a, rig::State& b, double seconds, RateDifference& most) {
    bool farther = false;
    const std::vector<rig::Residual> apart = rig::residuals(rig, a, b);
    for (std::size_t i = 0; i < apart.size(); ++i) {
        const rig::Element& element = rig.definition().elements[i];
        if (element.kind != rig::ElementKind::Bone) continue;
        most.degrees = std::max(most.degrees, glm::degrees(apart[i].radians));
        if (const double mm = 1000.0 * apart[i].metres; most.bone.empty() || mm > most.mm) {
            most.mm = mm;
            most.bone = element.name;
            most.seconds = seconds;
            farther = true;
        }
    }
    return farther;
}

}  // namespace

RateDifference compare_take_rates(const RigPart& part, std::uint32_t ticks, rig::Workspace& scratch) {
    const std::vector<signal::Sample> samples(ticks, {tick_seconds, 0.0});
    const signal::RateComparison rates = signal::compare_rates({}, samples);
    std::uint64_t solves = 0;
    for (const signal::RateRun& run : rates.runs) solves += run.time.size();
    if (solves * tick_work_of(part.state) > most_work)
        throw std::invalid_argument("the rig is so large that this would take too long");
    std::vector<RateTake> takes;
    takes.reserve(rates.runs.size());
    for (const signal::RateRun& run : rates.runs) takes.emplace_back(part, scratch, run.time);
    RateDifference most;
    most.ticks = static_cast<double>(ticks);
    if (takes.empty()) return most;
    for (const double end : rates.runs.front().time) {  // the slowest
        for (RateTake& take : takes) take.run_to(end);
        for (std::size_t a = 0; a < takes.size(); ++a)
            for (std::size_t b = a + 1; b < takes.size(); ++b)
                if (compare(part.rig, takes[a].state(), takes[b].state(), end, most))
                    most.between = name_of(rates.runs[a].rate) + " and " + name_of(rates.runs[b].rate);
    }
    return most;
}

}  // namespace tendril::app
