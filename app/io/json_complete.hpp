// json.hpp with the complete type, for sources that inspect JSON. No other header includes this one: it takes
// more than a second to compile.
#pragma once

#include <nlohmann/json.hpp>

#include "app/io/json.hpp"
