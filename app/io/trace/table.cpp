// Traces as tables: CSV, or what a spreadsheet copies.
#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "app/document/text.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {
namespace {

std::vector<std::string_view> cells(std::string_view line, char separator) {
    std::vector<std::string_view> found;
    while (true) {
        const std::size_t end = std::min(line.find(separator), line.size());
        std::string_view cell = line.substr(0, end);
        while (!cell.empty() && (cell.front() == ' ' || cell.front() == '"' || cell.front() == '\t'))
            cell.remove_prefix(1);
        while (!cell.empty() && (cell.back() == ' ' || cell.back() == '"' || cell.back() == '\t'))
            cell.remove_suffix(1);
        found.push_back(cell);
        if (end == line.size()) return found;
        line.remove_prefix(end + 1);
    }
}

/// The one that parts the line into most cells; spaces only where there is no other.
char separator_of(std::string_view line) {
    char best = ' ';
    std::ptrdiff_t most = 0;
    for (const char each : {',', ';', '\t', '|'}) {
        const auto count = std::count(line.begin(), line.end(), each);
        if (count > most) most = count, best = each;
    }
    return best;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> found = cells(line, separator);
    if (separator == ' ') std::erase_if(found, [](std::string_view cell) { return cell.empty(); });
    return found;
}

std::optional<double> number_in(std::string_view cell) {
    const auto number = take_number(cell);
    return number && cell.empty() ? number : std::nullopt;
}

bool all_numbers(const std::vector<std::string_view>& cells) {
    return std::ranges::all_of(cells, [](std::string_view cell) { return number_in(cell).has_value(); });
}

enum class Role { Ignored, Time, Dt, Chain, Target, Pole, Joint };
struct Column {
    Role role = Role::Ignored;
    std::size_t joint = 0;
    int axis = 0;
    std::size_t chain = 0;
    double unit = 1.0;  ///< seconds, of a time
};

struct PointColumn {
    std::string base;
    int axis = 0;         ///< 3: w
    bool prefix = false;  ///< "x_elbow"
};

/// "Elbow_X", "elbow.x [cm]", "elbow[0]" and "x_elbow" are axis 0 of "elbow".
std::optional<PointColumn> point_column(std::string_view cell) {
    if (cell.find_first_of("{}=<>") != cell.npos || cell.find(": ") != cell.npos ||
        std::ranges::count(cell, '(') != std::ranges::count(cell, ')'))
        return std::nullopt;
    std::string name = lower_case(cell);
    for (const char* axis : {"(x)", "(y)", "(z)", "(w)"})
        if (name.ends_with(axis)) name.replace(name.size() - 3, 3, 1, axis[1]);
    if (const std::size_t unit = name.find_first_of("([");
        unit != name.npos && unit > 0 && name[unit - 1] == ' ')
        name.resize(unit);
    const auto is_separator = [](char c) { return c == '.' || c == '_' || c == ' ' || c == '-' || c == ':'; };
    while (!name.empty() && is_separator(name.back())) name.pop_back();
    if (name.size() < 2) return std::nullopt;
    const auto axis_of = [](char c) { return c == 'w' ? 3 : c >= 'x' && c <= 'z' ? c - 'x' : -1; };
    int axis = axis_of(name.back());
    bool prefix = false;
    const bool indexed = name.size() > 3 && name.back() == ']' && name[name.size() - 3] == '[';
    if (indexed) {
        const char index = name[name.size() - 2];
        axis = index >= '0' && index <= '3' ? index - '0' : axis_of(index);
        name.resize(name.size() - 3);
    } else if (axis >= 0) {
        name.pop_back();
    } else if (axis = axis_of(name.front());
               axis >= 0 && (is_separator(name[1]) || (name[1] >= '0' && name[1] <= '9'))) {
        name.erase(0, 1);
        prefix = true;
    } else {
        return std::nullopt;
    }
    if (axis < 0) return std::nullopt;
    while (!name.empty() && is_separator(name.back())) name.pop_back();
    while (!name.empty() && is_separator(name.front())) name.erase(0, 1);
    if (name.empty()) return std::nullopt;
    return PointColumn{name, axis, prefix};
}

/// One a cell. "z-score" and "velocity" are none: there is no x of them.
std::vector<std::optional<PointColumn>> point_columns(const std::vector<std::string_view>& row) {
    std::vector<std::optional<PointColumn>> points;
    std::map<std::string, unsigned> axes;
    for (const std::string_view cell : row)
        if (const auto& point = points.emplace_back(point_column(cell)))
            axes[point->base] |= 1u << point->axis;
    for (auto& point : points)
        if (point &&
            (point->prefix ? (axes[point->base] & 7u) != 7u : std::has_single_bit(axes[point->base])))
            point.reset();
    return points;
}

Role role_of(const std::string& base) {
    if (base == "t") return Role::Target;
    if (base == "p") return Role::Pole;
    const bool other = base.size() > 1 && names_no_position(base);
    if (other || base == "q" || base.ends_with("_q") || base.ends_with(".q")) return Role::Ignored;
    constexpr std::array roles{Role::Joint, Role::Target, Role::Pole};
    return roles[static_cast<std::size_t>(meaning_of(base))];
}

}  // namespace

