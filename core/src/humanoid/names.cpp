#include "humanoid/names.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace tendril::humanoid::detail {
namespace {

bool is_upper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool is_lower(char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0;
}
bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Bone names of MikuMikuDance, longer ones first.
constexpr std::pair<std::string_view, std::string_view> japanese[]{
    {"センター", "pelvis"}, {"上半身", "spine"}, {"下半身", "lower half"},
    {"つま先", "toe"},      {"足先", "toe"},     {"手首", "wrist"},
    {"足首", "ankle"},      {"親指", "thumb"},   {"人指", "index"},
    {"人差指", "index"},    {"中指", "middle"},  {"薬指", "ring"},
    {"小指", "little"},     {"ひじ", "elbow"},   {"ひざ", "knee"},
    {"ＩＫ", "ik"},         {"左", "left"},      {"右", "right"},
    {"腰", "pelvis"},       {"首", "neck"},      {"頭", "head"},
    {"肩", "clavicle"},     {"腕", "upperarm"},  {"足", "upperleg"},
    {"捩", "twist"},        {"目", "eye"},       {"髪", "hair"}};

std::string in_english(std::string_view name) {
    std::string text;
    while (!name.empty()) {
        const auto known = std::find_if(std::begin(japanese), std::end(japanese),
                                        [&](const auto& each) { return name.starts_with(each.first); });
        if (known == std::end(japanese)) {
            text += name.front();
            name.remove_prefix(1);
        } else {
            text.append(" ").append(known->second).append(" ");
            name.remove_prefix(known->first.size());
        }
    }
    return text;
}

/// Lower-case words, split at separators, capitals and digits. "LHipJoint_01": l hip joint 01
std::vector<std::string> words_of(std::string_view original) {
    if (const std::size_t colon = original.find_last_of(":|");
        colon != original.npos && colon + 1 < original.size())
        original.remove_prefix(colon + 1);
    const std::string name = in_english(original);
    std::vector<std::string> words;
    bool fresh = true;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i], before = i > 0 ? name[i - 1] : ' ',
                   after = i + 1 < name.size() ? name[i + 1] : ' ';
        if (!std::isalnum(static_cast<unsigned char>(c))) {
            fresh = true;
            continue;
        }
        if (is_upper(c) && (is_lower(before) || (is_upper(before) && is_lower(after)))) fresh = true;
        if (is_digit(c) != is_digit(before)) fresh = true;
        if (fresh) words.emplace_back();
        fresh = false;
        words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return words;
}

/// True if a blank-separated list contains the word.
bool is_one_of(std::string_view word, std::string_view list) {
    for (std::size_t at = list.find(word); at != list.npos; at = list.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || list[at - 1] == ' ') && (end == list.size() || list[end] == ' '))
            return !word.empty();
    }
    return false;
}

/// Words in the names of nodes that are not bones of the body.
constexpr std::string_view not_bones =
    "twist roll helper ik pole poletarget target end leaf tip nub top socket attach "
    "weapon prop hair skirt cloth cape tail ear eye eyes brow jaw mouth lip tongue "
    "teeth nose cheek face breast finger fingers thumb index ring pinky little pinkie "
    "mid palm metacarpal carpal wing muscle share tweak fk ctrl control mch site "
    "camera light holder effector goal ankleroll sec";
/// Words to ignore in a name.
constexpr std::string_view fillers =
    "mixamorig bip biped def org valve j b cc base bone bn jnt rig armature character "
    "c m jt skel sk bones human center g x bend stretch avg";

/// The remaining words of a name, joined.
constexpr std::pair<Part, std::string_view> dictionary[]{
    {Part::Hips, "hips hip pelvis"},
    {Part::Spine,
     "spine chest upperchest lowerback torso abdomen waist ribcage thorax back "
     "upperback ab lumbar abdomenlower abdomenupper chestlower chestupper lowerspine "
     "upperspine spineupper spinelower spinenavel spinechest uppertorso ribs"},
    {Part::Neck, "neck lowerneck upperneck necklower neckupper"},
    {Part::Head, "head"},
    {Part::Shoulder, "clavicle collar collarbone clav scapula shoulderjoint"},
    {Part::ShoulderArm, "shoulder"},
    {Part::Arm, "arm"},
    {Part::UpperArm, "upperarm uparm uarm armupper shldr bicep humerus"},
    {Part::LowerArm, "lowerarm lowarm loarm armlower forearm farm elbow radius ulna"},
    {Part::Hand, "hand wrist"},
    {Part::Leg, "leg"},
    {Part::UpperLeg, "upperleg upleg legupper thigh femur"},
    {Part::LowerLeg, "lowerleg lowleg loleg leglower calf shin knee tibia fibula"},
    {Part::Foot, "foot ankle"},
    {Part::Toes, "toe toes toebase ball"}};

