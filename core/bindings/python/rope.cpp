// Ropes, cloth and colliders: tendril.rope.
#include "arrays.hpp"
#include "rooms.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::python {

namespace {

struct Body : Zeroed {
    rope::BodyId id;
};
struct Collider : Zeroed {
    rope::ColliderId id;
};

struct World : Zeroed {
    bool made = true, busy = false;
    rope::World world;
    rope::Workspace workspace;

    /// Nothing reads or edits a world that another thread advances.
    rope::World& free() {
        if (!made) throw py::type_error("the World was made without its constructor");
        const Busy asked(busy, "the World");
        return world;
    }
};

template <std::size_t index = 0>
rope::Shape shape_of(py::handle given) {
    if constexpr (index == std::variant_size_v<rope::Shape>) {
        throw py::type_error("a collider must be a Sphere, Capsule, Plane or Box of tendril.rope, got " +
                             py::repr(given).cast<std::string>());
    } else {
        using Kind = std::variant_alternative_t<index, rope::Shape>;
        if (py::isinstance<Struct>(given) && given.cast<const Struct&>().type == TypeOf<Kind>::type)
            return *value<Kind>(given, "collider");
        return shape_of<index + 1>(given);
    }
}

template <class Wrapper, class Id>
Wrapper wrapped(Expected<Id> made) {
    Wrapper wrapper;
    wrapper.id = value_or_throw(made);
    return wrapper;
}

const rope::Body& found(const rope::World& world, const Body& body) {
    if (const rope::Body* const at = world.find(body.id)) return *at;
    throw py::key_error("the body is not in this world: it was removed, or is another world's");
}

Array<double> positions(World& self, const py::object& body) {
    const rope::World& world = self.free();
    std::size_t first = 0, count = world.size();
    if (!body.is_none()) {
        const rope::Body& of = found(world, body.cast<const Body&>());
        first = of.first, count = of.count;
    }
    Array<double> made({static_cast<py::ssize_t>(count), py::ssize_t{3}});
    if (count > 0) world.pose(mutable_elements<glm::dvec3>(made), first);
    return made;
}

py::object advance(World& self, double seconds) {
    self.free();
    const Busy busy(self.busy, "the World");
    rope::Advance done;
    {
        const py::gil_scoped_release released;
        done = self.world.advance(seconds, self.workspace);
    }
    throw_if(done.accepted);
    return py::module_::import("tendril").attr("rope").attr("Advance")(
        done.substeps, done.dropped, done.unresolved, done.unconverged, done.fallbacks, done.held_back,
        done.torn.size(), done.contact_loss);
}

}  // namespace

