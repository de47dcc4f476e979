// Our parser accepts the same texts as the JSON library, with the same values, unless they are nested too
// deep; and finds a line for any path.
#include "app/io/json_complete.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril::app;
using tendril::fuzz::check;

FUZZ_TARGET(json) {
    Json ours;
    try {
        ours = parse_json(text);
    } catch (const ParseError& error) {
        const bool deep = error.reason.find("deeper") != std::string::npos;
        check(deep || !Json::accept(text), "what the library reads, we read");
        check(error.line >= 1, "an error has a line");
        return;
    }
    // Compared without order: both keep the last of repeated members, but at different positions.
    const auto theirs = nlohmann::json::parse(text);
    check(nlohmann::json::parse(ours.dump()) == theirs, "our value is the library's");
    check(parse_json(json_to_text(ours)) == ours, "text for people reads back the same");
    json_summary(ours);
    for (const char* path : {"a", "a.b", "0", "0.0.0", "labs.chain.segments.0", "."}) json_line(text, path);
}
