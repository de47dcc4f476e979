// A race: several solvers with the same start and target, and the pose of each after each of its iterations.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <tendril/chain/chain.hpp>
#include <tendril/ik/method.hpp>
#include <tendril/ik/report.hpp>
#include <vector>

#include "app/labs/chain/reach.hpp"

namespace tendril::app {

class ChainRuntime;

/// Which solvers take part, indexed by ik::Method.
using Racers = std::array<bool, ik::all_methods.size()>;

/// Poses after iterations 0, 1, 2, ... of a solve, in bounded memory: once they fill it, every second one is
/// dropped and from then on only every second is kept; then every fourth, and so on.
class KeptPoses {
  public:
    /// Positions, 3 MiB of them: all iterations of a chain of up to 26 joints, at least 256 of one of 512.
    static constexpr std::size_t default_most = 1u << 18;

    explicit KeptPoses(std::size_t most = default_most) : most_(most) {}

    /// The pose after the next iteration. All poses have the same number of joints.
    void add(std::span<const glm::vec3> pose);
    bool empty() const { return joints_.empty(); }
    /// The last kept iteration up to `iteration`.
    int kept(int iteration) const;
    /// The pose after kept(iteration). Must not be empty.
    std::span<const glm::vec3> at(int iteration) const;
    std::size_t bytes() const { return joints_.capacity() * sizeof(glm::vec3); }

  private:
    std::vector<glm::vec3> joints_;
    std::size_t most_, size_ = 0;         ///< joints in all, and in each pose
    std::size_t added_ = 0, stride_ = 1;  ///< iterations so far, and from one that is kept to the next
};

struct Racer {
    ik::Method method = ik::Method::Fabrik;
    ik::Report report;
    std::vector<glm::vec3> joints;  ///< the final pose
    KeptPoses poses;                ///< after each iteration; 0 is the prepared start
    /// Metres, before the first iteration and after each; never empty. The last is the final one.
    std::vector<float> residuals;
    /// Whether the solver finally restored an earlier, better pose; the report's residual is that pose's.
    bool restored = false;
    /// Time of the whole solve, the fastest of several runs. It varies from run to run, so it must not appear
    /// in --state or in compared pictures.
    double microseconds = 0.0;

    int iterations() const { return static_cast<int>(residuals.size()) - 1; }
};

/// A racer as it stood after an iteration of the race. One that has finished stays at its end.
struct RacerAt {
    bool finished = false;
    int iteration = 0;                  ///< its own; in a long solve of a long chain the last kept one
    std::span<const glm::vec3> joints;  ///< of the racer, or of its kept poses
    float error = 0.0f;                 ///< metres from the tip to the target
};
RacerAt racer_at(const Racer& racer, std::size_t iteration);

struct Race {
    std::vector<Racer> racers;
    float tolerance = 0.0f, root_to_target = 0.0f;  ///< metres

    /// The largest count of all racers.
    std::size_t iterations() const;
};

Race run_race(const Chain& chain, const ReachSettings& settings, glm::vec3 target, const Racers& racers,
              ChainRuntime& runtime);

/// "iteration 3", or "finished after 4"; "error 48.5 mm".
std::string progress_text(const RacerAt& at);
/// The same; of one that ended short of the target, with the reason: "stopped after 12, out of reach".
std::string outcome_text(const Racer& racer, const RacerAt& at);
std::string error_reading(const RacerAt& at);
/// "48.5 mm from the target"; with its status once it has finished: "Stalled, 310 mm from the target".
std::string error_text(const Racer& racer, const RacerAt& at);
/// The end of a racer: "Stalled, 310 mm from the target", or after it what ran besides the solver in the row
/// above: "Out of reach, 310 mm; solved in closed form".
std::string end_text(const Racer& racer);

}  // namespace tendril::app
