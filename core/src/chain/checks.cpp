#include "chain/checks.hpp"

namespace tendril::detail {

Result check_segment(std::string_view operation, const Argument& argument, const Segment& value) noexcept {
    if (const Result bad =
            check_point(operation, {argument.name, argument.index, "position"}, value.position);
        !bad) {
        return bad;
    }
    return check_length(operation, {argument.name, argument.index, "length"}, value.length);
}

}  // namespace tendril::detail