Part part_of(std::string_view text) {
    for (const auto& [part, words] : dictionary)
        if (is_one_of(text, words)) return part;
    return Part::None;
}

Side side_of(std::string_view word) {
    if (word == "l" || word == "left" || word == "lft" || word == "lf") return Side::Left;
    if (word == "r" || word == "right" || word == "rgt" || word == "rt" || word == "rf") return Side::Right;
    return Side::None;
}

/// Removes a side that has no separator: "leftarm", "lthigh", "handr".
Side take_side(std::string& text) {
    for (const std::string_view side : {"left", "right", "l", "r"}) {
        const bool before = text.starts_with(side), after = text.ends_with(side);
        if (before && part_of(std::string_view(text).substr(side.size())) != Part::None) {
            text.erase(0, side.size());
            return side_of(side);
        }
        if (after && part_of(std::string_view(text).substr(0, text.size() - side.size())) != Part::None) {
            text.resize(text.size() - side.size());
            return side_of(side);
        }
    }
    return Side::None;
}

}  // namespace

std::string common_word(const Skeleton& skeleton) {
    std::map<std::string, std::size_t> counts;
    for (const Node& node : skeleton.nodes()) {
        const std::vector<std::string> words = words_of(node.name);
        const auto first = std::find_if(words.begin(), words.end(), [](const std::string& word) {
            return !is_digit(word.front()) && !is_one_of(word, fillers) && !is_one_of(word, not_bones) &&
                   side_of(word) == Side::None && part_of(word) == Part::None;
        });
        if (first != words.end() && ++counts[*first] > skeleton.size() / 2) return *first;
    }
    return {};
}

NameReading read_name(std::string_view name, std::string_view ignored) {
    NameReading reading;
    std::string text;
    const std::vector<std::string> words = words_of(name);
    // Vertebrae: L5, T12
    if (words.size() == 2 && (words[0] == "l" || words[0] == "t") && is_digit(words[1].front()))
        return {.part = Part::Spine};
    for (const std::string& word : words) {
        if (is_digit(word.front()) || word == ignored) continue;
        if (is_one_of(word, not_bones)) return {};
        if (const Side side = side_of(word); side != Side::None)
            reading.side = side;
        else if (!is_one_of(word, fillers))
            text += word;
    }
    if (part_of(text) == Part::None && reading.side == Side::None) reading.side = take_side(text);
    reading.part = part_of(text);
    reading.is_plain = text == "hips";
    const bool has_side = reading.side != Side::None;
    if (text == "hip" && has_side) reading.part = Part::UpperLeg;  // but Rigify's pelvis.L is not a leg
    if (reading.part == Part::None || (reading.part >= Part::Shoulder) != has_side) return {};
    return reading;
}

bool is_same_but_for_numbers(std::string_view a, std::string_view b) {
    const auto without = [](std::string_view name) {
        std::string all;
        for (const std::string& word : words_of(name))
            if (!is_digit(word.front())) all += word + ' ';
        return all;
    };
    return without(a) == without(b);
}

bool is_palm_name(std::string_view name) {
    const std::vector<std::string> words = words_of(name);
    return std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word == "palm" || word == "meta" || word.ends_with("carpal");
    });
}

std::optional<Finger> finger_named(std::string_view name) {
    constexpr std::string_view ends = "end tip nub leaf site ik";
    constexpr std::pair<std::string_view, Finger> known[]{
        {"thumb", Finger::Thumb},   {"index", Finger::Index},  {"middle", Finger::Middle},
        {"mid", Finger::Middle},    {"ring", Finger::Ring},    {"pinky", Finger::Little},
        {"pinkie", Finger::Little}, {"little", Finger::Little}};
    if (is_palm_name(name)) return std::nullopt;
    std::optional<Finger> finger;
    bool numbered = false;
    for (const std::string& word : words_of(name)) {
        if (is_one_of(word, ends)) return std::nullopt;
        for (const auto& [text, its] : known)
            if (word == text) finger = its;
        if (numbered && !finger && word.front() >= '0' && word.front() <= '4')
            finger = static_cast<Finger>(word.front() - '0');
        numbered = word == "finger";
    }
    return finger;
}

bool is_twist_name(std::string_view name) {
    const std::vector<std::string> words = words_of(name);
    return std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word == "roll" || word.ends_with("twist") || word.starts_with("twist");
    });
}

}  // namespace tendril::humanoid::detail
