// Many chains at once: Batch and solve_many.
#include "tendril/ik/many.hpp"

#include "arrays.hpp"
#include "rooms.hpp"

namespace tendril::python {

namespace {

using Floats = Array<float>;

/// Reports of a batch, shown as arrays that lie in the reports themselves.
struct ManyReport : Zeroed {
    bool made = true;
    std::vector<ik::ManyReport> all;
    ik::ManySummary summary;

    void check() const {
        if (!made) throw py::type_error("the ManyReport was made without its constructor");
    }
    template <class Member>
    static py::array view(const py::object& self, Member ik::ManyReport::*member) {
        const auto& reports = self.cast<const ManyReport&>();
        reports.check();
        const auto count = static_cast<py::ssize_t>(reports.all.size());
        if (count == 0) return py::array(py::dtype::of<Member>(), std::vector<py::ssize_t>{0});
        py::array shown(py::dtype::of<Member>(), {count}, {static_cast<py::ssize_t>(sizeof(ik::ManyReport))},
                        &(reports.all[0].*member), self);
        shown.attr("setflags")(py::arg("write") = false);
        return shown;
    }
};
static_assert(sizeof(ik::Status) == 1, "shown as uint8");

py::array statuses(const py::object& self) {
    const auto& reports = self.cast<const ManyReport&>();
    reports.check();
    const auto count = static_cast<py::ssize_t>(reports.all.size());
    if (count == 0) return py::array(py::dtype::of<std::uint8_t>(), std::vector<py::ssize_t>{0});
    py::array shown(py::dtype::of<std::uint8_t>(), {count},
                    {static_cast<py::ssize_t>(sizeof(ik::ManyReport))},
                    reinterpret_cast<const std::uint8_t*>(&reports.all[0].status), self);
    shown.attr("setflags")(py::arg("write") = false);
    return shown;
}

struct Batch : Zeroed {
    bool busy = false;
    std::unique_ptr<ik::Batch> batch;
    bool limited = false;

