#include "app/io/trace/trace.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/io/text.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t frames_to_guess_from = 64;

std::string frames_of(const ik::ChainIncident& incident) {
    if (incident.last_frame <= incident.frame) return "Frame " + std::to_string(incident.frame);
    return "Frames " + std::to_string(incident.frame) + " to " + std::to_string(incident.last_frame);
}

/// "flip at joint 1 (elbow), 128 degrees"
std::string incident_text(const ik::ChainIncident& incident, const std::vector<std::string>& bones,
                          const Conventions& space) {
    std::string joint = "joint " + std::to_string(incident.joint);
    if (incident.joint < bones.size()) joint += " (" + printable(bones[incident.joint]) + ')';
    const auto text = [&](const char* format, auto... values) {
        char all[80];
        std::snprintf(all, sizeof all, format, values...);
        return std::string(all);
    };
    const double amount = incident.amount;
    const std::string length = space.length(std::abs(amount));
    switch (incident.kind) {
        case ik::IncidentKind::Flip:
            return "flip at " + joint + text(", %.0f degrees", amount);
        case ik::IncidentKind::Nan:
            return "NaN at " + joint;
        case ik::IncidentKind::Limit:
            return joint + text(" is %.1f degrees beyond its limit", amount);
        case ik::IncidentKind::Length:
            return (incident.joint == ik::no_joint ? "all bones are" : "the bone to " + joint + " is") + ' ' +
                   length + (amount < 0.0 ? " shorter" : " longer");
        case ik::IncidentKind::Jitter:
            return joint + " jitters by " + length + text(" at %.3g Hz", incident.hertz);
        case ik::IncidentKind::Lag:
            return joint + text(" is %.0f frame%s late", amount, amount == 1.0 ? "" : "s");
        case ik::IncidentKind::Missed:
            return joint + " is " + length + " short of the target";
        case ik::IncidentKind::Misplaced:
            return (incident.joint == ik::no_joint ? "the chain" : joint) + " is " + length + " off";
        case ik::IncidentKind::TargetJump:
            return "the target jumps by " + length;
        case ik::IncidentKind::PoleJump:
            return "the pole target jumps by " + length;
        case ik::IncidentKind::Repeated:
            break;
    }
    if (incident.hertz > 0.0)
        return text("%.0f frames repeat, new ones come at %.3g Hz", amount, incident.hertz);
    return amount == 1.0 ? "drawn twice" : text("drawn %.0f times", amount + 1.0);
}

}  // namespace

std::string TracedIncident::title(const std::vector<std::string>& bones, const Conventions& space) const {
    return frames_of(*this) + ": " + incident_text(*this, bones, space);
}

TraceReader::TraceReader(std::istream& in, const ConventionChoice& choice, std::optional<double> fps)
    : raw_(open_raw_trace(in)) {
    RawFrame frame;
    while (first_.size() < frames_to_guess_from && next_raw(frame)) first_.push_back(std::move(frame));
    if (first_.empty()) throw std::runtime_error("has no frames: expected joints");
    const std::vector<RawFrame> frames(first_.begin(), first_.end());
    conventions_ = conventions_of(*raw_, frames, choice);
    given_end_ = choice.target_joint ? choice.target_joint : raw_->header.target_joint;
    find_end_effectors();
    if (fps) {
        fps_ = *fps;
        fps_known_ = true;
    } else {
        find_rate();
    }
}

namespace {

/// The power of ten; the minimum of int for 0 and for values that are not finite.
int size_of(double value) {
    const double size = std::log10(std::abs(value));
    return std::isfinite(size) ? static_cast<int>(std::floor(size)) : std::numeric_limits<int>::min();
}

}  // namespace