std::optional<Sided> sided(std::string_view base) {
    const auto parts = [](char c) { return c == '.' || c == '_' || c == ' ' || c == '-' || c == ':'; };
    for (const std::string_view name : {"left", "right", "l", "r"}) {
        if (base.size() < name.size() + 2) continue;
        const std::size_t side = name[0] == 'l' ? 0 : 1, rest = base.size() - name.size();
        if (base.starts_with(name) && (name.size() > 1 || parts(base[1])))
            return Sided{side, std::string(base.substr(name.size() + (parts(base[name.size()]) ? 1 : 0)))};
        if (base.ends_with(name) && (name.size() > 1 || parts(base[rest - 1])))
            return Sided{side, std::string(base.substr(0, rest - (parts(base[rest - 1]) ? 1 : 0)))};
    }
    return std::nullopt;
}

double time_unit(std::string_view name) {
    double unit = 1.0;
    bool time = false;
    while (!name.empty()) {
        std::size_t end = 0;
        while (end < name.size() && name[end] >= 'a' && name[end] <= 'z') ++end;
        const std::string_view word = name.substr(0, end);
        name.remove_prefix(std::max<std::size_t>(end, 1));
        const auto is = [&](auto... words) { return ((word == words) || ...); };
        if (is("time", "t", "timestamp", "stamp", "seconds", "elapsed"))
            time = true;
        else if (is("ms", "msec", "milliseconds"))
            unit = 1e-3;
        else if (is("us", "usec", "microseconds"))
            unit = 1e-6;
        else if (is("ns", "nsec", "nanoseconds"))
            unit = 1e-9;
        else if (!is("", "s", "sec", "secs", "header", "field"))
            return 0.0;
    }
    return time ? unit : 0.0;
}

namespace {

class Table final : public RawTrace {
  public:
    Table(std::istream& in, std::string first, std::size_t at) : in_(in), text_(std::move(first)) {
        line = at;
        separator_ = separator_of(text_);
        const std::string names = text_;
        const auto row = split(names, separator_);
        if (all_numbers(row)) {
            without_names(row.size());
            return;
        }
        waiting_ = read_line(in_, text_, line);
        read_names(row, waiting_ ? split(text_, separator_) : row, at);
    }

