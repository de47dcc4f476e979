// Exceptions for files that the program's readers and writers refuse; classes of what they read.
#pragma once

#include <pybind11/pybind11.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "app/io/text.hpp"

namespace tendril::python {

namespace py = pybind11;

/// What a file holds, as Python's text: bytes that are no UTF-8 become U+FFFD.
inline py::str text(std::string_view bytes) {
    return py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
}
inline py::list text(const std::vector<std::string>& all) {
    py::list made;
    for (const std::string& each : all) made.append(text(each));
    return made;
}
/// A property's getter.
template <class Class, class Text>
auto text_of(Text Class::*member) {
    return [member](const Class& self) { return text(self.*member); };
}

/// Does it while other Python threads run. A refusal is a ValueError with its message, or an OSError if the
/// file cannot be written.
auto refusing(const auto& work) {
    try {
        const py::gil_scoped_release released;
        return work();
    } catch (const std::runtime_error& error) {
        if (std::string_view(error.what()).starts_with("cannot write")) {
            PyErr_SetString(PyExc_OSError, app::printable(error.what()).c_str());
            throw py::error_already_set();
        }
        throw py::value_error(app::printable(error.what()));
    }
}

/// The same for a file to be read; FileNotFoundError if there is none.
auto from_file(const std::filesystem::path& file, const auto& read) {
    std::error_code error;
    if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found) {
        errno = ENOENT;
        PyErr_SetFromErrnoWithFilename(PyExc_OSError, file.string().c_str());
        throw py::error_already_set();
    }
    return refusing(read);
}

/// The names of an enumeration's values, for bind_enum().
template <class E>
std::vector<const char*> names_to(E last) {
    std::vector<const char*> names;
    for (int i = 0; i <= static_cast<int>(last); ++i) names.push_back(name(static_cast<E>(i)));
    return names;
}

/// A class that Python can't make objects of, not even by __new__: they would have no file.
template <class Class>
Class made_only_here(Class bound) {
    reinterpret_cast<PyTypeObject*>(bound.ptr())->tp_new = [](PyTypeObject* type, PyObject*,
                                                              PyObject*) -> PyObject* {
        return PyErr_Format(PyExc_TypeError, "%s comes from a function of tendril, not from its constructor",
                            type->tp_name);
    };
    return bound;
}

}  // namespace tendril::python
