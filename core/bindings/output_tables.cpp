#include "output_tables.hpp"

#include "tendril/magnitude.hpp"

namespace tendril::ik {
namespace {

constexpr FieldRange anywhere{-max_magnitude, max_magnitude}, lengths{0.0, max_magnitude};

constexpr Field limb_rows[] = {
    field<&TwoBone::root>("root", anywhere, "m"), field<&TwoBone::mid>("mid", anywhere, "m"),
    field<&TwoBone::tip>("tip", anywhere, "m"), field<&TwoBone::upper>("upper", lengths, "m"),
    field<&TwoBone::lower>("lower", lengths, "m")};

}  // namespace
}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBone>() noexcept {
    return ik::limb_rows;
}
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBoneResult>() noexcept {
    using ik::TwoBoneResult;
    static const Field rows[] = {
        field<&TwoBoneResult::status>("status", field_of<&ik::Report::status>().choices),
        field<&TwoBoneResult::mid>("mid", ik::anywhere, "m"),
        field<&TwoBoneResult::tip>("tip", ik::anywhere, "m"),
        field<&TwoBoneResult::scale>("scale", {1.0, 100.0}),
        field<&TwoBoneResult::residual>("residual", ik::lengths, "m")};
    return rows;
}
