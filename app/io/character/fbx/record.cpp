#include "app/io/character/fbx/record.hpp"

#include <zlib.h>
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "app/io/text.hpp"

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
    if (read_double(text.data(), text.data() + text.size(), value).ec == std::errc()) return value;
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

constexpr std::uint64_t max_array_bytes = std::uint64_t{1} << 30;  // sum over all arrays
constexpr std::uint64_t max_packed = 1032;                         // zlib's maximum expansion
constexpr std::size_t binary_header = 27;

using std::to_string;

class BinaryRecords final : public RecordReader {
  public:
    explicit BinaryRecords(std::string_view bytes) : bytes_(bytes), at_(binary_header) {
        if (bytes.size() < at_) fail("ends in its header");
        file_.version = static_cast<int>(number<std::uint32_t>(23) & 0xffffff);
        wide_ = file_.version >= 7500;
    }

    File read() {
        while (at_ < bytes_.size()) {
            const std::size_t begin = at_;
            Head head = take_head();
            if (head.end == 0) {  // the end of a record's contents, or of the file
                if (!inside()) break;
                if (at_ != end()) fail("a record whose contents do not end at its stated end");
                close();
                continue;
            }
            const std::size_t limit = inside() ? end() : bytes_.size();
            if (head.end <= begin || head.end > limit)
                fail("a record that ends at byte " + to_string(head.end) + ", of " + to_string(limit));
            properties(head);
            open(std::move(head.record), static_cast<std::size_t>(head.end));
            if (at_ == end()) close();
        }
        return finish();
    }

  private:
    struct Head {
        std::uint64_t end = 0, count = 0, length = 0;
        Record record{};
    };

    std::string place() const override { return "byte " + to_string(at_); }
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
    std::string_view take(std::uint64_t size) {
        need(size);
        at_ += static_cast<std::size_t>(size);
        return bytes_.substr(at_ - static_cast<std::size_t>(size), static_cast<std::size_t>(size));
    }
    template <class T>
    T take() {
        take(sizeof(T));
        return number<T>(at_ - sizeof(T));
    }
    std::uint64_t take_size() { return wide_ ? take<std::uint64_t>() : take<std::uint32_t>(); }

    Head take_head() {
        Head head;
        head.end = take_size();
        head.count = take_size();
        head.length = take_size();
        head.record.name = take(take<std::uint8_t>());
        return head;
    }
    void properties(Head& head) {
        need(head.length);
        const std::size_t end = at_ + static_cast<std::size_t>(head.length);
        if (end > head.end) fail("properties longer than their record");
        for (std::uint64_t i = 0; i < head.count; ++i) {
            if (at_ >= end) fail("claims " + to_string(head.count) + " properties, has " + to_string(i));
            if (const char kind = bytes_[at_]; number_bytes(kind) == 0 && kind != 'S' && kind != 'R') {
                skip_unknown(head.record.name, end);
                break;
            }
            head.record.properties.push_back(property());
        }
        if (at_ != end) fail("properties that do not end at their stated end");
    }
    /// Skips to the end of the record: the length of an unknown kind of property is not known.
    void skip_unknown(std::string_view name, std::size_t end) {
        const char kind[]{bytes_[at_], '\0'};
        if (file_.note.empty())
            file_.note =
                "Values of an unknown kind are left out, the first one (kind " +
                (kind[0] > ' ' && kind[0] <= '~' ? std::string(kind)
                                                 : to_string(int(static_cast<unsigned char>(kind[0])))) +
                ") in record " + std::string(name) + ".";
        at_ = end;
    }
    Property property() {
        const char kind = static_cast<char>(take<std::uint8_t>());
        const std::size_t size = number_bytes(kind);
        if (size == 0) return {kind, take(take<std::uint32_t>())};  // a string
        return {kind, is_array(kind) ? array(size) : take(size)};
    }
    std::string_view array(std::uint64_t size) {
        const std::size_t begin = at_;
        const std::uint64_t count = take<std::uint32_t>();
        const auto encoding = take<std::uint32_t>();
        const std::uint64_t length = take<std::uint32_t>();
        need(length);
        if (encoding > 1 || (encoding == 0 && length != count * size) ||
            (encoding == 1 && count * size > max_packed * length))
            fail("an array that claims " + to_string(count) + " numbers in " + to_string(length) + " bytes");
        all_arrays_ += count * size;
        if (all_arrays_ > max_array_bytes) fail("arrays of more than 1 GB in total");
        take(length);
        return bytes_.substr(begin, at_ - begin);
    }

