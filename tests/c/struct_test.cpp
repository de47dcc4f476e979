// Structs of C: their sizes, their defaults, their members by name.
#include <cmath>
#include <tendril/fields.hpp>
#include <tendril/version.hpp>

#include "arm.hpp"

namespace tendril::test {
namespace {

TEST(CStruct, OfAnOlderVersionHasTheDefaultsOfWhatItLacks) {
    TwinArm older({0.5f, 0.4f, 0.3f}), newer({0.5f, 0.4f, 0.3f});
    tendril_ik_options options = tendril_ik_options_default();
    options.weight = 0.25f;
    ASSERT_EQ(newer.solve_c({0.3f, 0.6f, 0.0f}, nullptr), TENDRIL_OK);
    options.size = offsetof(tendril_ik_options, weight);
    ASSERT_EQ(older.solve_c({0.3f, 0.6f, 0.0f}, &options), TENDRIL_OK) << older.error.message;
    EXPECT_TRUE(same_bytes(older.c_joints, newer.c_joints));
    options.size = sizeof options;
    ASSERT_EQ(older.solve_c({0.3f, 0.6f, 0.0f}, &options), TENDRIL_OK);
}

TEST(CStruct, ReportOfAnOlderVersionIsWrittenAsFarAsItGoes) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    arm.c_report.size = offsetof(tendril_ik_report, residual);
    arm.c_report.residual = 77.0f;
    ASSERT_EQ(arm.solve_c({0.3f, 0.6f, 0.0f}, nullptr), TENDRIL_OK);
    EXPECT_EQ(arm.c_report.status, TENDRIL_IK_STATUS_CONVERGED);
    EXPECT_EQ(arm.c_report.residual, 77.0f);
    EXPECT_EQ(arm.c_report.size, offsetof(tendril_ik_report, residual));
}

TEST(CStruct, LimitsOfAnOlderVersionStandCloser) {
    TwinArm arm({0.5f, 0.4f});
    tendril_ik_limit limit = tendril_ik_limit_default();
    limit.size = offsetof(tendril_ik_limit, stiffness);
    std::vector<std::byte> older(2 * limit.size);
    for (std::size_t i = 0; i < 2; ++i) {
        limit.kind = i == 0 ? TENDRIL_IK_JOINT_KIND_FREE : TENDRIL_IK_JOINT_KIND_HINGE;
        limit.max = 1.0f;
        std::memcpy(older.data() + i * limit.size, &limit, limit.size);
    }
    tendril_ik_options c_options = tendril_ik_options_default();
    c_options.limits = reinterpret_cast<const tendril_ik_limit*>(older.data()), c_options.limits_count = 2;
    ik::Options options;
    const ik::Limit limits[] = {{.max = 1.0f}, ik::Limit::hinge({0, 0, 1}, 0.0f, 1.0f)};
    options.limits = limits;
    arm.solve({0.2f, 0.4f, 0.1f}, options, c_options);
}

TEST(CStruct, ElementsOfUnequalSizesAreRefused) {
    TwinArm arm({0.5f, 0.4f});
    tendril_ik_limit limits[2] = {tendril_ik_limit_default(), tendril_ik_limit_default()};
    limits[1].size -= 4;
    tendril_ik_options options = tendril_ik_options_default();
    options.limits = limits, options.limits_count = 2;
    EXPECT_EQ(arm.solve_c({0.3f, 0.6f, 0.0f}, &options), TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(arm.error.message, "options.limits[1]"), nullptr) << arm.error.message;
}

TEST(CStruct, AMemberThatTheCallersStructHasInPartIsNotThere) {
    tendril_error error;
    tendril_ik_options options = tendril_ik_options_default();
    const double pole[4] = {1.0, 2.0, 3.0, 0.0}, more[4] = {2.5, 0.0, 0.0, 0.0};
    options.size = offsetof(tendril_ik_options, pole) + 8;
    EXPECT_EQ(tendril_set(TENDRIL_STRUCT_IK_OPTIONS, &options, "pole", pole, &error), TENDRIL_NOT_FOUND);
    EXPECT_TRUE(std::isnan(options.pole.x));
    EXPECT_EQ(tendril_set(TENDRIL_STRUCT_IK_OPTIONS, &options, "max_iterations", more, &error),
              TENDRIL_INVALID_ARGUMENT);
    EXPECT_EQ(options.max_iterations, 100);
}

TEST(CStruct, OfAnImpossibleSizeIsRefusedByName) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    tendril_ik_options options = tendril_ik_options_default();
    for (const std::uint32_t size :
         {0u, 1u, 3u, static_cast<std::uint32_t>(offsetof(tendril_ik_options, plane)) + 4u,
          static_cast<std::uint32_t>(sizeof options) + 1, 1'000'000'000u}) {
        options.size = size;
        EXPECT_EQ(arm.solve_c({0.3f, 0.6f, 0.0f}, &options), TENDRIL_INVALID_ARGUMENT) << size;
        EXPECT_NE(std::strstr(arm.error.message, "options"), nullptr) << arm.error.message;
    }
    options.size = 0;
    EXPECT_EQ(arm.solve_c({0.3f, 0.6f, 0.0f}, &options), TENDRIL_INVALID_ARGUMENT);
    EXPECT_STREQ(arm.error.message, "ik_solve: options has size 0; make it by tendril_ik_options_default()");
}

TEST(CStruct, OfAProgramNewerThanTheLibraryIsRefusedAsThat) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    struct Newer {
        tendril_ik_options options;
        double more;
    } newer;
    tendril_default(TENDRIL_STRUCT_IK_OPTIONS, &newer, sizeof newer);
    EXPECT_EQ(newer.options.max_iterations, 100);
    EXPECT_EQ(newer.more, 0.0);
    EXPECT_EQ(arm.solve_c({0.3f, 0.6f, 0.0f}, &newer.options), TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(arm.error.message, "compiled for one newer than"), nullptr) << arm.error.message;
}

