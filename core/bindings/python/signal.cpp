// Filters and springs over whole arrays: tendril.signal.
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "rooms.hpp"
#include "tendril/signal/measure.hpp"

namespace tendril::python {

namespace {

using Doubles = Array<double>;

template <std::size_t index = 0>
signal::Filter filter_of(py::handle given, const char* what) {
    if constexpr (index == std::variant_size_v<signal::Filter>) {
        throw py::type_error(std::string(what) + " must be filters of tendril.signal, got " +
                             py::repr(given).cast<std::string>());
    } else {
        using Kind = std::variant_alternative_t<index, signal::Filter>;
        const Type* const type = TypeOf<Kind>::type;
        if (type != nullptr && py::isinstance<Struct>(given) && given.cast<const Struct&>().type == type)
            return *value<Kind>(given, what);
        return filter_of<index + 1>(given, what);
    }
}

std::vector<signal::Filter> filters_of(const py::object& given, const char* what) {
    std::vector<signal::Filter> all;
    if (py::isinstance<Struct>(given)) {
        all.push_back(filter_of(given, what));
    } else {
        if (!py::isinstance<py::iterable>(given))
            throw py::type_error(std::string(what) + " must be a filter or a list");
        for (const py::handle each : given) all.push_back(filter_of(each, what));
    }
    for (const signal::Filter& each : all) throw_if(signal::check(each));
    return all;
}

/// Seconds of each row: one number for all, or one per row.
std::vector<double> seconds_of(const py::object& given, py::ssize_t rows, const char* what) {
    const py::array any = numbers(given, what);
    if (any.ndim() != 0) expect_shape(any, {{rows}}, what);
    const Doubles all(any);
    std::vector<double> seconds(static_cast<std::size_t>(rows), all.ndim() == 0 ? *all.data() : 0.0);
    if (all.ndim() != 0) seconds.assign(all.data(), all.data() + all.size());
    for (std::size_t i = 0; i < seconds.size(); ++i)
        if (!signal::is_step(seconds[i]))
            throw py::value_error(std::string(what) + "[" + std::to_string(i) +
                                  "] must be finite and over 0 s, got " +
                                  py::repr(py::float_(seconds[i])).cast<std::string>());
    return seconds;
}

/// Filters one after the other, with a state of its own for each channel.
struct Chain : Zeroed {
    bool made = true, busy = false;
    std::vector<signal::Filter> filters;
    std::vector<std::vector<signal::FilterState>> states;  ///< by channel; grows when it first sees them

