// Writes FBX files for tests, text or binary: records as values, and the objects of a small scene.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

namespace tendril::test {

struct FbxRecord {
    using Value =
        std::variant<std::int64_t, double, std::string, std::vector<double>, std::vector<std::int64_t>>;
    std::string name{};
    std::vector<Value> values{};
    std::vector<FbxRecord> children{};
    bool has_children = false;  ///< braces in text even if there are none
};

/// A scene of version 7. Names are "Model::Hips" in text and "Hips\0\1Model" in binary.
class FbxScene {
  public:
    using Value = FbxRecord::Value;

    std::int64_t add(const std::string& kind, const std::string& name, const std::string& subtype,
                     std::vector<FbxRecord> children = {}) {
        objects_.push_back({kind, {next_, name + "::" + kind, subtype}, std::move(children), true});
        return next_++;
    }
    /// A property of a Properties70.
    static FbxRecord property(const std::string& name, std::vector<Value> values) {
        FbxRecord result{"P", {name, std::string("any"), std::string(), std::string("A")}, {}};
        result.values.insert(result.values.end(), values.begin(), values.end());
        return result;
    }
    static FbxRecord vector(const std::string& name, const glm::dvec3& value) {
        return property(name, {value.x, value.y, value.z});
    }
    static FbxRecord properties(std::vector<FbxRecord> list) {
        return {"Properties70", {}, std::move(list), true};
    }
    static FbxRecord list(const std::string& name, std::vector<double> numbers) {
        return {name, {numbers}, {}};
    }
    static FbxRecord list(const std::string& name, std::vector<std::int64_t> numbers) {
        return {name, {numbers}, {}};
    }

    std::int64_t model(const std::string& name, std::int64_t parent, std::vector<FbxRecord> list,
                       const std::string& subtype = "LimbNode") {
        const std::int64_t id = add("Model", name, subtype, {properties(std::move(list))});
        connect(id, parent);
        return id;
    }
    void connect(std::int64_t child, std::int64_t parent, const std::string& property = "") {
        FbxRecord record{"C", {std::string(property.empty() ? "OO" : "OP"), child, parent}, {}};
        if (!property.empty()) record.values.push_back(property);
        connections_.push_back(std::move(record));
    }

    struct Key {
        double time = 0.0, value = 0.0;
        std::int64_t flags = 4;
        double first = 0.0, second = 0.0;  ///< slopes
        std::uint32_t weights = 218434821;
    };
    static constexpr std::int64_t ticks = 46'186'158'000;
    std::int64_t curve(const std::vector<Key>& keys) {
        std::vector<std::int64_t> times, flags, counts;
        std::vector<double> values, data;
        for (const Key& key : keys) {
            times.push_back(static_cast<std::int64_t>(key.time * static_cast<double>(ticks) + 0.5));
            values.push_back(key.value);
            flags.push_back(key.flags);
            float weights = 0.0f;
            std::memcpy(&weights, &key.weights, sizeof weights);
            data.insert(data.end(), {key.first, key.second, static_cast<double>(weights), 0.0});
            counts.push_back(1);
        }
        return add("AnimationCurve", "", "",
                   {list("KeyTime", times), list("KeyValueFloat", values), list("KeyAttrFlags", flags),
                    list("KeyAttrDataFloat", data), list("KeyAttrRefCount", counts)});
    }
    std::int64_t stack(const std::string& name, double end, double begin = 0.0) {
        const auto at = [](double time) {
            return static_cast<std::int64_t>(time * static_cast<double>(ticks) + 0.5);
        };
        return add("AnimationStack", name, "",
                   {properties({property("LocalStart", {at(begin)}), property("LocalStop", {at(end)})})});
    }
    std::int64_t layer(std::int64_t stack, std::vector<FbxRecord> list = {}) {
        const std::int64_t id = add("AnimationLayer", "", "", {properties(std::move(list))});
        connect(id, stack);
        return id;
    }
    /// Up to three curves for a property of a model; empty ones are omitted.
    std::int64_t animate(std::int64_t layer, std::int64_t model, const std::string& property,
                         const std::vector<std::vector<Key>>& curves, const glm::dvec3& constant) {
        const std::int64_t node =
            add("AnimationCurveNode", "", "",
                {properties({FbxScene::property("d|X", {constant.x}), FbxScene::property("d|Y", {constant.y}),
                             FbxScene::property("d|Z", {constant.z})})});
        connect(node, layer);
        connect(node, model, property);
        const char* const axes[] = {"d|X", "d|Y", "d|Z"};
        for (std::size_t i = 0; i < curves.size(); ++i)
            if (!curves[i].empty()) connect(curve(curves[i]), node, axes[i]);
        return node;
    }
    std::vector<FbxRecord> settings{};
    std::vector<std::int64_t> ids{};  ///< for use by the test that makes the scene