void Rounding::add(double value) {
    char text[32];
    const auto [end, error] = std::to_chars(text, std::end(text), value, std::chars_format::fixed);
    if (error != std::errc() || !std::isfinite(value) || value == 0.0) return;
    const std::string_view digits(text, static_cast<std::size_t>(end - text));
    const std::size_t point = std::min(digits.find('.'), digits.size());
    // -2 for 1400.
    const int decimals = point < digits.size() ? static_cast<int>(digits.size() - point - 1)
                                               : -static_cast<int>(point - 1 - digits.find_last_not_of('0'));
    Digits& size = sizes_[size_of(value)];
    size.decimals = size.values.empty() ? decimals : std::max(size.decimals, decimals);
    if (size.values.size() < enough) size.values.insert(value);
    all_ = std::max(all_, decimals);
}

double Rounding::of(double value) const {
    const auto known = [](const auto& size) { return size.second.values.size() == enough; };
    int decimals = all_;
    if (const auto same = sizes_.find(size_of(value)); same != sizes_.end() && known(*same)) {
        decimals = same->second.decimals;
    } else if (value != 0.0) {
        // If a log keeps significant digits, smaller numbers show how many.
        for (auto below = sizes_.begin(); below != sizes_.upper_bound(size_of(value)); ++below)
            if (known(*below) && below->second.decimals < all_)
                decimals = std::min(all_, below->second.decimals - (size_of(value) - below->first));
    }
    double scale = 1.0;
    for (int i = std::abs(decimals); i > 0; --i) scale *= 10.0;
    return decimals > 0 ? 0.5 / scale : 0.5 * scale;
}

bool TraceReader::next_raw(RawFrame& frame) {
    if (damaged_) return false;
    try {
        if (!raw_->next(frame)) return false;
        if (frame.joints.size() < 2)
            fail_line(frame.line, frame.joints.empty() ? "expected two joints or more, found none"
                                  : frame.rotations.empty()
                                      ? "expected two joints or more, found one position"
                                      : "expected two joints or more, found one position and its rotation, "
                                        "which is no chain");
        const auto [chain, is_new] = joints_.try_emplace(frame.chain, frame.joints.size());
        if (is_new && joints_.size() > 1000) fail_line(frame.line, "found more than 1000 chains");
        if (chain->second != frame.joints.size())
            fail_line(frame.line, "expected " + std::to_string(chain->second) + " joints, as before, found " +
                                      std::to_string(frame.joints.size()));
        for (const glm::dvec3& joint : frame.joints)
            for (int axis = 0; axis < 3; ++axis) rounding_.add(joint[axis]);
        return true;
    } catch (const std::runtime_error& error) {
        if (joints_.empty()) throw;
        notes_.push_back(printable(error.what()) + "; what comes before it was read");
        damaged_ = true;
        return false;
    }
}

namespace {

/// Each joint's distance from the target over the frames: the median, at the best of some lags.
std::vector<double> distances_to_target(const std::vector<RawFrame>& frames) {
    constexpr std::size_t max_lag = 30;
    std::vector<double> distances(frames.front().joints.size(), std::numeric_limits<double>::infinity());
    for (std::size_t joint = 0; joint < distances.size(); ++joint)
        for (std::size_t lag = 0; lag <= max_lag && 2 * lag < frames.size(); ++lag) {
            std::vector<double> all;
            for (std::size_t i = lag; i < frames.size(); ++i)
                if (const auto& target = frames[i - lag].target)
                    if (const double d = glm::distance(*target, frames[i].joints[joint]); std::isfinite(d))
                        all.push_back(d);
            if (all.empty()) continue;
            const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
            std::ranges::nth_element(all, middle);
            distances[joint] = std::min(distances[joint], *middle);
        }
    return distances;
}

}  // namespace

