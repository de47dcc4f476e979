// Random rigs, most of them meaningless; Rig::make accepts them all.
#pragma once

#include "random.hpp"
#include "rig_rigs.hpp"

namespace tendril::rig {

/// `sane`: without numbers that are huge or at the ends of their ranges.
class Maker {
  public:
    explicit Maker(std::uint64_t seed, bool sane = false) : random_(seed), sane_(sane) {}

    Definition definition() {
        const std::size_t count = 2 + random_.below(7);
        for (std::size_t i = 0; i < count; ++i) {
            Element element{.name = numbered("e", static_cast<int>(i)),
                            .kind = static_cast<ElementKind>(random_.below(3))};
            if (i > 0 && !random_.chance(4))
                element.parent = numbered("e", static_cast<int>(random_.below(i)));
            element.initial = transform();
            if (element.kind == ElementKind::Control) element.control = control();
            rig_.elements.push_back(element);
        }
        rig_.curves = {{.name = "curve"}};
        const std::size_t units = 1 + random_.below(6);
        for (std::size_t i = 0; i < units; ++i) {
            Unit unit = this->unit(numbered("u", static_cast<int>(i)), false);
            if (Definition trial = rig_; trial.units.push_back(unit), Rig::make(trial))
                rig_ = std::move(trial);
        }
        return rig_;
    }

    Value value(Type type) {
        switch (type) {
            case Type::Bool:
                return random_.chance(2);
            case Type::Number:
                return number();
            case Type::Vector:
                return vector();
            case Type::Rotation:
                return transform().rotation;
            case Type::Transform:
                break;
        }
        return transform();
    }

  private:
    double number() {
        constexpr double some[] = {0, 1, -1, 0.5, 1e-9, -3, 1e9, -1e9, 7};
        if (!sane_ && random_.chance(3)) return some[random_.below(std::size(some))];
        return static_cast<double>(random_.around(2.0f));
    }
    glm::dvec3 vector() {
        if (!sane_ && random_.chance(6)) return glm::dvec3(0.0);
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }
    Transform transform() {
        Transform made{.translation = vector()};
        const double w = number(), x = number(), y = number(), z = number();
        if (std::abs(w) + std::abs(x) + std::abs(y) + std::abs(z) > 0.1)
            made.rotation = glm::normalize(glm::dquat(w, x, y, z));
        if (random_.chance(4)) {
            const glm::dvec3 scale = vector();
            if (scale.x * scale.y * scale.z != 0.0) made.scale = scale;
        }
        return made;
    }
    TransformFilter filter() {
        TransformFilter made;
        if (random_.chance(2)) return made;
        for (auto* each : {&made.translation, &made.rotation, &made.scale})
            for (bool& axis : *each) axis = random_.chance(2);
        return made;
    }
    Control control() {
        Control made{.kind = static_cast<ControlKind>(random_.below(6))};
        if (random_.chance(3)) made.axes = {2, 0};
        const glm::dvec3 low = vector(), size = vector();
        if (random_.chance(2)) made.minimum = low;
        if (random_.chance(2)) made.maximum = glm::min(low + glm::abs(size), glm::dvec3(1e9));
        return made;
    }
    std::string element() { return rig_.elements[random_.below(rig_.elements.size())].name; }
    Item item(bool in_body) {
        if (in_body && random_.chance(2)) return ThisElement();
        return element();
    }
    FromElement from(bool in_body) {
        return {.element = item(in_body),
                .of = static_cast<Of>(random_.below(8)),
                .space = static_cast<Space>(random_.below(2)),
                .pose = static_cast<Pose>(random_.below(3))};
    }
    template <class T>
    Input<T> input(bool in_body, T literal) {
        switch (random_.below(4)) {
            case 0:
                return from(in_body);
            case 1:
                return FromUnit{numbered("u", static_cast<int>(random_.below(6)))};
            default:
                return literal;
        }
    }
    AimInputs aim_part(bool in_body) {
        return {.axis = input(in_body, vector()),
                .target = input(in_body, vector()),
                .kind = random_.chance(2) ? AimTarget::Location : AimTarget::Direction};
    }

