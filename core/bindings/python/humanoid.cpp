// Characters from files: their clips as arrays, judged, mended, retargeted and written. The program's own
// code does it (app/io/character), so that a script says what `tendril lint` says.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <cmath>
#include <future>
#include <optional>

#include "app/io/character/bake.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/retargeted_motion.hpp"
#include "app/io/text.hpp"
#include "arrays.hpp"
#include "files.hpp"
#include "help.hpp"
#include "rooms.hpp"
#include "tendril/humanoid/lint.hpp"

namespace tendril::python {

namespace {

namespace fs = std::filesystem;
using humanoid::Ground;

/// Never changed once it is made, so that threads may share it.
struct Loaded {
    fs::path file;
    app::Character character;
    humanoid::BoneMap map;
    const humanoid::Skeleton& skeleton() const { return character.skeleton; }
    std::string name() const { return app::printable(file.filename().string()); }
};
using Shared = std::shared_ptr<const Loaded>;

struct Character {
    Shared loaded;
};

struct Clip {
    Shared of;
    std::shared_ptr<const humanoid::Clip> clip;
    std::vector<std::string> notes{};
};

struct Finding {
    humanoid::Finding found;
    Shared of;
};

struct LintReport {
    humanoid::LintReport report;
    std::vector<Finding> findings;
};

Clip clip_of(const Shared& of, humanoid::Clip clip, std::vector<std::string> notes = {}) {
    return {of, std::make_shared<const humanoid::Clip>(std::move(clip)), std::move(notes)};
}

/// Reads in another thread; this one calls `report` with the part read and listens to Ctrl+C. An exception of
/// either cancels the reading.
Shared read(const fs::path& file, const py::object& report) {
    constexpr std::chrono::milliseconds between_calls(50);  // a bar grows smoothly, and Python hardly works
    app::LoadProgress progress;
    const auto tell = [&](float part) {
        const py::gil_scoped_acquire held;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!report.is_none()) report(part);
    };
    auto reading = std::async(std::launch::async, [&] {
        auto loaded = std::make_shared<Loaded>();
        loaded->file = file;
        loaded->character = app::read_character(file, &progress);
        loaded->map = app::bone_map(loaded->character);
        return Shared(std::move(loaded));
    });
    try {
        while (reading.wait_for(between_calls) != std::future_status::ready) tell(progress.part());
        Shared loaded = reading.get();
        tell(1.0f);
        return loaded;
    } catch (...) {
        progress.cancel();
        throw;
    }
}

Character load_character(const fs::path& file, const py::object& progress) {
    if (!progress.is_none() && !PyCallable_Check(progress.ptr()))
        throw py::type_error("load_character: progress must be a function or None");
    return {from_file(file, [&] { return read(file, progress); })};
}

double rate_of(const std::optional<double>& rate, const humanoid::Clip& clip, const char* function) {
    const double chosen = rate.value_or(humanoid::frame_rate(clip));
    if (!(chosen >= app::min_rate && chosen <= app::largest_rate))
        throw py::value_error(std::string(function) + ": rate must be 1 to 1000, got " +
                              std::to_string(chosen));
    return chosen;
}

// ---- Arrays.

/// Calls take(frame, local transforms, placements) for every frame of the clip at its own rate.
void for_each_frame(const Clip& clip, const auto& take) {
    const humanoid::Skeleton& skeleton = clip.of->skeleton();
    const humanoid::Frames frames = frames_at(*clip.clip, humanoid::frame_rate(*clip.clip));
    std::vector<rig::Transform> pose(skeleton.size());
    std::vector<humanoid::Placement> placements(skeleton.size());
    for (std::size_t i = 0; i < frames.count; ++i) {
        sample(*clip.clip, skeleton, frames.time(i), pose);
        place(skeleton, pose, placements);
        take(i, pose, placements);
    }
}

std::size_t frame_count(const Clip& clip) {
    return frames_at(*clip.clip, humanoid::frame_rate(*clip.clip)).count;
}

/// Its frames, of which a file of a few bytes may have any number.
py::ssize_t frames_of(const Clip& clip) {
    constexpr std::size_t most = 50'000'000;  // as baked() has keys at most; 1.6 GB of rotations
    const std::size_t frames = frame_count(clip);
    if (frames > most / clip.of->skeleton().size())
        throw py::value_error("clip " + app::printable(clip.clip->name) + " has " + std::to_string(frames) +
                              " frames of " + app::count_text(clip.of->skeleton().size(), "joint") +
                              ", more than an array is made for");
    return static_cast<py::ssize_t>(frames);
}

/// An array (frames, joints, `numbers` of Element), each from `get` of the local transform and the placement.
template <class Element>
Array<double> of_joints(const Clip& clip, const auto& get) {
    const std::size_t joints = clip.of->skeleton().size();
    Array<double> array({frames_of(clip), static_cast<py::ssize_t>(joints),
                         static_cast<py::ssize_t>(sizeof(Element) / sizeof(double))});
    const std::span<Element> all = mutable_elements<Element>(array);
    const py::gil_scoped_release released;
    for_each_frame(clip, [&](std::size_t frame, const auto& pose, const auto& placements) {
        for (std::size_t i = 0; i < joints; ++i) all[frame * joints + i] = get(pose[i], placements[i]);
    });
    return array;
}

Array<double> positions(const Clip& clip) {
    return of_joints<glm::dvec3>(clip, [](const auto&, const auto& placed) { return placed.position; });
}
Array<double> rotations(const Clip& clip) {
    return of_joints<glm::dquat>(clip, [](const auto&, const auto& placed) { return placed.rotation(); });
}
Array<double> local_positions(const Clip& clip) {
    return of_joints<glm::dvec3>(clip, [](const auto& local, const auto&) { return local.translation; });
}
Array<double> local_rotations(const Clip& clip) {
    return of_joints<glm::dquat>(clip, [](const auto& local, const auto&) { return local.rotation; });
}

/// The clip with other poses in its frames: what does not change keeps its keys.
Clip with_poses(const Clip& clip, const py::object& given_rotations, const py::object& given_positions) {
    const py::ssize_t frames = frames_of(clip), joints = static_cast<py::ssize_t>(clip.of->skeleton().size());
    std::optional<Array<double>> turns, places;
    if (!given_rotations.is_none())
        turns = array<double>(given_rotations, {{frames}, {joints}, {4}}, "with_poses: local_rotations");
    if (!given_positions.is_none())
        places = array<double>(given_positions, {{frames}, {joints}, {3}}, "with_poses: local_positions");
    const std::span<const glm::dquat> turned =
        turns ? elements<glm::dquat>(*turns) : std::span<const glm::dquat>();
    const std::span<const glm::dvec3> placed =
        places ? elements<glm::dvec3>(*places) : std::span<const glm::dvec3>();
    return refusing([&] {
        std::size_t frame = 0;
        humanoid::Clip made =
            app::baked(clip.of->skeleton(), *clip.clip, humanoid::frame_rate(*clip.clip),
                       [&](std::span<rig::Transform> pose, double, double) {
                           // A clip may end between two frames: there the last one stands.
                           const std::size_t first =
                               std::min(frame++, static_cast<std::size_t>(frames) - 1) * pose.size();
                           for (std::size_t i = 0; i < pose.size(); ++i) {
                               if (!turned.empty()) pose[i].rotation = turned[first + i];
                               if (!placed.empty()) pose[i].translation = placed[first + i];
                           }
                       });
        if (const Result right = humanoid::check(made, clip.of->skeleton()); !right)
            throw std::runtime_error(right.message());
        return clip_of(clip.of, std::move(made), clip.notes);
    });
}

// ---- The character.

py::list node_names(const Loaded& loaded) {
    py::list names;
    for (const humanoid::Node& each : loaded.skeleton().nodes()) names.append(text(each.name));
    return names;
}

Array<std::int32_t> parents(const Loaded& loaded) {
    Array<std::int32_t> array(static_cast<py::ssize_t>(loaded.skeleton().size()));
    for (std::size_t i = 0; i < loaded.skeleton().size(); ++i)
        array.mutable_data()[i] = loaded.skeleton()[i].parent;
    return array;
}

std::vector<humanoid::Placement> rest_placements(const Loaded& loaded) {
    std::vector<humanoid::Placement> placements(loaded.skeleton().size());
    place(loaded.skeleton(), rest_pose(loaded.skeleton()), placements);
    return placements;
}

py::dict bones(const Loaded& loaded) {
    py::dict all;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (const std::int32_t node = loaded.map.bones[i].node; node >= 0)
            all[humanoid::name(static_cast<humanoid::Bone>(i))] =
                text(loaded.skeleton()[static_cast<std::size_t>(node)].name);
    return all;
}

std::vector<std::string> missing(const Loaded& loaded) {
    std::vector<std::string> names;
    for (const humanoid::Bone each : loaded.map.missing) names.emplace_back(humanoid::name(each));
    return names;
}

std::vector<Clip> clips(const Character& character) {
    std::vector<Clip> all;
    // They lie in the character, which each of them keeps alive.
    for (const humanoid::Clip& each : character.loaded->character.clips)
        all.push_back({character.loaded, std::shared_ptr<const humanoid::Clip>(character.loaded, &each)});
    return all;
}

Clip clip(const Character& character, const std::string& name) {
    return refusing([&] {
        const Loaded& of = *character.loaded;
        return Clip{character.loaded, {character.loaded, &app::clip_named(of.character, of.file, name)}};
    });
}

// ---- What is done with a clip.

Held<humanoid::LintSettings> lint_settings(const py::object& settings, const std::optional<Ground>& ground,
                                           const py::kwargs& arguments, const char* function) {
    auto held = options<humanoid::LintSettings>(settings, arguments, function);
    if (ground) held.value.ground = &*ground;
    return held;
}

LintReport lint(const Clip& clip, const py::object& settings, const std::optional<Ground>& ground,
                const py::kwargs& arguments) {
    const auto held = lint_settings(settings, ground, arguments, "lint");
    const Loaded& of = *clip.of;
    const py::gil_scoped_release released;
    LintReport made{humanoid::lint(of.skeleton(), of.map, *clip.clip, *held), {}};
    for (const humanoid::Finding& each : made.report.findings) made.findings.push_back({each, clip.of});
    return made;
}

Clip cure(const Clip& clip, const Finding& finding, const py::object& settings,
          const std::optional<Ground>& ground, const py::kwargs& arguments) {
    const auto held = lint_settings(settings, ground, arguments, "cure");
    const Loaded& of = *clip.of;
    return refusing([&] {
        const auto cured = humanoid::cure(of.skeleton(), of.map, *clip.clip, finding.found, *held);
        if (!cured) throw std::runtime_error(cured.message());
        return clip_of(clip.of, *cured, clip.notes);
    });
}

Clip plant_feet(const Clip& clip, const std::optional<Ground>& ground, const std::optional<double>& rate) {
    const double frames = rate_of(rate, *clip.clip, "plant_feet");
    const Loaded& of = *clip.of;
    return refusing([&] {
        Expected<Ground> level = Ground::flat();
        return clip_of(
            clip.of, app::with_feet_on(ground ? *ground : *level, of.skeleton(), of.map, *clip.clip, frames),
            clip.notes);
    });
}

Clip travel(const Clip& clip, const std::optional<double>& rate) {
    const double frames = rate_of(rate, *clip.clip, "travel");
    const Loaded& of = *clip.of;
    return refusing([&] {
        const glm::dvec3 ground_moves = humanoid::lint(of.skeleton(), of.map, *clip.clip).treadmill;
        if (ground_moves == glm::dvec3(0.0)) return clip;
        return clip_of(clip.of, app::travelling(of.skeleton(), *clip.clip, -ground_moves, frames),
                       clip.notes);
    });
}

Clip retarget(const Clip& clip, const Character& to) {
    const Loaded &from = *clip.of, &onto = *to.loaded;
    return refusing([&] {
        app::RetargetedMotion made =
            app::retargeted_clip(from.character, from.map, from.file, *clip.clip, onto.skeleton(), onto.map);
        return clip_of(to.loaded, std::move(made.clip), std::move(made.notes));
    });
}

app::ExportReport save_clip(const fs::path& path, const Clip& clip, const std::optional<Clip>& original,
                            const std::optional<double>& rate, const std::optional<Ground>& ground) {
    const double frames = rate_of(rate, *clip.clip, "save_clip");
    if (original && !(original->of->skeleton() == clip.of->skeleton()))
        throw py::value_error("save_clip: original must be a clip of " + clip.of->name() + ", got one of " +
                              original->of->name());
    return refusing([&] {
        return app::export_clip({.character = clip.of->character,
                                 .file = clip.of->file.string(),
                                 .original = original ? *original->clip : *clip.clip,
                                 .corrected = *clip.clip,
                                 .rate = frames,
                                 .ground = ground ? &*ground : nullptr},
                                path);
    });
}

// ---- The ground.

Ground terrain(const py::object& heights, double cell, double x, double z) {
    const auto given = array<double>(heights, {{-1, "rows"}, {-1, "columns"}}, "Ground.terrain: heights");
    Expected<Ground> made = Ground::terrain({.x = x,
                                             .z = z,
                                             .cell = cell,
                                             .columns = static_cast<std::size_t>(given.shape(1)),
                                             .heights = {given.data(), given.data() + given.size()}});
    return value_or_throw(made);
}

Ground mesh(const py::object& vertices, const py::object& triangles) {
    const auto points = array<double>(vertices, {{-1, "vertices"}, {3}}, "Ground.mesh: vertices");
    const auto given = array<double>(triangles, {{-1, "triangles"}, {3}}, "Ground.mesh: triangles");
    std::vector<std::uint32_t> corners;
    for (const double each : std::span(given.data(), static_cast<std::size_t>(given.size()))) {
        if (!(each >= 0.0 && each < static_cast<double>(points.shape(0)) && each == std::floor(each)))
            throw py::value_error("Ground.mesh: triangles must be indices below " +
                                  std::to_string(points.shape(0)) + ", got " + std::to_string(each));
        corners.push_back(static_cast<std::uint32_t>(each));
    }
    Expected<Ground> made = Ground::mesh(elements<glm::dvec3>(points), corners);
    return value_or_throw(made);
}

void bind_ground(py::module_& root) {
    bind_enum(root, "GroundKind", detail::type_name<humanoid::GroundKind>(),
              names_to(humanoid::GroundKind::Mesh));
    made_only_here(py::class_<Ground>(root, "Ground", help("Ground")))
        .def_static(
            "flat",
            [](double height) {
                Expected<Ground> made = Ground::flat(height);
                return value_or_throw(made);
            },
            py::arg("height") = 0.0, help("Ground.flat"))
        .def_static(
            "slope",
            [](double angle) {
                Expected<Ground> made = Ground::slope(angle);
                return value_or_throw(made);
            },
            py::arg("angle"), help("Ground.slope"))
        .def_static(
            "stairs",
            [](double step_height, double step_depth) {
                Expected<Ground> made = Ground::stairs(step_height, step_depth);
                return value_or_throw(made);
            },
            py::arg("step_height"), py::arg("step_depth"), help("Ground.stairs"))
        .def_static("terrain", &terrain, py::arg("heights"), py::arg("cell") = 0.5, py::arg("x") = 0.0,
                    py::arg("z") = 0.0, help("Ground.terrain"))
        .def_static("mesh", &mesh, py::arg("vertices"), py::arg("triangles"), help("Ground.mesh"))
        .def_property_readonly(
            "kind", [](const Ground& self) { return to_choice(self.kind()); }, help("Ground.kind"))
        .def(
            "height",
            [](const Ground& self, double x, double z) {
                const auto hit = self.highest(x, z);
                return hit ? std::optional(hit->height) : std::nullopt;
            },
            py::arg("x"), py::arg("z"), help("Ground.height"));
}

void bind_character(py::module_& root) {
    const auto points = [](const auto& all) {
        std::vector<glm::dvec3> places;
        for (const humanoid::Placement& each : all) places.push_back(each.position);
        return to_array<double>(std::span<const glm::dvec3>(places),
                                {static_cast<py::ssize_t>(places.size()), 3});
    };
    const auto turns = [](const auto& all) {
        std::vector<glm::dquat> rotations;
        for (const humanoid::Placement& each : all) rotations.push_back(each.rotation());
        return to_array<double>(std::span<const glm::dquat>(rotations),
                                {static_cast<py::ssize_t>(rotations.size()), 4});
    };
    made_only_here(py::class_<Character>(root, "Character", help("Character")))
        .def_property_readonly(
            "file", [](const Character& self) { return self.loaded->file; }, help("Character.file"))
        .def_property_readonly(
            "joints", [](const Character& self) { return node_names(*self.loaded); },
            help("Character.joints"))
        .def_property_readonly(
            "parents", [](const Character& self) { return parents(*self.loaded); }, help("Character.parents"))
        .def_property_readonly(
            "rest_positions",
            [points](const Character& self) { return points(rest_placements(*self.loaded)); },
            help("Character.rest_positions"))
        .def_property_readonly(
            "rest_rotations", [turns](const Character& self) { return turns(rest_placements(*self.loaded)); },
            help("Character.rest_rotations"))
        .def_property_readonly(
            "bones", [](const Character& self) { return bones(*self.loaded); }, help("Character.bones"))
        .def_property_readonly(
            "missing", [](const Character& self) { return missing(*self.loaded); }, help("Character.missing"))
        .def_property_readonly(
            "scale", [](const Character& self) { return self.loaded->character.scale; },
            help("Character.scale"))
        .def_property_readonly(
            "notes",
            [](const Character& self) {
                return text(app::guesses_of(self.loaded->character, self.loaded->map));
            },
            help("Character.notes"))
        .def_property_readonly("clips", &clips, help("Character.clips"))
        .def("clip", &clip, py::arg("name") = "", help("Character.clip"))
        .def("__repr__", [](const Character& self) {
            const app::Character& of = self.loaded->character;
            return "<Character " + self.loaded->name() + ": " + app::count_text(of.skeleton.size(), "joint") +
                   ", " + app::count_text(of.clips.size(), "clip") + ">";
        });
    made_only_here(py::class_<Clip>(root, "Clip", help("Clip")))
        .def_property_readonly(
            "name", [](const Clip& self) { return text(self.clip->name); }, help("Clip.name"))
        .def_property_readonly(
            "character", [](const Clip& self) { return Character{self.of}; }, help("Clip.character"))
        .def_property_readonly(
            "duration", [](const Clip& self) { return self.clip->duration; }, help("Clip.duration"))
        .def_property_readonly(
            "rate", [](const Clip& self) { return humanoid::frame_rate(*self.clip); }, help("Clip.rate"))
        .def_property_readonly("frames", &frame_count, help("Clip.frames"))
        .def_property_readonly("notes", text_of(&Clip::notes), help("Clip.notes"))
        .def_property_readonly("positions", &positions, help("Clip.positions"))
        .def_property_readonly("rotations", &rotations, help("Clip.rotations"))
        .def_property_readonly("local_positions", &local_positions, help("Clip.local_positions"))
        .def_property_readonly("local_rotations", &local_rotations, help("Clip.local_rotations"))
        .def("with_poses", &with_poses, py::arg("local_rotations") = py::none(),
             py::arg("local_positions") = py::none(), help("Clip.with_poses"))
        .def("__repr__", [](const Clip& self) {
            return "<Clip " + app::printable(self.clip->name) + " of " + self.of->name() + ": " +
                   app::count_text(frame_count(self), "frame") + " at " +
                   app::short_text(humanoid::frame_rate(*self.clip), "") + " fps>";
        });
}

void bind_lint(py::module_& root) {
    bind_enum(root, "Fault", detail::type_name<humanoid::Fault>(), names_to(humanoid::Fault::Axis));
    bind<humanoid::LintSettings>(root, "LintSettings");
    const auto found = [](auto member) {
        return [member](const Finding& self) { return self.found.*member; };
    };
    using Found = humanoid::Finding;
    made_only_here(py::class_<Finding>(root, "Finding", help("Finding")))
        .def_property_readonly(
            "kind", [](const Finding& self) { return to_choice(self.found.fault); }, help("Finding.kind"))
        .def_property_readonly("frame", found(&Found::frame), help("Finding.frame"))
        .def_property_readonly("first_frame", found(&Found::first), help("Finding.first_frame"))
        .def_property_readonly("last_frame", found(&Found::last), help("Finding.last_frame"))
        .def_property_readonly("time", found(&Found::time), help("Finding.time"))
        .def_property_readonly(
            "joint",
            [](const Finding& self) -> py::object {
                if (self.found.node < 0) return py::none();
                return text(self.of->skeleton()[static_cast<std::size_t>(self.found.node)].name);
            },
            help("Finding.joint"))
        .def_property_readonly("amount", found(&Found::amount), help("Finding.amount"))
        .def_property_readonly(
            "unit", [](const Finding& self) { return std::string(self.found.unit); }, help("Finding.unit"))
        .def_property_readonly(
            "text", [](const Finding& self) { return text(self.found.text); }, help("Finding.text"))
        .def_property_readonly("has_cure", found(&Found::has_cure), help("Finding.has_cure"))
        .def("__repr__", [](const Finding& self) {
            return std::string("<Finding ") + humanoid::name(self.found.fault) + ": " +
                   app::printable(self.found.text) + ">";
        });
    made_only_here(py::class_<LintReport>(root, "LintReport", help("LintReport")))
        .def_property_readonly(
            "rate", [](const LintReport& self) { return self.report.rate; }, help("LintReport.rate"))
        .def_property_readonly(
            "frames", [](const LintReport& self) { return self.report.frames; }, help("LintReport.frames"))
        .def_property_readonly(
            "floor",
            [](const LintReport& self) {
                return self.report.has_floor ? std::optional(self.report.floor) : std::nullopt;
            },
            help("LintReport.floor"))
        .def_property_readonly(
            "skating", [](const LintReport& self) { return self.report.skating; }, help("LintReport.skating"))
        .def_property_readonly(
            "findings", [](const LintReport& self) { return self.findings; }, help("LintReport.findings"))
        .def("__repr__", [](const LintReport& self) {
            return "<LintReport: " + app::count_text(self.findings.size(), "finding") + " in " +
                   app::count_text(self.report.frames, "frame") + ">";
        });
    root.def("lint", &lint, py::arg("clip"), py::kw_only(), py::arg("settings") = py::none(),
             py::arg("ground") = py::none(), help("lint"));
    root.def("cure", &cure, py::arg("clip"), py::arg("finding"), py::kw_only(),
             py::arg("settings") = py::none(), py::arg("ground") = py::none(), help("cure"));
}

}  // namespace

