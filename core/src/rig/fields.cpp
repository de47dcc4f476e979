// The tables of definitions, elements, units and their operations.
#include "tendril/fields.hpp"

#include "tendril/magnitude.hpp"
#include "tendril/rig/definition.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril {
namespace {

using namespace rig;

constexpr const char* operation_names[] = {"aim",
                                           "aim_math",
                                           "parent_constraint",
                                           "offset_transform",
                                           "set_transform",
                                           "set_rotation",
                                           "project_to_parent",
                                           "from_two_vectors",
                                           "transform_location",
                                           "transform_direction",
                                           "for_each",
                                           "alpha_interpolate",
                                           "spring_interpolate",
                                           "evaluate_curve",
                                           "set_curve",
                                           "two_bone",
                                           "fabrik",
                                           "spline"};
static_assert(std::size(operation_names) == std::variant_size_v<Operation::Variant>);
constexpr const char *targets[] = {"location", "direction"}, *spaces[] = {"local", "global"},
                     *element_kinds[] = {"bone", "null", "control"}, *axes[] = {"x", "y", "z"},
                     *control_kinds[] = {"transform", "position", "rotation", "float", "bool", "vector2d"};

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr FieldRange any{-static_cast<double>(max_magnitude), static_cast<double>(max_magnitude)};
constexpr FieldRange positive{0.0, any.high}, part{0.0, 1.0};

template <class T>
struct Access {
    using In = Input<T>;

    static const In& in(const void* at) noexcept { return *static_cast<const In*>(at); }
    static constexpr std::optional<Type> type() {
        if constexpr (std::is_same_v<T, bool>) return Type::Bool;
        if constexpr (std::is_same_v<T, double>) return Type::Number;
        if constexpr (std::is_same_v<T, glm::dvec3>) return Type::Vector;
        if constexpr (std::is_same_v<T, glm::dquat>) return Type::Rotation;
        if constexpr (std::is_same_v<T, Transform>) return Type::Transform;
        return std::nullopt;
    }
    static Input<Value> get(const void* at) {
        return std::visit([](const auto& source) { return Input<Value>(source); }, in(at).source);
    }
    static void set(void* at, const Input<Value>& given) {
        In& input = *static_cast<In*>(at);
        std::visit(
            [&]<class Source>(const Source& source) {
                if constexpr (!std::is_same_v<Source, Value>)
                    input = source;
                else if constexpr (std::is_same_v<T, Value>)
                    input = source;
                else
                    input = std::get<T>(source);
            },
            given.source);
    }
    static bool same(const void* a, const void* b) { return in(a) == in(b); }
    /// A literal's numbers: a number as {x, NaN, NaN, NaN}, a vector as {x, y, z, 0}.
    static FieldValue number(const void* at) noexcept {
        FieldValue all{no_value, no_value, no_value, no_value};
        const T* const literal = in(at).literal();
        if (literal == nullptr) return all;
        const double* number = nullptr;
        const glm::dvec3* vector = nullptr;
        if constexpr (std::is_same_v<T, double>) number = literal;
        if constexpr (std::is_same_v<T, glm::dvec3>) vector = literal;
        if constexpr (std::is_same_v<T, Value>)
            number = std::get_if<double>(literal), vector = std::get_if<glm::dvec3>(literal);
        if (number != nullptr) all[0] = *number;
        if (vector != nullptr) all = {vector->x, vector->y, vector->z, 0.0};
        return all;
    }
    /// Checks numbers and vectors only; the resolver checks rotations and transforms.
    static bool fits(const Field& row, const void* at) noexcept {
        const T* const literal = in(at).literal();
        if (literal == nullptr) return true;
        const auto number = [&](double value) { return row.in_range(value); };
        const auto vector = [&](const glm::dvec3& v) { return number(v.x) && number(v.y) && number(v.z); };
        if constexpr (std::is_same_v<T, double>) return number(*literal);
        if constexpr (std::is_same_v<T, glm::dvec3>) return vector(*literal);
        if constexpr (std::is_same_v<T, Value>) {
            if (const auto* const held = std::get_if<double>(literal)) return number(*held);
            if (const auto* const held = std::get_if<glm::dvec3>(literal)) return vector(*held);
        }
        return true;
    }
};
template <class T>
constexpr InputAccess access_to{
    {Access<T>::same}, InputAccess::Takes::Any, Access<T>::type(), Access<T>::get, Access<T>::set};

template <class T>
struct InputType;
template <class T>
struct InputType<Input<T>> : Access<T> {
    static constexpr const InputAccess* access = &access_to<T>;
};

/// A table row for an input, which may be optional.
template <auto member>
constexpr Field input(const char* name, FieldRange range = any, const char* unit = "") noexcept {
    using Member = tendril::detail::ValueOf<member>;
    using Of = InputType<typename tendril::detail::FieldOptional<Member>::type>;
    Field row{.name = name, .unit = unit, .type = FieldType::Other, .exact = true, .range = range};
    row.optional = tendril::detail::FieldOptional<Member>::value;
    row.get = Of::number, row.fits = Of::fits, row.access = Of::access;
    row.address = tendril::detail::struct_address<member>;
    if constexpr (tendril::detail::FieldOptional<Member>::value)
        row.resize = tendril::detail::resize_struct<member>;
    return row;
}

template <class T>
bool same_value(const void* a, const void* b) noexcept {
    return *static_cast<const T*>(a) == *static_cast<const T*>(b);
}
constexpr InputAccess item_access{
    {same_value<Item>},
    InputAccess::Takes::Item,
    {},
    [](const void* at) { return Input<Value>(FromElement{.element = *static_cast<const Item*>(at)}); },
    [](void* at, const Input<Value>& given) {
        *static_cast<Item*>(at) = std::get<FromElement>(given.source).element;
    }};
constexpr InputAccess transform_access{
    {same_value<Transform>},
    InputAccess::Takes::Literal,
    Type::Transform,
    [](const void* at) { return Input<Value>(Value(*static_cast<const Transform*>(at))); },
    [](void* at, const Input<Value>& given) {
        *static_cast<Transform*>(at) = std::get<Transform>(*given.literal());
    }};

/// A table row for an element. `of`: "bones" for the ends of a chain.
template <auto member>
constexpr Field item(const char* name, const char* of = "elements") noexcept {
    return {.name = name,
            .type = FieldType::Other,
            .of = of,
            .access = &item_access,
            .address = tendril::detail::struct_address<member>,
            .required = true};
}

template <class Op>
constexpr std::array<Field, 4> chain() noexcept {
    return {item<&Op::root>("root", "bones"), item<&Op::tip>("tip", "bones"),
            input<&Op::target>("target", any, "m"), input<&Op::pole_target>("pole_target", any, "m")};
}

}  // namespace

