// Numeric cases from an independent implementation in double precision. Skipped if the files are missing; the
// other tests do not need them.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "chain_support.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

using Json = nlohmann::json;

glm::vec3 point(const Json& json) {
    return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

Result apply(Chain& chain, const Json& op) {
    const std::string name = op.at("op");
    const auto index = [&] { return op.at("index").get<std::size_t>(); };
    const auto length = [&] { return op.at("length").get<float>(); };
    const auto target = [&] { return point(op.at("target")); };
    if (name == "add" && op.contains("position")) return chain.add(Segment{point(op["position"]), length()});
    if (name == "add") return chain.add(length());
    if (name == "insert" && op.contains("position")) {
        return chain.insert(index(), Segment{point(op["position"]), length()});
    }
    if (name == "insert") return chain.insert(index(), length());
    if (name == "remove") return chain.remove(index());
    if (name == "set_length") return chain.set_length(index(), length());
    if (name == "forward") return chain.forward(target());
    if (name == "backward") return chain.backward(target());
    if (name == "with_index") return chain.with_index(index(), target());
    if (name == "fixed") return chain.fixed(target(), {.iterations = op.value("iterations", 1)}).outcome;
    return {ErrorCode::NotFound, "no operation is called " + name};
}

TEST(ChainReference, AgreesWithAnIndependentImplementation) {
    const std::filesystem::path path = reference_path("chain.json");
    std::ifstream file(path);
    if (!file) GTEST_SKIP() << path << " is not there";

    double worst = 0.0;
    const Json cases = Json::parse(file);
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        Chain chain;
        expect_ok(chain.set_default_direction(point(example.at("default_direction"))));
        for (const Json& op : example.at("ops")) {
            expect_ok(apply(chain, op));
            EXPECT_TRUE(Holds(chain));
        }
        const Json& expected = example.at("expect");
        ASSERT_EQ(chain.size(), expected.at("positions").size());
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const double off = distance(chain.position(i), point(expected["positions"][i]));
            EXPECT_LE(off, example.value("tolerance", 1e-4)) << "segment " << i;
            EXPECT_EQ(chain.length(i), expected.at("lengths").at(i).get<float>()) << "segment " << i;
            worst = std::max(worst, off);
        }
    }
    std::printf("%zu cases, worst deviation %.2g m\n", cases.size(), worst);
    EXPECT_FALSE(cases.empty());
}

}  // namespace
}  // namespace tendril::test
