#include "app/io/character/export.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <tendril/humanoid/attach.hpp>
#include <tendril/humanoid/lint.hpp>

#include "app/io/character/bvh.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/gltf.hpp"
#include "app/io/text.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using humanoid::Placement;
using humanoid::Skeleton;

GltfOrigin origin_of(const std::string& file) {
    const std::string ending = lower_case(fs::path(file).extension().string());
    if (ending != ".gltf" && ending != ".glb" && ending != ".vrm" && ending != ".vrma") return {};
    return {character_bytes(file), fs::path(file).parent_path()};
}

/// The index of each of the character's nodes in the skeleton read back. Throws if one is missing.
std::vector<std::size_t> places_of(const Skeleton& skeleton, const Skeleton& read, bool is_bvh) {
    std::vector<std::size_t> places(skeleton.size());
    if (is_bvh) {
        // Both are in depth-first order; a joint without children is followed by its added end site.
        std::size_t next = 0;
        for (const std::int32_t each : skeleton.order()) {
            const auto node = static_cast<std::size_t>(each);
            if (next >= read.size())
                throw std::runtime_error("node " + skeleton[node].name + " was not written");
            places[node] = next++;
            if (skeleton.children(node).empty() && next < read.size() &&
                read[next].parent == static_cast<std::int32_t>(places[node]))
                ++next;
        }
        return places;
    }
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
        const auto place = read.find(skeleton[i].name);
        if (!place) throw std::runtime_error("node " + skeleton[i].name + " was not written");
        places[i] = *place;
    }
    return places;
}

/// Compares all joints at a time of the clip with the same time of the file.
class Comparison {
  public:
    Comparison(const Export& what, const Character& read, bool is_bvh, bool has_origin)
        : what_(what),
          dressed_(what.worn.dressed(what.character.skeleton)),
          read_(read),
          places_(places_of(humanoid::detached(dressed_), read.skeleton, is_bvh)),
          ratio_(has_origin ? what.character.scale : 1.0),
          turn_(turn_of(has_origin ? what.character.space.up : UpAxis::Y)) {}
    void at(double time, double read_time, ExportReport& report) {
        const Skeleton& skeleton = dressed_;
        pose(what_.corrected, skeleton, time, wanted_);
        pose(clip(), read_.skeleton, read_time, found_);
        for (std::size_t i = 0; i < skeleton.size(); ++i) {
            const double off =
                glm::distance(wanted_[i].position, turn_ * found_[places_[i]].position * ratio_);
            if (report.worst_joint.empty() || !(off <= report.worst)) {
                report.worst = off;
                report.worst_joint = skeleton[i].name;
            }
        }
    }

  private:
    const humanoid::Clip& clip() const {
        static const humanoid::Clip none{};
        return read_.clips.empty() ? none : read_.clips.front();
    }
    void pose(const humanoid::Clip& clip, const Skeleton& skeleton, double time,
              std::vector<Placement>& placed) {
        local_.resize(skeleton.size());
        placed.resize(skeleton.size());
        sample(clip, skeleton, time, local_);
        place(skeleton, local_, placed);
    }

    const Export& what_;
    const Skeleton dressed_;
    const Character& read_;
    std::vector<std::size_t> places_;
    double ratio_;     ///< metres per unit of the character read back
    glm::dquat turn_;  ///< from the axes of the character read back
    std::vector<rig::Transform> local_{};
    std::vector<Placement> wanted_{}, found_{};
};

/// True if the original has the same fault at the same joint, at the same or a neighbouring frame.
bool is_known(const humanoid::Finding& finding, const humanoid::LintReport& original) {
    constexpr std::size_t near = 3;  // frames
    return std::ranges::any_of(original.findings, [&](const humanoid::Finding& each) {
        return each.fault == finding.fault && each.node == finding.node &&
               each.first <= finding.last + near && finding.first <= each.last + near;
    });
}

ExportReport report_of(const Export& what, const Character& read, bool is_bvh, bool has_origin) {
    ExportReport report;
    const humanoid::Frames frames = frames_at(what.corrected, what.rate);
    report.frames = frames.count;
    Comparison comparison(what, read, is_bvh, has_origin);
    for (std::size_t i = 0; i < report.frames; ++i) {
        const double time = frames.time(i), between = time + 0.5 * frames.step;
        comparison.at(time, is_bvh ? static_cast<double>(i) / what.rate : time, report);
        // A BVH does not define the motion between frames.
        if (!is_bvh) comparison.at(between, between, report);
    }
    const Skeleton& skeleton = what.character.skeleton;
    const humanoid::BoneMap map = bone_map(what.character);
    humanoid::Clip bare = what.corrected;
    std::erase_if(bare.channels, [&](const humanoid::Channel& each) { return each.node >= skeleton.size(); });
    const humanoid::LintReport before = lint(skeleton, map, what.original, {.rate = what.rate}),
                               after = lint(skeleton, map, bare, {.rate = what.rate, .ground = what.ground});
    report.rate = what.rate;
    report.worn = names(what.worn.meshes, [](const WornMesh& each) { return each.name; });
    if (has_origin) report.unit = what.character.scale;
    report.on_ground = what.ground != nullptr && what.ground->kind() != humanoid::GroundKind::Flat;
    report.findings = after.findings.size();
    for (const humanoid::Finding& each : after.findings)
        if (!is_known(each, before)) report.new_findings.push_back(each.text);
    report.has_feet = before.has_floor && after.has_floor;
    if (report.has_feet) report.skating_before = before.skating, report.skating_after = after.skating;
    return report;
}

