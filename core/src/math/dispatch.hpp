// Vector units (Highway calls them targets) and the functions that Highway compiled for each of them. Include
// it before <hwy/foreach_target.h>: it also says for which units nothing is compiled. Not installed.
//
// A file with such functions defines HWY_TARGET_INCLUDE as its own name and includes <hwy/foreach_target.h>,
// which compiles it again for each unit, each time with another HWY_NAMESPACE. At its end, under HWY_ONCE,
// HWY_EXPORT(f) lists what was compiled of f, and TENDRIL_COMPILED_FOR(f, target) is the one for a unit.
#pragma once

#include <cstddef>
#include <cstdint>

// Adds nothing for floats and doubles, and some versions do not compile with it as the baseline
// (-march=native).
#ifdef TENDRIL_FEW_VECTOR_UNITS  // one wide and one narrow, for builds in which each takes minutes
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_AVX3 | HWY_SSE4 | HWY_SSSE3)
#else
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#endif
#include <hwy/targets.h>

namespace tendril::detail {

/// Calls it with each unit that the machine has and the library was compiled for, the widest first.
template <class Call>
void for_each_target(Call call) {
    std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    if (targets == 0) targets = HWY_STATIC_TARGET;
    for (; targets != 0; targets &= targets - 1) call(targets & -targets);  // a lower bit is a better target
}

/// Where Highway's tables of functions have this unit's.
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
