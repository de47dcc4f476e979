#include "structs.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <unordered_map>

namespace tendril::python {

void throw_if(const Result& refused) {
    switch (refused.code()) {
        case ErrorCode::None:
            return;
        case ErrorCode::OutOfRange:
            throw py::index_error(refused.message());
        case ErrorCode::NotFound:
            throw py::key_error(refused.message());
        case ErrorCode::InvalidArgument:
        case ErrorCode::AlreadyExists:
            throw py::value_error(refused.message());
    }
}

Busy::Busy(bool& flag, const char* what) : flag_(flag) {
    if (flag)
        throw std::runtime_error(std::string(what) +
                                 " is in use by another thread; give each thread its own");
    flag = true;
}

// ---- Enumerations.

namespace {

struct Enumeration {
    py::object type;
    std::vector<std::string> choices;
};
// Python keeps its classes until the process ends, and so are these: nothing is released after the
// interpreter.
std::map<std::string, Enumeration, std::less<>>& enumerations() {
    static auto* const all = new std::map<std::string, Enumeration, std::less<>>;
    return *all;
}
std::unordered_map<PyTypeObject*, const Type*>& types() {
    static auto* const all = new std::unordered_map<PyTypeObject*, const Type*>;
    return *all;
}

std::string enumerator_name(std::string_view choice) {
    std::string name;
    for (const char each : choice) {
        const bool capital = each >= 'A' && each <= 'Z';
        if (capital && !name.empty()) name += '_';
        name += static_cast<char>(each >= 'a' && each <= 'z' ? each - 'a' + 'A' : each);
    }
    return name;
}

std::string text_of(py::handle object) {
    return py::repr(object).cast<std::string>();
}

/// Of an argument in a message: short.
std::string shown(py::handle object) {
    std::string text = text_of(object);
    constexpr std::size_t longest = 60;
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return text;
}

std::string_view short_name(std::string_view cpp) {
    constexpr std::string_view space = "tendril::";
    return cpp.starts_with(space) ? cpp.substr(space.size()) : cpp;
}

}  // namespace

void bind_enum(py::module_& module, const char* name, std::string_view cpp,
               std::span<const char* const> choices) {
    py::list members;
    Enumeration made;
    for (const char* const each : choices) {
        members.append(py::make_tuple(enumerator_name(each), each));
        made.choices.emplace_back(each);
    }
    const py::object str = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyUnicode_Type));
    made.type = py::module_::import("enum").attr("Enum")(name, members, py::arg("type") = str,
                                                         py::arg("module") = module.attr("__name__"));
    made.type.attr("__str__") = str.attr("__str__");
    made.type.attr("__doc__") = help(short_name(cpp));
    module.attr(name) = made.type;
    enumerations().emplace(cpp, std::move(made));
}

py::object choice(std::string_view cpp, std::size_t index) {
    const Enumeration& of = enumerations().find(cpp)->second;
    if (index >= of.choices.size()) throw py::value_error("a value that its enumeration does not have");
    return of.type(of.choices[index]);
}

std::size_t choice(std::string_view cpp, py::handle given, const char* what) {
    const Enumeration& of = enumerations().find(cpp)->second;
    if (!py::isinstance<py::str>(given))
        throw py::type_error(std::string(what) + " must be a " +
                             py::cast<std::string>(of.type.attr("__name__")) + " or its name, got " +
                             shown(given));
    const auto text = given.cast<std::string>();
    const auto found = std::find(of.choices.begin(), of.choices.end(), text);
    if (found != of.choices.end()) return static_cast<std::size_t>(found - of.choices.begin());
    std::string all;
    for (const std::string& each : of.choices) all += (all.empty() ? "" : ", ") + each;
    throw py::value_error(std::string(what) + " must be one of " + all + ", got " + shown(given));
}

// ---- Numbers.

