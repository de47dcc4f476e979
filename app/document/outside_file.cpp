#include "app/document/outside_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <fstream>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t max_crc32 = 0xffff'ffff;

std::optional<std::uint32_t> crc32_of(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    std::ifstream in(file, std::ios::binary);
    std::vector<char> bytes(1 << 16);
    uLong sum = ::crc32(0, nullptr, 0);
    do {
        in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        sum = ::crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(in.gcount()));
    } while (in);
    return static_cast<std::uint32_t>(sum);
}

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::exists(path, error);
}

std::string text_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Calls `take` with each object in the part that names a file.
void for_each_file(auto& json, const auto& take) {
    if (!json.is_structured()) return;
    if (json.is_object() && !text_of(json, "file").empty()) take(json);
    for (auto& each : json) for_each_file(each, take);
}

/// Empty if the file is not found.
fs::path moved_file(const fs::path& path, const fs::path& scene_folder) {
    constexpr std::size_t longest = 4096;  // bytes, the usual limit of operating systems
    fs::path base = path.native().size() > longest ? fs::path() : scene_folder;
    std::error_code error;
    for (int up = 0; up <= 2 && !base.empty(); ++up, base /= "..") {
        const fs::path below = path.relative_path();
        for (auto from = below.begin(); from != below.end(); ++from) {
            fs::path end;
            for (auto each = from; each != below.end(); ++each) end /= *each;
            if (up > 0 && !end.has_parent_path()) break;
            if (fs::is_regular_file(base / end, error)) return base / end;
        }
    }
    return {};
}

}  // namespace

OutsideFile outside_file(const std::string& path, const std::string& file) {
    if (path.empty()) return {};
    return {file.empty() ? path : file, fs::absolute(path).lexically_normal().string(), crc32_of(path)};
}

Json save_outside_file(const OutsideFile& file) {
    Json json{{"file", file.file}};
    if (!file.path.empty()) json["path"] = file.path;
    if (file.crc32) json["crc32"] = *file.crc32;
    return json;
}

OutsideFile named_file(const JsonPlace& place) {
    if (const auto sum = place.optional("crc32")) static_cast<void>(sum->count(max_crc32));
    const auto path = place.optional("path");
    // Older scenes store only the path of a ground.
    const std::string file = (path && !place.optional("file") ? *path : place["file"]).text();
    if (!path || is_there(path->text())) return {file, path ? path->text() : file};
    if (!is_there(file))
        throw OutsideFileError(fs::path(path->text()).filename().string() + " is missing, at " +
                               shown_path(path->text()) + " and beside the scene");
    return {file, file};
}

void find_moved_files(Json& part, const fs::path& scene_folder) {
    for_each_file(part, [&](Json& each) {
        const fs::path path = text_of(each, "path");
        if (is_there(path) || is_there(text_of(each, "file"))) return;
        const fs::path found = moved_file(path, scene_folder);
        std::error_code error;
        if (!found.empty()) each["path"] = fs::absolute(found, error).lexically_normal().string();
    });
}

std::string changed_files_text(const Json& part) {
    std::vector<std::string> changed;
    for_each_file(part, [&](const Json& each) {
        const fs::path path = text_of(each, "path"),
                       file = is_there(path) ? path : fs::path(text_of(each, "file"));
        // load() refuses anything that is not a checksum.
        const auto sum = each.find("crc32");
        const std::uint64_t saved =
            sum != each.end() && sum->is_number_unsigned() ? sum->get<std::uint64_t>() : max_crc32 + 1;
        const std::string name = file.filename().string();
        if (saved <= max_crc32 && saved != crc32_of(file).value_or(0) &&
            std::ranges::find(changed, name) == changed.end())
            changed.push_back(name);
    });
    if (changed.empty()) return {};
    return comma_list(changed) + (changed.size() > 1 ? " have" : " has") +
           " changed since the scene was saved";
}

}  // namespace tendril::app
