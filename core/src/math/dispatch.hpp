// Vector units (Highway calls them targets) and the functions that Highway compiled for each of them. Include
// this before <hwy/foreach_target.h>, because it also disables some units. Not installed.
//
// A file with such functions begins with math/each_target-inl.hpp. At its end, under HWY_ONCE, HWY_EXPORT(f)
// lists the compiled versions of f, and TENDRIL_COMPILED_FOR(f, target) is the one for a unit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

// AVX3_DL adds nothing for floats and doubles, and some versions do not compile with it as the baseline
// (-march=native).
#ifdef TENDRIL_FEW_VECTOR_UNITS  // one wide and one narrow, for builds in which each takes minutes
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_AVX3 | HWY_SSE4 | HWY_SSSE3)
#else
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#endif
#include <hwy/targets.h>

namespace tendril::detail {

/// Calls `call` with each unit that the machine has and the library was compiled for, widest first.
template <class Call>
void for_each_target(Call call) {
    std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    if (targets == 0) targets = HWY_STATIC_TARGET;
    for (; targets != 0; targets &= targets - 1) call(targets & -targets);  // a lower bit is a better target
}

/// The unit with this name, or the widest one if the name is empty; 0 if there is none.
inline std::int64_t target_named(std::string_view name) {
    std::int64_t found = 0;
    for_each_target([&](std::int64_t target) {
        if (found == 0 && (name.empty() || name == hwy::TargetName(target))) found = target;
    });
    return found;
}

/// Index of this unit in Highway's dispatch tables.
inline std::size_t table_index(std::int64_t target) {
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    return chosen.GetIndex();
}

}  // namespace tendril::detail

#if HWY_TARGETS == HWY_STATIC_TARGET
#define TENDRIL_COMPILED_FOR(function, target) (static_cast<void>(target), HWY_STATIC_DISPATCH(function))
#else
#define TENDRIL_COMPILED_FOR(function, target) \
    (HWY_DISPATCH_TABLE(function)[::tendril::detail::table_index(target)])
#endif