namespace {

/// The double that is written as the float is: 0.1, not 0.10000000149.
double shortest(double number) {
    const auto single = static_cast<float>(number);
    if (!std::isfinite(single) || static_cast<double>(single) != number) return number;
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, single).ptr;
    double read = number;
    std::from_chars(text, end, read);
    return read;
}

py::object number_to_python(const Field& row, double number) {
    if (row.optional && std::isnan(number)) return py::none();
    switch (row.type) {
        case FieldType::Flag:
            return py::bool_(number != 0.0);
        case FieldType::Choice:
            return choice(row.in_code, static_cast<std::size_t>(number));
        case FieldType::Integer:
        case FieldType::Index:
            if (std::isnan(number)) return py::none();  // an index that refers to nothing
            return py::reinterpret_steal<py::object>(PyLong_FromDouble(number));
        default:
            return py::float_(row.exact ? number : shortest(number));
    }
}

double number_from_python(const Field& row, py::handle given, const std::string& place) {
    PyObject* const object = given.ptr();
    if (row.type == FieldType::Flag) {
        const int truth = PyBool_Check(object) ? PyObject_IsTrue(object) : -1;
        if (truth < 0) throw py::type_error(place + " must be True or False, got " + shown(given));
        return truth;
    }
    if (row.type == FieldType::Choice) return static_cast<double>(choice(row.in_code, given, place.c_str()));
    const bool integer = row.type == FieldType::Integer || row.type == FieldType::Index;
    if (PyUnicode_Check(object) || PyBytes_Check(object) || PyBool_Check(object))
        throw py::type_error(place + " must be " + (integer ? "an integer" : "a number") + ", got " +
                             shown(given));
    if (integer) {
        const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(object));
        if (!index) {
            PyErr_Clear();
            throw py::type_error(place + " must be an integer, got " + shown(given));
        }
        const double number = PyLong_AsDouble(index.ptr());
        if (number == -1.0 && PyErr_Occurred()) {  // over 1e308
            PyErr_Clear();
            throw py::value_error(place + " is too large");
        }
        return number;
    }
    const double number = PyFloat_AsDouble(object);
    if (number == -1.0 && PyErr_Occurred()) {
        PyErr_Clear();
        throw py::type_error(place + " must be a number, got " + shown(given));
    }
    return number;
}

FieldValue value_from_python(const Field& row, py::handle given, const std::string& place) {
    if (given.is_none()) {
        if (row.optional) return {std::numeric_limits<double>::quiet_NaN()};
        throw py::type_error(place + " must not be None");
    }
    if (row.size() == 1) {
        const double number = number_from_python(row, given, place);
        if (row.optional && std::isnan(number)) throw py::value_error(place + " must be a number, got nan");
        return {number};
    }
    const auto count = static_cast<std::size_t>(row.size());
    const auto refuse = [&] {
        throw py::type_error(place + " must be " + std::to_string(count) + " numbers, got " + shown(given));
    };
    if (PyUnicode_Check(given.ptr()) || !PySequence_Check(given.ptr())) refuse();
    const auto sequence = py::reinterpret_steal<py::object>(PySequence_Fast(given.ptr(), ""));
    if (!sequence) {
        PyErr_Clear();
        refuse();
    }
    if (static_cast<std::size_t>(PySequence_Fast_GET_SIZE(sequence.ptr())) != count) refuse();
    FieldValue value{};
    for (std::size_t i = 0; i < count; ++i)
        value[i] = number_from_python(
            row, PySequence_Fast_GET_ITEM(sequence.ptr(), static_cast<Py_ssize_t>(i)), place);
    if (row.optional && std::isnan(value[0])) throw py::value_error(place + " must be numbers, got nan");
    return value;
}

py::object value_to_python(const Field& row, const FieldValue& value) {
    if (row.size() == 1) return number_to_python(row, value[0]);
    if (row.optional && std::isnan(value[0])) return py::none();
    py::tuple all(static_cast<std::size_t>(row.size()));
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = py::float_(row.exact ? value[i] : shortest(value[i]));
    return all;
}

