#include "app/widgets/emit.hpp"

#include "app/io/json_complete.hpp"

namespace tendril::app {

void Emit::operator()(std::string name, const ArgumentList& arguments) {
    commands_.push_back({std::move(name), to_json(arguments), false});
}

void Emit::continuously(std::string name, const ArgumentList& arguments) {
    commands_.push_back({std::move(name), to_json(arguments), true});
}

void Emit::typed(std::string name, SharedJson arguments) {
    commands_.push_back({std::move(name), std::move(arguments), false});
}

}  // namespace tendril::app
