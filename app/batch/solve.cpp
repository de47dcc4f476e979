#include "app/batch/subcommands.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <tendril/ik/curve.hpp>
#include <tendril/ik/solver.hpp>

#include "app/batch/cases.hpp"
#include "app/batch/output.hpp"
#include "app/document/scene_file.hpp"
#include "app/fields/solver_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/solver_text.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {
namespace {

using Clock = std::chrono::steady_clock;

struct Row {
    const Case& problem;
    ik::Method method;
    ik::Report report;
    double microseconds;
    const std::vector<glm::vec3>& joints;
    std::optional<ik::CurveReport> curve{};  ///< the curve report, if the case places a chain along a curve
    const LinkageCase* linkage = nullptr;    ///< the linkage in its present pose, if the case is one
    std::string reason{};                    ///< for InvalidInput: the invalid value and its place

    const char* solver() const { return linkage ? "linkage" : curve ? "curve" : ik::name(method); }
    /// "solver", "status", "iterations", "residual" and more.
    Json json() const {
        Json json = linkage ? linkage_row_json(linkage->part) : report_json(method, report);
        json["solver"] = solver();
        if (!reason.empty()) json["reason"] = reason;
        return json;
    }
};

/// Rounds to nanoseconds, the clock's resolution.
Json microseconds_json(double value) {
    return std::round(value * 1000.0) / 1000.0;
}

/// Writes rows, and the text before the first and after the last.
class Rows {
  public:
    virtual ~Rows() = default;
    virtual void begin(Output&) {}
    virtual void add(Output& out, const Row& row) = 0;
    virtual void end(Output&) {}
};

class JsonRows final : public Rows {
  public:
    void add(Output& out, const Row& row) override {
        Json json{{"name", row.problem.name}};
        json.update(row.json());
        if (row.curve)
            json["curve"] = {{"bones_past_end", row.curve->bones_past_end},
                             {"past_end", number(row.curve->past_end)}};
        if (row.problem.normal) json["off_plane"] = number(row.report.off_plane);
        json.erase("ran");  // only in the table; the JSON's keys must not change for scripts
        json["microseconds"] = microseconds_json(row.microseconds);
        if (!row.linkage) {
            Json positions = Json::array();
            for (const glm::vec3& joint : row.joints) positions.push_back(point(joint));
            json["positions"] = std::move(positions);
        }
        out.write(any_ ? ",\n " : "[\n ");
        out.write(json.dump(-1, ' ', false, Json::error_handler_t::replace));
        any_ = true;
    }
    void end(Output& out) override { out.write(any_ ? "\n]\n" : "[]\n"); }

  private:
    bool any_ = false;
};

class CsvRows final : public Rows {
  public:
    /// `more`: additional columns that all cases have.
    explicit CsvRows(std::vector<std::string> more) : more_(std::move(more)) {}
    void begin(Output& out) override {
        std::string line = "name,solver,status,iterations,residual,microseconds";
        for (const std::string& each : more_) line += ',' + csv_field(each);
        out.write(line + '\n');
    }
    void add(Output& out, const Row& row) override {
        std::string line = csv_field(row.problem.name);
        const Json report = row.json();
        for (const char* key : {"solver", "status", "iterations", "residual"}) {
            const Json& value = report[key];
            line += ',' + (value.is_string() ? value.get<std::string>()
                           : value.is_null() ? ""
                                             : value.dump());
        }
        line += ',' + microseconds_json(row.microseconds).dump();
        if (!more_.empty())
            for (const double each : row.linkage->column_values()) line += ',' + Json(each).dump();
        out.write(line + '\n');
    }

  private:
    std::vector<std::string> more_;
};

class TableRows final : public Rows {
  public:
    explicit TableRows(std::size_t name_width) : name_width_(name_width) {}
    void add(Output& out, const Row& row) override {
        if (!headed_) {
            out.write(
                column("name", name_width_) +
                "  solver              status          iterations    residual (m)   time (\xc2\xb5s)  ran\n");
            headed_ = true;
        }
        char rest[256], residual[32] = "-";  // refused input has no residual
        const Json report = row.json();
        if (report["residual"].is_number())
            std::snprintf(residual, sizeof residual, "%.6g", report["residual"].get<double>());
        const std::string ran = row.linkage           ? report["verdict"].get<std::string>()
                                : !row.reason.empty() ? row.reason
                                : row.curve           ? ""
                                                      : ran_text(row.method, row.report);
        std::snprintf(rest, sizeof rest, "  %-18s  %-14s  %10d  %14s  %10.2f  ", row.solver(),
                      report["status"].get_ref<const std::string&>().c_str(), report["iterations"].get<int>(),
                      residual, row.microseconds);
        out.write(column(row.problem.name, name_width_) + rest + ran + '\n');
    }