// ---- Rows.

bool is_struct(const Field& row) {
    return row.type == FieldType::Struct || row.type == FieldType::Kind;
}
/// Not in Python: types that only C++ knows, and lists of numbers that C++ writes to.
bool is_hidden(const Type& type, const Field& row) {
    if (row.type == FieldType::Other ||
        (row.type == FieldType::Text && row.count == nullptr && row.text == nullptr))
        return true;
    if (row.count == nullptr || row.resize != nullptr || row.most == row.fewest) return false;
    if (row.count(type.fresh()) == row.most) return false;  // a fixed array
    return std::none_of(type.spans.begin(), type.spans.end(),
                        [&](const SpanRow& each) { return std::string_view(each.name) == row.name; });
}

/// "from_" for a row whose name Python keeps for itself.
std::string name_of(const Field& row) {
    static const auto* const is_keyword = new py::object(py::module_::import("keyword").attr("iskeyword"));
    return (*is_keyword)(row.name).cast<bool>() ? std::string(row.name) + "_" : row.name;
}

const Type& type_of_table(std::span<const Field> (*table)() noexcept) {
    for (const auto& [python, type] : types())
        if (type->table_of == table) return *type;
    throw py::type_error("a nested struct that Python does not know");
}

const Type& type_of_class(py::handle cls) {
    const auto mro = py::reinterpret_borrow<py::tuple>(reinterpret_cast<PyTypeObject*>(cls.ptr())->tp_mro);
    for (const py::handle each : mro)
        if (const auto found = types().find(reinterpret_cast<PyTypeObject*>(each.ptr()));
            found != types().end())
            return *found->second;
    throw py::type_error("tendril.Struct has no members; use one of its subclasses");
}

const Struct& made(const Struct& given) {
    if (given.type == nullptr || given.object == nullptr)
        throw py::type_error("the object was made without its constructor");
    return given;
}
const Struct* as_struct(py::handle object) {
    if (!py::isinstance<Struct>(object)) return nullptr;
    return &made(object.cast<const Struct&>());
}

py::object held_from(const Field& row, const void* object) {
    const auto one = [&](const void* at, const FieldKind& kind) -> py::object {
        return at == nullptr ? py::object(py::none()) : make(type_of_table(kind.table), at);
    };
    if (row.count == nullptr)
        return one(row.address(object, 0), row.type == FieldType::Kind ? row.kind(object) : row.kinds[0]);
    py::tuple all(row.count(object));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = one(row.address(object, i), row.kinds[0]);
    return all;
}

py::object get(const Struct& from, std::size_t at) {
    const Field& row = from.type->table[at];
    if (from.held[at]) return from.held[at];
    if (row.type == FieldType::Text && row.count == nullptr) {
        const std::string_view text = row.text(from.object);
        return py::str(text.data(), text.size());
    }
    if (row.count == nullptr) return value_to_python(row, row.get(from.object));
    py::tuple all(row.count(from.object));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const void* const element = row.address(from.object, i);
        if (row.type == FieldType::Text) {
            const std::string_view text = row.text(element);
            all[i] = py::str(text.data(), text.size());
        } else {
            all[i] = value_to_python(row, row.get(element));
        }
    }
    return all;
}

void expect_struct(const Field& row, py::handle given, const std::string& place) {
    const Struct* const object = as_struct(given);
    std::string names;
    for (const FieldKind& kind : row.kinds) {
        const Type& type = type_of_table(kind.table);
        if (object != nullptr && object->type == &type) return;
        names += (names.empty() ? "" : ", ") + type.name;
    }
    throw py::type_error(place + " must be a " + names + ", got " + shown(given));
}

