#include "app/window/shared_library.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace tendril::app {

SharedLibrary::SharedLibrary(std::initializer_list<const char*> names) {
    std::string tried;
    for (const char* name : names) {
        // Local: several Mesa libraries define the same GL names and must not share them.
        handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (handle_ != nullptr) {
            name_ = name;
            return;
        }
        tried += (tried.empty() ? "" : ", ") + std::string(name);
    }
    throw std::runtime_error("none of these libraries could be opened: " + tried);
}

// Stays open on purpose: Mesa's compiler threads and exit handlers don't survive being unloaded.
SharedLibrary::~SharedLibrary() = default;

void* SharedLibrary::find(const char* name) const {
    void* const symbol = dlsym(handle_, name);
    if (symbol == nullptr) throw std::runtime_error(name_ + " has no " + name);
    return symbol;
}

}  // namespace tendril::app
