// Chains that reach: Solver, State, two bones.
#include "tendril/ik/solver.hpp"

#include "arrays.hpp"
#include "rooms.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::python {

namespace {

/// The state of a chain. Only the interpreter's lock guards it, so a solve works on a copy.
struct State : Zeroed {
    bool made;
    ik::State value;
    explicit State(ik::State from) : made(true), value(std::move(from)) {}
    const ik::State& checked() const {
        if (!made) throw py::type_error("the State was made without its constructor");
        return value;
    }
};

struct Solver : Zeroed {
    bool busy = false;
    std::unique_ptr<ik::Solver> solver;
    std::vector<float> lengths;
    std::vector<glm::vec3> rest_directions;

    Solver(const py::object& given_lengths, const py::object& directions) {
        const auto all = array<float>(given_lengths, {{-1, "bones"}}, "Solver: lengths");
        lengths.assign(all.data(), all.data() + all.size());
        if (!directions.is_none()) {
            const auto rest = array<float>(directions, {{all.size()}, {3}}, "Solver: rest_directions");
            const auto span = elements<glm::vec3>(rest);
            rest_directions.assign(span.begin(), span.end());
        }
        Expected<ik::Solver> made = ik::Solver::make(lengths, rest_directions);
        solver = std::make_unique<ik::Solver>(value_or_throw(made));
    }
    ik::Solver& checked() const {
        if (!solver) throw py::type_error("the Solver was made without its constructor");
        return *solver;
    }
    py::ssize_t joints() const { return static_cast<py::ssize_t>(checked().bones()) + 1; }
};

/// A copy of the given state, or a fresh one.
ik::State state_for(const Solver& self, const py::object& given) {
    if (given.is_none()) return self.solver->initial_state();
    if (!py::isinstance<State>(given)) throw py::type_error("solve: state must be a State");
    return given.cast<const State&>().checked();
}

py::tuple solve(Solver& self, const py::object& joints, const py::object& target, const py::object& method,
                const py::object& state, const py::object& options_given, const py::object& out,
                const py::kwargs& arguments) {
    const py::ssize_t count = self.joints();
    const Busy busy(self.busy, "the Solver");
    const auto options = python::options<ik::Options>(options_given, arguments, "solve");
    const auto chosen = choice_of<ik::Method>(method, "solve: method");
    const glm::vec3 to = point(target, "solve: target");
    const auto given = array<float>(joints, {{count}, {3}}, "solve: joints");
    std::vector<glm::vec3> moved(elements<glm::vec3>(given).begin(), elements<glm::vec3>(given).end());
    ik::State next = state_for(self, state);
    ik::Report report;
    {
        const py::gil_scoped_release released;
        report = self.solver->solve(chosen, moved, next, to, *options);
    }
    throw_if(report.accepted);
    auto result = copy(to_array<float>(std::span<const glm::vec3>(moved), {count, 3}), out, {{count}, {3}},
                       "solve: out");
    if (!state.is_none()) state.cast<State&>().value = std::move(next);
    return py::make_tuple(out.is_none() ? py::object(result) : out, to_python(report));
}

py::object explain(Solver& self, const py::object& joints, const py::object& target, const py::object& state,
                   const py::object& options_given, const py::kwargs& arguments) {
    const py::ssize_t count = self.joints();
    const Busy busy(self.busy, "the Solver");
    const auto options = python::options<ik::Options>(options_given, arguments, "explain");
    const glm::vec3 to = point(target, "explain: target");
    const auto given = array<float>(joints, {{count}, {3}}, "explain: joints");
    std::vector<glm::vec3> pose(elements<glm::vec3>(given).begin(), elements<glm::vec3>(given).end());
    ik::State before = state_for(self, state);
    std::optional<ik::ActiveLimit> active;
    Result refused;
    {
        const py::gil_scoped_release released;
        active = self.solver->explain(pose, before, to, *options);
        // None is also the answer to bad input, which a solve names.
        if (!active) refused = self.solver->solve(ik::Method::Fabrik, pose, before, to, *options).accepted;
    }
    throw_if(refused);
    return active ? to_python(*active) : py::none();
}

Array<float> rest_joints(const Solver& self, const py::object& root) {
    const py::ssize_t count = self.joints();
    Array<float> joints({count, py::ssize_t{3}});
    const auto all = mutable_elements<glm::vec3>(joints);
    all[0] = root.is_none() ? glm::vec3(0.0f) : point(root, "rest_joints: root");
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        const glm::vec3 along =
            self.rest_directions.empty() ? glm::vec3(1.0f, 0.0f, 0.0f) : self.rest_directions[i];
        all[i + 1] = all[i] + self.lengths[i] * along;
    }
    return joints;
}