template <>
std::span<const Field> fields<AimInputs>() noexcept {
    static constexpr Field rows[] = {
        input<&AimInputs::axis>("axis"), input<&AimInputs::target>("target", any, "m"),
        field<&AimInputs::kind>("kind", targets), input<&AimInputs::weight>("weight", part)};
    return rows;
}

template <>
std::span<const Field> fields<Aim>() noexcept {
    static constexpr Field rows[] = {item<&Aim::item>("item"), nested<&Aim::primary>("primary"),
                                     nested<&Aim::secondary>("secondary"),
                                     input<&Aim::max_speed>("max_speed", positive, "deg/s")};
    return rows;
}

template <>
std::span<const Field> fields<AimMath>() noexcept {
    static constexpr Field rows[] = {
        input<&AimMath::transform>("transform"), nested<&AimMath::primary>("primary"),
        nested<&AimMath::secondary>("secondary"), input<&AimMath::max_speed>("max_speed", positive, "deg/s")};
    return rows;
}

template <>
std::span<const Field> fields<ParentInputs>() noexcept {
    static constexpr Field rows[] = {item<&ParentInputs::item>("item"),
                                     input<&ParentInputs::weight>("weight", positive)};
    return rows;
}

template <>
std::span<const Field> fields<TransformFilter>() noexcept {
    static constexpr Field rows[] = {list<&TransformFilter::translation>("translation"),
                                     list<&TransformFilter::rotation>("rotation"),
                                     list<&TransformFilter::scale>("scale")};
    return rows;
}

