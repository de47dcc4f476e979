// Calls of rope worlds and batches that no program should make: an error each, never a crash.
#include <limits>

#include "arm.hpp"

namespace tendril::test {
namespace {

class RopeCaller {
  public:
    explicit RopeCaller(std::uint64_t seed) : random_(seed) {
        for (tendril_rope_world& world : worlds_)
            EXPECT_EQ(tendril_rope_world_make(nullptr, &world, nullptr), TENDRIL_OK);
        EXPECT_EQ(tendril_ik_batch_make(6, 3, 1, &batch_, nullptr), TENDRIL_OK);
    }
    ~RopeCaller() {
        for (const tendril_rope_world world : worlds_) tendril_rope_world_destroy(world);
        tendril_ik_batch_destroy(batch_);
    }
    RopeCaller(const RopeCaller&) = delete;
    RopeCaller& operator=(const RopeCaller&) = delete;

    /// True if the call was accepted. A refused call must say why.
    bool call() {
        error_.code = TENDRIL_OK;
        std::strcpy(error_.message, "untouched");
        const tendril_code code = some_call();
        EXPECT_EQ(error_.code, code);
        EXPECT_TRUE(code == TENDRIL_OK || std::strcmp(error_.message, "untouched") != 0)
            << tendril_code_name(code);
        return code == TENDRIL_OK;
    }

  private:
    tendril_code some_call() {
        const tendril_rope_world world = some_world();
        switch (random_.below(22)) {
            case 0: {
                if (tendril_rope_particles(world) > 400) return tendril_rope_clear(world, &error_);
                tendril_rope_shape shape = tendril_rope_shape_default();
                shape.from = some_point(), shape.to = some_point();
                shape.segments = static_cast<int32_t>(random_.below(20));
                shape.pin_start = static_cast<int32_t>(random_.below(2));
                spoil(shape.size);
                return tendril_rope_add_rope(world, or_null(&shape), or_null(&bodies_[random_.below(4)]),
                                             &error_);
            }
            case 1: {
                if (tendril_rope_particles(world) > 400) return tendril_rope_clear(world, &error_);
                tendril_rope_cloth_shape shape = tendril_rope_cloth_shape_default();
                shape.columns = static_cast<int32_t>(random_.below(8));
                shape.rows = 5, shape.along = some_point();
                spoil(shape.size);
                return tendril_rope_add_cloth(world, &shape, &bodies_[random_.below(4)], &error_);
            }
            case 2: {
                tendril_rope_sphere shape = tendril_rope_sphere_default();
                shape.centre = some_point(), shape.radius = some_number();
                return random_.chance(2)
                           ? tendril_rope_add_sphere(world, &shape, &colliders_[random_.below(4)], &error_)
                           : tendril_rope_set_sphere(world, some_collider(), &shape, &error_);
            }
            case 3:
                return tendril_rope_move_collider(world, some_collider(), some_point(), some_seconds(),
                                                  &error_);
            case 4:
                return tendril_rope_remove_collider(world, some_collider(), &error_);
            case 5:
            case 6:
            case 7: {
                tendril_rope_report report = tendril_rope_report_default();
                spoil(report.size);
                return tendril_rope_advance(world, some_seconds(), 1, random_.chance(2) ? nullptr : &report,
                                            &error_);
            }
            case 8:
                return tendril_rope_pin(world, some_index(), some_place(), some_seconds(), &error_);
            case 9:
                return random_.chance(2) ? tendril_rope_unpin(world, some_index(), &error_)
                                         : tendril_rope_attach(world, some_index(), some_collider(), &error_);
            case 10:
                return tendril_rope_cut(world, some_body(), some_index(), &bodies_[random_.below(4)],
                                        &error_);
            case 11: {
                const tendril_vec2f line[3] = {
                    {some_number(), -1.0f}, {some_number(), 9.0f}, {some_number(), 3.0f}};
                std::size_t pieces;
                return random_.chance(2) ? tendril_rope_cut_cloth(world, some_body(), or_null(line),
                                                                  some_count(3), &pieces, &error_)
                                         : tendril_rope_part(world, some_body(), or_null(&pieces), &error_);
            }
            case 12:
                return tendril_rope_tie(world, some_index(), some_index(), nullptr, &ties_[random_.below(2)],
                                        &error_);
            case 13: {
                float tension;
                return random_.chance(2)
                           ? tendril_rope_untie(world, ties_[random_.below(2)], &error_)
                           : tendril_rope_tie_tension(world, ties_[random_.below(2)], &tension, &error_);
            }
            case 14:
                return tendril_rope_positions(world, some_body(), or_null(places_), some_index(), &error_);
            case 15:
                return tendril_rope_set_collides(world, some_body(), some_body(), 1, &error_);
            case 16: {
                std::size_t used = 0;
                const tendril_code code =
                    tendril_rope_save(world, or_null(bytes_), some_count(sizeof bytes_), &used, &error_);
                if (code == TENDRIL_OK) used_ = used;
                return code;
            }
            case 17: {
                if (used_ > 0 && random_.chance(3))
                    bytes_[random_.below(used_)] ^= static_cast<unsigned char>(1u << random_.below(8));
                return tendril_rope_load(world, or_null(bytes_), some_count(used_), &error_);
            }
            case 18:
                return tendril_rope_copy(world, some_world(), &error_);
            case 19: {
                std::size_t a, b;
                tendril_vec3 force;
                tendril_rope_body_id body;
                return random_.chance(2)
                           ? tendril_rope_contact_at(world, some_index(), &a, &b, &force, &error_)
                           : tendril_rope_torn_at(world, some_index(), &body, &a, or_null(&b), &error_);
            }
            case 20: {
                tendril_vec3f targets[6];
                for (tendril_vec3f& target : targets) target = some_point();
                return tendril_ik_batch_solve(some_batch(), or_null(targets), some_count(6), nullptr, nullptr,
                                              nullptr, &error_);
            }
            default: {
                tendril_vec3f joints[24];
                for (tendril_vec3f& joint : joints) joint = some_point();
                return random_.chance(2) ? tendril_ik_batch_set_joints(some_batch(), or_null(joints),
                                                                       some_count(24), &error_)
                                         : tendril_ik_batch_chain_joints(some_batch(), some_index(),
                                                                         or_null(joints), 4, &error_);
            }
        }
    }