void bind_rope(py::module_& root) {
    py::module_ rope = root.def_submodule("rope", help("rope"));
    rope.attr("__name__") = "tendril.rope";
    bind<rope::Settings>(rope, "Settings");
    bind<rope::RopeShape>(rope, "RopeShape");
    bind<rope::ClothShape>(rope, "ClothShape");
    bind<rope::Sphere>(rope, "Sphere");
    bind<rope::Capsule>(rope, "Capsule");
    bind<rope::Plane>(rope, "Plane");
    bind<rope::Box>(rope, "Box");
    bind<rope::Drive>(rope, "Drive");

    rope.attr("Advance") = py::module_::import("collections")
                               .attr("namedtuple")("Advance",
                                                   "substeps dropped unresolved unconverged fallbacks "
                                                   "held_back torn contact_loss",
                                                   py::arg("module") = "tendril.rope");
    rope.attr("Advance").attr("__doc__") = help("rope.Advance");
    py::class_<Body>(rope, "Body", help("rope.Body"))
        .def("__eq__", [](const Body& self, const py::object& other) {
            return py::isinstance<Body>(other) && other.cast<const Body&>().id == self.id;
        });
    py::class_<Collider>(rope, "Collider", help("rope.Collider"))
        .def("__eq__", [](const Collider& self, const py::object& other) {
            return py::isinstance<Collider>(other) && other.cast<const Collider&>().id == self.id;
        });

    py::class_<World>(rope, "World", help("rope.World"))
        .def(py::init([](const py::object& settings, int threads, const py::kwargs& members) {
                 auto made = std::make_unique<World>();
                 throw_if(made->world.set_settings(*options<rope::Settings>(settings, members, "World")));
                 throw_if(made->workspace.use_threads(threads));
                 return made;
             }),
             py::arg("settings") = py::none(), py::kw_only(), py::arg("threads") = 1,
             help("rope.World.__init__"))
        .def_property(
            "settings", [](World& self) { return to_python(self.free().settings()); },
            [](World& self, const py::object& given) {
                throw_if(self.free().set_settings(*value<rope::Settings>(given, "World: settings")));
            },
            help("rope.World.settings"))
        .def(
            "add_rope",
            [](World& self, const py::object& shape, const py::kwargs& members) {
                return wrapped<Body>(
                    self.free().add_rope(*options<rope::RopeShape>(shape, members, "add_rope")));
            },
            py::arg("shape") = py::none(), help("rope.World.add_rope"))
        .def(
            "add_cloth",
            [](World& self, const py::object& shape, const py::kwargs& members) {
                return wrapped<Body>(
                    self.free().add_cloth(*options<rope::ClothShape>(shape, members, "add_cloth")));
            },
            py::arg("shape") = py::none(), help("rope.World.add_cloth"))
        .def(
            "remove", [](World& self, const Body& body) { throw_if(self.free().remove(body.id)); },
            py::arg("body"), help("rope.World.remove"))
        .def(
            "add_collider",
            [](World& self, const py::object& shape) {
                return wrapped<Collider>(self.free().add_collider(shape_of(shape)));
            },
            py::arg("shape"), help("rope.World.add_collider"))
        .def(
            "move_collider",
            [](World& self, const Collider& collider, const py::object& to, double seconds) {
                throw_if(self.free().move_collider(collider.id, point(to, "move_collider: to"), seconds));
            },
            py::arg("collider"), py::arg("to"), py::arg("seconds") = 0.0, help("rope.World.move_collider"))
        .def(
            "drive_collider",
            [](World& self, const Collider& collider, const py::object& drive, const py::kwargs& members) {
                throw_if(self.free().drive_collider(collider.id,
                                                    *options<rope::Drive>(drive, members, "drive_collider")));
            },
            py::arg("collider"), py::arg("drive") = py::none(), help("rope.World.drive_collider"))
        .def(
            "remove_collider",
            [](World& self, const Collider& collider) { throw_if(self.free().remove_collider(collider.id)); },
            py::arg("collider"), help("rope.World.remove_collider"))
        .def(
            "particle",
            [](World& self, const Body& body, std::size_t index) {
                auto at = self.free().particle(body.id, index);
                return value_or_throw(at);
            },
            py::arg("body"), py::arg("index"), help("rope.World.particle"))
        .def(
            "pin",
            [](World& self, std::size_t particle, const py::object& at, double seconds) {
                throw_if(self.free().pin(particle, exact_point(at, "pin: at"), seconds));
            },
            py::arg("particle"), py::arg("at"), py::arg("seconds") = 0.0, help("rope.World.pin"))
        .def(
            "unpin", [](World& self, std::size_t particle) { throw_if(self.free().unpin(particle)); },
            py::arg("particle"), help("rope.World.unpin"))
        .def("advance", &advance, py::arg("seconds"), help("rope.World.advance"))
        .def("positions", &positions, py::arg("body") = py::none(), help("rope.World.positions"))
        .def(
            "length_error",
            [](World& self, const py::object& body) {
                const rope::World& world = self.free();
                return body.is_none() ? world.length_error()
                                      : world.length_error(found(world, body.cast<const Body&>()));
            },
            py::arg("body") = py::none(), help("rope.World.length_error"))
        .def_property_readonly(
            "energy", [](World& self) { return self.free().energy(); }, help("rope.World.energy"))
        .def_property_readonly(
            "pending", [](World& self) { return self.free().pending(); }, help("rope.World.pending"))
        .def(
            "copy",
            [](World& self) {
                auto copied = std::make_unique<World>();
                copied->world = self.free();
                return copied;
            },
            help("rope.World.copy"))
        .def("__len__", [](World& self) { return self.free().size(); })
        .def("__repr__", [](World& self) {
            const rope::State& state = self.free().state();
            return "<World of " + std::to_string(state.bodies.size()) + " bodies, " +
                   std::to_string(state.position.size()) + " particles, " +
                   std::to_string(state.colliders.size()) + " colliders>";
        });
}

}  // namespace tendril::python
