// The library's structs as Python classes, each made from its field table: keyword arguments, properties that
// check ranges, repr, ==, copy and pickle. One class, Struct, holds any of them, so that a further struct
// costs a line and no compile time:
//
//     bind<ik::Options>(module, "Options", {span_of<&ik::Options::limits>("limits")});
//
// A number is stored in the C++ struct. A nested struct and a list of structs are Python objects, which the
// program may go on changing; value() copies them into the C++ struct when it is needed.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "help.hpp"
#include "tendril/fields.hpp"
#include "tendril/result.hpp"

namespace tendril::python {

namespace py = pybind11;

/// An exception for a refused call; returns if it was not refused.
void throw_if(const Result& refused);
template <class T>
T&& value_or_throw(Expected<T>& expected) {
    throw_if(expected.error());
    return std::move(*expected);
}

/// Memory of zeroes for every object that Python makes: pybind11 hands out memory that no constructor has
/// seen for an object made by __new__ alone.
struct Zeroed {
    static void* operator new(std::size_t size) {
        if (void* const at = std::calloc(1, size)) return at;
        throw std::bad_alloc();
    }
    static void* operator new(std::size_t, void* at) noexcept { return at; }
    static void operator delete(void* at) noexcept { std::free(at); }
};

/// Marks an object as in use by this call. Solvers have scratch memory: a second thread gets an error instead
/// of a race. The flag is only touched with the interpreter's lock held.
class Busy {
  public:
    Busy(bool& flag, const char* what);
    ~Busy() { flag_ = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

  private:
    bool& flag_;
};

/// Lists that a C++ struct refers to and does not own.
using Storage = std::vector<std::shared_ptr<const void>>;

struct Struct;
/// Sets a span of structs, whose elements then lie in `storage`.
struct SpanRow {
    const char* name;
    void (*set)(void* object, std::span<const Struct* const> elements, Storage& storage);
};

/// A struct of the library and its class.
struct Type {
    std::string_view cpp;  ///< "ik::Options"
    std::string name;      ///< "Options"
    std::span<const Field> table;
    std::span<const Field> (*table_of)() noexcept;
    const void* (*fresh)() noexcept;
    void* (*copy)(const void* object);
    void (*assign)(void* to, const void* from);
    void (*destroy)(void* object) noexcept;
    std::vector<SpanRow> spans{};
    PyTypeObject* python = nullptr;
};

template <class T>
struct TypeOf {
    static inline Type* type = nullptr;
};

struct Struct : Zeroed {
    const Type* type;
    void* object;
    std::vector<py::object> held;  ///< by row; null but for structs and lists of them

    Struct(const Type& of, const void* from);
    Struct(const Struct& other) = delete;
    Struct& operator=(const Struct& other) = delete;
    ~Struct();
    /// Copies everything, also the nested structs, to `to`.
    void copy_to(void* to, Storage& storage) const;
};

/// A C++ struct together with what it refers to.
template <class T>
struct Held {
    T value;
    Storage storage;
    const T& operator*() const noexcept { return value; }
    const T* operator->() const noexcept { return &value; }
};

/// TypeError unless `given` is of that type.
const Struct& struct_of(const Type& type, py::handle given, const char* what);
py::object make(const Type& type, const void* from);
/// A struct with some members set by keyword arguments. `given` may be None; TypeError for an unknown name.
py::object with_arguments(const Type& type, py::handle given, const py::dict& arguments, const char* what);

template <class T>
py::object to_python(const T& value) {
    return make(*TypeOf<T>::type, &value);
}
template <class T>
Held<T> value(py::handle given, const char* what) {
    const Struct& from = struct_of(*TypeOf<T>::type, given, what);
    Held<T> held;
    from.copy_to(&held.value, held.storage);
    return held;
}
/// For functions that take `options=None, **fields`.
template <class T>
Held<T> options(py::handle given, const py::kwargs& arguments, const char* function) {
    if (given.is_none() && arguments.empty()) return {};
    return value<T>(with_arguments(*TypeOf<T>::type, given, arguments, function), function);
}

// ---- Enumerations: Python's enum.Enum, whose members are also strings.

void bind_enum(py::module_& module, const char* name, std::string_view cpp,
               std::span<const char* const> choices);
py::object choice(std::string_view cpp, std::size_t index);
/// A member, or its name as a string.
std::size_t choice(std::string_view cpp, py::handle given, const char* what);

template <class E>
py::object to_choice(E value) {
    return choice(detail::type_name<E>(), static_cast<std::size_t>(value));
}
template <class E>
E choice_of(py::handle given, const char* what) {
    return static_cast<E>(choice(detail::type_name<E>(), given, what));
}

// ---- Binding.

void bind_type(py::module_& module, Type& type);

template <auto member>
SpanRow span_of(const char* name) {
    using Span = detail::ValueOf<member>;
    using Element = std::remove_const_t<typename Span::element_type>;
    return {name, [](void* object, std::span<const Struct* const> elements, Storage& storage) {
                const auto all = std::make_shared<std::vector<Element>>(elements.size());
                for (std::size_t i = 0; i < elements.size(); ++i) elements[i]->copy_to(&(*all)[i], storage);
                detail::member_of<member>(object) = *all;
                storage.push_back(all);
            }};
}

template <class T>
void bind(py::module_& module, const char* name, std::initializer_list<SpanRow> spans = {}) {
    static Type type{detail::type_name<T>(),
                     name,
                     fields<T>(),
                     fields<T>,
                     detail::fresh<T>,
                     [](const void* object) -> void* { return new T(*static_cast<const T*>(object)); },
                     [](void* to, const void* from) { *static_cast<T*>(to) = *static_cast<const T*>(from); },
                     [](void* object) noexcept { delete static_cast<T*>(object); },
                     spans};
    TypeOf<T>::type = &type;
    bind_type(module, type);
}

/// The class Struct itself, before all others.
void bind_structs(py::module_& module);

}  // namespace tendril::python
