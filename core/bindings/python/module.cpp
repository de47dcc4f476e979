// The module tendril._tendril; the package tendril shows its names.
#include "rooms.hpp"
#include "structs.hpp"
#include "tendril/version.hpp"

PYBIND11_MODULE(_tendril, module) {
    namespace python = tendril::python;
    pybind11::options options;
    options.disable_function_signatures();  // the help has them, as Python writes them
    const pybind11::object name = module.attr("__name__");
    module.attr("__name__") = "tendril";  // classes, and so messages and pickles, say the package's name
    module.attr("__version__") = tendril::version_string;
    python::bind_structs(module);
    python::bind_ik(module);
    python::bind_linkage(module);
    python::bind_many(module);
    python::bind_signal(module);
    python::bind_rope(module);
    python::bind_humanoid(module);
    python::bind_trace(module);
    module.attr("__name__") = name;
    module.doc() = python::help("tendril");
}
