// Links joined into closed loops: tendril.linkage.
#include "tendril/ik/linkage.hpp"

#include <pybind11/stl.h>

#include <limits>
#include <map>

#include "arrays.hpp"
#include "rooms.hpp"
#include "tendril/ik/mechanisms.hpp"

namespace tendril::python {

namespace {

using Drivers = std::map<std::string, double>;

struct Solver : Zeroed {
    bool busy = false;
    std::unique_ptr<ik::LinkageSolver> solver;
    ik::LinkageState state;

    explicit Solver(const py::object& linkage) {
        Expected<ik::LinkageSolver> made =
            ik::LinkageSolver::make(*value<ik::Linkage>(linkage, "Solver: linkage"));
        solver = std::make_unique<ik::LinkageSolver>(value_or_throw(made));
        state = solver->initial_state();
        throw_if(solver->place(state));
    }
    /// Nothing reads a linkage that another thread moves.
    ik::LinkageSolver& free() {
        if (!solver) throw py::type_error("the Solver was made without its constructor");
        const Busy asked(busy, "the Solver");
        return *solver;
    }
    std::size_t link(const std::string& name) {
        return found(free().linkage().find_link(name), "link", name);
    }
    std::size_t point(const std::string& name) {
        return found(free().linkage().find_point(name), "point", name);
    }
    std::vector<ik::LinkDriver> drivers(const Drivers& given) {
        std::vector<ik::LinkDriver> all;
        for (const auto& [name, to] : given) all.push_back({link(name), to});
        return all;
    }

  private:
    static std::size_t found(const std::optional<std::size_t>& at, const char* kind,
                             const std::string& name) {
        if (!at) throw py::key_error(std::string("the linkage has no ") + kind + " " + name);
        return *at;
    }
};

py::object solve(Solver& self, const Drivers& drivers, const std::map<std::string, py::object>& targets,
                 const py::object& given, const py::kwargs& members) {
    ik::LinkageSolver& solver = self.free();
    const auto options = python::options<ik::LinkageOptions>(given, members, "solve");
    const std::vector<ik::LinkDriver> driven = self.drivers(drivers);
    std::vector<ik::LinkTarget> pulled;
    for (const auto& [name, to] : targets)
        pulled.push_back({.point = self.point(name), .to = exact_point(to, "solve: targets")});
    const Busy busy(self.busy, "the Solver");
    ik::LinkageReport report;
    {
        const py::gil_scoped_release released;
        report = solver.solve(self.state, {.drivers = driven, .targets = pulled}, *options);
    }
    throw_if(report.accepted);
    return to_python(report);
}

Array<double> path(Solver& self, const std::string& point, const std::string& driver,
                   const py::object& values) {
    ik::LinkageSolver& solver = self.free();
    const std::size_t traced = self.point(point);
    ik::LinkDriver drive{self.link(driver), 0.0};
    const auto given = array<double>(values, {{-1, "values"}}, "path: values");
    Array<double> made({given.size(), py::ssize_t{3}});
    const std::span<glm::dvec3> places = mutable_elements<glm::dvec3>(made);
    const Busy busy(self.busy, "the Solver");
    Result accepted;
    {
        const py::gil_scoped_release released;
        for (std::size_t i = 0; i < places.size() && accepted; ++i) {
            drive.value = given.data()[i];
            const ik::LinkageReport report = solver.solve(self.state, {.drivers = {&drive, 1}});
            accepted = report.accepted;
            places[i] = report.status == ik::LinkageStatus::Reached
                            ? solver.point(traced)
                            : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
        }
    }
    throw_if(accepted);
    return made;
}

Array<double> positions(Solver& self) {
    const ik::LinkageSolver& solver = self.free();
    std::vector<glm::dvec3> places(solver.linkage().points.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = solver.point(i);
    return to_array<double>(std::span<const glm::dvec3>(places),
                            {static_cast<py::ssize_t>(places.size()), 3});
}

void other_mode(Solver& self, const Drivers& drivers, bool nearest) {
    ik::LinkageSolver& solver = self.free();
    const std::vector<ik::LinkDriver> driven = self.drivers(drivers);
    const Busy busy(self.busy, "the Solver");
    Result switched;
    {
        const py::gil_scoped_release released;
        switched =
            solver.other_mode(self.state, driven, nearest ? ik::OtherMode::Nearest : ik::OtherMode::Next);
    }
    throw_if(switched);
}

/// A function that draws the mechanism of these lengths, as a Linkage.
template <class Lengths>
void bind_mechanism(py::module_& linkage, const char* name, auto make) {
    linkage.def(
        name,
        [make, name](const py::object& lengths, const py::kwargs& members) {
            auto made = make(*options<Lengths>(lengths, members, name));
            Expected<ik::Linkage> drawn = linkage_from(value_or_throw(made));
            return to_python(value_or_throw(drawn));
        },
        py::arg("lengths") = py::none(), help((std::string("linkage.") + name).c_str()));
}

}  // namespace

void bind_linkage(py::module_& root) {
    py::module_ linkage = root.def_submodule("linkage", help("linkage"));
    linkage.attr("__name__") = "tendril.linkage";
    bind<ik::Link>(linkage, "Link");
    bind<ik::LinkPoint>(linkage, "Point");
    bind<ik::Closure>(linkage, "Closure");
    bind<ik::Linkage>(linkage, "Linkage");
    bind<ik::JointPlace>(linkage, "JointPlace");
    bind<ik::LinkageState>(linkage, "State");
    bind<ik::LinkageOptions>(linkage, "Options");
    bind<ik::LinkageReport>(linkage, "Report");
    bind<ik::LinkageFreedom>(linkage, "Freedom");
    bind<ik::FourBar>(linkage, "FourBar");
    bind<ik::SliderCrank>(linkage, "SliderCrank");
    bind<ik::Jansen>(linkage, "Jansen");
    bind_mechanism<ik::FourBar>(linkage, "four_bar", ik::four_bar);
    bind_mechanism<ik::SliderCrank>(linkage, "slider_crank", ik::slider_crank);
    bind_mechanism<ik::Jansen>(linkage, "jansen", ik::jansen);

    py::class_<Solver>(linkage, "Solver", help("linkage.Solver"))
        .def(py::init<py::object>(), py::arg("linkage"), help("linkage.Solver.__init__"))
        .def_property(
            "state", [](Solver& self) { return self.free(), to_python(self.state); },
            [](Solver& self, const py::object& given) {
                const auto state = value<ik::LinkageState>(given, "Solver: state");
                throw_if(self.free().place(*state));
                self.state = *state;
            },
            help("linkage.Solver.state"))
        .def("solve", &solve, py::arg("drivers") = Drivers(), py::kw_only(),
             py::arg("targets") = std::map<std::string, py::object>(), py::arg("options") = py::none(),
             help("linkage.Solver.solve"))
        .def("path", &path, py::arg("point"), py::arg("driver"), py::arg("values"),
             help("linkage.Solver.path"))
        .def("positions", &positions, help("linkage.Solver.positions"))
        .def("other_mode", &other_mode, py::arg("drivers") = Drivers(), py::kw_only(),
             py::arg("nearest") = false, help("linkage.Solver.other_mode"))
        .def_property_readonly(
            "freedom", [](Solver& self) { return to_python(self.free().freedom(self.state)); },
            help("linkage.Solver.freedom"))
        .def("__repr__", [](Solver& self) {
            const ik::Linkage& of = self.free().linkage();
            return "<Solver of " + std::to_string(of.links.size()) + " links, " +
                   std::to_string(of.closures.size()) + " closures>";
        });
}

}  // namespace tendril::python
