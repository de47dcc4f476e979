#include "app/labs/chain/study.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <tendril/ik/observer.hpp>
#include <tendril/ik/solver.hpp>
#include <utility>

#include "app/io/solver_text.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/film.hpp"
#include "app/labs/kit/race.hpp"

namespace tendril::app {

void KeptPoses::add(std::span<const glm::vec3> pose) {
    size_ = pose.size();
    const std::size_t iteration = added_++;
    if (iteration % stride_ != 0) return;
    joints_.insert(joints_.end(), pose.begin(), pose.end());
    while (joints_.size() > most_ && joints_.size() > 2 * size_) {
        stride_ *= 2;
        std::size_t poses = 0;
        for (std::size_t from = 0; from < joints_.size(); from += 2 * size_, ++poses)
            std::copy_n(joints_.begin() + static_cast<std::ptrdiff_t>(from), size_,
                        joints_.begin() + static_cast<std::ptrdiff_t>(poses * size_));
        joints_.resize(poses * size_);
    }
}

int KeptPoses::kept(int iteration) const {
    const std::size_t wanted = std::min(static_cast<std::size_t>(std::max(0, iteration)), added_ - 1);
    return static_cast<int>(wanted - wanted % stride_);
}

std::span<const glm::vec3> KeptPoses::at(int iteration) const {
    const std::size_t pose = static_cast<std::size_t>(kept(iteration)) / stride_;
    return std::span(joints_).subspan(pose * size_, size_);
}

namespace {

constexpr int timings = 5;

/// Records the pose and the residual after each iteration, and whether the best pose was restored at the end.
/// Iteration 0 is the common start, before any solver prepares it: FABRIK, accelerated, bends a straight
/// chain first.
class Watch final : public ik::Observer {
  public:
    Watch(Racer& racer, const std::vector<glm::vec3>& start, float residual) : racer_(racer), joints_(start) {
        add(joints_, residual);
    }
    void step(const ik::Step& step) noexcept override {
        joints_[step.joint] = step.to;
        if (step.phase == ik::Phase::RestoreBest) racer_.restored = true;
    }
    void iteration_done(int iteration, float residual) noexcept override {
        if (iteration > 0) add(joints_, residual);
        racer_.restored = false;  // the solver continued from the restored pose
    }
    /// A chain that was only stretched towards its target has moved without an iteration.
    void finish() {
        if (racer_.residuals.size() == 1 && !std::ranges::equal(racer_.joints, racer_.poses.at(0)))
            add(racer_.joints, racer_.report.residual);
    }

  private:
    void add(std::span<const glm::vec3> joints, float residual) {
        racer_.residuals.push_back(residual);
        racer_.poses.add(joints);
    }

    Racer& racer_;
    std::vector<glm::vec3> joints_;
};

Racer run(ik::Method method, const Chain& chain, const ReachSettings& settings, glm::vec3 target,
          ChainRuntime& runtime) {
    using Clock = std::chrono::steady_clock;
    Racer racer;
    racer.method = method;
    const std::vector<glm::vec3> start = positions(chain);
    ik::Solver& solver = runtime.solver(chain);
    ReachSettings each = settings;
    const ik::State begin = state_for(each, solver.bones());
    const ik::Options options = solver_options(each, solver.reach());
    Watch watch(racer, start, glm::distance(start.back(), target));
    const auto solve = [&](ik::Observer* observer) {
        racer.joints = start;
        each.state = begin;
        racer.report = solver.solve(method, racer.joints, each.state, target, options, observer);
    };
    solve(&watch);
    watch.finish();
    for (int i = 0; i < timings; ++i) {
        const auto from = Clock::now();
        solve(nullptr);
        const double took = std::chrono::duration<double, std::micro>(Clock::now() - from).count();
        racer.microseconds = i == 0 ? took : std::min(racer.microseconds, took);
    }
    return racer;
}

/// One row for each iteration of each solver: solver, iteration, tip_to_target_m, root_to_target_m,
/// microseconds; a solver's last row adds status, ran (see ran_text) and, if the best pose was restored, its
/// restored_m.
std::string race_csv(const Race& race) {
    const auto metres = [](float value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
        return std::string(text);
    };
    std::string csv =
        "solver,iteration,tip_to_target_m,root_to_target_m,microseconds,status,ran,restored_m\n";
    for (const Racer& racer : race.racers) {
        const int last = racer.iterations();
        for (int i = 0; i <= last; ++i) {
            csv += '"' + std::string(solver_title(racer.method)) + "\"," + std::to_string(i) + ',' +
                   metres(racer.residuals[static_cast<std::size_t>(i)]) + ',' + metres(race.root_to_target) +
                   ',' + fixed_text(racer.microseconds * i / std::max(last, 1), 3) + ',';
            csv += i < last ? ",,"
                            : std::string(ik::name(racer.report.status)) + ",\"" +
                                  ran_text(racer.method, racer.report) + "\"," +
                                  (racer.restored ? metres(racer.report.residual) : "");
            csv += '\n';
        }
    }
    return csv;
}

std::string open_race_csv(const Workspace& workspace) {
    const ShownChain shown = shown_chain(workspace);
    check_race(shown.part);
    return race_csv(*shown.race);
}

constexpr double frames_per_second = 30.0;
constexpr int end_frames = 30;  ///< the end is held for a second, so a film lasts 4 to 12 s
constexpr double max_frames = 18'000.0;

/// Shows a frame of the film in a copy of the workspace.
struct RaceFrames {
    std::size_t last = 0;  ///< iteration
    double pace = 4.0;     ///< iterations per second
    std::size_t shown = Study::race_end;