// Finds the joint that reaches for the target: the last, or one far nearer, such as a wrist before a hand.
void TraceReader::find_end_effectors() {
    constexpr double nearer = 0.25, near = 0.02;  // fraction of the last joint's distance; of the reach
    if (given_end_) {
        std::size_t most = 0;
        for (const auto& [name, joints] : joints_) most = std::max(most, joints - 1);
        if (*given_end_ == 0 || *given_end_ > most)
            throw std::runtime_error("target_joint: must be 1 to " + std::to_string(most) + ", got " +
                                     std::to_string(*given_end_));
        conventions_.target = ", joint " + std::to_string(*given_end_) + " reaches for the target (given)";
        return;
    }
    std::map<std::string, std::vector<RawFrame>> chains;
    for (const RawFrame& frame : first_) chains[frame.chain].push_back(frame);
    for (const auto& [name, frames] : chains) {
        const std::vector<double> away = distances_to_target(frames);
        const auto nearest = static_cast<std::size_t>(std::ranges::min_element(away) - away.begin());
        if (nearest == 0 || !(away.back() > near * first_reach(frames)) ||
            !(away[nearest] < nearer * away.back()))
            continue;
        ends_[name] = nearest;
        conventions_.target += ", joint " + std::to_string(nearest) +
                               (name.empty() ? "" : " of " + printable(name)) +
                               " reaches for the target (the nearest to it)";
    }
}

void TraceReader::find_rate() {
    if (raw_->header.fps) {
        fps_ = *raw_->header.fps;
        fps_known_ = true;
        return;
    }
    std::vector<double> steps;
    std::map<std::string, double> last;
    for (const RawFrame& frame : first_) {
        if (frame.dt && *frame.dt > 0.0) steps.push_back(*frame.dt);
        if (!frame.time || frame.dt) continue;
        const auto [before, is_new] = last.try_emplace(frame.chain, *frame.time);
        if (!is_new && *frame.time > before->second) steps.push_back(*frame.time - before->second);
        before->second = *frame.time;
    }
    if (steps.empty()) return;
    std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
    const double median = steps[steps.size() / 2];
    if (median == 1.0) return;  // the times are frame numbers
    // Times are rounded: the mean of the steps is more accurate than any of them.
    double sum = 0.0, count = 0.0;
    for (const double each : steps)
        if (std::abs(each - median) <= 0.25 * median) sum += each, count += 1.0;
    double step = sum / count;
    while (step >= 1.0 && step < 1e12) step /= 1000.0;  // milliseconds or smaller
    if (!(step > 1e-6 && step < 1e3)) return;
    fps_ = 1.0 / step;
    fps_known_ = true;
}

bool TraceReader::next(TracedFrame& frame) {
    RawFrame raw;
    if (!first_.empty()) {
        raw = std::move(first_.front());
        first_.pop_front();
        if (first_.empty()) first_.shrink_to_fit();
    } else if (!next_raw(raw)) {
        if (!raw_->notes.empty()) notes_.insert(notes_.end(), raw_->notes.begin(), raw_->notes.end());
        raw_->notes.clear();
        return false;
    }
    frame.chain = std::move(raw.chain);
    frame.line = raw.line;
    frame.end = given_end_;
    if (const auto end = ends_.find(frame.chain); end != ends_.end()) frame.end = end->second;
    if (frame.end && *frame.end + 1 >= raw.joints.size()) frame.end.reset();
    frame.resolution = 0.0f;
    const auto point = [&](const glm::dvec3& p) {
        constexpr double floats = 0x1p-23;  // half a unit in a float's last place, in the engine and here
        for (int axis = 0; axis < 3; ++axis) {
            const double off =
                std::max(rounding_.of(p[axis]), floats * std::abs(p[axis])) * conventions_.metres();
            if (off < 1e12) frame.resolution = std::max(frame.resolution, static_cast<float>(off));
        }
        return conventions_.point(p);
    };
    frame.joints.clear();
    for (const glm::dvec3& joint : raw.joints) frame.joints.push_back(point(joint));
    frame.target = raw.target ? std::optional(point(*raw.target)) : std::nullopt;
    frame.pole = raw.pole ? std::optional(conventions_.point(*raw.pole)) : std::nullopt;
    frame.rotations.clear();
    for (const glm::dvec4& each : raw.rotations) frame.rotations.push_back(conventions_.rotation(each));
    frame.dt = raw.dt ? std::optional(static_cast<float>(*raw.dt)) : std::nullopt;
    return true;
}