std::vector<py::object> elements_of(const Field& row, py::handle given, const std::string& place,
                                    std::size_t size) {
    if (PyUnicode_Check(given.ptr()) || !py::isinstance<py::iterable>(given))
        throw py::type_error(place + " must be a list, got " + shown(given));
    std::vector<py::object> all;
    for (const py::handle each : py::reinterpret_borrow<py::iterable>(given)) {
        all.push_back(py::reinterpret_borrow<py::object>(each));
        if (all.size() > row.most) break;
    }
    const bool fixed = row.resize == nullptr && row.most == size && size > 0;
    if (fixed ? all.size() != size : all.size() < row.fewest || all.size() > row.most)
        throw py::value_error(
            place + " must have " +
            (fixed ? std::to_string(size) : std::to_string(row.fewest) + " to " + std::to_string(row.most)) +
            " elements, got " + std::to_string(all.size()));
    return all;
}

std::string text_from(py::handle given, const std::string& place) {
    if (!py::isinstance<py::str>(given))
        throw py::type_error(place + " must be a string, got " + shown(given));
    return given.cast<std::string>();
}

void set(Struct& to, std::size_t at, py::handle given) {
    const Type& type = *to.type;
    const Field& row = type.table[at];
    const std::string place = type.name + ": " + name_of(row);
    if (is_struct(row)) {
        if (row.count != nullptr) {
            const std::vector<py::object> all = elements_of(row, given, place, row.count(to.object));
            py::tuple kept(all.size());
            for (std::size_t i = 0; i < all.size(); ++i) {
                expect_struct(row, all[i], place + "[" + std::to_string(i) + "]");
                kept[i] = all[i];
            }
            to.held[at] = std::move(kept);
            return;
        }
        if (!given.is_none() || !row.optional) expect_struct(row, given, place);
        to.held[at] = py::reinterpret_borrow<py::object>(given);
        return;
    }
    // On a copy, so that a refused value changes nothing.
    const std::unique_ptr<void, void (*)(void*)> changed(type.copy(to.object), type.destroy);
    if (row.count != nullptr) {
        const std::vector<py::object> all = elements_of(row, given, place, row.count(to.object));
        if (row.resize != nullptr) row.resize(changed.get(), all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            void* const element = row.address_in(changed.get(), i);
            const std::string element_place = place + "[" + std::to_string(i) + "]";
            if (row.type == FieldType::Text)
                row.set_text(element, text_from(all[i], element_place));
            else
                row.set(element, value_from_python(row, all[i], element_place));
        }
    } else if (row.type == FieldType::Text) {
        row.set_text(changed.get(),
                     given.is_none() && row.optional ? std::string() : text_from(given, place));
    } else if (row.type == FieldType::Index) {
        const double index = given.is_none() && row.optional ? -1.0 : number_from_python(row, given, place);
        if (!given.is_none() && index < 0.0)
            throw py::value_error(place + " must not be negative, got " + shown(given));
        if (index < 0.0)
            row.set(changed.get(), {std::numeric_limits<double>::infinity()});  // reads back as none
        else
            row.set(changed.get(), {index});
    } else {
        row.set(changed.get(), value_from_python(row, given, place));
    }
    if (row.type != FieldType::Text && row.type != FieldType::Index)
        throw_if(check_fields(type.name.c_str(), {&row, 1}, changed.get()));
    type.assign(to.object, changed.get());
}

std::size_t row_named(const Type& type, const std::string& name, const std::string& what) {
    for (std::size_t at = 0; at < type.table.size(); ++at)
        if (name == name_of(type.table[at]) && !is_hidden(type, type.table[at])) return at;
    throw py::type_error(what + " has no argument '" + name + "'");
}

void set_all(Struct& to, const py::dict& arguments, const std::string& what) {
    for (const auto& [name, given] : arguments)
        set(to, row_named(*to.type, py::cast<std::string>(name), what), given);
}

bool same(const Struct& one, const Struct& other) {
    if (one.type != other.type) return false;
    for (std::size_t at = 0; at < one.type->table.size(); ++at)
        if (!is_hidden(*one.type, one.type->table[at]) && !get(one, at).equal(get(other, at))) return false;
    return true;
}

