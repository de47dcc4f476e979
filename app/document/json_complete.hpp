// json.hpp with the type complete, for sources that look into JSON. No other header includes this one: it
// takes a compiler more than a second.
#pragma once

#include <nlohmann/json.hpp>

#include "app/document/json.hpp"