    Unit unit(const std::string& name, bool in_body) {
        Unit made{.name = name};
        switch (random_.below(in_body ? 14 : 18)) {
            case 0:
                made.operation =
                    Aim{.item = item(in_body), .primary = aim_part(in_body), .secondary = aim_part(in_body)};
                break;
            case 1:
                made.operation = AimMath{.transform = input(in_body, transform()),
                                         .primary = aim_part(in_body),
                                         .max_speed = random_.chance(2) ? 30.0 : 0.0};
                break;
            case 2:
                made.operation =
                    ParentConstraint{.item = item(in_body),
                                     .parents = {{.item = item(in_body)},
                                                 {.item = item(in_body), .weight = input(in_body, 0.5)}},
                                     .maintain_offset = random_.chance(2),
                                     .filter = filter()};
                break;
            case 3:
                made.operation = OffsetTransform{.item = item(in_body),
                                                 .offset = input(in_body, transform()),
                                                 .propagate = random_.chance(2)};
                break;
            case 4:
                made.operation = SetTransform{.item = item(in_body),
                                              .transform = input(in_body, transform()),
                                              .space = static_cast<Space>(random_.below(2)),
                                              .propagate = random_.chance(2)};
                break;
            case 5:
                made.operation = SetRotation{.item = item(in_body),
                                             .rotation = input(in_body, transform().rotation),
                                             .propagate = random_.chance(2)};
                break;
            case 6:
                made.operation = ProjectToParent{
                    .child = item(in_body), .old_parent = item(in_body), .new_parent = item(in_body)};
                break;
            case 7:
                made.operation =
                    FromTwoVectors{.from = input(in_body, vector()), .to = input(in_body, vector())};
                break;
            case 8:
                made.operation = TransformLocation{.transform = input(in_body, transform()),
                                                   .location = input(in_body, vector())};
                break;
            case 9:
                made.operation = alpha_interpolate(in_body);
                break;
            case 10:
                made.operation =
                    SpringInterpolate{.target = input(in_body, value(static_cast<Type>(random_.below(5)))),
                                      .strength = input(in_body, std::min(std::abs(number()), 1e4))};
                break;
            case 11:
                made.operation = EvaluateCurve{.value = input(in_body, number())};
                break;
            case 12:
                made.operation = SetCurve{.curve = "curve", .value = input(in_body, number())};
                break;
            case 13:
                made.operation = TransformDirection{.transform = input(in_body, transform()),
                                                    .direction = input(in_body, vector())};
                break;
            case 14:
                made.operation =
                    Fabrik{.root = element(), .tip = element(), .target = input(in_body, vector())};
                break;
            case 15:
                made.operation = TwoBone{.root = element(),
                                         .tip = element(),
                                         .target = input(in_body, vector()),
                                         .pole_target = input(in_body, vector())};
                break;
            case 16:
                made.operation = Spline{.root = element(),
                                        .tip = element(),
                                        .points = {element(), element(), element()},
                                        .b_spline = random_.chance(2),
                                        .fit = random_.chance(2),
                                        .up = vector(),
                                        .roll_start_deg = number(),
                                        .roll_end_deg = input(in_body, number())};
                break;
            default: {
                ForEach loop{
                    .roots = random_.chance(2) ? std::vector{element()} : std::vector{element(), element()},
                    .include_parent = random_.chance(2),
                    .recursive = random_.chance(2)};
                for (int i = 0; i < 2; ++i)
                    loop.body.push_back(unit(numbered((name + ".").c_str(), i), true));
                made.operation = std::move(loop);
            }
        }
        made.weight = random_.chance(3) ? input(in_body, 0.5) : Input<double>(1.0);
        if (random_.chance(6)) made.when = input(in_body, false);
        made.enabled = !random_.chance(12);
        return made;
    }
    AlphaInterpolate alpha_interpolate(bool in_body) {
        AlphaInterpolate made{.value = input(in_body, number())};
        made.map_range = random_.chance(2);
        made.in_range = {number(), number()};
        made.out_range = {number(), number()};
        made.scale = input(in_body, number());
        made.bias = input(in_body, number());
        made.clamp = random_.chance(2);
        made.clamp_min = -number() * number();
        made.clamp_max = number() * number() + 1.0;
        made.interp = random_.chance(2);
        made.speed_increasing = number() * number();
        return made;
    }

    test::Random random_;
    bool sane_;
    Definition rig_;
};

}  // namespace tendril::rig