TEST(CStruct, NamesTheElementThatItRefuses) {
    TwinArm arm({0.5f, 0.4f});
    tendril_ik_limit limits[2] = {tendril_ik_limit_default(), tendril_ik_limit_default()};
    const int wrong = 9;
    std::memcpy(&limits[1].kind, &wrong, sizeof wrong);
    tendril_ik_options options = tendril_ik_options_default();
    options.limits = limits, options.limits_count = 2;
    EXPECT_EQ(arm.solve_c({0.3f, 0.6f, 0.0f}, &options), TENDRIL_INVALID_ARGUMENT);
    EXPECT_STREQ(arm.error.message,
                 "ik_solve: options.limits[1].kind must be one of free to ball_and_socket, got 9");
}

/// Every struct of the header.
class CNames : public testing::TestWithParam<int> {};

TEST_P(CNames, SetInRangeReadBackOutOfRangeRefused) {
    const auto kind = static_cast<tendril_struct>(GetParam());
    alignas(8) std::byte object[1024];
    const std::size_t count = tendril_field_count(kind);
    if (count == 0) return;  // bytes, or no kind yet
    const std::size_t size = tendril_struct_size(kind);
    ASSERT_GT(size, 4u);
    tendril_default(kind, object, size);
    for (std::size_t i = 0; i < count; ++i) {
        tendril_error error{};
        tendril_field field;
        ASSERT_DONE(tendril_field_at(kind, i, &field, &error));
        SCOPED_TRACE(field.name);
        double read[4] = {};
        ASSERT_DONE(tendril_get(kind, object, field.name, read, &error));
        for (int axis = 0; axis < field.values; ++axis)
            EXPECT_TRUE(read[axis] == field.fresh[axis] || read[axis] != read[axis]);
        const bool rotation = field.values == 4;
        for (const double part : {0.0, 0.5, 1.0}) {
            const double low = std::max(field.low, -1e6), high = std::min(field.high, 1e6);
            double value = low + part * (high - low);
            if (field.whole) value = std::floor(value);
            if (field.over_low && value == field.low) continue;
            const double given[4] = {rotation ? 0.0 : value, rotation ? 0.0 : value, rotation ? 0.0 : value,
                                     1.0};
            ASSERT_DONE(tendril_set(kind, object, field.name, given, &error));
            ASSERT_DONE(tendril_get(kind, object, field.name, read, &error));
            for (int axis = 0; axis < field.values; ++axis)
                EXPECT_TRUE(read[axis] == given[axis] ||
                            read[axis] == static_cast<double>(static_cast<float>(given[axis])));
        }
        if (field.choices == nullptr && field.whole && field.high == 1.0)
            continue;                                               // a flag takes any whole number
        if (std::isinf(field.high) || field.high > 1e17) continue;  // a refused solve's residual; a count
        const double beyond[4] = {field.high * 2.0 + 1.0, 0.0, 0.0, field.high + 1.0};
        EXPECT_EQ(tendril_set(kind, object, field.name, beyond, &error), TENDRIL_INVALID_ARGUMENT);
        EXPECT_NE(std::strstr(error.message, field.name), nullptr) << error.message;
        const double nan[4] = {NAN, NAN, NAN, NAN};
        EXPECT_EQ(tendril_set(kind, object, field.name, nan, &error),
                  field.optional ? TENDRIL_OK : TENDRIL_INVALID_ARGUMENT);
        if (!field.optional) continue;
        ASSERT_DONE(tendril_get(kind, object, field.name, read, &error));
        EXPECT_NE(read[0], read[0]) << "unset";
    }
    tendril_error error{};
    double read[4];
    EXPECT_EQ(tendril_get(kind, object, "no_such_member", read, &error), TENDRIL_NOT_FOUND);
}
INSTANTIATE_TEST_SUITE_P(, CNames, testing::Range(1, 64));  // C++ knows no other value of this enumeration

TEST(CNamesOf, EnumerationsAreTheLibrarys) {
    EXPECT_STREQ(tendril_ik_method_name(TENDRIL_IK_METHOD_JACOBIAN_TRANSPOSE),
                 ik::name(ik::Method::JacobianTranspose));
    EXPECT_STREQ(tendril_ik_status_name(TENDRIL_IK_STATUS_TOO_CLOSE), ik::name(ik::Status::TooClose));
    EXPECT_STREQ(tendril_ik_method_name(static_cast<tendril_ik_method>(7)), "?");
    EXPECT_STREQ(tendril_code_name(TENDRIL_BUSY), "TENDRIL_BUSY");
    EXPECT_STREQ(tendril_version(), version_string);
}

TEST(CNamesOf, CheckSaysWhatTheTablesSay) {
    tendril_error error;
    tendril_ik_options options = tendril_ik_options_default();
    EXPECT_DONE(tendril_check(TENDRIL_STRUCT_IK_OPTIONS, &options, &error));
    tendril_ik_limit limit = tendril_ik_limit_default();
    limit.up = 4.0f;
    options.limits = &limit, options.limits_count = 1;
    EXPECT_EQ(tendril_check(TENDRIL_STRUCT_IK_OPTIONS, &options, &error), TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(error.message, "object.limits[0].up"), nullptr) << error.message;
}

}  // namespace
}  // namespace tendril::test