    bool operator()(Workspace& workspace, int frame) {
        const double iteration = std::floor(frame * pace / frames_per_second);
        const std::size_t now = std::min(last, static_cast<std::size_t>(iteration));
        workspace.document.edit<ChainPart>(chain_lab).study.go_to(now, last);
        return std::exchange(shown, now) != now;
    }
};

void record_race(Workspace& workspace, const Arguments& given) {
    const ShownChain chain = shown_chain(workspace);
    check_race(chain.part);
    if (workspace.lab != chain_lab) throw Refused("the race is not in view: open the lab chain");
    const std::size_t last = chain.last();
    const double pace = given.has("pace") ? given.real("pace") : static_cast<double>(race_pace(last));
    const double frames = std::ceil(static_cast<double>(last) * frames_per_second / pace) + 1.0 + end_frames;
    if (frames > max_frames)
        throw Refused("pace must be at least " +
                      fixed_text(0.01 * std::ceil(100.0 * static_cast<double>(last) * frames_per_second /
                                                  (max_frames - 1.0 - end_frames)),
                                 2) +
                      " for a race of " + std::to_string(last) +
                      " iterations: a film lasts up to 10 minutes");
    VideoRequest wanted = film_request(workspace, given, "race");
    wanted.command = "race.record";
    wanted.shown_frames = static_cast<int>(frames);
    wanted.show = RaceFrames{last, pace};
    workspace.ui.video = std::move(wanted);
}

}  // namespace

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers,
              ChainRuntime& runtime) {
    Race race;
    race.tolerance = reach_tolerance(settings, chain.reach());
    race.root_to_target = glm::distance(chain.segments().front().position, target);
    for (const ik::Method method : ik::all_methods) {
        if (racers[static_cast<std::size_t>(method)])
            race.racers.push_back(run(method, chain, settings, target, runtime));
    }
    return race;
}

std::size_t Race::iterations() const {
    int most = 0;
    for (const Racer& racer : racers) most = std::max(most, racer.iterations());
    return static_cast<std::size_t>(most);
}

RacerAt racer_at(const Racer& racer, std::size_t iteration) {
    const int last = racer.iterations();
    if (iteration >= static_cast<std::size_t>(last))
        return {.finished = true,
                .iteration = last,
                .joints = racer.joints,
                .error = racer.restored ? racer.report.residual : racer.residuals.back()};
    const int kept = racer.poses.kept(static_cast<int>(iteration));
    return {.iteration = kept,
            .joints = racer.poses.at(kept),
            .error = racer.residuals[static_cast<std::size_t>(kept)]};
}

std::string progress_text(const RacerAt& at) {
    return (at.finished ? "finished after " : "iteration ") + std::to_string(at.iteration);
}

std::string outcome_text(const Racer& racer, const RacerAt& at) {
    if (!at.finished || racer.report.status == ik::Status::Converged) return progress_text(at);
    return "stopped after " + std::to_string(at.iteration) + ", " + outcome_name(racer.report.status);
}

std::string error_reading(const RacerAt& at) {
    return "error " + si_text(static_cast<double>(at.error), "m");
}

std::string error_text(const Racer& racer, const RacerAt& at) {
    const std::string status = at.finished ? capitalised(outcome_name(racer.report.status)) + ", " : "";
    return status + si_text(static_cast<double>(at.error), "m") + " from the target";
}

std::string end_text(const Racer& racer) {
    std::string text = capitalised(outcome_name(racer.report.status)) + ", " +
                       si_text(static_cast<double>(racer.residuals.back()), "m");
    const std::string ran = ran_text(racer.method, racer.report);
    const std::size_t more =
        ran.find_first_not_of(" +,", std::string_view(solver_title(racer.method)).size());
    if (racer.restored)
        text += "; best pose restored: " + si_text(static_cast<double>(racer.report.residual), "m");
    if (more != ran.npos && racer.iterations() > 0) return text + "; " + ran.substr(more);
    return racer.restored ? text : text + " from the target";
}

// Commands that write the open race to a file: its numbers, or a video.

void add_race_file_commands(CommandTable& table) {
    add_race_csv_commands(table, {.race = "race",
                                  .title = "the race as CSV",
                                  .holds = "tip to target in metres, for every solver and iteration,",
                                  .text = open_race_csv});
    table.add(
        "race.record", "Record the race",
        film_arguments(
            {number_argument("pace", "iterations per second; default: so many that the film lasts 4 to 12 s",
                             shortest_decimal(slowest_pace), shortest_decimal(fastest_pace))},
            true),
        "Writes a video of the race from its start to its end, with names, iterations and errors",
        Effect::Look, record_race);
}

}  // namespace tendril::app