    std::string text(int version = 7400) const {
        std::ostringstream out;
        out << std::setprecision(std::numeric_limits<double>::max_digits10);
        out << "; FBX " << version / 1000 << '.' << version / 100 % 10 << ".0 project file\n\n";
        for (const FbxRecord& each : records(version)) write_text(out, each, 0);
        return out.str();
    }
    /// `packed`: arrays are compressed.
    std::string binary(int version = 7400, bool packed = false) const {
        std::string out = "Kaydara FBX Binary  ";
        out += std::string("\0\x1a\0", 3) + raw(static_cast<std::uint32_t>(version));
        for (const FbxRecord& each : records(version)) write_binary(out, each, version >= 7500, packed);
        out.append(version >= 7500 ? 25 : 13, '\0');
        return out;
    }

  private:
    std::vector<FbxRecord> records(int version) const {
        return {{"FBXHeaderExtension", {}, {{"FBXVersion", {std::int64_t{version}}, {}}}, true},
                {"GlobalSettings", {}, {properties(settings)}, true},
                {"Objects", {}, objects_, true},
                {"Connections", {}, connections_, true}};
    }
    template <class T>
    static std::string raw(T value) {
        std::string bytes(sizeof value, '\0');
        std::memcpy(bytes.data(), &value, sizeof value);
        return bytes;
    }
    static void write_text(std::ostream& out, const FbxRecord& record, int depth) {
        const std::string tabs(static_cast<std::size_t>(depth), '\t');
        out << tabs << record.name << ": ";
        bool first = true, is_array = false;
        for (const Value& value : record.values) {
            if (!first) out << ", ";
            first = false;
            if (const auto* number = std::get_if<std::int64_t>(&value)) out << *number;
            if (const auto* number = std::get_if<double>(&value)) out << *number;
            if (const auto* text = std::get_if<std::string>(&value)) {
                const std::size_t kind = text->find("::");
                out << '"'
                    << (kind == text->npos ? *text : text->substr(kind + 2) + "::" + text->substr(0, kind))
                    << '"';
            }
            const auto write_list = [&](const auto& numbers) {
                out << '*' << numbers.size() << " {\n" << tabs << "\ta: ";
                for (std::size_t i = 0; i < numbers.size(); ++i)
                    out << (i > 0 ? "," : "") << bits(record, numbers[i]);
                out << '\n' << tabs << "}";
                is_array = true;
            };
            if (const auto* numbers = std::get_if<std::vector<double>>(&value)) write_list(*numbers);
            if (const auto* numbers = std::get_if<std::vector<std::int64_t>>(&value)) write_list(*numbers);
        }
        if (!is_array && (record.has_children || !record.children.empty())) {
            out << " {\n";
            for (const FbxRecord& each : record.children) write_text(out, each, depth + 1);
            out << tabs << '}';
        }
        out << '\n';
    }
    /// Text files write the attributes of keys as the integers of their bits.
    template <class T>
    static std::string bits(const FbxRecord& record, T number) {
        std::ostringstream out;
        out << std::setprecision(std::numeric_limits<double>::max_digits10);
        if (record.name == "KeyAttrDataFloat") {
            const auto value = static_cast<float>(number);
            std::int32_t integer = 0;
            std::memcpy(&integer, &value, sizeof integer);
            out << integer;
        } else {
            out << number;
        }
        return out.str();
    }
    static void write_binary(std::string& out, const FbxRecord& record, bool wide, bool packed) {
        std::string values;
        for (const Value& value : record.values) {
            if (const auto* number = std::get_if<std::int64_t>(&value)) values += 'L' + raw(*number);
            if (const auto* number = std::get_if<double>(&value)) values += 'D' + raw(*number);
            if (const auto* text = std::get_if<std::string>(&value)) {
                std::string written = *text;
                if (const std::size_t kind = written.find("::"); kind != written.npos)
                    written.replace(kind, 2, std::string("\0\1", 2));
                values += 'S' + raw(static_cast<std::uint32_t>(written.size())) + written;
            }
            const auto write_list = [&](char kind, const auto& numbers) {
                std::string bytes;
                for (const auto number : numbers) bytes += raw(number);
                if (packed) {
                    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
                    std::string smaller(size, '\0');
                    compress(reinterpret_cast<Bytef*>(smaller.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
                    bytes = smaller.substr(0, size);
                }
                values += kind + raw(static_cast<std::uint32_t>(numbers.size())) +
                          raw(std::uint32_t{packed ? 1u : 0u}) +
                          raw(static_cast<std::uint32_t>(bytes.size())) + bytes;
            };
            if (const auto* numbers = std::get_if<std::vector<double>>(&value)) write_list('d', *numbers);
            if (const auto* numbers = std::get_if<std::vector<std::int64_t>>(&value))
                write_list('l', *numbers);
        }
        const std::size_t at = out.size(), size = wide ? 8 : 4;
        const auto put = [&](std::size_t field, std::uint64_t number) {
            std::memcpy(out.data() + at + field * size, &number, size);
        };
        out.append(3 * size, '\0');
        out += static_cast<char>(record.name.size());
        out += record.name + values;
        for (const FbxRecord& each : record.children) write_binary(out, each, wide, packed);
        if (record.has_children || !record.children.empty()) out.append(3 * size + 1, '\0');
        put(0, out.size());
        put(1, record.values.size());
        put(2, values.size());
    }

    std::int64_t next_ = 1000;
    std::vector<FbxRecord> objects_{}, connections_{};
};

/// A small scene with one of each kind of object: two bones, and an animated mesh that follows them.
inline FbxScene bent_leg() {
    FbxScene scene;
    const std::int64_t hips =
        scene.model("Hips", 0, {FbxScene::vector("Lcl Translation", {0.0, 100.0, 0.0})});
    const std::int64_t knee =
        scene.model("Knee", hips, {FbxScene::vector("Lcl Translation", {0.0, -50.0, 0.0})});
    const std::int64_t body = scene.model("Body", 0, {}, "Mesh");
    const std::int64_t mesh = scene.add(
        "Geometry", "", "Mesh",
        {FbxScene::list("Vertices", std::vector<double>{0, 100, 0, 10, 100, 0, 0, 50, 0, 10, 50, 0}),
         FbxScene::list("PolygonVertexIndex", std::vector<std::int64_t>{0, 1, 3, -3})});
    scene.connect(mesh, body);
    const std::int64_t skin = scene.add("Deformer", "", "Skin");
    scene.connect(skin, mesh);
    const auto cluster = [&](std::int64_t bone, std::vector<std::int64_t> points, double y) {
        const std::int64_t id =
            scene.add("Deformer", "", "Cluster",
                      {FbxScene::list("Indexes", points),
                       FbxScene::list("Weights", std::vector<double>(points.size(), 1.0)),
                       FbxScene::list("Transform",
                                      std::vector<double>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -y, 0, 1})});
        scene.connect(id, skin);
        scene.connect(bone, id);
    };
    cluster(hips, {0, 1}, 100.0);
    cluster(knee, {2, 3}, 50.0);
    const std::int64_t shapes = scene.add("Deformer", "", "BlendShape");
    scene.connect(shapes, mesh);
    const std::int64_t channel = scene.add("Deformer", "smile", "BlendShapeChannel");
    scene.connect(channel, shapes);
    const std::int64_t shape = scene.add("Geometry", "smile", "Shape",
                                         {FbxScene::list("Indexes", std::vector<std::int64_t>{1}),
                                          FbxScene::list("Vertices", std::vector<double>{0, 0, 20})});
    scene.connect(shape, channel);
    const std::int64_t layer = scene.layer(scene.stack("bend", 1.0));
    scene.animate(layer, hips, "Lcl Rotation", {{}, {}, {{0.0, 0.0}, {1.0, 90.0}}}, glm::dvec3(0.0));
    const std::int64_t weight = scene.add("AnimationCurveNode", "", "");
    scene.connect(weight, layer);
    scene.connect(weight, channel, "DeformPercent");
    scene.connect(scene.curve({{0.0, 0.0}, {1.0, 50.0}}), weight, "d|DeformPercent");
    return scene;
}

}  // namespace tendril::test
