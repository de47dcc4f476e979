// An FBX file as its records, binary or text, versions 6.0 to 7.7: a record has a name, properties and
// records of its own (Blender Foundation, "FBX binary file format specification", 2013).
//
//     const File file = read_records(bytes);
//     const Record* objects = file.root.child("Objects");
//     for (const Record& each : objects->children) each.text(1);  // "Hips\0\1Model", "Model::Hips"
//
// Properties are views of the file, decoded on request, so that memory stays below a constant times the
// file's size, whatever its arrays claim.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app::fbx {

/// One property. In binary files `kind` is the file's letter; in text files 'S' for a quoted string and 'T'
/// for a number or a bare word.
struct Property {
    char kind = 0;
    std::string_view bytes{};  ///< a string's characters, a number's bytes or text, an array with its header
};

struct Record {
    std::string_view name{};
    std::vector<Property> properties{};
    std::vector<Record> children{};

    /// The first child of that name; null: none.
    const Record* child(std::string_view wanted) const;
    /// A property as a number, or `otherwise` if it is none or missing.
    double number(std::size_t index, double otherwise = 0.0) const;
    std::int64_t integer(std::size_t index, std::int64_t otherwise = 0) const;
    /// A string, a character or a text file's bare word; "" for any other kind or if missing.
    std::string_view text(std::size_t index) const;
    /// All numbers of the record: of its array, or else of its properties. Throws std::runtime_error for an
    /// array that cannot be unpacked.
    std::vector<double> numbers() const;
    std::vector<std::int64_t> integers() const;
    /// The numbers as 32-bit floats, which text files may write as integers with the same bits.
    std::vector<double> floats() const;
    /// A child's numbers; empty if there is no such child.
    std::vector<double> numbers_of(std::string_view wanted) const;
    std::vector<std::int64_t> integers_of(std::string_view wanted) const;
};

struct File {
    Record root{};
    int version = 0;     ///< 7400 for 7.4
    std::string note{};  ///< the omissions; "": none
};

/// The records keep views of `bytes`. Throws std::runtime_error with the reason and the byte or line.
/// O(bytes).
File read_records(std::string_view bytes);

// For read_records().

/// Bytes of one number of that letter in a binary file, or of one array element; 0: not a number.
std::size_t number_bytes(char kind);
inline bool is_array(char kind) {
    return kind >= 'a' && kind <= 'z' && number_bytes(kind) > 0;
}

/// Shared by both readers: the stack of open records.
class RecordReader {
  public:
    RecordReader() = default;
    RecordReader(const RecordReader&) = delete;
    RecordReader& operator=(const RecordReader&) = delete;

  protected:
    virtual ~RecordReader() = default;
    virtual std::string place() const = 0;  ///< "line 12"
    [[noreturn]] void fail(const std::string& what) const;
    void open(Record record, std::size_t end = 0);
    bool inside() const { return !open_.empty(); }
    std::size_t end() const { return open_.back().end; }  ///< end of the innermost record
    void close();
    File finish();

    File file_{};

  private:
    struct Open {
        Record record;
        std::size_t end;
    };
    std::vector<Open> open_{};
};

File read_binary(std::string_view bytes);
File read_text(std::string_view text);

}  // namespace tendril::app::fbx
