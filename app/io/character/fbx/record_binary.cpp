#include <cstring>

#include "app/io/character/fbx/record.hpp"

namespace tendril::app::fbx {
namespace {

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
                if (at_ != end()) fail("a record that does not end where it says");
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
        if (at_ != end) fail("properties that do not end where they say");
    }
    /// Skips to the end of the record: the length of a property of unknown kind is not known.
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

}  // namespace

File read_binary(std::string_view bytes) {
    return BinaryRecords(bytes).read();
}

}  // namespace tendril::app::fbx
