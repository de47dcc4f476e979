#include "app/labs/signal/fitting.hpp"

#include <algorithm>

#include "app/document/refused.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t share_rows = 200'000;  ///< that filters are run over in a tick

const signal::Filter* of_kind(const std::vector<signal::Filter>& filters, const signal::Kind& kind) {
    const auto found = std::ranges::find_if(
        filters, [&](const signal::Filter& filter) { return &signal::kind_of(filter) == &kind; });
    return found == filters.end() ? nullptr : &*found;
}

}  // namespace

void start_fitting(SignalPart& part) {
    if (part.wanted.empty())
        throw Refused("no response is wanted yet: draw one into the plot Fit, or give one with to");
    part.fits.clear();
    part.fitting.emplace();
    for (const SignalStage& stage : part.stages) part.fitting->from.push_back(stage.filter);
    part.plot = SignalPlot::Fit;
}

void cancel_fitting(SignalPart& part) {
    if (!part.fitting) throw Refused("no fit is running");
    part.fitting.reset();
}

FitWork::Task::Task(const SignalPart& part)
    : rows(part.fit_input),
      wanted(part.wanted),
      from(part.fitting->from),
      kind(part.fits.size()),
      problem{rows, wanted},
      task(begin_fit(signal::kinds()[kind], problem, of_kind(from, signal::kinds()[kind]))) {}

bool FitWork::Task::of(const SignalPart& part) const {
    return kind == part.fits.size() && shares == part.fitting->shares && from == part.fitting->from &&
           rows == part.fit_input && wanted == part.wanted;
}

void FitWork::Task::advance() {
    const auto share = static_cast<int>(share_rows / std::max<std::size_t>(rows.size(), 1));
    const int until = task->evaluations() + share;
    while (more && task->evaluations() < until) more = task->advance();
    ++shares;
}

void FitWork::advance(SignalPart& part) {
    if (!part.fitting) return;
    if (!task_ || !task_->of(part)) {
        task_ = std::make_unique<Task>(part);
        while (task_->more && task_->shares < part.fitting->shares) task_->advance();
    }
    task_->advance();
    part.fitting->shares = task_->shares;
    if (task_->more) return;
    part.fits.push_back(task_->task->fit());
    part.fits.back().residual = std::min(part.fits.back().residual, max_residual);
    rank(part.fits);
    part.fitting->shares = 0;
    if (part.fits.size() == signal::kinds().size()) part.fitting.reset();
    task_.reset();
}

}  // namespace tendril::app