    explicit Chain(const py::object& given) : filters(filters_of(given, "Chain: filters")) {}
    void check() const {
        if (!made) throw py::type_error("the Chain was made without its constructor");
    }
    Doubles run(const py::object& values, const py::object& dt) {
        check();
        const Busy in_use(busy, "the Chain");
        const py::array any = numbers(values, "run: values");
        if (any.ndim() != 1) expect_shape(any, {{-1, "n"}, {-1, "channels"}}, "run: values");
        const Doubles in(any);
        const py::ssize_t rows = in.shape(0);
        const auto channels = static_cast<std::size_t>(in.ndim() == 1 ? 1 : in.shape(1));
        if (!states.empty() && states.size() != channels)
            throw py::value_error("run: values must have " + std::to_string(states.size()) +
                                  " channels, as before, got " + std::to_string(channels));
        const std::vector<double> seconds = seconds_of(dt, rows, "run: dt");
        Doubles out(std::vector<py::ssize_t>(in.shape(), in.shape() + in.ndim()));
        auto next = states;
        next.resize(channels, std::vector<signal::FilterState>(filters.size()));
        const double* from = in.data();
        double* to = out.mutable_data();
        Result why;
        std::size_t refused = 0;
        {
            const py::gil_scoped_release released;
            for (std::size_t row = 0; row < seconds.size() && why.ok(); ++row)
                for (std::size_t channel = 0; channel < channels && why.ok(); ++channel, ++from, ++to) {
                    *to = signal::step(filters, next[channel], *from, seconds[row], &why);
                    refused = row;
                }
        }
        if (!why) throw py::value_error("run: values[" + std::to_string(refused) + "]: " + why.reason());
        states = std::move(next);
        return out;
    }
};

// ---- Pickles: filters as they are; states as their kind, the numbers of their tables, and a moving
// average's window.

template <class Known>
py::tuple numbers_of(const Known& state) {
    py::list numbers;
    for (const Field& row : fields<Known>()) numbers.append(row.number(&state));
    py::list window;
    if constexpr (std::is_same_v<Known, signal::MovingAverageState>)
        for (const auto& each : state.entries)
            window.append(py::make_tuple(each.dt, each.input, each.time_on, each.area_on));
    return py::make_tuple(numbers, window);
}

template <class Known>
Known state_of(const py::tuple& values) {
    Known state;
    const py::list numbers = values[0];
    if (numbers.size() != fields<Known>().size()) throw py::value_error("Chain: not a pickled Chain");
    for (std::size_t i = 0; i < numbers.size(); ++i)
        fields<Known>()[i].set(&state, {numbers[i].cast<double>()});
    throw_if(check_fields("Chain", state));
    if constexpr (std::is_same_v<Known, signal::MovingAverageState>) {
        for (const py::handle each : values[1]) {
            const auto entry = each.cast<std::array<double, 4>>();
            state.entries.push_back({entry[0], entry[1], entry[2], entry[3]});
        }
        if (state.split > state.entries.size() || state.first > state.split)
            throw py::value_error("Chain: not a pickled Chain");
    }
    return state;
}

py::tuple chain_values(const Chain& self) {
    self.check();
    py::list filters, channels;
    for (const signal::Filter& each : self.filters)
        filters.append(std::visit(
            [](const auto& known) -> py::object {
                using Known = std::remove_cvref_t<decltype(known)>;
                if constexpr (std::is_same_v<Known, signal::Curve>)
                    throw py::type_error("Chain: a curve");
                else
                    return to_python(known);
            },
            each));
    for (const auto& channel : self.states) {
        py::list states;
        for (const signal::FilterState& each : channel)
            states.append(py::make_tuple(
                each.index(), std::visit([](const auto& known) { return numbers_of(known); }, each)));
        channels.append(states);
    }
    return py::make_tuple(filters, channels);
}

template <std::size_t index = 0>
signal::FilterState any_state_of(std::size_t kind, const py::tuple& values) {
    if constexpr (index == std::variant_size_v<signal::FilterState>) {
        throw py::value_error("Chain: not a pickled Chain");
    } else {
        if (kind == index) return state_of<std::variant_alternative_t<index, signal::FilterState>>(values);
        return any_state_of<index + 1>(kind, values);
    }
}

std::unique_ptr<Chain> chain_from(const py::tuple& values) {
    if (values.size() != 2) throw py::value_error("Chain: not a pickled Chain");
    auto made = std::make_unique<Chain>(py::object(values[0]));
    for (const py::handle channel : values[1]) {
        std::vector<signal::FilterState> states;
        for (const py::handle each : channel) {
            const auto pair = each.cast<py::tuple>();
            states.push_back(any_state_of(pair[0].cast<std::size_t>(), pair[1]));
        }
        if (states.size() != made->filters.size()) throw py::value_error("Chain: not a pickled Chain");
        made->states.push_back(std::move(states));
    }
    return made;
}

Doubles run(const py::object& filters, const py::object& values, const py::object& dt) {
    return Chain(filters).run(values, dt);
}

py::object measure(const py::object& filters, const py::object& values, const py::object& dt) {
    const std::vector<signal::Filter> all = filters_of(filters, "measure: filters");
    const auto in = array<double>(values, {{-1, "n"}}, "measure: values");
    const std::vector<double> seconds = seconds_of(dt, in.size(), "measure: dt");
    std::vector<signal::Sample> samples;
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        samples.push_back({seconds[i], in.data()[i]});
        if (!signal::is_input(samples.back().input))
            throw py::value_error("measure: values[" + std::to_string(i) +
                                  "] must be finite and at most 1e9 in magnitude");
    }
    signal::Measures measures;
    {
        const py::gil_scoped_release released;
        measures = signal::measure(all, samples);
    }
    const auto number = [](const std::optional<double>& value) {
        return value ? py::object(py::float_(*value)) : py::object(py::none());
    };
    constexpr const char* following[] = {"unknown", "follows", "does_not_follow", "unstable"};
    return py::module_::import("tendril").attr("signal").attr("Measures")(
        following[static_cast<std::size_t>(measures.following)], number(measures.lag),
        number(measures.overshoot), number(measures.settling_time), number(measures.jitter),
        measures.rate_difference);
}

}  // namespace