  private:
    std::size_t name_width_;
    bool headed_ = false;
};

struct Survey {
    std::size_t cases = 0;
    std::size_t name_width = 4;  // at least the header's, "name"
    /// CSV columns that all cases have, if all are linkages with the same drivers and points.
    std::optional<std::vector<std::string>> columns{};
};

/// Calls `take` with each case of a list, or with the single case of an object: a linkage, or a scene with
/// one. Goals given as arguments replace the linkages' own.
void read_all(std::string_view text, const Json& goals, const std::function<bool(Case&, double)>& take) {
    const auto with_goals = [&](Case read, double done) {
        if (!goals.empty() && !read.linkage)
            throw std::runtime_error("--drive and --target are for linkages, case \"" + read.name +
                                     "\" is none");
        if (read.linkage) override_linkage_goals(goals, *read.linkage);
        return take(read, done);
    };
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == text.npos || text[first] != '{') return read_cases(text, with_goals);
    const Json json = parse_json(text);
    if (json.contains("linkage")) {
        with_goals(case_from_json(json, "case", 0), 1.0);
        return;
    }
    if (!json.contains("labs"))
        throw std::runtime_error("expected a list of cases, a linkage or a scene, found none of these");
    const Labs labs;
    Workspace workspace = make_blank_workspace(labs);
    load_scene(workspace, json);
    if (workspace.lab != linkage_lab)
        throw std::runtime_error(
            "expected a list of cases or a scene of the lab linkage, found one of the lab " + workspace.lab);
    Case scene;
    scene.name = "scene";
    scene.linkage = LinkageCase{linkage_part(workspace)};
    with_goals(std::move(scene), 1.0);
}

/// Reads all cases once, so that errors are reported before anything is solved.
Survey check(std::string_view text, const Json& goals, Progress& progress, const std::atomic<bool>& ending) {
    constexpr std::size_t widest = 40;
    Survey survey;
    read_all(text, goals, [&](const Case& read, double done) {
        std::vector<std::string> columns;
        if (read.linkage) columns = read.linkage->columns();
        if (survey.cases++ == 0) survey.columns = columns;
        if (survey.columns != columns) survey.columns = std::vector<std::string>{};
        survey.name_width = std::min(widest, std::max(survey.name_width, width_of(read.name)));
        progress.show("checking the cases", done);
        return !ending;
    });
    return survey;
}

/// The residual is the distance from the tip to the curve's end.
Row place(const Case& problem, std::vector<glm::vec3>& joints) {
    joints = problem.start;
    ik::State state(problem.lengths.size());
    ik::CurveMemory memory;
    const auto begin = Clock::now();
    const ik::CurveReport placed =
        ik::place_along(problem.curve, {problem.lengths, problem.rest_directions}, joints, state, memory);
    const std::chrono::duration<double, std::micro> taken = Clock::now() - begin;
    const ik::Report report{.status = placed.status,
                            .residual = std::max(placed.past_end, placed.short_of_end)};
    return {problem, ik::Method::Fabrik, report, taken.count(), joints, placed};
}

Row solve(const Case& problem, ik::Method method, const SolveOptions& options,
          std::vector<glm::vec3>& joints) {
    Expected<ik::Solver> made = ik::Solver::make(problem.lengths, problem.rest_directions);
    if (!made) throw std::invalid_argument(made.message());
    ik::Solver& solver = *made;
    ik::State state = solver.initial_state();
    ik::Options solve_options;
    solve_options.tolerance = options.tolerance;
    solve_options.max_iterations = options.max_iterations.value_or(solve_options.max_iterations);
    solve_options.pole = problem.pole;
    solve_options.limits = problem.limits;
    if (problem.normal) solve_options.plane = ik::Plane{*problem.normal, problem.bend, problem.angle_limits};
    joints = problem.start;
    const auto begin = Clock::now();
    const ik::Report report = solver.solve(method, joints, state, problem.target, solve_options);
    const std::chrono::duration<double, std::micro> taken = Clock::now() - begin;
    return {problem, method, report, taken.count(), joints, std::nullopt, nullptr, report.accepted.message()};
}

/// Solves one row, starting from the pose of the row before.
Row move_linkage(Case& problem, std::size_t index, LinkageRuntime& runtime, const SolveOptions& options,
                 const std::vector<glm::vec3>& joints) {
    ik::LinkageOptions solve_options;
    solve_options.max_iterations = options.max_iterations.value_or(solve_options.max_iterations);
    if (options.tolerance) solve_options.tolerance = static_cast<double>(*options.tolerance);
    const auto begin = Clock::now();
    problem.linkage->solve(index, runtime, solve_options);
    const std::chrono::duration<double, std::micro> taken = Clock::now() - begin;
    return {problem, ik::Method::Fabrik, {}, taken.count(), joints, std::nullopt, &*problem.linkage};
}

std::unique_ptr<Rows> rows_of(RowFormat format, const Survey& survey) {
    if (format == RowFormat::Json) return std::make_unique<JsonRows>();
    if (format == RowFormat::Csv)
        return std::make_unique<CsvRows>(survey.columns.value_or(std::vector<std::string>{}));
    return std::make_unique<TableRows>(survey.name_width);
}

}  // namespace