void bind_humanoid(py::module_& root) {
    bind_ground(root);
    bind_character(root);
    bind_lint(root);
    root.def("load_character", &load_character, py::arg("path"), py::kw_only(),
             py::arg("progress") = py::none(), help("load_character"));
    root.def("plant_feet", &plant_feet, py::arg("clip"), py::arg("ground") = py::none(), py::kw_only(),
             py::arg("rate") = py::none(), help("plant_feet"));
    root.def("travel", &travel, py::arg("clip"), py::kw_only(), py::arg("rate") = py::none(), help("travel"));
    root.def("retarget", &retarget, py::arg("clip"), py::arg("to"), help("retarget"));
    using Report = app::ExportReport;
    made_only_here(py::class_<Report>(root, "SaveReport", help("SaveReport")))
        .def_readonly("frames", &Report::frames, help("SaveReport.frames"))
        .def_readonly("worst", &Report::worst, help("SaveReport.worst"))
        .def_property_readonly("worst_joint", text_of(&Report::worst_joint), help("SaveReport.worst_joint"))
        .def_readonly("skating_before", &Report::skating_before, help("SaveReport.skating_before"))
        .def_readonly("skating_after", &Report::skating_after, help("SaveReport.skating_after"))
        .def_property_readonly("new_findings", text_of(&Report::new_findings),
                               help("SaveReport.new_findings"))
        .def_property_readonly(
            "text", [](const Report& self) { return text(self.text()); }, help("SaveReport.text"))
        .def("__repr__",
             [](const Report& self) { return "<SaveReport: " + app::printable(self.text()) + ">"; });
    root.def("save_clip", &save_clip, py::arg("path"), py::arg("clip"), py::kw_only(),
             py::arg("original") = py::none(), py::arg("rate") = py::none(), py::arg("ground") = py::none(),
             help("save_clip"));
}

}  // namespace tendril::python
