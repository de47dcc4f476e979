// A function for each room, in a file of its own: it binds the room's structs and functions.
#pragma once

#include <pybind11/pybind11.h>

namespace tendril::python {

void bind_humanoid(pybind11::module_& root);
void bind_ik(pybind11::module_& root);
void bind_linkage(pybind11::module_& root);
void bind_many(pybind11::module_& root);
void bind_signal(pybind11::module_& root);
void bind_rope(pybind11::module_& root);
void bind_trace(pybind11::module_& root);

}  // namespace tendril::python
