#include "app/io/outputs.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

/// The same name for all paths to a file. A file with two names counts as two.
fs::path canonical_name(const fs::path& path) {
    std::error_code error;
    // A relative path without any existing part would stay as it is spelled.
    fs::path name = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? path : name;
}

std::string text_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

/// The first and the last 64 kB of a file, enough to tell its kind.
std::string ends_of(const fs::path& path) {
    constexpr std::streamoff enough = 1 << 16;
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = in.tellg();
    std::string text(static_cast<std::size_t>(std::clamp<std::streamoff>(size, 0, 2 * enough)), '\0');
    in.seekg(0);
    in.read(text.data(), std::min<std::streamoff>(size, enough));
    if (size > enough) {
        const std::streamoff rest = std::min(size - enough, enough);
        in.seekg(size - rest);
        in.read(text.data() + enough, rest);
    }
    return text;
}

bool is_png(std::string_view text) {
    return text.starts_with("\x89PNG\r\n\x1a\n");
}

bool is_animated(std::string_view text) {
    return is_png(text) && text.substr(0, text.find("IDAT")).find("acTL") != text.npos;
}

bool is_mp4(std::string_view text) {
    return text.substr(std::min<std::size_t>(4, text.size()), 4) == "ftyp";
}

bool is(OutputKind kind, std::string_view text) {
    const auto holds = [&](const char* part) { return text.find(part) != text.npos; };
    const std::string_view line = text.substr(0, text.find('\n'));
    const bool json = text.starts_with('{'), recording = text.starts_with("{\"recording\":"),
               scene = json && !recording && holds("\"tendril_scene\"");
    switch (kind) {
        case OutputKind::Scene:
            return scene;
        case OutputKind::Recording:
            return recording;
        case OutputKind::State:
            return json && !scene && !recording && holds("\"layout\":") && holds("\"strip\":");
        case OutputKind::Picture:
            return is_png(text) && !is_animated(text);
        case OutputKind::Video:
            return is_animated(text) || is_mp4(text);
        case OutputKind::Motion:
            return text.starts_with("glTF") || text.starts_with("HIERARCHY") || (json && holds("\"asset\""));
        case OutputKind::BoneMap:
            return json && holds("\"bone map\"");
        case OutputKind::Csv:
            return !json && !text.starts_with('[') && text.find('\0') == text.npos &&
                   line.find(',') != line.npos;
        case OutputKind::Trace:
            return json && line.find("\"trace\"") != line.npos;
    }
    return false;
}

const char* name(OutputKind kind) {
    constexpr const char* names[]{"a scene",       "a recording", "a state of --state",
                                  "a PNG picture", "a video",     "a glTF, GLB or BVH file",
                                  "a bone map",    "a CSV file",  "a trace"};
    return names[static_cast<std::size_t>(kind)];
}

/// The JSON of a glTF file, text or binary; null for any other file.
Json gltf_json(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text(20, '\0');  // in a binary file: magic, version, length; its JSON's length and "JSON"
    in.read(text.data(), 20);
    if (text.starts_with("glTF")) {
        const auto byte = [&](std::size_t at) { return static_cast<std::uint32_t>(text[at]) & 0xff; };
        const std::uint32_t size = byte(12) | byte(13) << 8 | byte(14) << 16 | byte(15) << 24;
        std::error_code unknown;
        text.resize(std::min<std::uintmax_t>(size, fs::file_size(file, unknown)));
        in.read(text.data(), static_cast<std::streamsize>(text.size()));
    } else if (lower_case(file.extension().string()) == ".gltf") {
        text = text_of(file);
    } else {
        return nullptr;
    }
    try {
        return parse_json(text);
    } catch (const ParseError&) {
        return nullptr;  // no reader accepts it either
    }
}

/// True if a "uri" in the JSON leads from the folder to that file.
bool names(const Json& json, const fs::path& folder, const fs::path& path) {
    if (!json.is_structured()) return false;
    if (const auto uri = json.is_object() ? json.find("uri") : json.end();
        uri != json.end() && uri->is_string() && !uri->get_ref<const std::string&>().starts_with("data:"))
        for (const std::string& name : names_of_uri(uri->get<std::string>())) {
            std::error_code error;
            if (fs::equivalent(folder / name, path, error)) return true;
        }
    for (const Json& each : json)
        if (names(each, folder, path)) return true;
    return false;
}

/// True if `input` is that file, or a glTF file that names it as its buffer or picture.
bool reads(const fs::path& input, const fs::path& path) {
    std::error_code error;
    if (fs::equivalent(input, path, error)) return true;
    return fs::is_regular_file(input, error) && names(gltf_json(input), input.parent_path(), path);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
    throw std::runtime_error(shown_path(path) + ' ' + why);
}

}  // namespace

void Outputs::own(const fs::path& path, const FileStamp& stamp) {
    const fs::path file = canonical_name(path);
    owned_[file] = stamp;
    asked_.erase(file);
}

void Outputs::check(const std::vector<fs::path>& paths, OutputKind kind, bool redraws) {
    std::vector<fs::path> others;  // existing files that are not the session's
    for (const fs::path& path : paths) {
        std::error_code error;
        if (!fs::is_regular_file(path, error)) continue;  // the writer reports the error
        for (const auto* list : {&inputs, &in_use})
            for (const fs::path& input : *list)
                if (reads(input, path)) refuse(path, "is not replaced: it is in use as input");
        if (fs::file_size(path, error) == 0) continue;
        if (!is(kind, ends_of(path))) refuse(path, std::string("is not replaced: it is not ") + name(kind));
        const auto owned = owned_.find(canonical_name(path));
        const bool own = owned != owned_.end() && owned->second == file_stamp(path);
        if (!force && !redraws && !own) others.push_back(path);
    }
    bool asked = in_window || others.empty();
    for (const fs::path& path : others) {
        FileStamp& last = asked_[canonical_name(path)];
        asked &= last == file_stamp(path);
        last = file_stamp(path);
    }
    if (asked) return;
    const std::string more = others.size() > 1 ? "and " + std::to_string(others.size() - 1) + " more " : "";
    refuse(others.front(),
           more +
               (owned_.contains(canonical_name(others.front())) ? "was changed by another program"
                : others.size() > 1                             ? "already exist"
                                                                : "already exists") +
               again());
}

void Outputs::confirm(const std::string& loss) {
    const bool agreed = loss.empty() || force || (in_window && asked_loss_ == loss);
    asked_loss_ = agreed ? std::string() : loss;
    if (!agreed) throw std::runtime_error(loss + again());
}

Outputs::Place Outputs::place_at_end(const fs::path& path, OutputKind kind) {
    try {
        check({path}, kind);
        return {path};
    } catch (const std::runtime_error& error) {
        return {numbered_file(path.parent_path() / path.stem(), path.extension().string()), error.what()};
    }
}

void Outputs::write(const fs::path& path, OutputKind kind, std::string_view bytes, bool redraws) {
    std::error_code error;
    const bool same = fs::is_regular_file(path, error) && fs::file_size(path, error) == bytes.size() &&
                      text_of(path) == bytes;
    if (!same) check({path}, kind, redraws);
    write_file_atomically(path, bytes);
    own(path, file_stamp(path));
}

}  // namespace tendril::app
