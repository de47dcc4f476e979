// A library loaded at run time, so that the program starts without it installed.
#pragma once

#include <initializer_list>
#include <string>

namespace tendril::app {

class SharedLibrary {
  public:
    /// Opens the first of the names that exists; throws std::runtime_error naming them all if none does.
    explicit SharedLibrary(std::initializer_list<const char*> names);
    ~SharedLibrary();
    SharedLibrary(const SharedLibrary&) = delete;
    SharedLibrary& operator=(const SharedLibrary&) = delete;

    /// The function of that name; throws std::runtime_error if the library has none.
    template <typename Function>
    Function get(const char* name) const {
        return reinterpret_cast<Function>(find(name));
    }

  private:
    void* find(const char* name) const;

    void* handle_ = nullptr;
    std::string name_;
};

}  // namespace tendril::app