    template <class Value>
    Value* or_null(Value* values) {
        return random_.chance(20) ? nullptr : values;
    }
    void spoil(std::uint32_t& size) {
        if (random_.chance(25)) size = static_cast<std::uint32_t>(random_.bits());
    }
    std::size_t some_count(std::size_t right) {
        return random_.chance(15)  ? std::size_t{1} << 63
               : random_.chance(8) ? random_.below(right + 1)
                                   : right;
    }
    std::size_t some_index() { return random_.chance(10) ? ~std::size_t{0} : random_.below(40); }
    float some_number() {
        const float all[] = {NAN, INFINITY, -INFINITY, -1.0f, 0.0f, 1e-40f, 1e9f, 3e38f};
        return random_.chance(12) ? all[random_.below(8)] : 0.5f + random_.part();
    }
    tendril_vec3f some_point() { return {some_number(), some_number(), some_number()}; }
    tendril_vec3 some_place() {
        const tendril_vec3f at = some_point();
        return {static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
    }
    double some_seconds() { return random_.chance(9) ? static_cast<double>(some_number()) : 0.01; }
    tendril_rope_world some_world() {
        if (random_.chance(30)) return {static_cast<std::uint32_t>(random_.bits()), 1};
        return worlds_[random_.below(2)];
    }
    tendril_ik_batch some_batch() { return random_.chance(20) ? tendril_ik_batch{3, 7} : batch_; }
    tendril_rope_body_id some_body() {
        if (random_.chance(20))
            return {static_cast<std::uint32_t>(random_.bits()), static_cast<std::uint32_t>(random_.bits())};
        return bodies_[random_.below(4)];
    }
    tendril_rope_collider_id some_collider() {
        return random_.chance(20) ? tendril_rope_collider_id{~0u, 1} : colliders_[random_.below(4)];
    }

    Random random_;
    tendril_rope_world worlds_[2] = {};
    tendril_ik_batch batch_{};
    tendril_rope_body_id bodies_[4] = {};
    tendril_rope_collider_id colliders_[4] = {};
    tendril_rope_tie_id ties_[2] = {};
    tendril_vec3 places_[40] = {};
    unsigned char bytes_[1 << 18] = {};
    std::size_t used_ = 0;
    tendril_error error_{};
};

TEST(CRopeHostile, RandomCallsAreErrors) {
    const std::size_t before = tendril_live_objects();
    {
        RopeCaller caller(1);
        int accepted = 0;
        for (int i = 0; i < 4'000 && !testing::Test::HasFailure(); ++i) accepted += caller.call() ? 1 : 0;
        EXPECT_GT(accepted, 800) << "mostly refused at the door: tests too little";
    }
    EXPECT_EQ(tendril_live_objects(), before);
}

}  // namespace
}  // namespace tendril::test
