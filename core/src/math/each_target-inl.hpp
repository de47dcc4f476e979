// The preamble of a file that Highway compiles once per vector unit, by including it repeatedly, each time
// with another HWY_NAMESPACE:
//
//     #define HWY_TARGET_INCLUDE "rope/grid_vector.cpp"  // its own name
//     #include "math/each_target-inl.hpp"
//
// Everything between HWY_BEFORE_NAMESPACE() and HWY_AFTER_NAMESPACE() is then compiled for each unit; at the
// end, under HWY_ONCE, see math/dispatch.hpp. Not installed.
#include "math/dispatch.hpp"
// foreach_target.h must come first: it includes the file again.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
