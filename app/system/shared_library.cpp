#include "app/system/shared_library.hpp"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include <stdexcept>

namespace tendril::app {
namespace {

#ifdef _WIN32
void* open_library(const char* name) {
    return reinterpret_cast<void*>(::LoadLibraryA(name));
}

void* find_symbol(void* library, const char* name) {
    return reinterpret_cast<void*>(::GetProcAddress(reinterpret_cast<HMODULE>(library), name));
}
#else
void* open_library(const char* name) {
    // Local: several Mesa libraries define the same GL names and must not share them.
    return ::dlopen(name, RTLD_NOW | RTLD_LOCAL);
}

void* find_symbol(void* library, const char* name) {
    return ::dlsym(library, name);
}
#endif

}  // namespace

SharedLibrary::SharedLibrary(std::initializer_list<const char*> names) {
    std::string tried;
    for (const char* name : names) {
        handle_ = open_library(name);
        if (handle_ != nullptr) {
            name_ = name;
            return;
        }
        tried += (tried.empty() ? "" : ", ") + std::string(name);
    }
    throw std::runtime_error("none of these libraries could be opened: " + tried);
}

// Never unloaded: Mesa's compiler threads and exit handlers would not survive it.
SharedLibrary::~SharedLibrary() = default;

void* SharedLibrary::find(const char* name) const {
    void* const symbol = find_symbol(handle_, name);
    if (symbol == nullptr) throw std::runtime_error(name_ + " has no " + name);
    return symbol;
}

}  // namespace tendril::app
