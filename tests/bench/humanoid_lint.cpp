// Cost of motion lint per frame of a clip, by nodes and length, and of fixing a foot.
//
// Claims, for the worst row:
//  - checking takes at most one loop (measure.hpp) per frame and node, at any length;
//  - fixing one foot takes less than checking the clip three times, and an eighth of one check of a long
//    clip whose report is at hand: then the cure looks only at the frames around it.
#include "../core/humanoid_walk.hpp"
#include "measure.hpp"
#include "tendril/humanoid/lint.hpp"

namespace {

using namespace tendril;
using namespace tendril::bench;
using namespace tendril::humanoid;

/// The figure, with fingers to make up `nodes` nodes; at least its own.
Skeleton figure_of(std::size_t nodes) {
    std::vector<Node> all = test::make_figure({}).nodes();
    const auto hand = [&](const char* name) {
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].name == name) return static_cast<std::int32_t>(i);
        return 0;
    };
    const std::int32_t hands[]{hand("LeftHand"), hand("RightHand")};
    for (std::size_t i = 0; all.size() < nodes; ++i) {
        std::string name = "finger";
        name += std::to_string(i);
        all.push_back({name, hands[i % 2], {.translation = {0.02, 0.01 * static_cast<double>(i / 2), 0.0}}});
    }
    return *Skeleton::make(std::move(all));
}

/// Walks for `frames` frames at 60 frames/s, with keys on every node; one foot slides now and then.
Clip walk_of(const Skeleton& skeleton, std::size_t frames) {
    const Clip cycle = test::FigureWalk(skeleton).clip();
    Clip clip{.name = "long", .duration = static_cast<double>(frames - 1) / 60.0, .channels = {}};
    for (std::size_t node = 0; node < skeleton.size(); ++node) clip.channels.push_back({.node = node});
    std::vector<rig::Transform> pose(skeleton.size());
    for (std::size_t i = 0; i < frames; ++i) {
        const double time = std::min(static_cast<double>(i) / 60.0, clip.duration);
        const double rounds = std::floor(time / cycle.duration), within = time - rounds * cycle.duration;
        sample(cycle, skeleton, within, pose);
        const double swing = std::sin(2.0 * 3.14159265358979 * within / cycle.duration);
        for (std::size_t node = 0; node < skeleton.size(); ++node) {
            rig::Transform local = pose[node];
            if (skeleton[node].parent < 0)
                local.translation.z += rounds * test::FigureWalk::speed * test::FigureWalk::period;
            if (skeleton[node].parent < 0 && i % 600 < 60) local.translation.x += 0.03 * swing;
            Channel& channel = clip.channels[node];
            channel.rotation.times.push_back(time), channel.translation.times.push_back(time);
            channel.rotation.values.push_back(local.rotation);
            channel.translation.values.push_back(local.translation);
        }
    }
    return clip;
}

}  // namespace

int main(int count, char** arguments) {
    std::printf("%-12s%10s%20s%20s%12s\n", "nodes", "frames", "judged, us a frame", "foot mended, part",
                "findings");
    double slowest = 0.0, dearest = 0.0, dearest_around = 0.0;
    for (const std::size_t nodes : {std::size_t{22}, std::size_t{60}, std::size_t{120}})
        for (const std::size_t frames : {std::size_t{120}, std::size_t{1200}, std::size_t{12000}}) {
            const Skeleton skeleton = figure_of(nodes);
            const BoneMap map = match_bones(skeleton);
            const Clip clip = walk_of(skeleton, frames);
            require(check(clip, skeleton));
            LintReport report = lint(skeleton, map, clip);
            const auto slides = std::find_if(
                report.findings.begin(), report.findings.end(),
                [](const Finding& each) { return each.fault == Fault::Skating && each.has_cure; });
            if (slides == report.findings.end()) {
                std::fprintf(stderr, "no foot slides in the clip of %zu frames\n", frames);
                return 2;
            }
            std::size_t keys = 0;
            const std::vector<double> seconds = race(
                {[&] { keys += lint(skeleton, map, clip).frames; },
                 [&] { keys += cure(skeleton, map, clip, *slides).value().channels.size(); },
                 [&] { keys += cure(skeleton, map, clip, *slides, {}, &report).value().channels.size(); }},
                frames > 2000 ? 3 : 11);
            const double a_frame = seconds[0] * 1e6 / static_cast<double>(frames);
            const double part = seconds[1] / seconds[0];
            std::printf("%-12zu%10zu%20.1f%20.2f%12zu\n", skeleton.size(), frames, a_frame, part,
                        report.findings.size());
            slowest = std::max(slowest, a_frame / static_cast<double>(skeleton.size()));
            dearest = std::max(dearest, part);
            if (frames > 2000) dearest_around = std::max(dearest_around, seconds[2] / seconds[0]);
        }
    bool all = claim_loops("a frame and node", 1e-6 * slowest, 1);
    all &= claim("three judgements over the cure of a foot", 3.0 / dearest, 1.0);
    all &= claim("a judgement of a long clip over a cure that has one", 1.0 / dearest_around, 8.0);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