void bind_signal(py::module_& root) {
    py::module_ signal = root.def_submodule("signal", help("signal"));
    signal.attr("__name__") = "tendril.signal";
    bind<signal::InterpTo>(signal, "InterpTo");
    bind<signal::InterpToExact>(signal, "InterpToExact");
    bind<signal::ScaleBiasClamp>(signal, "ScaleBiasClamp");
    bind<signal::Spring<double>>(signal, "Spring");
    bind<signal::ExponentialDecay>(signal, "ExponentialDecay");
    bind<signal::RateLimit>(signal, "RateLimit");
    bind<signal::SmoothDamp>(signal, "SmoothDamp");
    bind<signal::SpringSemiImplicit>(signal, "SpringSemiImplicit");
    bind<signal::OneEuro>(signal, "OneEuro");
    bind<signal::MovingAverage>(signal, "MovingAverage");
    bind<signal::DeadZone>(signal, "DeadZone");
    bind<signal::Hysteresis>(signal, "Hysteresis");
    bind<signal::Inertialize>(signal, "Inertialize");

    signal.attr("Measures") =
        py::module_::import("collections")
            .attr("namedtuple")("Measures", "following lag overshoot settling_time jitter rate_difference",
                                py::arg("module") = "tendril.signal");
    signal.attr("Measures").attr("__doc__") = help("signal.Measures");
    py::class_<Chain>(signal, "Chain", help("signal.Chain"))
        .def(py::init<py::object>(), py::arg("filters"), help("signal.Chain.__init__"))
        .def("run", &Chain::run, py::arg("values"), py::arg("dt"), help("signal.Chain.run"))
        .def(
            "step",
            [](Chain& self, const py::object& value, const py::object& dt) -> py::object {
                const py::object rows =
                    py::module_::import("numpy").attr("asarray")(value).attr("__getitem__")(py::none());
                return self.run(rows, dt).attr("__getitem__")(0);
            },
            py::arg("value"), py::arg("dt"), help("signal.Chain.step"))
        .def(
            "reset", [](Chain& self) { self.check(), self.states.clear(); }, help("signal.Chain.reset"))
        .def(
            "copy",
            [](const Chain& self) {
                self.check();
                auto copied = std::make_unique<Chain>(self);
                copied->busy = false;
                return copied;
            },
            help("signal.Chain.copy"))
        .def(py::pickle(&chain_values, &chain_from))
        .def("__repr__", [](const Chain& self) {
            self.check();
            std::string text;
            for (const signal::Filter& each : self.filters)
                text += (text.empty() ? "" : ", ") + std::string(signal::kind(each));
            return "<Chain of " + text + ">";
        });
    signal.def("run", &run, py::arg("filters"), py::arg("values"), py::arg("dt"), help("signal.run"));
    signal.def("measure", &measure, py::arg("filters"), py::arg("values"), py::arg("dt"),
               help("signal.measure"));
}

}  // namespace tendril::python
