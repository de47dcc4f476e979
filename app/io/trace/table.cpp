// Traces as tables: CSV, or cells copied from a spreadsheet.
#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "app/io/text.hpp"
#include "app/io/trace/log_vectors.hpp"

namespace tendril::app {
namespace {

std::vector<std::string_view> cells(std::string_view line, char separator) {
    std::vector<std::string_view> found;
    while (true) {
        const std::size_t end = std::min(line.find(separator), line.size());
        std::string_view cell = line.substr(0, end);
        constexpr std::string_view blank = " \"\t";
        cell.remove_prefix(std::min(cell.find_first_not_of(blank), cell.size()));
        cell = cell.substr(0, cell.find_last_not_of(blank) + 1);
        found.push_back(cell);
        if (end == line.size()) return found;
        line.remove_prefix(end + 1);
    }
}

/// The separator that splits the line into most cells; spaces only if there is no other.
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

/// One per cell. Empty for names such as "z-score" and "velocity", which have no x column.
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

/// True if a column's name is only an axis: X, or X1 as in a .trc file.
bool is_axis(std::string_view cell) {
    cell = cell.substr(0, std::min(cell.find_first_of("0123456789"), cell.size()));
    return cell.size() == 1 && std::string_view("xyzwXYZW").find(cell) != cell.npos;
}

/// The column names in a line. If they are only axes, the line above has the names of points, each over three
/// columns or repeated: "shoulder,,,elbow,," over "X,Y,Z,X,Y,Z".
std::vector<std::string> column_names(Lines& lines, std::size_t at, char separator) {
    const auto row = split(*lines.ahead(at), separator);
    std::vector<std::string> names(row.begin(), row.end());
    if (std::ranges::count_if(row, is_axis) < 6) return names;
    std::vector<std::string> points(row.size());
    for (std::size_t above = at; above-- > 0;) {
        auto upper = cells(*lines.ahead(above), separator);
        upper.resize(row.size());
        std::set<std::string_view> different;
        bool numbers = false, words = false;
        std::string_view last;
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (!is_axis(row[i])) {
                if (names[i].empty()) names[i] = upper[i];
                continue;
            }
            if (!upper[i].empty()) last = upper[i];
            upper[i] = last;
            different.insert(last);
            if (!last.empty()) (number_in(last) ? numbers : words) = true;
        }
        if (words == numbers) break;  // a blank line, or not part of the header
        if (numbers || different.size() < 2) continue;
        for (std::size_t i = 0; i < row.size(); ++i)
            if (is_axis(row[i]))
                points[i] = std::string(upper[i]) + (points[i].empty() ? "" : " ") + points[i];
    }
    std::size_t count = 0;  // number of unnamed points
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (!is_axis(row[i])) continue;
        if ((row[i][0] | 0x20) == 'x') ++count;
        if (points[i].empty() && row[i].size() == 1) points[i] = "joint" + std::to_string(count - 1);
        if (!points[i].empty()) names[i] = points[i] + ' ' + row[i][0];
    }
    return names;
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

enum class Role { Ignored, Time, Dt, Chain, Point };
struct Column {
    Role role = Role::Ignored;
    std::size_t point = 0;
    std::size_t axis = 0;
    double unit = 1.0;  ///< seconds per unit, for a time column
};

class TableRows final : public VectorLines {
  public:
    TableRows(Lines& lines, char separator) : lines_(lines), separator_(separator) {}