Array<float> quaternions(std::span<const glm::quat> all) {
    return to_array<float>(all, {static_cast<py::ssize_t>(all.size()), 4});
}

py::tuple state_values(const State& self) {
    const ik::State& state = self.checked();
    // Their tables leave out whether they are valid.
    return py::make_tuple(quaternions(state.rotations), state.pole.valid, to_python(state.pole),
                          state.limits.valid, to_python(state.limits), to_choice(state.side));
}

State state_from(const py::tuple& values) {
    ik::State state;
    const auto turns = array<float>(values[0], {{-1, "bones"}, {4}}, "State: rotations");
    state.rotations.assign(elements<glm::quat>(turns).begin(), elements<glm::quat>(turns).end());
    state.pole = *value<ik::PoleMemory>(values[2], "State: pole");
    state.pole.valid = values[1].cast<bool>();
    state.limits = *value<ik::LimitMemory>(values[4], "State: limits");
    state.limits.valid = values[3].cast<bool>();
    state.side = choice_of<ik::Side>(values[5], "State: side");
    throw_if(ik::check(state, state.bones()));
    return State(std::move(state));
}

py::object two_bone(const py::object& root, const py::object& mid, const py::object& tip,
                    const py::object& target, const py::object& lengths, const py::object& options_given,
                    const py::kwargs& arguments) {
    const auto options = python::options<ik::TwoBoneOptions>(options_given, arguments, "two_bone");
    ik::TwoBone limb;
    limb.root = point(root, "two_bone: root"), limb.mid = point(mid, "two_bone: mid");
    limb.tip = point(tip, "two_bone: tip");
    const auto both = array<float>(lengths, {{2}}, "two_bone: lengths");
    limb.upper = both.at(0), limb.lower = both.at(1);
    const ik::TwoBoneResult result = ik::two_bone(limb, point(target, "two_bone: target"), *options);
    throw_if(result.accepted);
    return to_python(result);
}

}  // namespace

