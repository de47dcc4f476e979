#include "arrays.hpp"

namespace tendril::python {

std::string shape_of(const py::array& array) {
    return py::repr(array.attr("shape")).cast<std::string>();
}

namespace {

/// "float32"
std::string name_of(const py::dtype& type) {
    return py::str(static_cast<const py::object&>(type)).cast<std::string>();
}

bool fits(const py::array& array, Shape shape) {
    if (static_cast<std::size_t>(array.ndim()) != shape.size()) return false;
    py::ssize_t axis = 0;
    for (const Axis& each : shape)
        if (const py::ssize_t size = array.shape(axis++); each.size >= 0 && size != each.size) return false;
    return true;
}

}  // namespace

py::array numbers(py::handle given, const char* what) {
    if (given.is_none()) throw py::type_error(std::string(what) + " must be an array, got None");
    const auto array = py::array::ensure(given);
    if (!array) {
        PyErr_Clear();
        throw py::value_error(std::string(what) + " must be an array of numbers");
    }
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u')
        throw py::type_error(std::string(what) + " must be an array of numbers, got dtype " +
                             name_of(array.dtype()));
    return array;
}

void expect_shape(const py::array& array, Shape shape, const char* what) {
    if (fits(array, shape)) return;
    std::string wanted;
    for (const Axis& each : shape)
        wanted += (wanted.empty() ? "" : ", ") +
                  (each.size < 0 ? std::string(each.letter) : std::to_string(each.size));
    if (shape.size() == 1) wanted += ",";
    throw py::value_error(std::string(what) + " must have shape (" + wanted + "), got " + shape_of(array));
}

void expect_out(const py::array& array, const py::dtype& type, Shape shape, const char* what) {
    if (!array.dtype().equal(type))
        throw py::type_error(std::string(what) + " must be " + name_of(type) + ", got " +
                             name_of(array.dtype()));
    expect_shape(array, shape, what);
    if ((array.flags() & py::array::c_style) == 0)
        throw py::value_error(std::string(what) + " must be C-contiguous");
    if (!array.writeable()) throw py::value_error(std::string(what) + " must be writeable");
}

}  // namespace tendril::python