    /// `names`: the names of all columns.
    void read_names(const std::vector<std::string>& names, RawTrace& trace) {
        const std::vector<std::string_view> row(names.begin(), names.end());
        const auto points = point_columns(row);
        std::map<std::string, std::size_t> known;
        std::set<std::string> left_out;
        std::vector<unsigned> axes;
        for (std::size_t i = 0; i < row.size(); ++i) {
            Column& column = columns_.emplace_back();
            const std::string name = lower_case(row[i]);
            if (const double unit = time_unit(name); unit > 0.0) {
                column.role = Role::Time;
                column.unit = unit;
            } else if (name == "dt" || name == "delta" || name == "delta_time") {
                column.role = Role::Dt;
            } else if (name == "chain") {
                column.role = Role::Chain;
            } else if (points[i]) {
                const std::string& base = points[i]->base;
                if (base.size() > 1 && names_no_position(base)) {
                    if (left_out.insert(base).second)
                        trace.notes.push_back("the columns of \"" + printable(base) +
                                              "\" were left out: they are not positions");
                    continue;
                }
                const auto [point, is_new] = known.try_emplace(base, points_.size());
                if (is_new) {
                    LogVector& made = points_.emplace_back();
                    add_words(made.words, base == "t" ? "target" : base == "p" ? "pole" : base);
                    axes.push_back(0);
                }
                column = {Role::Point, point->second, static_cast<std::size_t>(points[i]->axis)};
                axes[column.point] |= 1u << column.axis;
            } else if (!name.empty() && name.find("frame") == name.npos) {
                trace.notes.push_back("column \"" + printable(row[i]) + "\" was left out");
            }
        }
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if ((axes[i] & 7u) != 7u)
                fail_line(lines_.taken(),
                          "expected columns x, y and z of every joint: j0x, j0y, j0z, j1x and so on");
            points_[i].numbers.resize(axes[i] == 15u ? 4 : 3);
        }
    }

    bool next(std::vector<LogVector>& found) override {
        std::string text;
        do {
            if (!lines_.next(text)) return false;
        } while (text.find_first_not_of(" \t,;|-:+=") == text.npos || text.starts_with('#'));
        auto row = split(text, separator_);
        if (row.size() == columns_.size() + 1 && row.back().empty()) row.pop_back();
        if (row.size() != columns_.size())
            fail_line(lines_.taken(), "expected " + std::to_string(columns_.size()) + " columns, found " +
                                          std::to_string(row.size()));
        if (std::exchange(first_, false) &&
            std::ranges::none_of(row, [](auto cell) { return number_in(cell).has_value(); }))
            return next(found);  // units
        found = points_;
        std::optional<double> time, dt;
        std::string chain;
        std::vector<bool> empty(points_.size());
        for (std::size_t i = 0; i < row.size(); ++i) {
            const Column& column = columns_[i];
            if (column.role == Role::Ignored) continue;
            const auto number = number_in(row[i]);
            if (column.role == Role::Chain)
                chain = std::string(row[i]);
            else if (column.role == Role::Time)
                time = number ? std::optional(*number * column.unit)
                              : std::nullopt;  // otherwise it may be a date
            else if (row[i].empty() && column.role == Role::Point)
                empty[column.point] = true;
            else if (!number)
                fail_line(lines_.taken(), "column " + std::to_string(i + 1) +
                                              ": expected a number, found \"" +
                                              printable(row[i].substr(0, 40)) + '"');
            else if (column.role == Role::Dt)
                dt = number;
            else
                found[column.point].numbers[column.axis] = *number;
        }
        for (std::size_t i = 0; i < points_.size(); ++i) {
            found[i].line = lines_.taken();
            found[i].stamp = time;
            found[i].dt = dt;
            found[i].chain = chain;
            found[i].missing = empty[i];
            if (found[i].missing)
                std::ranges::fill(found[i].numbers, std::numeric_limits<double>::quiet_NaN());
        }
        if (!found.empty()) found[0].first = true, found[0].gap = NextLine;
        return true;
    }

  private:
    Lines& lines_;
    char separator_;
    std::vector<Column> columns_;
    std::vector<LogVector> points_;  ///< points without their numbers
    bool first_ = true;
};

}  // namespace

std::unique_ptr<VectorLines> open_table(Lines& lines, RawTrace& trace) {
    constexpr std::size_t most = 24;  // lines above the names
    for (std::size_t at = 0; at < most && lines.ahead(at); ++at) {
        std::string line = *lines.ahead(at);
        const char separator = separator_of(line);
        auto names = column_names(lines, at, separator);
        if (!names.empty() && names[0].starts_with('#')) names[0].erase(0, 1);
        if (separator == ' ' && !names.empty() && names[0].empty()) names.erase(names.begin());
        const std::vector<std::string_view> row(names.begin(), names.end());
        const auto points = static_cast<std::size_t>(
            std::ranges::count_if(point_columns(row), [](const auto& each) { return each.has_value(); }));
        if (separator != ' ' ? points < 3 : points < 6 || points + 1 < row.size()) continue;
        lines.drop(at + 1);
        auto rows = std::make_unique<TableRows>(lines, separator);
        rows->read_names(names, trace);
        return rows;
    }
    return nullptr;
}

}  // namespace tendril::app
