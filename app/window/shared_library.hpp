// A library opened while the program runs, so that the program starts where that library is not installed.
#pragma once

#include <initializer_list>
#include <string>

namespace tendril::app {

class SharedLibrary {
  public:
    /// Opens the first of the names that is there; throws std::runtime_error naming them where none is.
    explicit SharedLibrary(std::initializer_list<const char*> names);
    ~SharedLibrary();
    SharedLibrary(const SharedLibrary&) = delete;
    SharedLibrary& operator=(const SharedLibrary&) = delete;

    /// The function of that name; throws std::runtime_error where the library has none.
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
