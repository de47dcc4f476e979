#include "app/io/character/fbx_structure.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <stdexcept>

namespace tendril::app {
namespace {

constexpr std::size_t max_nested = 64;   // records in records; files have up to 10
constexpr std::size_t max_depth = 1000;  // nested models: Assimp recurses
constexpr std::size_t max_models = 100'000;
constexpr std::size_t max_curve_keys = 50'000'000;
constexpr std::uint64_t max_array_bytes = std::uint64_t{1} << 30;  // sum over all arrays
constexpr std::uint64_t max_packed = 1032;                         // zlib's maximum expansion

using std::to_string;

/// "Hips" for "Hips\0\1Model" or "Model::Hips".
std::string_view plain_name(std::string_view name) {
    if (const std::size_t end = name.find('\0'); end != name.npos) return name.substr(0, end);
    return name.starts_with("Model::") ? name.substr(7) : name;
}

class BinaryFbx {
  public:
    explicit BinaryFbx(std::string_view bytes) : bytes_(bytes), at_(27) {
        if (bytes.size() < at_) fail("ends in its header");
        wide_ = number<std::uint32_t>(23) >= 7500;
    }

    FbxObjects read() {
        while (at_ < bytes_.size()) {
            const std::size_t begin = at_;
            Record record = head();
            if (record.end == 0) {  // the end of a record's contents, or of the file
                if (open_.empty()) break;
                if (at_ != open_.back().end) fail("a record that does not end where it says");
                close();
                continue;
            }
            const std::size_t limit = open_.empty() ? bytes_.size() : open_.back().end;
            if (record.end <= begin || record.end > limit)
                fail("a record that ends at byte " + to_string(record.end) + ", of " + to_string(limit));
            properties(record);
            if (open_.size() >= max_nested) fail("more than " + to_string(max_nested) + " nested records");
            open_.push_back(record);
            if (at_ == record.end) close();
        }
        if (!open_.empty()) fail("the file ends inside a record");
        objects_.check();
        return std::move(objects_);
    }

  private:
    struct Record {
        std::uint64_t end = 0, count = 0, length = 0;
        std::string_view name{};
        std::array<std::int64_t, 3> ids{};        // the integers among the first three properties
        std::array<std::string_view, 3> texts{};  // the strings among them
    };

    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error("byte " + to_string(at_) + ": " + what);
    }
    void need(std::uint64_t bytes) const {
        if (bytes > bytes_.size() - at_)
            fail("claims " + to_string(bytes) + " bytes, the file has " + to_string(bytes_.size() - at_) +
                 " more");
    }
    template <class T>
    T number(std::size_t at) const {
        T value;
        std::memcpy(&value, bytes_.data() + at, sizeof value);
        return value;
    }
    template <class T>
    T take() {
        need(sizeof(T));
        const T value = number<T>(at_);
        at_ += sizeof(T);
        return value;
    }
    std::string_view take_text(std::uint64_t size) {
        need(size);
        at_ += static_cast<std::size_t>(size);
        return bytes_.substr(at_ - static_cast<std::size_t>(size), static_cast<std::size_t>(size));
    }
    std::uint64_t take_size() { return wide_ ? take<std::uint64_t>() : take<std::uint32_t>(); }

    Record head() {
        Record record;
        record.end = take_size();
        record.count = take_size();
        record.length = take_size();
        record.name = take_text(take<std::uint8_t>());
        return record;
    }
    void close() {
        const Record& record = open_.back();
        if (open_.size() == 2 && open_.front().name == "Objects" && record.name == "Model")
            objects_.add_model(record.ids[0], plain_name(record.texts[1]), record.texts[2]);
        if (open_.size() == 2 && open_.front().name == "Connections" && record.name == "C")
            objects_.connect(record.ids[1], record.ids[2]);
        at_ = static_cast<std::size_t>(record.end);
        open_.pop_back();
    }
    void properties(Record& record) {
        need(record.length);
        const std::size_t end = at_ + static_cast<std::size_t>(record.length);
        if (end > record.end) fail("properties longer than their record");
        for (std::uint64_t i = 0; i < record.count; ++i) {
            if (at_ >= end) fail("claims " + to_string(record.count) + " properties, has " + to_string(i));
            property(record, i);
        }
        if (at_ != end) fail("properties that do not end where they say");
    }
    void property(Record& record, std::uint64_t i) {
        const char kind = static_cast<char>(take<std::uint8_t>());
        switch (kind) {
            case 'C':
                return void(take<std::uint8_t>());
            case 'Y':
                return void(take<std::int16_t>());
            case 'I':
            case 'F':
                return void(take<std::int32_t>());
            case 'D':
                return void(take<double>());
            case 'L': {
                const auto value = take<std::int64_t>();
                if (i < 3) record.ids[i] = value;
                return;
            }
            case 'S':
            case 'R': {
                const std::string_view text = take_text(take<std::uint32_t>());
                if (i < 3) record.texts[i] = text;
                return;
            }
            case 'b':
            case 'c':
                return array(record, 1);
            case 'i':
            case 'f':
                return array(record, 4);
            case 'l':
            case 'd':
                return array(record, 8);
            default:
                fail("a property of unknown kind");
        }
    }
    void array(const Record& record, std::uint64_t size) {
        const std::uint64_t count = take<std::uint32_t>();
        const auto encoding = take<std::uint32_t>();
        const std::uint64_t length = take<std::uint32_t>();
        need(length);
        if (encoding > 1 || (encoding == 0 && length != count * size) ||
            (encoding == 1 && count * size > max_packed * length))
            fail("an array that claims " + to_string(count) + " numbers in " + to_string(length) + " bytes");
        all_arrays_ += count * size;
        if (all_arrays_ > max_array_bytes) fail("arrays of more than 1 GB in total");
        at_ += static_cast<std::size_t>(length);
        if (record.name == "KeyTime" && open_.size() == 2 && open_.back().name == "AnimationCurve")
            objects_.add_curve(open_.back().ids[0], static_cast<std::size_t>(count));
    }