    std::string_view bytes_;
    std::size_t at_;
    bool wide_ = false;
    std::uint64_t all_arrays_ = 0;
};

/// `Name: value, value { records }`. A list begins on a later line, or continues there after a comma, unless
/// a record begins there; it also continues if that line begins with a comma.
class TextRecords final : public RecordReader {
  public:
    explicit TextRecords(std::string_view text) : text_(text) {}

    File read() {
        while (true) {
            skip_lines();
            if (at_ == text_.size()) break;
            if (text_[at_] == '}') {
                if (!inside()) fail("} without a matching {");
                ++at_;
                close();
                continue;
            }
            Record record;
            record.name = name();
            properties(record);
            skip_lines();
            open(std::move(record));
            if (at_ < text_.size() && text_[at_] == '{')
                ++at_;
            else
                close();
        }
        const Record* header = file_.root.child("FBXHeaderExtension");
        const Record* version = header ? header->child("FBXVersion") : nullptr;
        file_.version = version ? static_cast<int>(version->integer(0) % 1'000'000) : version_in_comment();
        return finish();
    }

  private:
    std::string place() const override { return "line " + std::to_string(line_); }
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; }
    void skip_blanks() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }
    /// Also skips line ends and comments.
    void skip_lines() {
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == ';') at_ = std::min(text_.find('\n', at_), text_.size());
            if (at_ == text_.size()) return;
            if (text_[at_] == '\n')
                ++line_;
            else if (!is_blank(text_[at_]))
                return;
        }
    }
    std::string_view word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) &&
               std::string_view("\n:,;{}\"").find(text_[at_]) == std::string_view::npos)
            ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::string_view name() {
        const std::string_view name = word();
        skip_blanks();
        if (name.empty() || at_ == text_.size() || text_[at_] != ':')
            fail("expected a record, \"Name: ...\"");
        ++at_;
        return name;
    }
    /// True if no value follows: at `Name:`, a brace, or the end.
    bool at_record() {
        const std::size_t begin = at_;
        const bool has_word = !word().empty();
        skip_blanks();
        const char next = at_ < text_.size() ? text_[at_] : '}';
        const bool ends = has_word ? next == ':' : next == '{' || next == '}';
        at_ = begin;
        return ends;
    }
    void properties(Record& record) {
        for (bool more = true; more;) {
            skip_lines();
            if (at_record()) return;
            record.properties.push_back(property());
            const std::size_t after = at_, line = line_;
            skip_lines();
            more = at_ < text_.size() && text_[at_] == ',';
            if (more)
                ++at_;
            else
                at_ = after, line_ = line;
        }
        skip_blanks();
        if (at_ < text_.size() && std::string_view("\n;{}").find(text_[at_]) == text_.npos)
            fail("expected a comma or the end of the line");
    }
    Property property() {
        if (at_ == text_.size() || text_[at_] != '"') return {'T', word()};
        const std::size_t begin = ++at_, end = text_.find('"', begin);
        if (end == text_.npos) fail("a string without an end");
        for (; at_ < end; ++at_)
            if (text_[at_] == '\n') ++line_;
        at_ = end + 1;
        return {'S', text_.substr(begin, end - begin)};
    }
    /// "; FBX 6.1.0 project file": 6100.
    int version_in_comment() const {
        const std::size_t at = text_.substr(0, 4096).find("; FBX ");
        if (at == text_.npos || at + 8 >= text_.size()) return 0;
        const char major = text_[at + 6], minor = text_[at + 8];
        const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
        return is_digit(major) && is_digit(minor) ? 1000 * (major - '0') + 100 * (minor - '0') : 0;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

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

File read_binary(std::string_view bytes) {
    return BinaryRecords(bytes).read();
}

File read_text(std::string_view text) {
    return TextRecords(text).read();
}

}  // namespace tendril::app::fbx