/// The members that differ from the defaults.
py::dict changed_members(const Struct& from) {
    const Struct fresh(*from.type, from.type->fresh());
    py::dict all;
    for (std::size_t at = 0; at < from.type->table.size(); ++at) {
        const Field& row = from.type->table[at];
        if (is_hidden(*from.type, row)) continue;
        const py::object value = get(from, at);
        if (!value.equal(get(fresh, at))) all[name_of(row).c_str()] = value;
    }
    return all;
}

std::string repr_of(const Struct& from) {
    std::string text;
    for (const auto& [name, given] : changed_members(from)) {
        const bool is_choice = py::isinstance(given, py::module_::import("enum").attr("Enum"));
        text +=
            (text.empty() ? "" : ", ") + py::cast<std::string>(name) + "=" +
            text_of(is_choice ? py::object(given.attr("value")) : py::reinterpret_borrow<py::object>(given));
    }
    return from.type->name + "(" + text + ")";
}

py::object deep_copy(const Struct& from) {
    py::object copied = make(*from.type, from.object);
    auto& copy = copied.cast<Struct&>();
    for (std::size_t at = 0; at < from.held.size(); ++at) {
        const py::object& value = from.held[at];
        if (!value || value.is_none()) {
            copy.held[at] = value;
        } else if (py::isinstance<py::tuple>(value)) {
            const auto all = py::reinterpret_borrow<py::tuple>(value);
            py::tuple copies(all.size());
            for (std::size_t i = 0; i < all.size(); ++i)
                copies[i] = deep_copy(made(all[i].cast<const Struct&>()));
            copy.held[at] = std::move(copies);
        } else {
            copy.held[at] = deep_copy(made(value.cast<const Struct&>()));
        }
    }
    return copied;
}

}  // namespace

// ---- Struct.

Struct::Struct(const Type& of, const void* from) : type(&of), object(of.copy(from)), held(of.table.size()) {
    for (std::size_t at = 0; at < held.size(); ++at)
        if (const Field& row = of.table[at]; is_struct(row) && !is_hidden(of, row))
            held[at] = held_from(row, object);
}

Struct::~Struct() {
    if (type != nullptr) type->destroy(object);
}

void Struct::copy_to(void* to, Storage& storage) const {
    type->assign(to, object);
    for (std::size_t at = 0; at < held.size(); ++at) {
        if (!held[at]) continue;
        const Field& row = type->table[at];
        if (row.count != nullptr) {
            std::vector<const Struct*> elements;
            for (const py::handle each : py::reinterpret_borrow<py::tuple>(held[at]))
                elements.push_back(as_struct(each));
            const auto span = std::find_if(type->spans.begin(), type->spans.end(), [&](const SpanRow& each) {
                return std::string_view(each.name) == row.name;
            });
            if (span != type->spans.end()) {
                span->set(to, elements, storage);
                continue;
            }
            if (row.resize != nullptr) row.resize(to, elements.size());
            for (std::size_t i = 0; i < elements.size(); ++i)
                elements[i]->copy_to(row.address_in(to, i), storage);
        } else if (held[at].is_none()) {
            row.resize(to, 0);
        } else {
            const Struct& nested = *as_struct(held[at]);
            if (row.type == FieldType::Kind) {
                std::size_t kind = 0;
                while (row.kinds[kind].table != nested.type->table_of) ++kind;
                row.set(to, {static_cast<double>(kind)});
            } else if (row.resize != nullptr) {
                row.resize(to, 1);
            }
            nested.copy_to(row.address_in(to), storage);
        }
    }
}

const Struct& struct_of(const Type& type, py::handle given, const char* what) {
    const Struct* const object = as_struct(given);
    if (object == nullptr || object->type != &type)
        throw py::type_error(std::string(what) + " must be a " + type.name + ", got " + shown(given));
    return *object;
}