    std::string_view bytes_;
    std::size_t at_;
    bool wide_ = false;
    std::uint64_t all_arrays_ = 0;
    std::vector<Record> open_{};
    FbxObjects objects_{};
};

std::int64_t integer(std::string_view text) {
    const std::size_t begin = text.find_first_of("-0123456789");
    std::int64_t value = 0;
    if (begin != text.npos) std::from_chars(text.data() + begin, text.data() + text.size(), value);
    return value;
}

/// Comma-separated fields without quotes; at most four.
std::vector<std::string_view> fields(std::string_view line) {
    std::vector<std::string_view> result;
    while (!line.empty() && result.size() < 4) {
        const std::size_t comma = std::min(line.find(','), line.size());
        std::string_view field = line.substr(0, comma);
        while (!field.empty() && (field.front() == ' ' || field.front() == '"')) field.remove_prefix(1);
        while (!field.empty() && std::strchr(" \"{\r\t", field.back())) field.remove_suffix(1);
        result.push_back(field);
        line.remove_prefix(std::min(comma + 1, line.size()));
    }
    return result;
}

/// Reads line by line: in text files a record's name and properties are on one line.
FbxObjects text_objects(std::string_view text) {
    FbxObjects objects;
    std::size_t depth = 0, line_number = 0;
    std::int64_t curve = 0;
    while (!text.empty()) {
        ++line_number;
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
        if (line.starts_with("Model:"))
            if (const auto all = fields(line.substr(6)); all.size() >= 3)
                objects.add_model(integer(all[0]), plain_name(all[1]), all[2]);
        if (line.starts_with("AnimationCurve:")) curve = integer(line.substr(15));
        if (line.starts_with("KeyTime:") && line.find('*') != line.npos)
            objects.add_curve(curve, static_cast<std::size_t>(
                                         std::max<std::int64_t>(integer(line.substr(line.find('*'))), 0)));
        if (line.starts_with("C:"))
            if (const auto all = fields(line.substr(2)); all.size() >= 3)
                objects.connect(integer(all[1]), integer(all[2]));
        bool quoted = false;
        for (const char c : line) {
            if (c == ';' && !quoted) break;
            if (c == '"') quoted = !quoted;
            if (quoted) continue;
            if (c == '}' && depth-- == 0)
                throw std::runtime_error("line " + to_string(line_number) + ": } without a matching {");
            if (c == '{' && ++depth > max_nested)
                throw std::runtime_error("line " + to_string(line_number) + ": more than " +
                                         to_string(max_nested) + " nested records");
        }
    }
    if (depth > 0) throw std::runtime_error("the file ends inside a record");
    objects.check();
    return objects;
}

}  // namespace

void FbxObjects::add_model(std::int64_t id, std::string_view name, std::string_view kind) {
    models_[id] = name;
    if (kind == "LimbNode" || kind == "Limb" || kind == "Root") limbs_.emplace(name);
}

void FbxObjects::check() const {
    std::unordered_map<std::int64_t, std::vector<std::int64_t>> below;
    std::unordered_map<std::int64_t, std::size_t> open;  // incoming connections not yet followed
    std::size_t keys = 0;
    for (const Connection& each : connections_) {
        if (const auto curve = curves_.find(each.child); curve != curves_.end()) keys += curve->second;
        if (!models_.count(each.child) || (each.parent != 0 && !models_.count(each.parent))) continue;
        below[each.parent].push_back(each.child);
        ++open[each.child];
    }
    if (keys > max_curve_keys)
        throw std::runtime_error("has more than " + to_string(max_curve_keys) + " keys");

    // Topological order from the root: how deep each model is, and how many copies Assimp would create.
    struct Seen {
        std::size_t depth = 0, times = 0;
    };
    std::unordered_map<std::int64_t, Seen> seen{{0, {0, 1}}};
    std::vector<std::int64_t> ready{0};
    for (const auto& [id, name] : models_)
        if (!open.count(id)) ready.push_back(id), seen[id] = {1, 1};
    std::size_t done = 0, times = 0;
    while (!ready.empty()) {
        const std::int64_t id = ready.back();
        ready.pop_back();
        const Seen from = seen[id];
        done += id != 0;
        times += from.times;
        if (from.depth > max_depth)
            throw std::runtime_error("models nested more than " + to_string(max_depth) + " deep");
        if (times > max_models) throw std::runtime_error("more than " + to_string(max_models) + " models");
        for (const std::int64_t child : below[id]) {
            Seen& to = seen[child];
            to = {std::max(to.depth, from.depth + 1), to.times + from.times};
            if (--open[child] == 0) ready.push_back(child);
        }
    }
    if (done < models_.size())
        for (const auto& [id, name] : models_)
            if (open.count(id) && open[id] > 0)
                throw std::runtime_error("model " + name + " is below itself");
}

FbxObjects fbx_objects(std::string_view bytes) {
    if (bytes.starts_with("Kaydara FBX Binary  ")) {
        if constexpr (std::endian::native != std::endian::little)
            throw std::runtime_error("binary FBX files are read on little-endian machines only");
        return BinaryFbx(bytes).read();
    }
    const std::string_view top = bytes.substr(0, 4096);
    if (top.find("FBXHeaderExtension") == top.npos && top.find("; FBX") == top.npos)
        throw std::runtime_error("is not an FBX file");
    return text_objects(bytes);
}

}  // namespace tendril::app