std::size_t TraceFindings::count() const {
    std::size_t total = 0;
    for (const Chain& each : chains) total += each.incidents.size() + each.left_off;
    return total;
}

namespace {

/// Finds the incidents of one chain, and looks for changes that prevent a flip as soon as enough frames after
/// it are read.
class ChainTrial {
  public:
    ChainTrial(std::string name, ik::IncidentOptions options)
        : name_(std::move(name)), finder_(std::move(options)) {}

    const std::string& name() const { return name_; }

    void add(const TracedFrame& frame, std::size_t& joints_of_tries) {
        finder_.add({.joints = frame.joints,
                     .target = frame.target,
                     .pole = frame.pole,
                     .rotations = frame.rotations,
                     .dt = frame.dt,
                     .resolution = frame.resolution});
        latest_.push_back(frame);
        if (latest_.size() > frames_before_flip + frames_after_flip + 1) latest_.pop_front();
        for (; seen_ < finder_.incidents().size(); ++seen_)
            if (const ik::ChainIncident& each = finder_.incidents()[seen_];
                each.kind == ik::IncidentKind::Flip && each.flip != ik::FlipCause::Rolled)
                waiting_.push_back(each);
        if (!waiting_.empty() && waiting_.front().frame + frames_after_flip < finder_.frames())
            try_next(joints_of_tries);
    }

    TraceFindings::Chain finish(std::size_t& joints_of_tries) {
        while (!waiting_.empty()) try_next(joints_of_tries);
        finder_.finish();
        TraceFindings::Chain chain{name_, {}, finder_.frames(), finder_.left_off()};
        for (const ik::ChainIncident& each : finder_.incidents()) {
            chain.incidents.push_back({each, {}});
            const auto tried = tried_.find(each.frame);
            if (each.kind == ik::IncidentKind::Flip && tried != tried_.end())
                chain.incidents.back().prevented = std::move(tried->second);
        }
        return chain;
    }

  private:
    void try_next(std::size_t& joints_of_tries) {
        const ik::ChainIncident flip = waiting_.front();
        waiting_.pop_front();
        const std::uint64_t oldest = finder_.frames() - latest_.size();
        const std::uint64_t first =
            std::max(oldest, flip.frame < frames_before_flip ? 0 : flip.frame - frames_before_flip);
        const std::vector<TracedFrame> frames(latest_.begin() + static_cast<std::ptrdiff_t>(first - oldest),
                                              latest_.end());
        if (joints_of_tries + frames.front().joints.size() > max_joints_of_tries) return;
        joints_of_tries += frames.front().joints.size();
        tried_[flip.frame] =
            prevent_flip(frames, static_cast<std::size_t>(flip.frame - first), flip.joint, flip.flip);
    }

    std::string name_;
    ik::IncidentFinder finder_;
    std::deque<TracedFrame> latest_;
    std::deque<ik::ChainIncident> waiting_;  ///< flips whose following frames are not read yet
    std::size_t seen_ = 0;
    std::map<std::uint64_t, PreventedFlip> tried_;  ///< by frame
};

}  // namespace

TraceFindings find_incidents(TraceReader& reader, const std::function<void()>& progress) {
    std::vector<ChainTrial> running;
    std::size_t joints_of_tries = 0;
    TracedFrame frame;
    while (reader.next(frame)) {
        auto chain = std::ranges::find(running, frame.chain, &ChainTrial::name);
        if (chain == running.end()) {
            running.emplace_back(frame.chain, ik::IncidentOptions{.fps = static_cast<float>(reader.fps()),
                                                                  .limits = reader.header().limits,
                                                                  .end_effector = frame.end});
            chain = running.end() - 1;
        }
        chain->add(frame, joints_of_tries);
        if (progress) progress();
    }
    TraceFindings findings;
    for (ChainTrial& each : running) findings.chains.push_back(each.finish(joints_of_tries));
    return findings;
}

}  // namespace tendril::app