    Batch(const py::object& given, const py::object& chains, int threads, const py::object& limits,
          const py::object& rest_directions) {
        const py::array any = numbers(given, "Batch: lengths");
        const bool each = any.ndim() == 2;
        if (!each) expect_shape(any, {{-1, "bones"}}, "Batch: lengths");
        const Floats lengths(any);
        std::size_t count = 0;
        if (!chains.is_none())
            count = chains.cast<std::size_t>();
        else if (each)
            count = static_cast<std::size_t>(lengths.shape(0));
        else
            throw py::type_error("Batch: chains must be given with lengths of shape (bones,)");
        if (each && count != static_cast<std::size_t>(lengths.shape(0)))
            throw py::value_error("Batch: lengths of " + std::to_string(lengths.shape(0)) +
                                  " chains, but chains is " + std::to_string(count));
        const auto bones = static_cast<std::size_t>(lengths.shape(each ? 1 : 0));
        Expected<ik::Batch> made = ik::Batch::make(count, bones, threads);
        batch = std::make_unique<ik::Batch>(value_or_throw(made));
        const std::span<const float> all(lengths.data(), static_cast<std::size_t>(lengths.size()));
        if (!each) throw_if(batch->set_lengths(all));
        for (std::size_t i = 0; each && i < count; ++i)
            throw_if(batch->set_lengths(i, all.subspan(i * bones, bones)));
        std::vector<ik::Limit> every;
        for (const py::handle one : limits) every.push_back(*value<ik::Limit>(one, "Batch: limits"));
        limited = !every.empty();
        if (!limited) return;
        Floats rest;
        if (!rest_directions.is_none())
            rest = array<float>(rest_directions, {{static_cast<py::ssize_t>(bones)}, {3}},
                                "Batch: rest_directions");
        throw_if(batch->set_limits(every, elements<glm::vec3>(rest)));
    }
    ik::Batch& checked() const {
        if (!batch) throw py::type_error("the Batch was made without its constructor");
        return *batch;
    }
    py::ssize_t chains() const { return static_cast<py::ssize_t>(checked().size()); }
    py::ssize_t bones() const { return static_cast<py::ssize_t>(checked().bones()); }
};

py::tuple solve(Batch& self, const py::object& joints, const py::object& targets,
                const py::object& options_given, const py::object& out, const py::kwargs& arguments) {
    self.checked();
    const Busy busy(self.busy, "the Batch");
    const auto options = python::options<ik::ManyOptions>(options_given, arguments, "solve_many");
    const Axis chains{self.chains()}, three{3};
    const auto given = array<float>(joints, {chains, {self.bones() + 1}, three}, "solve_many: joints");
    const auto to = array<float>(targets, {chains, three}, "solve_many: targets");
    Floats moved = copy(given, out, {chains, {self.bones() + 1}, three}, "solve_many: out");
    auto report = std::make_unique<ManyReport>();
    report->all.resize(self.batch->size());
    {
        const std::span<glm::vec3> all = mutable_elements<glm::vec3>(moved);
        const std::span<const glm::vec3> ends = elements<glm::vec3>(to);
        const py::gil_scoped_release released;
        report->summary = ik::solve_many(*self.batch, all, ends, report->all, *options);
    }
    // A chain that is refused keeps its pose and says so in the report; only if all are, the call is wrong.
    if (report->summary.invalid == report->all.size()) throw_if(report->summary.accepted);
    return py::make_tuple(out.is_none() ? py::object(moved) : out, std::move(report));
}

py::tuple solve_many(const py::object& lengths, const py::object& joints, const py::object& targets,
                     int threads, const py::object& limits, const py::object& rest_directions,
                     const py::object& options, const py::object& out, const py::kwargs& arguments) {
    const py::array all = numbers(joints, "solve_many: joints");
    expect_shape(all, {{-1, "chains"}, {-1, "bones + 1"}, {3}}, "solve_many: joints");
    Batch batch(lengths, py::int_(all.shape(0)), threads, limits, rest_directions);
    return solve(batch, joints, targets, options, out, arguments);
}

}  // namespace

void bind_many(py::module_& root) {
    bind<ik::ManyOptions>(root, "ManyOptions");

    py::class_<ManyReport>(root, "ManyReport", help("ManyReport"))
        .def_property_readonly("status", &statuses, help("ManyReport.status"))
        .def_property_readonly(
            "converged",
            [](const py::object& self) {
                return statuses(self).attr("__eq__")(static_cast<int>(ik::Status::Converged));
            },
            help("ManyReport.converged"))
        .def_property_readonly(
            "iterations",
            [](const py::object& self) { return ManyReport::view(self, &ik::ManyReport::iterations); },
            help("ManyReport.iterations"))
        .def_property_readonly(
            "residual",
            [](const py::object& self) { return ManyReport::view(self, &ik::ManyReport::residual); },
            help("ManyReport.residual"))
        .def_property_readonly(
            "scalar_fallback",
            [](const py::object& self) { return ManyReport::view(self, &ik::ManyReport::scalar_fallback); },
            help("ManyReport.scalar_fallback"))
        .def_property_readonly(
            "invalid", [](const ManyReport& self) { return self.check(), self.summary.invalid; },
            help("ManyReport.invalid"))
        .def("__len__", [](const ManyReport& self) { return self.all.size(); })
        .def("__repr__", [](const ManyReport& self) {
            self.check();
            std::size_t converged = 0;
            for (const ik::ManyReport& each : self.all) converged += each.status == ik::Status::Converged;
            return "<ManyReport: " + std::to_string(converged) + " of " + std::to_string(self.all.size()) +
                   " chains converged, " + std::to_string(self.summary.invalid) + " refused>";
        });

    py::class_<Batch>(root, "Batch", help("Batch"))
        .def(py::init<py::object, py::object, int, py::object, py::object>(), py::arg("lengths"),
             py::arg("chains") = py::none(), py::kw_only(), py::arg("threads") = 1,
             py::arg("limits") = py::tuple(), py::arg("rest_directions") = py::none(), help("Batch.__init__"))
        .def_property_readonly("chains", &Batch::chains, help("Batch.chains"))
        .def_property_readonly("bones", &Batch::bones, help("Batch.bones"))
        .def_property(
            "rotations",
            [](const Batch& self) {
                self.checked();
                std::vector<glm::quat> all(self.limited ? self.batch->size() * self.batch->bones() : 0);
                throw_if(self.batch->copy_rotations(all));
                return to_array<float>(std::span<const glm::quat>(all), {self.chains(), self.bones(), 4});
            },
            [](Batch& self, const py::object& given) {
                const auto all =
                    array<float>(given, {{self.chains()}, {self.bones()}, {4}}, "Batch: rotations");
                throw_if(self.batch->set_rotations(elements<glm::quat>(all)));
            },
            help("Batch.rotations"))
        .def("solve", &solve, py::arg("joints"), py::arg("targets"), py::kw_only(),
             py::arg("options") = py::none(), py::arg("out") = py::none(), help("Batch.solve"))
        .def("__repr__", [](const Batch& self) {
            return "<Batch of " + std::to_string(self.chains()) + " chains of " +
                   std::to_string(self.bones()) + (self.bones() == 1 ? " bone>" : " bones>");
        });
    root.def("solve_many", &solve_many, py::arg("lengths"), py::arg("joints"), py::arg("targets"),
             py::kw_only(), py::arg("threads") = 1, py::arg("limits") = py::tuple(),
             py::arg("rest_directions") = py::none(), py::arg("options") = py::none(),
             py::arg("out") = py::none(), help("solve_many"));
}

}  // namespace tendril::python
