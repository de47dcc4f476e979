// Words that must not come back: the glossary has one word for one thing, and these are the ones it replaced.
// A folder is listed once it is clean; what is listed stays clean: its identifiers, strings, comments and the
// names of its files.
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
using Places = std::vector<std::string>;

const fs::path project_top = TENDRIL_SOURCE_DIR;

// Folders and files from the top of the project that are clean.
const Places program{"app", "README.md"};
const Places chains{"app/labs/chain", "app/batch", "app/io"};
const Places ropes{"app/labs/rope", "core/src/rope", "core/include/tendril/rope"};
const Places solvers{"core/src/ik", "core/include/tendril/ik", "core/src/math"};
const Places reaching{"app/labs/chain",
                      "app/batch",
                      "app/io",
                      "core/src/chain",
                      "core/include/tendril/chain",
                      "core/src/ik",
                      "core/include/tendril/ik",
                      "core/src/math"};

/// A word as people would write it again, and what to write.
struct Rule {
    const Places& places;
    const char* word;       ///< a regular expression over plain(text)
    const char* write;      ///< the glossary's word
    const char* fine = "";  ///< a regular expression: where the word means something else
};

const std::vector<Rule>& rules() {
    static const std::vector<Rule> list{
        // the program
        {program, R"(carr(y|ied) (it )?away|\bcarry rows)", "Export"},
        {program, R"("begin with|begins with a ready|\bbegin with one of)", "Presets"},
        {program, R"(\blooks? inside\b|\blooking into a solve)", "Analyse"},
        {program, R"(\btime (stands|is paused|runs(?! up)))", "the simulation is paused, or running"},
        {program, R"(removes? what is selected)", "Delete selection"},
        {program, R"(pins( it)?, or lets)", "pin or unpin"},
        {program, R"(\bof 0 to\b)", "N of M"},
        {program, R"(\bis there already\b|\bsave once more\b)",
         "already exists. Press Save again to replace it"},
        {program, R"(%\.\d?f us\b|\bus/solve\b)", "µs"},
        {program, R"(\bm off\b)", "from the target"},
        {program, R"(\bbend (turns to )?faces?\b)", "pole target: what the elbow or knee points at"},
        {program, R"(\b(least|greatest)\b)", "minimum, maximum",
         R"(\b(at|damped) least\b|\bleast squares?\b|\bleast rotation\b)"},
        {program, R"(\bfabrik, plain\b|\bplain fabrik\b)", "FABRIK (2011)"},
        {program, R"(\b(torture|stress)\b)", "frame-time jitter; strain"},
        {program, R"(\bsheet (grid|links?)\b|\bclass sheet\b|\bsheets of cloth\b)", "cloth"},
        // chains and solvers
        {chains, R"(\b(links?|particles?|pieces?)\b)", "bone, joint", R"(\btarget link libraries\b)"},
        {reaching, R"(\b(kick(s|ed)?|bows?|shakes?|line trap)\b)", "perturbation; collinear singularity"},
        {chains, R"(\bhold (text|json|back)\b|\bholds? the (chain|tip) back\b)", "active limit"},
        {reaching, R"(\b(rooms?|settles?|settled|assumes?|polish(es|ed)?|careful)\b)",
         "workspace; active-set projection, clamp; refine; scalar fallback"},
        {reaching, R"(\b(lay|lays|laid|laying|relay)\b)", "place, commit, forward kinematics",
         R"(\blays? out\b)"},
        {chains, R"(\bcarry\b)", "parallel transport; move along"},
        {reaching, R"(\bcarr(ies|ied)\b)", "parallel transport; move along", R"(\bcarried along\b)"},
        {reaching, R"(\bpull(s|ed)? from the (tip|root)\b)", "forward reaching, backward reaching"},
        {solvers, R"(\b(hold back|progress)\b)", "active-set projection; convergence"},
        {solvers, R"(\b(greatest|spread|start again)\b)", "maximum; accelerate; restart"},
        // ropes
        {ropes, R"(\b(locks?|sheets?)\b)", "hair, cloth"},
        {ropes, R"(\b(rescues?|last push|push(ed|es|ing)? out|rooms?)\b)",
         "fallback; depenetration; workspace"},
        {ropes, R"(\bgiv(e|es|ing) way\b)", "quasi-static drag"},
        {ropes, R"(\bchoice\b)", "selection", R"(\bchoice (argument|field)\b)"},
    };
    return list;
}

/// Lower case, identifiers taken apart: "ropeChoice" and "rope_choice" are "rope choice". As many lines as
/// before.
std::string plain(const std::string& text) {
    std::string words;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        const bool hump = i > 0 && std::isupper(c) && std::islower(static_cast<unsigned char>(text[i - 1]));
        if (hump) words += ' ';
        words += c == '_' || c == '-' || c == '*' ? ' ' : static_cast<char>(std::tolower(c));
    }
    return words;
}

