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

constexpr std::uint64_t max_work = 20'000'000, rates_work_per_tick = 300'000;  ///< steps of some 30 ns
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

/// Whether something is farther apart than anything before, and `farthest`.
bool compare(const rig::Rig& rig, rig::State& a, rig::State& b, double seconds, RateDifference& most,
             double& farthest) {
    bool farther = false;
    const std::vector<rig::Residual> apart = rig::residuals(rig, a, b);
    for (std::size_t i = 0; i < apart.size(); ++i) {
        const rig::Element& element = rig.definition().elements[i];
        if (element.kind != rig::ElementKind::Bone) continue;
        most.mm = std::max(most.mm, 1000.0 * apart[i].metres);
        most.degrees = std::max(most.degrees, glm::degrees(apart[i].radians));
        most.scale = std::max(most.scale, apart[i].scale);
        if (const double all = amount(apart[i]); most.bone.empty() || all > farthest) {
            farthest = all;
            most.bone = element.name;
            most.seconds = seconds;
            farther = true;
        }
    }
    return farther;
}

signal::RateComparison runs_over(std::uint32_t ticks) {
    const std::vector<signal::Sample> samples(ticks, {tick_seconds, 0.0});
    return signal::compare_rates({}, samples);
}

std::uint64_t solves_of(const signal::RateComparison& rates) {
    std::uint64_t solves = 0;
    for (const signal::RateRun& run : rates.runs) solves += run.time.size();
    return solves;
}

}  // namespace

void start_rates(RigPart& part, std::uint32_t ticks) {
    const signal::RateComparison rates = runs_over(ticks);
    if (solves_of(rates) * part.rig.work() > max_work)
        throw std::invalid_argument("the rig is so large that this would take too long");
    RateDifference begun;
    begun.ticks = static_cast<double>(ticks);
    begun.frames = rates.runs.empty() ? 0 : rates.runs.front().time.size();
    begun.running = begun.frames > 0;
    part.rates = begun;
}

float rates_done(const RateDifference& rates) {
    return rates.frames == 0 ? 1.0f : static_cast<float>(rates.done) / static_cast<float>(rates.frames);
}

/// Of a part as it was: of its take nothing changes that would not end the comparison.
struct RatesWork::Takes {
    explicit Takes(const RigPart& now)
        : part(now), scratch(part.rig), rates(runs_over(static_cast<std::uint32_t>(now.rates->ticks))) {
        takes.reserve(rates.runs.size());
        for (const signal::RateRun& run : rates.runs) takes.emplace_back(part, scratch, run.time);
    }

    bool of(const RigPart& now) const {
        return &part.rig.definition() == &now.rig.definition() && part.take.began == now.take.began &&
               part.take.keys == now.take.keys && part.walks == now.walks && starts_as(now) &&
               part.rates->ticks == now.rates->ticks && done == now.rates->done;
    }
    /// Until a tick has passed the take has no start but the state as it is.
    bool starts_as(const RigPart& now) const {
        if (part.take.start) return part.take.start == now.take.start;
        return part.state == (now.take.start ? *now.take.start : now.state);
    }

    /// One of the slowest's.
    void frame() {
        const double end = rates.runs.front().time[done++];
        for (RateTake& take : takes) take.run_to(end);
        for (std::size_t a = 0; a < takes.size(); ++a)
            for (std::size_t b = a + 1; b < takes.size(); ++b)
                if (compare(part.rig, takes[a].state(), takes[b].state(), end, most, farthest))
                    most.between = name_of(rates.runs[a].rate) + " and " + name_of(rates.runs[b].rate);
    }

    const RigPart part;
    rig::Workspace scratch;
    signal::RateComparison rates;
    std::vector<RateTake> takes;
    RateDifference most;
    double farthest = 0.0;  ///< as amount has it
    std::size_t done = 0;
};

RatesWork::RatesWork() = default;
RatesWork::~RatesWork() = default;

void RatesWork::advance(RigPart& part) {
    if (!part.rates || !part.rates->running) return;
    if (!takes_ || !takes_->of(part)) {
        takes_ = std::make_unique<Takes>(part);
        while (takes_->done < part.rates->done) takes_->frame();
    }
    const std::size_t frames = part.rates->frames;
    const std::uint64_t each = std::max<std::uint64_t>(solves_of(takes_->rates) / frames, 1);
    const std::uint64_t work = each * std::max<std::uint64_t>(part.rig.work(), 1);
    for (std::uint64_t spent = 0; spent < rates_work_per_tick && takes_->done < frames; spent += work)
        takes_->frame();
    const RateDifference& most = takes_->most;
    RateDifference now = most;
    now.ticks = part.rates->ticks;
    now.frames = frames;
    now.done = takes_->done;
    now.running = now.done < frames;
    part.rates = now;
    if (!now.running) takes_.reset();
}

}  // namespace tendril::app