template <>
std::span<const Field> fields<ParentConstraint>() noexcept {
    static constexpr Field rows[] = {item<&ParentConstraint::item>("item"),
                                     list<&ParentConstraint::parents>("parents").up_to(1'000, 1).needed(),
                                     input<&ParentConstraint::maintain_offset>("maintain_offset"),
                                     nested<&ParentConstraint::filter>("filter")};
    return rows;
}

template <>
std::span<const Field> fields<OffsetTransform>() noexcept {
    static constexpr Field rows[] = {item<&OffsetTransform::item>("item"),
                                     input<&OffsetTransform::offset>("offset"),
                                     input<&OffsetTransform::propagate>("propagate")};
    return rows;
}

template <>
std::span<const Field> fields<SetTransform>() noexcept {
    static constexpr Field rows[] = {
        item<&SetTransform::item>("item"), input<&SetTransform::transform>("transform"),
        field<&SetTransform::space>("space", spaces), input<&SetTransform::propagate>("propagate")};
    return rows;
}

template <>
std::span<const Field> fields<SetRotation>() noexcept {
    static constexpr Field rows[] = {
        item<&SetRotation::item>("item"), input<&SetRotation::rotation>("rotation"),
        field<&SetRotation::space>("space", spaces), input<&SetRotation::propagate>("propagate")};
    return rows;
}

template <>
std::span<const Field> fields<ProjectToParent>() noexcept {
    static constexpr Field rows[] = {item<&ProjectToParent::child>("child"),
                                     item<&ProjectToParent::old_parent>("old_parent"),
                                     item<&ProjectToParent::new_parent>("new_parent")};
    return rows;
}

template <>
std::span<const Field> fields<FromTwoVectors>() noexcept {
    static constexpr Field rows[] = {input<&FromTwoVectors::from>("from"), input<&FromTwoVectors::to>("to")};
    return rows;
}

template <>
std::span<const Field> fields<TransformLocation>() noexcept {
    static constexpr Field rows[] = {input<&TransformLocation::transform>("transform"),
                                     input<&TransformLocation::location>("location", any, "m")};
    return rows;
}

template <>
std::span<const Field> fields<TransformDirection>() noexcept {
    static constexpr Field rows[] = {input<&TransformDirection::transform>("transform"),
                                     input<&TransformDirection::direction>("direction")};
    return rows;
}

template <>
std::span<const Field> fields<ForEach>() noexcept {
    static constexpr Field rows[] = {
        list<&ForEach::roots>("roots").up_to(1'000, 1).naming("elements").needed(),
        field<&ForEach::include_parent>("include_parent"), field<&ForEach::recursive>("recursive"),
        list<&ForEach::body>("body").up_to(2'000)};
    return rows;
}

template <>
std::span<const Field> fields<AlphaInterpolate>() noexcept {
    using Alpha = AlphaInterpolate;
    static constexpr Field rows[] = {input<&Alpha::value>("value"),
                                     input<&Alpha::map_range>("map_range"),
                                     field<&Alpha::in_range>("in_range", any),
                                     field<&Alpha::out_range>("out_range", any),
                                     input<&Alpha::scale>("scale"),
                                     input<&Alpha::bias>("bias"),
                                     input<&Alpha::clamp>("clamp"),
                                     input<&Alpha::clamp_min>("clamp_min"),
                                     input<&Alpha::clamp_max>("clamp_max"),
                                     input<&Alpha::interp>("interp"),
                                     input<&Alpha::speed_increasing>("speed_increasing", any, "1/s"),
                                     input<&Alpha::speed_decreasing>("speed_decreasing", any, "1/s")};
    return rows;
}

template <>
std::span<const Field> fields<SpringInterpolate>() noexcept {
    using Spring = SpringInterpolate;
    static constexpr Field rows[] = {
        input<&Spring::target>("target", any, "m"),
        input<&Spring::strength>("strength", {0.0, signal::max_strength}, "Hz"),
        input<&Spring::critical_damping>("critical_damping", {0.0, signal::max_damping}),
        input<&Spring::force>("force"),
        input<&Spring::target_velocity_amount>("target_velocity_amount", part)};
    return rows;
}

template <>
std::span<const Field> fields<EvaluateCurve>() noexcept {
    static constexpr Field rows[] = {input<&EvaluateCurve::value>("value"),
                                     nested<&EvaluateCurve::curve>("curve")};
    return rows;
}

template <>
std::span<const Field> fields<SetCurve>() noexcept {
    static constexpr Field rows[] = {field<&SetCurve::curve>("curve").naming("curves").needed(),
                                     input<&SetCurve::value>("value")};
    return rows;
}

template <>
std::span<const Field> fields<TwoBone>() noexcept {
    static constexpr auto rows = chain<TwoBone>();
    return rows;
}

template <>
std::span<const Field> fields<Fabrik>() noexcept {
    static constexpr auto rows = chain<Fabrik>();
    return rows;
}

template <>
std::span<const Field> fields<Spline>() noexcept {
    static constexpr Field rows[] = {
        item<&Spline::root>("root", "bones"),
        item<&Spline::tip>("tip", "bones"),
        list<&Spline::points>("points").up_to(4096, 2).naming("elements").needed(),
        input<&Spline::b_spline>("b_spline"),
        input<&Spline::fit>("fit"),
        input<&Spline::max_factor>("max_factor", {0.0, 100.0}),
        input<&Spline::up>("up"),
        input<&Spline::roll_start_deg>("roll_start_deg", any, "deg"),
        input<&Spline::roll_end_deg>("roll_end_deg", any, "deg")};
    return rows;
}

template <>
std::span<const Field> fields<Unit>() noexcept {
    static constexpr Field rows[] = {field<&Unit::name>("name").omissible(),
                                     kinds<&Unit::operation>("unit", operation_names).as_member("operation"),
                                     input<&Unit::weight>("weight", part), input<&Unit::when>("when"),
                                     field<&Unit::enabled>("enabled")};
    return rows;
}

namespace {

/// A bound of a control's range, stored as the numbers of the control's value.
constexpr Field bound(Field row, FieldType type) noexcept {
    row.type = type;
    return row.sparsely();
}
template <FieldType type>
constexpr Field minimum = bound(field<&Control::minimum>("minimum", any), type);
template <FieldType type>
constexpr Field maximum = bound(field<&Control::maximum>("maximum", any), type);
constexpr Field axes_row() noexcept {
    Field row = list<&Control::axes>("axes", {0.0, 2.0});
    row.type = FieldType::Choice, row.choices = axes;
    return row;
}
template <FieldType type>
std::span<const Field> range_rows() noexcept {
    static constexpr Field rows[] = {minimum<type>, maximum<type>};
    return rows;
}
std::span<const Field> vector2d_rows() noexcept {
    static constexpr Field rows[] = {axes_row(), minimum<FieldType::Pair>, maximum<FieldType::Pair>};
    return rows;
}
std::span<const Field> no_rows() noexcept {
    return {};
}
constexpr auto usual_control = tendril::detail::fresh<Control>;
/// In the order of ControlKind.
constexpr FieldKind controls[] = {{range_rows<FieldType::Point>, usual_control, {}},
                                  {range_rows<FieldType::Point>, usual_control, {}},
                                  {no_rows, usual_control, {}},
                                  {range_rows<FieldType::Number>, usual_control, {}},
                                  {no_rows, usual_control, {}},
                                  {vector2d_rows, usual_control, {}}};

std::optional<Control>& control_of(const void* element) noexcept {
    return const_cast<Element*>(static_cast<const Element*>(element))->control;
}
constexpr Field control_row{.name = "control",
                            .type = FieldType::Kind,
                            .optional = true,
                            .range = {0.0, 5.0},
                            .choices = control_kinds,
                            .get = [](const void* element) noexcept -> FieldValue {
                                const std::optional<Control>& control = control_of(element);
                                return {control ? static_cast<double>(control->kind) : no_value};
                            },
                            .set =
                                [](void* element, const FieldValue& kind) noexcept {
                                    control_of(element).reset();
                                    if (kind[0] >= 0.0 && kind[0] <= 5.0)
                                        control_of(element) = {.kind = static_cast<ControlKind>(kind[0])};
                                },
                            .kinds = controls,
                            .address = [](const void* element, std::size_t) noexcept -> const void* {
                                const std::optional<Control>& control = control_of(element);
                                return control ? &*control : nullptr;
                            }};

}  // namespace

template <>
std::span<const Field> fields<Element>() noexcept {
    static constexpr Field rows[] = {field<&Element::name>("name").needed(),
                                     field<&Element::kind>("kind", element_kinds),
                                     field<&Element::parent>("parent").naming("elements").sparsely(),
                                     {.name = "local",
                                      .type = FieldType::Other,
                                      .in_code = "initial",
                                      .access = &transform_access,
                                      .address = tendril::detail::struct_address<&Element::initial>},
                                     control_row};
    return rows;
}

template <>
std::span<const Field> fields<NamedCurve>() noexcept {
    static constexpr Field rows[] = {field<&NamedCurve::name>("name").needed(),
                                     field<&NamedCurve::value>("value", any).needed()};
    return rows;
}

template <>
std::span<const Field> fields<Definition>() noexcept {
    static constexpr Field rows[] = {list<&Definition::elements>("elements").needed(),
                                     list<&Definition::curves>("curves").needed(),
                                     list<&Definition::units>("units").needed()};
    return rows;
}

namespace rig {

const char* name(ElementKind kind) noexcept {
    return element_kinds[static_cast<std::size_t>(kind)];
}
const char* name(ControlKind kind) noexcept {
    return control_kinds[static_cast<std::size_t>(kind)];
}
const char* operation_name(std::size_t index) noexcept {
    return operation_names[index];
}

}  // namespace rig
}  // namespace tendril