/// Each line with what follows it in the next one, so that a phrase is found across the end of a line; the
/// line after it begins no sooner than a comment's text does.
std::vector<std::string> lines_of(const std::string& text) {
    static const std::regex margin(R"(^[ \t/<!]*)");
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        const std::string next = std::regex_replace(lines[i + 1], margin, "");
        lines[i] += '\n';
        lines[i] += next.substr(0, next.find(' '));
    }
    return lines;
}

/// A regular expression's spaces as any white space, the end of a line among them.
std::string with_any_space(const std::string& expression) {
    return std::regex_replace(expression, std::regex(" "), "\\s");
}

struct Found {
    std::size_t line = 0;
    std::string word;
};

/// Where `text` has the rule's word. A line that says so is about scene files of version 1, whose words stay.
std::vector<Found> find(const Rule& rule, const std::string& text) {
    const std::regex word(with_any_space(rule.word)), fine(with_any_space(rule.fine));
    std::vector<Found> found;
    const std::vector<std::string> lines = lines_of(plain(text));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string line = lines[i];
        if (line.find("version 1") != line.npos) continue;
        if (*rule.fine != '\0') line = std::regex_replace(line, fine, "");
        std::smatch match;
        if (!std::regex_search(line, match, word)) continue;
        if (static_cast<std::size_t>(match.position()) >= line.find('\n')) continue;  // the next line's
        found.push_back({i + 1, match.str()});
    }
    return found;
}

bool is_text(const fs::path& file) {
    const std::string extension = file.extension().string();
    return extension == ".hpp" || extension == ".cpp" || extension == ".md" || extension == ".txt";
}

std::vector<fs::path> files_of(const std::string& place) {
    if (fs::is_regular_file(project_top / place)) return {project_top / place};
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(project_top / place))
        if (entry.is_regular_file() && is_text(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class Words : public testing::TestWithParam<std::size_t> {};

TEST_P(Words, DoNotComeBack) {
    const Rule& rule = rules()[GetParam()];
    for (const std::string& place : rule.places) {
        const std::vector<fs::path> files = files_of(place);
        ASSERT_FALSE(files.empty()) << place;
        for (const fs::path& file : files) {
            const std::string name = file.lexically_relative(project_top).generic_string();
            for (const Found& each : find(rule, read(file)))
                ADD_FAILURE() << name << ':' << each.line << " says \"" << each.word
                              << "\"; the glossary has: " << rule.write;
            EXPECT_TRUE(find(rule, name).empty()) << name << "; the glossary has: " << rule.write;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Rules, Words, testing::Range<std::size_t>(0, rules().size()));

/// Does a rule of these places refuse the text?
bool refused(const std::string& text, const Places& places) {
    return std::any_of(rules().begin(), rules().end(), [&](const Rule& rule) {
        const auto& ruled = rule.places;
        return std::find(ruled.begin(), ruled.end(), places.front()) != ruled.end() &&
               !find(rule, text).empty();
    });
}

TEST(WordsTest, FindsAWordInCodeTextAndComment) {
    for (const char* text :
         {"section(\"Carry away\");", "// what a chain looks like, carried\n// away from here",
          "constexpr float least_damping = 1;", "toast(\"Time stands: \" + why);", "\"%.0f us\"",
          "{\"delete\", \"Remove what is selected\"}", "reading(\"particle\", \"%zu of 0 to %zu\");"})
        EXPECT_TRUE(refused(text, program)) << text;
    for (const char* text : {"struct Piece {", "solve_piece(link);", "// shakes the chain", "hold_text(h)",
                             "// lays the chain\n// straight", "app/labs/chain/line_trap.cpp"})
        EXPECT_TRUE(refused(text, chains)) << text;
    for (const char* text :
         {"std::optional<RopeSelection> choice;", "\"sheet\"", "// pushed\n    /// out of it"})
        EXPECT_TRUE(refused(text, ropes)) << text;
}

TEST(WordsTest, LeavesOrdinaryEnglishAlone) {
    for (const char* text : {"at least two", "no time runs up", "least_squares", "// what is selected now",
                             "use us", "a m offset", "the camera stands still"})
        EXPECT_FALSE(refused(text, program)) << text;
    for (const char* text : {"target_link_libraries(game)", "std::piecewise_construct", "holds a float",
                             "the elbow", "layout", "broom"})
        EXPECT_FALSE(refused(text, chains)) << text;
    for (const char* text : {"choice_argument(\"pins\")", "gives a value", "block", "pushed",
                             "{\"rope\", \"sheet\", \"lock\"};  // version 1"})
        EXPECT_FALSE(refused(text, ropes)) << text;
}

}  // namespace
}  // namespace tendril::test
