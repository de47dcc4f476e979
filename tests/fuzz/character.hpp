// Properties that hold for the bytes of a character, whatever they are.
#pragma once

#include "tests/app/io/sound_character.hpp"
#include "tests/fuzz/check.hpp"

namespace tendril::fuzz {

/// `read` reads the bytes as the file "it". Either it refuses with a message that begins with that name, or
/// it returns a character that can be played.
template <class Read>
void check_character(const Read& read) {
    app::Character character;
    try {
        character = read();
    } catch (const std::runtime_error& error) {
        check(std::string_view(error.what()).starts_with("it"), "a refusal names the file");
        return;
    }
    const char* const fault = app::test_sound::fault_of(character);
    check(fault == nullptr, fault ? fault : "");
}

}  // namespace tendril::fuzz
