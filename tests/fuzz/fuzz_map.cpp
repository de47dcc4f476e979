// A bone map's file is refused with a std::runtime_error that names it, or reads back unchanged.
#include "app/io/character/map_file.hpp"
#include "app/io/character/stick_figure.hpp"
#include "tests/fuzz/check.hpp"

FUZZ_TARGET(map) {
    using namespace tendril;
    static const app::Character figure = app::stick_figure();
    app::SavedMap map;
    try {
        map = app::parse_map(text, "it");
    } catch (const std::runtime_error& error) {
        fuzz::check(std::string_view(error.what()).starts_with("it: "), "a refusal names the file");
        return;
    }
    fuzz::check(app::parse_map(app::map_text(map), "it") == map, "what was read is written the same");
    try {
        app::applied(map, figure.skeleton);
    } catch (const std::runtime_error&) {
        // Names that the figure does not have.
    }
}