void bind_ik(py::module_& root) {
    std::vector<const char*> methods;
    for (const ik::Method each : ik::all_methods) methods.push_back(ik::name(each));
    bind_enum(root, "Method", detail::type_name<ik::Method>(), methods);
    bind<ik::Limit>(root, "Limit");
    bind<ik::AngleLimit>(root, "AngleLimit");
    bind<ik::Plane>(root, "Plane", {span_of<&ik::Plane::limits>("limits")});
    bind<ik::Options>(root, "Options", {span_of<&ik::Options::limits>("limits")});
    bind<ik::Report>(root, "Report");
    bind<ik::ActiveLimit>(root, "ActiveLimit");
    bind<ik::PoleMemory>(root, "PoleMemory");
    bind<ik::LimitMemory>(root, "LimitMemory");
    bind<ik::TwoBoneOptions>(root, "TwoBoneOptions");
    bind<ik::TwoBoneResult>(root, "TwoBoneResult");

    root.attr("Limit").attr("of") =
        py::module_::import("builtins")
            .attr("staticmethod")(py::cpp_function(
                [](const py::object& kind) {
                    return to_python(ik::Limit::of(choice_of<ik::JointKind>(kind, "Limit.of: kind")));
                },
                py::name("of"), py::arg("kind"), help("Limit.of")));
    root.attr("Limit").attr("hinge") =
        py::module_::import("builtins")
            .attr("staticmethod")(py::cpp_function(
                [](const py::object& axis, float min, float max) {
                    return to_python(ik::Limit::hinge(point(axis, "Limit.hinge: axis"), min, max));
                },
                py::name("hinge"), py::arg("axis"), py::arg("min"), py::arg("max"), help("Limit.hinge")));

    py::class_<State>(root, "State", help("State"))
        .def(py::init([](std::size_t bones) {
                 constexpr std::size_t most = 1'000'000;  // a chain's
                 if (bones > most) throw py::value_error("State: bones must be 0 to 1000000");
                 return std::make_unique<State>(ik::State(bones));
             }),
             py::arg("bones"), help("State.__init__"))
        .def_property_readonly(
            "bones", [](const State& self) { return self.checked().bones(); }, help("State.bones"))
        .def_property_readonly(
            "rotations", [](const State& self) { return quaternions(self.checked().rotations); },
            help("State.rotations"))
        .def_property_readonly(
            "local_rotations",
            [](const State& self) {
                std::vector<glm::quat> local(self.checked().bones());
                throw_if(ik::local_rotations(self.value, local));
                return quaternions(local);
            },
            help("State.local_rotations"))
        .def_property_readonly(
            "pole", [](const State& self) { return to_python(self.checked().pole); }, help("State.pole"))
        .def_property_readonly(
            "limits", [](const State& self) { return to_python(self.checked().limits); },
            help("State.limits"))
        .def_property_readonly(
            "side", [](const State& self) { return to_choice(self.checked().side); }, help("State.side"))
        .def(
            "reset", [](State& self) { self.checked(), self.value.reset(); }, help("State.reset"))
        .def(
            "copy", [](const State& self) { return State(self.checked()); }, help("State.copy"))
        .def("__copy__", [](const State& self) { return State(self.checked()); })
        .def("__deepcopy__", [](const State& self, const py::object&) { return State(self.checked()); })
        .def("__eq__",
             [](const State& self, const py::object& other) -> py::object {
                 if (!py::isinstance<State>(other))
                     return py::reinterpret_borrow<py::object>(Py_NotImplemented);
                 return py::bool_(self.checked() == other.cast<const State&>().checked());
             })
        .def("__repr__",
             [](const State& self) {
                 const ik::State& state = self.checked();
                 return "<State of " + std::to_string(state.bones()) +
                        (state.bones() == 1 ? " bone" : " bones") +
                        (state == ik::State(state.bones()) ? ", at rest>" : ">");
             })
        .def(py::pickle(&state_values, [](const py::tuple& values) {
            if (values.size() != 6) throw py::value_error("State: not a pickled State");
            return std::make_unique<State>(state_from(values));
        }));
    root.attr("State").attr("__hash__") = py::none();

    py::class_<Solver>(root, "Solver", help("Solver"))
        .def(py::init<py::object, py::object>(), py::arg("lengths"), py::arg("rest_directions") = py::none(),
             help("Solver.__init__"))
        .def_property_readonly(
            "bones", [](const Solver& self) { return self.checked().bones(); }, help("Solver.bones"))
        .def_property_readonly(
            "reach", [](const Solver& self) { return self.checked().reach(); }, help("Solver.reach"))
        .def_property_readonly(
            "lengths",
            [](const Solver& self) {
                return to_array<float>(std::span<const float>(self.lengths),
                                       {static_cast<py::ssize_t>(self.checked().bones())});
            },
            help("Solver.lengths"))
        .def(
            "initial_state", [](const Solver& self) { return State(self.checked().initial_state()); },
            help("Solver.initial_state"))
        .def("rest_joints", &rest_joints, py::arg("root") = py::none(), help("Solver.rest_joints"))
        .def("solve", &solve, py::arg("joints"), py::arg("target"), py::kw_only(),
             py::arg("method") = "fabrik", py::arg("state") = py::none(), py::arg("options") = py::none(),
             py::arg("out") = py::none(), help("Solver.solve"))
        .def("explain", &explain, py::arg("joints"), py::arg("target"), py::kw_only(),
             py::arg("state") = py::none(), py::arg("options") = py::none(), help("Solver.explain"))
        .def("__repr__",
             [](const Solver& self) {
                 const std::size_t bones = self.checked().bones();
                 return "<Solver of " + std::to_string(bones) + (bones == 1 ? " bone" : " bones") +
                        ", reach " +
                        py::str(py::float_(std::round(static_cast<double>(self.solver->reach()) * 1e6) / 1e6))
                            .cast<std::string>() +
                        " m>";
             })
        .def("__reduce__", [](const py::object& self) {
            const auto& solver = self.cast<const Solver&>();
            const auto bones = solver.joints() - 1;
            const py::object directions =
                solver.rest_directions.empty()
                    ? py::object(py::none())
                    : to_array<float>(std::span<const glm::vec3>(solver.rest_directions), {bones, 3});
            return py::make_tuple(
                py::type::of(self),
                py::make_tuple(to_array<float>(std::span<const float>(solver.lengths), {bones}), directions));
        });
    root.def("two_bone", &two_bone, py::arg("root"), py::arg("mid"), py::arg("tip"), py::arg("target"),
             py::kw_only(), py::arg("lengths"), py::arg("options") = py::none(), help("two_bone"));
}

}  // namespace tendril::python
