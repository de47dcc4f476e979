// Fuzz targets for external input, in one program: --target=NAME chooses, which the fuzzer ignores.
#include <cstring>

#include "tests/fuzz/check.hpp"

namespace tendril::fuzz {
namespace {

const Target* first = nullptr;
const Target* chosen = nullptr;

}  // namespace

Target::Target(const char* called, void (*runs)(std::string_view)) : name(called), run(runs), next(first) {
    first = this;
}

}  // namespace tendril::fuzz

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    using namespace tendril::fuzz;
    std::string_view name;
    std::filesystem::path folder;  // the first one receives new inputs
    for (int i = 1; i < *count; ++i) {
        const std::string_view each = (*arguments)[i];
        if (each.starts_with("--target=")) name = each.substr(std::strlen("--target="));
        if (folder.empty() && std::filesystem::is_directory(each)) folder = each;
    }
    for (const Target* each = first; each != nullptr; each = each->next)
        if (each->name == name) chosen = each;
    if (chosen == nullptr) {
        std::fprintf(stderr, "there is no target \"%.*s\"; give --target= with one of:",
                     static_cast<int>(name.size()), name.data());
        for (const Target* each = first; each != nullptr; each = each->next)
            std::fprintf(stderr, " %s", each->name);
        std::fputc('\n', stderr);
        std::exit(2);
    }
    if (name == "scene" && !folder.empty()) write_scenes(folder);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tendril::fuzz::chosen->run({reinterpret_cast<const char*>(data), size});
    return 0;
}
