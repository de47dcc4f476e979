#include "tests/places.hpp"

#include <cstdlib>

namespace tendril::test {

std::string source_path(const std::string& name) {
    return TENDRIL_SOURCE_DIR "/" + name;
}

std::filesystem::path characters_folder() {
    return TENDRIL_CHARACTERS_DIR;
}

std::filesystem::path found_path(const std::string& name) {
    return std::filesystem::path(TENDRIL_FOUND_DIR) / name;
}

std::filesystem::path reference_path(const std::string& name) {
    const char* const folder = std::getenv("TENDRIL_REFERENCE_DIR");
    return std::filesystem::path(folder ? folder : TENDRIL_REFERENCE_DIR) / name;
}

}  // namespace tendril::test
