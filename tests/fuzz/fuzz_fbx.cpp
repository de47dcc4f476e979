// An FBX file is refused with a std::runtime_error that names it, or is a character that can be played.
#include "app/io/character/fbx/fbx.hpp"
#include "tests/fuzz/character.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tendril;
    const std::string_view text = fuzz::text_of(data, size);
    fuzz::check_character([&] { return app::parse_fbx(text, "it"); });
    return 0;
}
