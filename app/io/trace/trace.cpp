#include "app/io/trace/trace.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "app/document/text.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t frames_to_guess_from = 64;

}  // namespace

TraceReader::TraceReader(std::istream& in, const ConventionChoice& choice, std::optional<double> fps)
    : raw_(open_raw_trace(in)) {
    RawFrame frame;
    while (first_.size() < frames_to_guess_from && next_raw(frame)) first_.push_back(std::move(frame));
    if (first_.empty()) throw std::runtime_error("has no frames: expected joints");
    const std::vector<RawFrame> frames(first_.begin(), first_.end());
    conventions_ = conventions_of(*raw_, frames, choice);
    if (fps) {
        fps_ = *fps;
        fps_known_ = true;
    } else {
        find_rate();
    }
}

bool TraceReader::next_raw(RawFrame& frame) {
    if (damaged_) return false;
    try {
        if (!raw_->next(frame)) return false;
        if (frame.joints.size() < 2)
            fail_line(frame.line,
                      "expected two joints or more, found " + std::to_string(frame.joints.size()));
        const auto [chain, is_new] = joints_.try_emplace(frame.chain, frame.joints.size());
        if (is_new && joints_.size() > 1000) fail_line(frame.line, "found more than 1000 chains");
        if (chain->second != frame.joints.size())
            fail_line(frame.line, "expected " + std::to_string(chain->second) + " joints, as before, found " +
                                      std::to_string(frame.joints.size()));
        return true;
    } catch (const std::runtime_error& error) {
        if (first_.empty()) throw;
        notes_.push_back(printable(error.what()) + "; what comes before it was read");
        damaged_ = true;
        return false;
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
    const double step = steps[steps.size() / 2];
    if (!(step > 1e-6 && step < 1e3)) return;
    fps_ = 1.0 / step;
    fps_known_ = true;
}

float TraceReader::resolution() const {
    if (raw_->decimals < 0) return 0.0f;
    return static_cast<float>(0.5 * std::pow(10.0, -raw_->decimals) * conventions_.metres());
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
    frame.joints.clear();
    for (const glm::dvec3& joint : raw.joints) frame.joints.push_back(conventions_.point(joint));
    const auto point = [&](const std::optional<glm::dvec3>& p) {
        return p ? std::optional(conventions_.point(*p)) : std::nullopt;
    };
    frame.target = point(raw.target);
    frame.pole = point(raw.pole);
    frame.dt = raw.dt ? std::optional(static_cast<float>(*raw.dt)) : std::nullopt;
    return true;
}

std::size_t TraceFindings::count() const {
    std::size_t total = 0;
    for (const Chain& each : chains) total += each.incidents.size() + each.left_off;
    return total;
}

TraceFindings find_incidents(TraceReader& reader, const std::function<void()>& progress) {
    struct Running {
        std::string name;
        ik::IncidentFinder finder;
    };
    std::vector<Running> running;
    TracedFrame frame;
    while (reader.next(frame)) {
        auto chain = std::ranges::find(running, frame.chain, &Running::name);
        if (chain == running.end()) {
            running.push_back({frame.chain, ik::IncidentFinder({.resolution = reader.resolution(),
                                                                .fps = static_cast<float>(reader.fps()),
                                                                .limits = reader.header().limits})});
            chain = running.end() - 1;
        }
        chain->finder.add(
            {.joints = frame.joints, .target = frame.target, .pole = frame.pole, .dt = frame.dt});
        if (progress) progress();
    }
    TraceFindings findings;
    for (Running& each : running) {
        each.finder.finish();
        findings.chains.push_back(
            {each.name, each.finder.incidents(), each.finder.frames(), each.finder.left_off()});
    }
    return findings;
}

}  // namespace tendril::app
