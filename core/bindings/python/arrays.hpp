// NumPy arrays in and out. An array of the library's own layout (float32 points, C order) is used where it
// lies; other numbers are converted. A wrong shape or type is refused with its name, and what it got.
#pragma once

#include <pybind11/numpy.h>

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "structs.hpp"
#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::python {

/// The length of an axis, or any if negative; its letter in messages.
struct Axis {
    py::ssize_t size;
    const char* letter = "n";
};
using Shape = std::initializer_list<Axis>;

/// "(3, 2)"
std::string shape_of(const py::array& array);
/// Numbers of any type but complex; TypeError or ValueError naming `what`.
py::array numbers(py::handle given, const char* what);
void expect_shape(const py::array& array, Shape shape, const char* what);
/// Memory for results: the type, order and shape must be exact.
void expect_out(const py::array& array, const py::dtype& type, Shape shape, const char* what);

template <class Number>
using Array = py::array_t<Number, py::array::c_style | py::array::forcecast>;

/// An input of this shape, converted only if it has another type or order.
template <class Number>
Array<Number> array(py::handle given, Shape shape, const char* what) {
    const py::array any = numbers(given, what);
    expect_shape(any, shape, what);
    return Array<Number>(any);
}
/// A new array with the numbers of an input, or the given one with them.
template <class Number>
Array<Number> copy(const Array<Number>& from, const py::object& out, Shape shape, const char* what) {
    if (out.is_none()) {
        Array<Number> made(std::vector<py::ssize_t>(from.shape(), from.shape() + from.ndim()));
        std::copy_n(from.data(), from.size(), made.mutable_data());
        return made;
    }
    if (!py::isinstance<py::array>(out)) throw py::type_error(std::string(what) + " must be a NumPy array");
    const auto given = py::reinterpret_borrow<py::array>(out);
    expect_out(given, py::dtype::of<Number>(), shape, what);
    auto made = py::reinterpret_borrow<Array<Number>>(given);
    if (made.data() != from.data())
        std::memmove(made.mutable_data(), from.data(),
                     sizeof(Number) * static_cast<std::size_t>(from.size()));
    return made;
}

/// The elements of an array as points or rotations.
template <class Element, class Number>
std::span<const Element> elements(const Array<Number>& array) {
    static_assert(sizeof(Element) % sizeof(Number) == 0);
    return {reinterpret_cast<const Element*>(array.data()),
            static_cast<std::size_t>(array.size()) * sizeof(Number) / sizeof(Element)};
}
template <class Element, class Number>
std::span<Element> mutable_elements(Array<Number>& array) {
    return {reinterpret_cast<Element*>(array.mutable_data()),
            static_cast<std::size_t>(array.size()) * sizeof(Number) / sizeof(Element)};
}

inline glm::vec3 point(py::handle given, const char* what) {
    const auto numbers = array<float>(given, {{3}}, what);
    return {numbers.at(0), numbers.at(1), numbers.at(2)};
}
inline glm::dvec3 exact_point(py::handle given, const char* what) {
    const auto numbers = array<double>(given, {{3}}, what);
    return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

template <class Number, class Element>
Array<Number> to_array(std::span<const Element> values, std::vector<py::ssize_t> shape) {
    Array<Number> made(std::move(shape));
    std::copy_n(reinterpret_cast<const Number*>(values.data()), made.size(), made.mutable_data());
    return made;
}

}  // namespace tendril::python
