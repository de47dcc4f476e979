#include "app/io/character/fbx/record.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace tendril::app::fbx {
namespace {

constexpr std::size_t max_nested = 64;  ///< nesting of records; files have up to 10

template <class T>
T raw_at(std::string_view bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// A text file's number; bare words are 0, except T and Y, which mean true.
double number_in(std::string_view text, double otherwise) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc()) return value;
    return text == "T" || text == "Y" ? 1.0 : otherwise;
}
std::int64_t integer_in(std::string_view text, std::int64_t otherwise) {
    if (text.starts_with('+')) text.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (bad == std::errc() && end == text.data() + text.size()) return value;
    const double real = number_in(text, static_cast<double>(otherwise));
    return std::abs(real) < 9e18 ? static_cast<std::int64_t>(real) : otherwise;
}

/// Calls `with` with the number in its own type.
template <class With>
bool visit(const Property& property, With&& with) {
    switch (property.kind) {
        case 'B':
        case 'C':
            return with(static_cast<std::int64_t>(property.bytes[0] != 0)), true;
        case 'Y':
            return with(static_cast<std::int64_t>(raw_at<std::int16_t>(property.bytes, 0))), true;
        case 'I':
            return with(static_cast<std::int64_t>(raw_at<std::int32_t>(property.bytes, 0))), true;
        case 'L':
            return with(raw_at<std::int64_t>(property.bytes, 0)), true;
        case 'F':
            return with(static_cast<double>(raw_at<float>(property.bytes, 0))), true;
        case 'D':
            return with(raw_at<double>(property.bytes, 0)), true;
        default:
            return false;
    }
}

std::string unpacked(std::string_view packed, std::size_t size) {
    std::string bytes(size, '\0');
    auto length = static_cast<uLongf>(size);
    const int rc =
        uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                   reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
    if (rc != Z_OK || length != size) throw std::runtime_error("an array that cannot be unpacked");
    return bytes;
}

template <class T, class From>
T converted(From value) {
    if constexpr (std::is_floating_point_v<From> && std::is_integral_v<T>)
        return std::abs(value) < From(9e18) ? static_cast<T>(value) : T(0);
    else
        return static_cast<T>(value);
}

/// The elements of a binary array, converted to T.
template <class T>
std::vector<T> elements(const Property& array) {
    const std::size_t count = raw_at<std::uint32_t>(array.bytes, 0), size = number_bytes(array.kind);
    std::string_view bytes = array.bytes.substr(12);
    std::string own;
    if (raw_at<std::uint32_t>(array.bytes, 4) == 1) bytes = own = unpacked(bytes, count * size);
    std::vector<T> result;
    result.reserve(count);
    const auto add = [&](auto value) { result.push_back(converted<T>(value)); };
    for (std::size_t i = 0; i < count; ++i) {
        if (array.kind == 'f')
            add(raw_at<float>(bytes, 4 * i));
        else if (array.kind == 'd')
            add(raw_at<double>(bytes, 8 * i));
        else if (size == 4)
            add(raw_at<std::int32_t>(bytes, 4 * i));
        else if (size == 8)
            add(raw_at<std::int64_t>(bytes, 8 * i));
        else
            add(static_cast<unsigned char>(bytes[i]));
    }
    return result;
}

/// The properties that hold the record's numbers; text files put arrays into a child named "a".
const std::vector<Property>& holders(const Record& record) {
    const Record* array = record.properties.size() == 1 ? record.child("a") : nullptr;
    return array ? array->properties : record.properties;
}

template <class T>
std::vector<T> all_of(const Record& record) {
    const std::vector<Property>& from = holders(record);
    if (from.size() == 1 && is_array(from[0].kind)) return elements<T>(from[0]);
    std::vector<T> result;
    result.reserve(from.size());
    for (const Property& each : from) {
        if (each.kind != 'T')
            visit(each, [&](auto value) { result.push_back(converted<T>(value)); });
        else if constexpr (std::is_integral_v<T>)
            result.push_back(integer_in(each.bytes, 0));
        else
            result.push_back(number_in(each.bytes, 0.0));
    }
    return result;
}

}  // namespace