    bool next(RawFrame& frame) override {
        frame = {};
        if (one_pose_) return next_pose(frame);
        if (!other_.joints.empty()) {
            frame = std::exchange(other_, {});
            return true;
        }
        do {
            if (!waiting_ && !read_line(in_, text_, line)) return false;
            waiting_ = false;
        } while (text_.find_first_not_of(" \t,;") == text_.npos || text_.starts_with('#'));
        frame.line = line;
        frame.joints.assign(joints_, glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
        auto row = split(text_, separator_);
        if (row.size() == columns_.size() + 1 && row.back().empty()) row.pop_back();
        if (row.size() != columns_.size())
            fail_line(line, "expected " + std::to_string(columns_.size()) + " columns, found " +
                                std::to_string(row.size()));
        if (two_sides_) {
            frame.chain = "left";
            other_ = frame;
            other_.chain = "right";
        }
        for (std::size_t i = 0; i < row.size(); ++i)
            take(two_sides_ && columns_[i].chain == 1 ? other_ : frame, i, row[i]);
        other_.time = frame.time;
        other_.dt = frame.dt;
        return true;
    }

  private:
    /// Rows of three numbers are the joints of one pose.
    bool next_pose(RawFrame& frame) {
        if (done_) return false;
        done_ = true;
        frame.line = line;
        do {
            if (text_.find_first_not_of(" \t,;") == text_.npos) continue;
            const auto row = split(text_, separator_);
            if (row.size() != 3 || !all_numbers(row)) fail_line(line, "expected three numbers, x, y and z");
            if (frame.joints.size() == max_trace_joints) fail_line(line, "found more than 4096 joints");
            frame.joints.emplace_back(*number_in(row[0]), *number_in(row[1]), *number_in(row[2]));
        } while (read_line(in_, text_, line));
        return true;
    }

    void without_names(std::size_t count) {
        if (count == 3) {
            one_pose_ = true;
            return;
        }
        const bool time = count % 3 == 1;
        if (count % 3 == 2 || count < 6)
            fail_line(line, "expected x, y and z of each joint, and perhaps a time before them; found " +
                                std::to_string(count) + " numbers");
        if (time) columns_.push_back({.role = Role::Time});
        for (std::size_t i = 0; i < count / 3; ++i)
            for (int axis = 0; axis < 3; ++axis) columns_.push_back({Role::Joint, i, axis});
        joints_ = count / 3;
    }

    /// `values`: the first row of numbers.
    void read_names(const std::vector<std::string_view>& row, const std::vector<std::string_view>& values,
                    std::size_t at) {
        const auto points = point_columns(row);
        std::map<std::string, std::size_t> joints;
        std::array<int, 3> axes{};
        // Points with a w are quaternions, unless w is 1 beside other numbers.
        std::map<std::string, glm::dvec4> fours;
        std::set<std::string> turns;
        for (std::size_t i = 0; i < std::min(row.size(), values.size()); ++i)
            if (points[i]) fours[points[i]->base][points[i]->axis] = number_in(values[i]).value_or(0.0);
        for (const auto& point : points)
            if (point && point->axis == 3 &&
                !(fours[point->base].w == 1.0 && glm::length(fours[point->base]) > 1.02))
                turns.insert(point->base);
        // Both arms in one table: each joint of the one has its like in the other.
        std::array<std::set<std::string>, 2> sides;
        two_sides_ = std::ranges::none_of(row, [](auto cell) { return lower_case(cell) == "chain"; });
        for (const auto& point : points) {
            if (!point || turns.contains(point->base) || role_of(point->base) != Role::Joint) continue;
            const auto side = sided(point->base);
            two_sides_ = two_sides_ && side;
            if (side) sides[side->side].insert(side->part);
        }
        two_sides_ = two_sides_ && sides[0].size() > 1 && sides[0] == sides[1];
        std::string left_out;
        std::map<std::pair<Role, std::size_t>, std::string> aims;
        for (std::size_t i = 0; i < row.size(); ++i) {
            Column column;
            const std::string_view cell = row[i];
            const std::string name = lower_case(cell);
            const auto& point = points[i];
            if (const double unit = time_unit(name); unit > 0.0) {
                column.role = Role::Time;
                column.unit = unit;
            } else if (name == "dt" || name == "delta" || name == "delta_time") {
                column.role = Role::Dt;
            } else if (name == "chain") {
                column.role = Role::Chain;
            } else if (point) {
                column.role = turns.contains(point->base) ? Role::Ignored : role_of(point->base);
                const bool aim = column.role == Role::Target || column.role == Role::Pole;
                const auto side = two_sides_ ? sided(point->base) : std::nullopt;
                if (side) column.chain = side->side;
                const bool second =
                    aim &&
                    ((two_sides_ && !side) ||
                     aims.try_emplace({column.role, column.chain}, point->base).first->second != point->base);
                if (second) column.role = Role::Ignored;
                if (column.role == Role::Ignored && left_out != point->base)
                    notes.push_back("the columns of \"" + printable(left_out = point->base) +
                                    "\" were left out: they are " +
                                    (!second      ? "not positions"
                                     : two_sides_ ? "no side's target"
                                                  : "a second target"));
                if (point->axis == 3) column.role = Role::Ignored;
                column.axis = point->axis;
                if (column.role == Role::Joint) {
                    // Of two sides the second has the first one's joints.
                    const std::string& bone = side ? side->part : point->base;
                    const auto [joint, is_new] = joints.try_emplace(bone, joints.size());
                    if (is_new) header.bones.push_back(bone);
                    column.joint = joint->second;
                    ++axes[static_cast<std::size_t>(column.axis)];
                }
            } else if (!cell.empty()) {
                notes.push_back("column \"" + printable(cell) + "\" was left out");
            }
            columns_.push_back(column);
        }
        joints_ = joints.size();
        for (const int count : axes)
            if (static_cast<std::size_t>(count) != joints_ * (two_sides_ ? 2 : 1))
                fail_line(at, "expected columns x, y and z of every joint: j0x, j0y, j0z, j1x and so on");
        if (joints_ > max_trace_joints) fail_line(at, "found more than 4096 joints");
    }

    void take(RawFrame& frame, std::size_t index, std::string_view cell) {
        const Column& column = columns_[index];
        if (column.role == Role::Ignored) return;
        if (column.role == Role::Chain) {
            frame.chain = std::string(cell);
            return;
        }
        std::string decimal(cell);
        if (separator_ != ',') std::ranges::replace(decimal, ',', '.');
        const auto number = number_in(decimal);
        if (!number && column.role == Role::Time) return;  // a date
        const bool point = column.role == Role::Target || column.role == Role::Pole;
        if (!number && cell.empty() && point) return;  // a frame without a target
        if (!number)
            fail_line(line, "column " + std::to_string(index + 1) + ": expected a number, found \"" +
                                printable(cell.substr(0, 40)) + '"');
        const auto put = [&](std::optional<glm::dvec3>& to) {
            if (!to) to.emplace(0.0);
            (*to)[column.axis] = *number;
        };
        switch (column.role) {
            case Role::Time:
                frame.time = *number * column.unit;
                break;
            case Role::Dt:
                frame.dt = *number;
                break;
            case Role::Target:
                put(frame.target);
                break;
            case Role::Pole:
                put(frame.pole);
                break;
            default:
                frame.joints[column.joint][column.axis] = *number;
        }
    }

    std::istream& in_;
    std::string text_;
    char separator_ = ',';
    std::vector<Column> columns_;
    std::size_t joints_ = 0;
    RawFrame other_;  ///< the right side's, while it was not handed out
    bool waiting_ = true, one_pose_ = false, done_ = false, two_sides_ = false;
};

}  // namespace

bool begins_table(std::string_view line) {
    const auto row = split(line, separator_of(line));
    if (row.size() >= 3 && all_numbers(row)) return true;
    const auto points = std::ranges::count_if(point_columns(row), &std::optional<PointColumn>::has_value);
    if (separator_of(line) != ' ') return points >= 3;
    return points >= 6 && static_cast<std::size_t>(points) + 1 >= row.size();
}

std::unique_ptr<RawTrace> open_table_trace(std::istream& in, std::string first, std::size_t line) {
    return std::make_unique<Table>(in, std::move(first), line);
}

}  // namespace tendril::app