py::object make(const Type& type, const void* from) {
    py::object made = py::handle(reinterpret_cast<PyObject*>(type.python))();
    auto& fresh = made.cast<Struct&>();
    type.assign(fresh.object, from);
    for (std::size_t at = 0; at < fresh.held.size(); ++at)
        if (fresh.held[at]) fresh.held[at] = held_from(type.table[at], fresh.object);
    return made;
}

py::object with_arguments(const Type& type, py::handle given, const py::dict& arguments, const char* what) {
    py::object made = given.is_none() ? make(type, type.fresh()) : deep_copy(struct_of(type, given, what));
    set_all(made.cast<Struct&>(), arguments, what);
    return made;
}

void bind_type(py::module_& module, Type& type) {
    type.cpp = short_name(type.cpp);
    const py::object base = py::type::of<Struct>();
    py::dict members;
    members["__slots__"] = py::tuple();
    members["__module__"] = module.attr("__name__");
    members["__doc__"] = help(type.cpp);
    members["__hash__"] = py::none();
    const py::object property = py::module_::import("builtins").attr("property");
    for (std::size_t at = 0; at < type.table.size(); ++at) {
        const Field& row = type.table[at];
        if (is_hidden(type, row)) continue;
        if (row.type == FieldType::Choice && !enumerations().contains(row.in_code)) {
            const std::size_t colon = row.in_code.rfind(':');
            bind_enum(module, std::string(row.in_code.substr(colon + 1)).c_str(), row.in_code, row.choices);
        }
        const Type* const of = &type;
        const std::string text = help(std::string(type.cpp) + "." + row.name);
        members[name_of(row).c_str()] =
            property(py::cpp_function(
                         [of, at](const py::object& self) { return get(struct_of(*of, self, "self"), at); }),
                     py::cpp_function([of, at](const py::object& self, const py::object& given) {
                         struct_of(*of, self, "self");
                         set(self.cast<Struct&>(), at, given);
                     }),
                     py::none(), text);
    }
    const py::object made = py::type::of(base)(type.name, py::make_tuple(base), members);
    type.python = reinterpret_cast<PyTypeObject*>(made.ptr());
    types().emplace(type.python, &type);
    module.attr(type.name.c_str()) = made;
}

namespace {

/// The subclass says which struct it is.
void construct(py::detail::value_and_holder& self, const py::dict& members) {
    const Type& type =
        type_of_class(reinterpret_cast<PyObject*>(Py_TYPE(reinterpret_cast<PyObject*>(self.inst))));
    auto fresh = std::make_unique<Struct>(type, type.fresh());
    set_all(*fresh, members, type.name);
    if (self.value_ptr() != nullptr) throw py::type_error(type.name + " is made already");
    self.value_ptr() = fresh.release();
}

}  // namespace

void bind_structs(py::module_& module) {
    py::class_<Struct> base(module, "Struct", help("Struct"));
    base.def(
        "__init__",
        [](py::detail::value_and_holder& self, const py::kwargs& members) { construct(self, members); },
        py::detail::is_new_style_constructor());
    base.def("__repr__", [](const Struct& self) { return repr_of(made(self)); });
    base.def("__eq__", [](const Struct& self, const py::object& other) -> py::object {
        const Struct* const given = as_struct(other);
        if (given == nullptr) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
        return py::bool_(same(made(self), *given));
    });
    base.attr("__hash__") = py::none();
    base.def(
        "copy", [](const Struct& self) { return deep_copy(made(self)); }, help("Struct.copy"));
    base.def("__copy__", [](const Struct& self) { return deep_copy(made(self)); });
    base.def("__deepcopy__", [](const Struct& self, const py::object&) { return deep_copy(made(self)); });
    base.def("__getstate__", [](const Struct& self) { return changed_members(made(self)); });
    base.def("__setstate__", construct, py::detail::is_new_style_constructor());
}

}  // namespace tendril::python
