// An FBX file, binary or text, versions 6.0 to 7.7, as its records, and as the objects that they describe. A
// record has a name, properties and records of its own (Blender Foundation, "FBX binary file format
// specification", 2013).
//
//     const File file = read_records(bytes);
//     const Record* objects = file.root.child("Objects");
//     for (const Record& each : objects->children) each.text(1);  // "Hips\0\1Model", "Model::Hips"
//
// Properties are views of the file, decoded on request, so that memory stays below a constant times the
// file's size, whatever its arrays claim.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
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
    /// A property as a number, or `otherwise` if it is missing or not a number.
    double number(std::size_t index, double otherwise = 0.0) const;
    std::int64_t integer(std::size_t index, std::int64_t otherwise = 0) const;
    /// A string, a character or a text file's bare word; "" if missing or of another kind.
    std::string_view text(std::size_t index) const;
    /// All numbers of the record: from its array or, if it has none, its properties. Throws
    /// std::runtime_error for an array that cannot be unpacked.
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
    std::string note{};  ///< what was omitted; "": nothing
};

/// The records keep views of `bytes`. Throws std::runtime_error with the reason and the byte or line.
/// O(bytes).
File read_records(std::string_view bytes);

// Helpers of read_records().

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

// The objects of an FBX file and their connections: models, curves, deformers. Version 6 refers to them by
// name, version 7 by number; here both become indices.

struct Object {
    const Record* record = nullptr;
    std::string_view kind{};     ///< "Model", "Deformer", "AnimationCurve"
    std::string_view name{};     ///< "Hips", without the kind
    std::string_view subtype{};  ///< "LimbNode", "Cluster"
};

/// `object` belongs to another one, or to one of its properties.
struct Connection {
    std::size_t object = 0;
    std::string_view property{};  ///< "Lcl Rotation"; "": the object itself
};

class Objects {
  public:
    /// Keeps views of the file.
    explicit Objects(const File& file);

    std::size_t size() const { return objects_.size(); }
    const Object& operator[](std::size_t index) const { return objects_[index]; }
    const std::vector<Connection>& children(std::size_t index) const { return children_[index]; }
    const std::vector<Connection>& parents(std::size_t index) const { return parents_[index]; }
    /// The index of the object that version 6 calls "Model::Hips".
    std::int64_t find(std::string_view full_name) const;

    /// A property's values, from element `first` of the record on; null if neither the object nor its
    /// template has the property.
    struct Values {
        const Record* record = nullptr;
        std::size_t first = 0;
        explicit operator bool() const { return record != nullptr; }
    };
    Values property(std::size_t index, std::string_view name) const;
    double number(std::size_t index, std::string_view name, double otherwise) const;
    std::int64_t integer(std::size_t index, std::string_view name, std::int64_t otherwise) const;
    glm::dvec3 vector(std::size_t index, std::string_view name, const glm::dvec3& otherwise) const;

    /// A property of the file's GlobalSettings.
    Values setting(std::string_view name) const;

  private:
    using Table = std::unordered_map<std::string_view, Values>;
    static Table table(const Record& owner);

    std::vector<Object> objects_{};
    std::vector<Table> tables_{};
    std::unordered_map<std::string_view, Table> templates_{};
    Table settings_{};
    std::vector<std::vector<Connection>> children_{}, parents_{};
    std::unordered_map<std::int64_t, std::size_t> ids_{};
    std::unordered_map<std::string_view, std::size_t> names_{};
};

/// "Hips" for "Hips\0\1Model" or "Model::Hips".
std::string_view plain_name(std::string_view name);

}  // namespace tendril::app::fbx
