// The log of somebody's solver, explained: as `tendril trace` does (app/io/trace).
#include "app/io/trace/trace.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <fstream>

#include "app/io/text.hpp"
#include "arrays.hpp"
#include "files.hpp"
#include "help.hpp"
#include "rooms.hpp"

namespace tendril::python {

namespace {

namespace fs = std::filesystem;

/// A vector per frame; NaN where there is none.
using Points = std::vector<glm::vec3>;

struct Incident {
    app::TracedIncident found;
    std::string chain, text;
    std::vector<std::string> prevented_by;
};

struct TraceChain {
    std::string name;
    std::size_t joints = 0, end_effector = 0;
    Points positions, targets, poles;
    std::uint64_t left_off = 0;
};

struct Trace {
    fs::path file;
    double fps = 0.0;
    bool fps_known = false;
    std::string conventions;
    std::vector<std::string> bones, notes;
    std::vector<std::shared_ptr<TraceChain>> chains;
    std::vector<Incident> incidents;

    TraceChain* chain(std::string_view name) {
        const auto found =
            std::ranges::find(chains, name, [](const auto& each) { return std::string_view(each->name); });
        return found == chains.end() ? nullptr : found->get();
    }
};

constexpr glm::vec3 nowhere(std::numeric_limits<float>::quiet_NaN());

void add_frame(Trace& trace, const app::TracedFrame& frame) {
    TraceChain* chain = trace.chain(frame.chain);
    if (chain == nullptr) {
        chain = trace.chains.emplace_back(std::make_shared<TraceChain>()).get();
        chain->name = frame.chain, chain->joints = frame.joints.size(),
        chain->end_effector = frame.end_effector();
    }
    chain->positions.insert(chain->positions.end(), frame.joints.begin(), frame.joints.end());
    chain->targets.push_back(frame.target.value_or(nowhere));
    chain->poles.push_back(frame.pole.value_or(nowhere));
}

Trace read_trace(const fs::path& file, const app::ConventionChoice& choice,
                 const std::optional<double>& fps) {
    const std::string name = file.filename().string();
    if (!fs::is_regular_file(file)) throw std::runtime_error(name + " is not a file");
    const auto opened = [&](std::ifstream& in) -> std::ifstream& {
        in.open(file, std::ios::binary);
        if (!in) throw std::runtime_error("cannot be opened");
        return in;
    };
    try {
        Trace trace;
        trace.file = file;
        std::ifstream in, again;
        app::TraceReader frames(opened(in), choice, fps), reader(opened(again), choice, fps);
        for (app::TracedFrame frame; frames.next(frame);) add_frame(trace, frame);
        const app::TraceFindings findings = app::find_incidents(reader);
        trace.fps = reader.fps(), trace.fps_known = reader.fps_known();
        trace.conventions = reader.conventions().text();
        trace.bones = reader.header().bones, trace.notes = reader.notes();
        for (const auto& chain : findings.chains) {
            if (TraceChain* const of = trace.chain(chain.name)) of->left_off = chain.left_off;
            for (const app::TracedIncident& each : chain.incidents) {
                Incident incident{each, chain.name, each.text(trace.bones, reader.conventions()), {}};
                for (const app::Prevention& change : each.prevented.by)
                    incident.prevented_by.push_back(change.text(reader.conventions()));
                trace.incidents.push_back(std::move(incident));
            }
        }
        return trace;
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

Trace load_trace(const fs::path& file, const std::optional<double>& fps, const std::string& up,
                 const std::string& handed, const std::string& unit, const std::string& rotations,
                 const std::optional<std::size_t>& target_joint) {
    if (fps && !(*fps >= 0.001 && *fps <= 1e6))
        throw py::value_error("load_trace: fps must be 0.001 to 1000000, got " + std::to_string(*fps));
    return from_file(file, [&] {
        return read_trace(file, {up, handed, unit, rotations, target_joint}, fps);
    });
}

Array<float> per_frame(const Points& points) {
    return to_array<float>(std::span<const glm::vec3>(points), {static_cast<py::ssize_t>(points.size()), 3});
}

}  // namespace

void bind_trace(py::module_& root) {
    bind_enum(root, "IncidentKind", detail::type_name<ik::IncidentKind>(),
              names_to(ik::IncidentKind::Misplaced));
    made_only_here(py::class_<Incident>(root, "Incident", help("Incident")))
        .def_property_readonly(
            "kind", [](const Incident& self) { return to_choice(self.found.kind); }, help("Incident.kind"))
        .def_property_readonly("chain", text_of(&Incident::chain), help("Incident.chain"))
        .def_property_readonly(
            "frame", [](const Incident& self) { return self.found.frame; }, help("Incident.frame"))
        .def_property_readonly(
            "last_frame", [](const Incident& self) { return self.found.last_frame; },
            help("Incident.last_frame"))
        .def_property_readonly(
            "joint",
            [](const Incident& self) {
                return self.found.joint == ik::no_joint ? std::nullopt : std::optional(self.found.joint);
            },
            help("Incident.joint"))
        .def_property_readonly(
            "amount", [](const Incident& self) { return self.found.amount; }, help("Incident.amount"))
        .def_property_readonly(
            "unit", [](const Incident& self) { return std::string(ik::unit(self.found.kind)); },
            help("Incident.unit"))
        .def_property_readonly(
            "hertz", [](const Incident& self) { return self.found.hertz; }, help("Incident.hertz"))
        .def_property_readonly(
            "cause", [](const Incident& self) { return text(self.found.cause); }, help("Incident.cause"))
        .def_property_readonly("text", text_of(&Incident::text), help("Incident.text"))
        .def_property_readonly(
            "flips_in",
            [](const Incident& self) -> py::object {
                if (!self.found.prevented.flips_in) return py::none();
                return to_choice(*self.found.prevented.flips_in);
            },
            help("Incident.flips_in"))
        .def_property_readonly("prevented_by", text_of(&Incident::prevented_by),
                               help("Incident.prevented_by"))
        .def("__repr__", [](const Incident& self) { return "<Incident " + app::printable(self.text) + ">"; });
    made_only_here(
        py::class_<TraceChain, std::shared_ptr<TraceChain>>(root, "TraceChain", help("TraceChain")))
        .def_property_readonly("name", text_of(&TraceChain::name), help("TraceChain.name"))
        .def_property_readonly(
            "frames", [](const TraceChain& self) { return self.targets.size(); }, help("TraceChain.frames"))
        .def_property_readonly(
            "joints",
            [](const TraceChain& self) {
                return to_array<float>(std::span<const glm::vec3>(self.positions),
                                       {static_cast<py::ssize_t>(self.targets.size()),
                                        static_cast<py::ssize_t>(self.joints), 3});
            },
            help("TraceChain.joints"))
        .def_property_readonly(
            "targets", [](const TraceChain& self) { return per_frame(self.targets); },
            help("TraceChain.targets"))
        .def_property_readonly(
            "poles", [](const TraceChain& self) { return per_frame(self.poles); }, help("TraceChain.poles"))
        .def_readonly("end_effector", &TraceChain::end_effector, help("TraceChain.end_effector"))
        .def_readonly("left_off", &TraceChain::left_off, help("TraceChain.left_off"))
        .def("__repr__", [](const TraceChain& self) {
            return "<TraceChain " + app::printable(self.name) + ": " +
                   app::count_text(self.targets.size(), "frame") + " of " +
                   app::count_text(self.joints, "joint") + ">";
        });
    made_only_here(py::class_<Trace>(root, "Trace", help("Trace")))
        .def_property_readonly(
            "file", [](const Trace& self) { return self.file; }, help("Trace.file"))
        .def_readonly("fps", &Trace::fps, help("Trace.fps"))
        .def_readonly("fps_known", &Trace::fps_known, help("Trace.fps_known"))
        .def_property_readonly("conventions", text_of(&Trace::conventions), help("Trace.conventions"))
        .def_property_readonly("bones", text_of(&Trace::bones), help("Trace.bones"))
        .def_property_readonly("notes", text_of(&Trace::notes), help("Trace.notes"))
        .def_readonly("chains", &Trace::chains, help("Trace.chains"))
        .def_readonly("incidents", &Trace::incidents, help("Trace.incidents"))
        .def("__repr__", [](const Trace& self) {
            return "<Trace " + app::printable(self.file.filename().string()) + ": " +
                   app::count_text(self.chains.size(), "chain") + ", " +
                   app::count_text(self.incidents.size(), "incident") + ">";
        });
    root.def("load_trace", &load_trace, py::arg("path"), py::kw_only(), py::arg("fps") = py::none(),
             py::arg("up") = "", py::arg("handed") = "", py::arg("unit") = "", py::arg("rotations") = "",
             py::arg("target_joint") = py::none(), help("load_trace"));
}

}  // namespace tendril::python
