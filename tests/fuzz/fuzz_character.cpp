// A character's file is refused with a std::runtime_error that names it, or is a character that can be
// played. The build names the FORMAT.
#include "app/io/character/bvh.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "app/io/character/gltf.hpp"
#include "tests/app/io/sound_character.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril;

[[maybe_unused]] static app::Character read_bvh(std::string_view text) {
    return app::parse_bvh(text, "it");
}
[[maybe_unused]] static app::Character read_fbx(std::string_view text) {
    return app::parse_fbx(text, "it");
}
[[maybe_unused]] static app::Character read_gltf(std::string_view text) {
    return app::parse_gltf(text, "it", "/nowhere");
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    app::Character character;
    try {
        character = FORMAT(fuzz::text_of(data, size));
    } catch (const std::runtime_error& error) {
        fuzz::check(std::string_view(error.what()).starts_with("it"), "a refusal names the file");
        return 0;
    }
    const char* const fault = app::test_sound::fault_of(character);
    fuzz::check(fault == nullptr, fault ? fault : "");
    return 0;
}
