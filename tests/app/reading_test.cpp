// The pages that lead a reader through the sources: every file, function, type and command that they name is
// there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/app/support/temp_folder.hpp"

namespace tendril::test {
namespace {

namespace fs = std::filesystem;

const fs::path top = TENDRIL_SOURCE_DIR;

/// The texts of all sources.
const std::vector<std::string>& sources() {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> all;
        for (const char* folder : {"app", "core", "tests"})
            for (const auto& entry : fs::recursive_directory_iterator(top / folder))
                if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
                    all.push_back(read(entry.path()));
        return all;
    }();
    return texts;
}

bool is_word_letter(char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c));
}

/// Whether `text` has the whole word, followed by `after`.
bool has_word(const std::string& text, const std::string& word, const std::string& after = "") {
    for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const auto end = at + word.size();
        const bool whole =
            (at == 0 || !is_word_letter(text[at - 1])) && (end == text.size() || !is_word_letter(text[end]));
        if (whole && text.compare(end, after.size(), after) == 0) return true;
    }
    return false;
}

bool some_source_has(const std::string& word, const std::string& after = "") {
    return std::any_of(sources().begin(), sources().end(),
                       [&](const std::string& text) { return has_word(text, word, after); });
}

/// "Lab::handles": in one source with both words.
bool is_member(const std::string& owner, const std::string& member) {
    return std::any_of(sources().begin(), sources().end(), [&](const std::string& text) {
        return has_word(text, owner) && has_word(text, member);
    });
}

/// From the top of the project, beside the page, or as sources include it.
bool is_path(const fs::path& page, const std::string& name) {
    for (const fs::path& from : {top, page.parent_path(), top / "core/include", top / "core/include/tendril"})
        if (fs::exists(from / name)) return true;
    return false;
}

/// What a name in backticks claims, and whether it holds; what claims nothing (an option, a line of code)
/// holds.
bool holds(const fs::path& page, std::string name) {
    static const std::regex path(R"([\w.-]+/[\w./-]*|[\w-]+\.(hpp|cpp|md|cmake|json|png|jsonl))"),
        command(R"([a-z]+\.[a-z_]+)"), member(R"(([\w:]+)::(\w+)(\(\))?)"), function(R"((\w+)\(\))"),
        type(R"([A-Z]\w*[a-z]\w*)");
    std::smatch found;
    if (std::regex_match(name, path)) return is_path(page, name);
    if (std::regex_match(name, command)) return some_source_has(name);
    if (std::regex_match(name, found, member)) {
        const std::string owner = found[1].str();
        return is_member(owner.substr(owner.rfind(':') == owner.npos ? 0 : owner.rfind(':') + 1), found[2]);
    }
    if (std::regex_match(name, found, function)) return some_source_has(found[1], "(");
    if (std::regex_match(name, type)) return some_source_has(name);
    return true;
}

/// What stands in backticks, but for blocks of code.
std::vector<std::string> names_in(const std::string& text) {
    std::vector<std::string> names;
    const std::string prose = std::regex_replace(text, std::regex("```[^`]*```"), "");
    static const std::regex quoted("`([^`\n]+)`");
    for (std::sregex_iterator each(prose.begin(), prose.end(), quoted), end; each != end; ++each)
        names.push_back((*each)[1]);
    return names;
}

std::vector<fs::path> pages() {
    std::vector<fs::path> found;
    for (const char* page : {"app/labs/README.md", "core/README.md"})
        if (fs::exists(top / page)) found.push_back(top / page);
    return found;
}

TEST(Reading, EveryNameInThePagesIsThere) {
    ASSERT_FALSE(pages().empty());
    for (const fs::path& page : pages()) {
        const std::vector<std::string> names = names_in(read(page));
        EXPECT_GE(names.size(), 20u) << page;
        for (const std::string& name : names)
            EXPECT_TRUE(holds(page, name)) << page << " names `" << name << '`';
    }
}

TEST(Reading, ANameThatIsNotThereIsFound) {
    const fs::path page = top / "app/labs/README.md";
    for (const char* name : {"app/app.cpp", "lab.hpp", "Lab", "Lab::handles", "Pointer::drag()",
                             "make_command_table()", "chain.target", "--headless", "int x = 3;"})
        EXPECT_TRUE(holds(page, name)) << name;
    for (const char* name : {"app/no_such.cpp", "no_such.hpp",
                             "NoSuchThing"
                             "AtAll",
                             "Lab::no_such"
                             "_member",
                             "no_such"
                             "_function()",
                             "chain.no_such"
                             "_command"})
        EXPECT_FALSE(holds(page, name)) << name;
}

/// Its code is code of the sources, so that it cannot fall behind them.
TEST(Reading, CodeOnTheLabsPageStandsInTheSources) {
    const auto squeezed = [](const std::string& text) {
        return std::regex_replace(text, std::regex(R"(\s+)"), " ");
    };
    std::vector<std::string> texts;
    for (const std::string& text : sources()) texts.push_back(squeezed(text));
    const std::string text = read(top / "app/labs/README.md");
    static const std::regex block("```cpp\n([^`]*)```");
    for (std::sregex_iterator each(text.begin(), text.end(), block), end; each != end; ++each) {
        const std::string code = squeezed((*each)[1]);
        const bool stands = std::any_of(texts.begin(), texts.end(), [&](const std::string& source) {
            return source.find(code) != source.npos;
        });
        EXPECT_TRUE(stands) << "code that no source has:\n" << (*each)[1];
    }
}

}  // namespace
}  // namespace tendril::test