std::vector<ik::Method> methods_named(const std::string& name) {
    if (name == "all") return {ik::all_methods.begin(), ik::all_methods.end()};
    if (const auto method = ik::method_named(name)) return {*method};
    throw std::runtime_error("--solver: expected all or one of " + method_names() + ", found " +
                             json_summary(Json(name)));
}

void solve_cases(const SolveOptions& options, const std::atomic<bool>& ending) {
    const Json goals = linkage_goals_from_arguments(options.drivers, options.targets);
    const std::string text = read_text_file(options.cases);
    Progress progress;
    Survey survey;
    try {
        survey = check(text, goals, progress, ending);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(options.cases + ": " + error.what());
    }

    Output out(progress);
    std::size_t done = 0;
    std::vector<glm::vec3> joints;
    const auto rows = rows_of(options.format, survey);
    rows->begin(out);
    const auto each = [&](Case& problem, double) {
        const auto all = static_cast<double>(survey.cases);
        LinkageRuntime runtime;
        const std::size_t count = problem.linkage ? problem.linkage->rows() : 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (ending) return false;
            rows->add(out, move_linkage(problem, i, runtime, options, joints));
            const double part = static_cast<double>(i + 1) / static_cast<double>(count);
            progress.show("solving", (static_cast<double>(done) + part) / all);
        }
        if (problem.linkage) {
            ++done;
            return true;
        }
        for (const ik::Method method : options.methods) {
            if (ending) return false;
            if (!problem.curve.empty()) {
                rows->add(out, place(problem, joints));
                break;  // the method does not apply
            }
            rows->add(out, solve(problem, method, options, joints));
        }
        progress.show("solving", static_cast<double>(++done) / all);
        return true;
    };
    if (!ending) read_all(text, goals, each);
    rows->end(out);
    out.finish();
    progress.clear();
    if (ending) std::fprintf(stderr, "tendril: stopped after %zu cases\n", done);
}

const char* const solve_help =
    "CASES is a JSON list of\n"
    "  {\"name\": \"arm\", \"lengths\": [0.5, 0.4], \"target\": [0.3, 0.6, 0]}\n"
    "with a length in metres for each bone, and optionally\n"
    "  \"curve\"   control points, instead of the target: the chain lies along the curve through them\n"
    "  \"start\"   a point for each joint, one more than lengths; default: straight along +X from the "
    "origin\n"
    "  \"rest\"    the same for the pose that limits are measured from\n"
    "  \"pole\"    the pole target: what the elbow points at\n"
    "  \"plane\"   the normal of a plane that the chain stays in, through its root; with it\n"
    "            \"bend\": \"left\" or \"right\", and \"angle_limits\": for each bone null or\n"
    "            {\"min_deg\": -45, \"max_deg\": 45, \"from\": \"bone\"} (or \"base\") instead of limits\n"
    "  \"limits\"  for each bone, null or the limit of the joint that it starts from:\n"
    "            {\"kind\": \"hinge\", \"axis\": [0, 0, 1], \"min_deg\": 0, \"max_deg\": 145} or\n"
    "            {\"kind\": \"ball_and_socket\", \"axis\": [0, 0, 1], \"up_deg\": 90, \"down_deg\": 40, "
    "\"left_deg\": 60,\n"
    "             \"right_deg\": 60, \"twist_min_deg\": -45, \"twist_max_deg\": 45}; likewise gliding, "
    "saddle,\n"
    "            pivot, suture; free is no limit. Omitted keys take the usual values of that kind of joint.\n"
    "            All kinds may have a \"stiffness\", 0 to 0.99: how much the joint resists turning.\n"
    "A linkage is a case as well, without a solver; its row has the values of --state, points first.\n"
    "  {\"linkage\": \"four_bar\", \"lengths\": {\"crank\": 0.8},\n"
    "   \"drivers\": {\"crank\": {\"from\": 0, \"to\": 360, \"step\": 15}}}\n"
    "  \"linkage\"  a preset by name, with the \"lengths\" to change; or a linkage as in a scene file\n"
    "  \"drivers\"  degrees of a hinge, metres of a slider, by its name: a number, a list or a range\n"
    "  \"targets\"  a point, or a list of them, for points of the linkage by name\n"
    "A list makes a row for each value, each from the pose of the row before; --csv then has columns for\n"
    "drivers and points, where all cases have the same. CASES may be one such object, or a scene of the\n"
    "Linkage lab; --drive and --target replace its drivers and targets.\n"
    "Other keys are ignored. The whole file is checked first: a value of the wrong type or out of its range\n"
    "(1e9 m, a negative length, a wrong number of points, min over max) is reported with its line and\n"
    "place, and nothing is solved (exit code 2). So is a file of more than 64 MB. A case that a solver\n"
    "cannot take, such as five bones for two_bone, has the status InvalidInput in its row, with the reason\n"
    "in a table and in --json. An empty list gives an empty answer.\n"
    "Ctrl+C ends the run with the rows done so far, whole and valid.\n"
    "To open a scene file that is named solve, write ./solve.";

}  // namespace tendril::app
