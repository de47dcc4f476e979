// A character's file is refused with a std::runtime_error that names it, or is a character that can be
// played.
#include "app/io/character/bvh.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "app/io/character/gltf.hpp"
#include "tests/app/io/sound_character.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril;

template <class Read>
static void fuzz_character(const Read& read) {
    app::Character character;
    try {
        character = read();
    } catch (const std::runtime_error& error) {
        fuzz::check(std::string_view(error.what()).starts_with("it"), "a refusal names the file");
        return;
    }
    const char* const fault = app::test_sound::fault_of(character);
    fuzz::check(fault == nullptr, fault ? fault : "");
}

FUZZ_TARGET(bvh) {
    fuzz_character([&] { return app::parse_bvh(text, "it"); });
}
FUZZ_TARGET(fbx) {
    fuzz_character([&] { return app::parse_fbx(text, "it"); });
}
FUZZ_TARGET(gltf) {
    fuzz_character([&] { return app::parse_gltf(text, "it", "/nowhere"); });
}