std::size_t number_bytes(char kind) {
    constexpr std::string_view letters = "BCbcYIFifDLdl";
    constexpr std::array<std::size_t, letters.size()> sizes{1, 1, 1, 1, 2, 4, 4, 4, 4, 8, 8, 8, 8};
    const std::size_t at = letters.find(kind);
    return at == letters.npos ? 0 : sizes[at];
}

const Record* Record::child(std::string_view wanted) const {
    const auto found = std::ranges::find(children, wanted, &Record::name);
    return found == children.end() ? nullptr : &*found;
}

double Record::number(std::size_t index, double otherwise) const {
    if (index >= properties.size()) return otherwise;
    const Property& property = properties[index];
    double value = property.kind == 'T' ? number_in(property.bytes, otherwise) : otherwise;
    visit(property, [&](auto each) { value = static_cast<double>(each); });
    return std::isfinite(value) ? value : otherwise;
}

std::int64_t Record::integer(std::size_t index, std::int64_t otherwise) const {
    if (index >= properties.size()) return otherwise;
    const Property& property = properties[index];
    std::int64_t value = property.kind == 'T' ? integer_in(property.bytes, otherwise) : otherwise;
    visit(property, [&](auto each) {
        const bool fits = std::abs(static_cast<double>(each)) < 9e18;  // false for NaN
        value = fits ? static_cast<std::int64_t>(each) : otherwise;
    });
    return value;
}

std::string_view Record::text(std::size_t index) const {
    if (index >= properties.size()) return {};
    const Property& property = properties[index];
    return property.kind != 0 && std::strchr("SRTC", property.kind) ? property.bytes : std::string_view();
}

std::vector<double> Record::numbers() const {
    return all_of<double>(*this);
}
std::vector<std::int64_t> Record::integers() const {
    return all_of<std::int64_t>(*this);
}

std::vector<double> Record::floats() const {
    const std::vector<Property>& from = holders(*this);
    const bool is_text = !from.empty() && from[0].kind == 'T';
    const bool is_decimal = std::ranges::any_of(from, [](const Property& each) {
        return each.kind == 'T' && each.bytes.find_first_of(".eE") != std::string_view::npos;
    });
    if (!is_text || is_decimal) return numbers();
    std::vector<double> result;
    for (const std::int64_t bits : integers())
        result.push_back(
            static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits & 0xffffffff))));
    return result;
}

std::vector<double> Record::numbers_of(std::string_view wanted) const {
    const Record* found = child(wanted);
    return found ? found->numbers() : std::vector<double>();
}
std::vector<std::int64_t> Record::integers_of(std::string_view wanted) const {
    const Record* found = child(wanted);
    return found ? found->integers() : std::vector<std::int64_t>();
}

File read_records(std::string_view bytes) {
    if (bytes.empty()) throw std::runtime_error("is empty");
    const bool is_binary = bytes.starts_with("Kaydara FBX Binary  ");
    if constexpr (std::endian::native != std::endian::little)
        if (is_binary) throw std::runtime_error("binary FBX files are read on little-endian machines only");
    if (!is_binary) {
        const std::string_view top = bytes.substr(0, 4096);
        if (top.find("FBXHeaderExtension") == top.npos && top.find("; FBX") == top.npos)
            throw std::runtime_error("is not an FBX file");
    }
    File file = is_binary ? read_binary(bytes) : read_text(bytes);
    if (file.version < 6000 || file.version >= 8000)
        throw std::runtime_error("is of FBX version " + std::to_string(file.version / 1000) + '.' +
                                 std::to_string(file.version / 100 % 10) + "; 6.0 to 7.7 are read");
    return file;
}

void RecordReader::fail(const std::string& what) const {
    throw std::runtime_error(place() + ": " + what);
}

void RecordReader::open(Record record, std::size_t end) {
    if (open_.size() >= max_nested) fail("more than " + std::to_string(max_nested) + " nested records");
    open_.push_back({std::move(record), end});
}

void RecordReader::close() {
    Record done = std::move(open_.back().record);
    open_.pop_back();
    (open_.empty() ? file_.root : open_.back().record).children.push_back(std::move(done));
}

File RecordReader::finish() {
    if (inside()) fail("the file ends inside a record");
    return std::move(file_);
}

}  // namespace tendril::app::fbx
