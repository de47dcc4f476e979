#include "app/widgets/expression.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace tendril::app {
namespace {

enum class Kind { Length, Angle, Time, Speed, Turning, Frequency, Share };

struct Unit {
    std::string_view name;
    Kind kind;
    double size;  ///< the size of one, in the first unit of its kind
};
constexpr double degrees = 180.0 / std::numbers::pi;
constexpr std::array units{Unit{"m", Kind::Length, 1.0},         Unit{"km", Kind::Length, 1e3},
                           Unit{"cm", Kind::Length, 1e-2},       Unit{"mm", Kind::Length, 1e-3},
                           Unit{"in", Kind::Length, 0.0254},     Unit{"ft", Kind::Length, 0.3048},
                           Unit{"deg", Kind::Angle, 1.0},        Unit{"\u00b0", Kind::Angle, 1.0},
                           Unit{"rad", Kind::Angle, degrees},    Unit{"s", Kind::Time, 1.0},
                           Unit{"ms", Kind::Time, 1e-3},         Unit{"min", Kind::Time, 60.0},
                           Unit{"m/s", Kind::Speed, 1.0},        Unit{"cm/s", Kind::Speed, 1e-2},
                           Unit{"km/h", Kind::Speed, 1.0 / 3.6}, Unit{"deg/s", Kind::Turning, 1.0},
                           Unit{"\u00b0/s", Kind::Turning, 1.0}, Unit{"rad/s", Kind::Turning, degrees},
                           Unit{"Hz", Kind::Frequency, 1.0},     Unit{"kHz", Kind::Frequency, 1e3},
                           Unit{"/s", Kind::Frequency, 1.0},     Unit{"%", Kind::Share, 1.0}};

const Unit* find_unit(std::string_view name) {
    for (const Unit& each : units)
        if (each.name == name) return &each;
    return nullptr;
}

std::string quoted(std::string_view text) {
    return '"' + std::string(text) + '"';
}

/// Reads from left to right; left() is the unread rest.
class Reader {
  public:
    explicit Reader(std::string_view text) : left_(text) { skip(); }

    std::optional<double> sum() {
        std::optional<double> value = product();
        while (value) {
            if (take('+')) {
                value = with(value, product(), [](double a, double b) { return a + b; });
            } else if (take('-')) {
                value = with(value, product(), [](double a, double b) { return a - b; });
            } else {
                break;
            }
        }
        return value;
    }
    std::string_view left() const { return left_; }

  private:
    static constexpr int deepest = 50;

    template <class Do>
    static std::optional<double> with(std::optional<double> a, std::optional<double> b, Do combine) {
        return a && b ? std::optional(combine(*a, *b)) : std::nullopt;
    }
    std::optional<double> product() {
        std::optional<double> value = power();
        while (value) {
            if (take('*')) {
                value = with(value, power(), [](double a, double b) { return a * b; });
            } else if (!left_.starts_with("/s") && take('/')) {
                value = with(value, power(), [](double a, double b) { return a / b; });
            } else {
                break;
            }
        }
        return value;
    }
    std::optional<double> power() {
        if (depth_ > deepest) return std::nullopt;
        if (take('+')) return deeper(&Reader::power);
        if (take('-')) {
            const std::optional<double> value = deeper(&Reader::power);
            return value ? std::optional(-*value) : value;
        }
        const std::optional<double> base = single();
        if (!base || !take('^')) return base;
        return with(base, deeper(&Reader::power), [](double a, double b) { return std::pow(a, b); });
    }
    std::optional<double> single() {
        if (take('(')) {
            const std::optional<double> value = deeper(&Reader::sum);
            return value && take(')') ? value : std::nullopt;
        }
        if (left_.starts_with("pi")) {
            left_.remove_prefix(2);
            skip();
            return std::numbers::pi;
        }
        double value = 0.0;
        const auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
        if (end == left_.data() || left_.starts_with("inf") || left_.starts_with("nan")) return std::nullopt;
        const std::string_view digits(left_.data(), static_cast<std::size_t>(end - left_.data()));
        const bool tiny =
            digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos;
        if (error == std::errc::result_out_of_range) value = tiny ? 0.0 : HUGE_VAL;
        left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
        skip();
        return value;
    }
    std::optional<double> deeper(std::optional<double> (Reader::*read)()) {
        ++depth_;
        const std::optional<double> value = (this->*read)();
        --depth_;
        return value;
    }
    bool take(char symbol) {
        if (!left_.starts_with(symbol)) return false;
        left_.remove_prefix(1);
        skip();
        return true;
    }
    void skip() {
        while (left_.starts_with(' ') || left_.starts_with('\t')) left_.remove_prefix(1);
    }

    std::string_view left_;
    int depth_ = 0;
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

}  // namespace

TypedNumber read_number(std::string_view text, std::string_view unit) {
    Reader reader(text);
    std::optional<double> value = reader.sum();
    if (!value) return {std::nullopt, quoted(trimmed(text)) + " is not a number"};
    if (std::isnan(*value)) return {std::nullopt, quoted(trimmed(text)) + " has no value"};
    const std::string_view name = trimmed(reader.left());
    if (name.empty() || name == unit) return {value, {}};
    const Unit* const given = find_unit(name);
    const Unit* const wanted = find_unit(unit);
    if (given == nullptr) return {std::nullopt, quoted(trimmed(text)) + " is not a number"};
    if (wanted == nullptr) return {std::nullopt, quoted(trimmed(text)) + ": this number has no unit"};
    if (wanted->kind != given->kind)
        return {std::nullopt, quoted(trimmed(text)) + ": this number is in " + std::string(unit)};
    return {*value * given->size / wanted->size, {}};
}

std::string unit_of(std::string_view format) {
    const std::size_t number = format.find('%');
    const std::size_t end = format.find_first_of("fgdeu", number);
    if (number == std::string_view::npos || end == std::string_view::npos) return {};
    std::string_view behind = format.substr(end + 1);
    while (behind.starts_with(' ')) behind.remove_prefix(1);
    if (behind.starts_with("%%")) behind.remove_prefix(1);
    return std::string(trimmed(behind));
}

}  // namespace tendril::app