/// "7 findings in the written clip, 2 of them new: ...". A clip whose feet were put on a ground is judged on
/// that ground, which a reader of the file does not know.
std::string findings_text(const ExportReport& report) {
    constexpr std::size_t named = 2;
    if (report.findings == 0) return "no findings in the written clip";
    std::string text =
        count_text(report.findings, "finding") +
        (report.on_ground ? " in the written clip on this ground, " : " in the written clip, ");
    const std::size_t fresh = report.new_findings.size();
    if (fresh == 0) return text + "none of them new";
    text += std::to_string(fresh) + " of them new: ";
    for (std::size_t i = 0; i < std::min(fresh, named); ++i)
        text += (i > 0 ? ", " : "") + report.new_findings[i];
    return fresh > named ? text + " and " + std::to_string(fresh - named) + " more" : text;
}

std::string unit_text(const ExportReport& report) {
    if (report.unit == 1.0) return "";
    return "; the file keeps its unit: other programs read 1 m as " + si_text(1.0 / report.unit, "m");
}

}  // namespace

std::string read_back_text(const ExportReport& report) {
    return "; read back within " + fixed_text(1e3 * report.worst, 4) + " mm, worst at " + report.worst_joint;
}

std::string ExportReport::text() const {
    char rate_text[40];
    std::snprintf(rate_text, sizeof rate_text, " at %.5g fps", rate);
    const std::string text =
        count_text(frames, "frame") + rate_text + read_back_text(*this) + unit_text(*this);
    const std::string found = "; " + findings_text(*this);
    if (!has_feet) return text + "; no foot is ever planted" + found;
    return text + "; feet skate " + fixed_text(1e3 * skating_after, 1) + " mm, before fixes and IK " +
           fixed_text(1e3 * skating_before, 1) + " mm" + found;
}

std::string one_of_clips_text(const Character& character, const std::string& clip) {
    const std::size_t count = character.clips.size();
    return count < 2 ? std::string() : "1 of " + std::to_string(count) + " clips: " + clip;
}

std::vector<fs::path> paths_of_clips(const Character& character, const fs::path& path) {
    std::vector<fs::path> paths;
    for (const humanoid::Clip& clip : character.clips) {
        std::string name = clip.name;
        for (char& each : name) {
            const auto byte = static_cast<unsigned char>(each);
            if (byte < 0x20 || byte == 0x7f ||
                std::string_view("/\\:*?\"<>|").find(each) != std::string_view::npos)
                each = '_';
        }
        const std::string stem = path.stem().string() + '_' + name, ending = path.extension().string();
        fs::path next = path.parent_path() / (stem + ending);
        for (int i = 2; std::ranges::find(paths, next) != paths.end(); ++i)
            next = path.parent_path() / (stem + '_' + std::to_string(i) + ending);
        paths.push_back(std::move(next));
    }
    return paths;
}

std::string sum_text(const std::vector<ExportReport>& reports) {
    const ExportReport* worst = nullptr;
    std::size_t fresh = 0;
    for (const ExportReport& each : reports) {
        if (worst == nullptr || each.worst > worst->worst) worst = &each;
        fresh += each.new_findings.size();
    }
    return count_text(reports.size(), "clip") +
           (worst != nullptr ? read_back_text(*worst) + unit_text(*worst) : "") + "; " +
           (fresh == 0 ? "no new findings" : count_text(fresh, "new finding")) + " in them";
}

bool ends_as_export(const fs::path& path) {
    const std::string ending = lower_case(path.extension().string());
    return ending == ".gltf" || ending == ".glb" || ending == ".bvh";
}

ExportReport export_clip(const Export& what, const fs::path& path) {
    const std::string name = (path.has_filename() ? path.filename() : path).string(),
                      ending = lower_case(path.extension().string());
    if (!ends_as_export(path))
        throw std::runtime_error(name + ": expected a name that ends in .gltf, .glb or .bvh");
    if (!(what.rate >= min_rate && what.rate <= largest_rate))
        throw std::runtime_error(name + ": expected 1 to 1000 frames per second");
    constexpr double max_frames = 1'000'000;
    if (what.corrected.duration * what.rate > max_frames)
        throw std::runtime_error(name + ": would have more than 1000000 frames");
    Outputs any;
    any.force = true;
    if (!what.file.empty()) any.inputs.push_back(what.file);
    Outputs& outputs = what.outputs ? *what.outputs : any;
    outputs.check({path}, OutputKind::Motion);
    check_writable(path);
    try {
        const bool is_bvh = ending == ".bvh";
        const GltfOrigin origin = is_bvh ? GltfOrigin() : origin_of(what.file);
        Character written = what.character;
        written.skeleton = humanoid::detached(what.worn.dressed(what.character.skeleton));
        const std::string bytes =
            is_bvh ? bvh_text(written.skeleton, what.corrected, what.rate)
                   : gltf_bytes(written, what.corrected, what.rate, origin, ending == ".glb", what.worn);
        const Character read = is_bvh ? parse_bvh(bytes, name) : parse_gltf(bytes, name, {});
        const ExportReport report = report_of(what, read, is_bvh, !origin.bytes.empty());
        outputs.write(path, OutputKind::Motion, bytes);
        return report;
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error(name + ": the JSON of " + fs::path(what.file).filename().string() +
                                 " is not valid glTF");
    }
}

}  // namespace tendril::app
