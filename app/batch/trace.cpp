#include "app/batch/subcommands.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "app/batch/output.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/io/trace/trace.hpp"
#include "app/system/file.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using ik::IncidentKind;

/// The change that would have prevented a flip; positions in the file's conventions.
Json prevention_json(const Prevention& prevention, const Conventions& space) {
    const TraceSolve& solve = prevention.solve;
    Json json{{"change", prevention_names[static_cast<std::size_t>(prevention.kind)]},
              {"solver", ik::name(solve.method)}};
    if (prevention.pole) {
        const glm::dvec3 to = space.written(*prevention.pole);
        json["to"] = {to.x, to.y, to.z};
    }
    if (solve.soft_zone > 0.0f) json["soft_zone"] = number(solve.soft_zone);
    if (solve.hinge > 0) json["joint"] = solve.hinge;
    return json;
}

Json incident_json(const TracedIncident& incident, const std::string& chain, const Conventions& space) {
    Json json{{"frame", incident.frame},
              {"last_frame", incident.last_frame},
              {"joint", incident.joint == ik::no_joint ? Json() : Json(incident.joint)},
              {"kind", ik::name(incident.kind)},
              {"amount", incident.kind == IncidentKind::Nan ? Json() : Json(incident.amount)},
              {"unit", ik::unit(incident.kind)},
              {"cause", incident.cause}};
    if (incident.hertz > 0.0) json["hertz"] = incident.hertz;
    if (incident.prevented.tried) {
        const auto& flips_in = incident.prevented.flips_in;
        json["flips_in"] = flips_in ? Json(ik::name(*flips_in)) : Json();
        json["prevented_by"] = Json::array();
        for (const Prevention& each : incident.prevented.by)
            json["prevented_by"].push_back(prevention_json(each, space));
    }
    if (!chain.empty()) json["chain"] = chain;
    return json;
}

std::string csv_row(const TracedIncident& incident, const std::string& chain) {
    char amount[40] = "";
    if (incident.kind != IncidentKind::Nan) std::snprintf(amount, sizeof amount, "%.9g", incident.amount);
    const std::string joint = incident.joint == ik::no_joint ? "" : std::to_string(incident.joint);
    return csv_field(chain) + ',' + std::to_string(incident.frame) + ',' +
           std::to_string(incident.last_frame) + ',' + joint + ',' + ik::name(incident.kind) + ',' + amount +
           ',' + ik::unit(incident.kind) + ',' + csv_field(incident.cause) + '\n';
}

void print_lines(const TraceFindings& findings, const TraceReader& reader, Output& out) {
    for (const auto& chain : findings.chains) {
        const std::string name = chain.name.empty() ? "" : printable(chain.name) + ": ";
        for (const TracedIncident& each : chain.incidents) {
            out.write(name + each.text(reader.header().bones, reader.conventions()) + '\n');
            if (each.prevented.tried) out.write("  " + each.prevented.text() + '\n');
            for (const Prevention& change : each.prevented.by)
                out.write("  prevented by: " + change.text(reader.conventions()) + '\n');
        }
        if (chain.left_off > 0)
            out.write(name + count_text(chain.left_off, "more incident") + " not listed\n");
    }
}

}  // namespace

std::size_t run_trace(const TraceOptions& options) {
    const bool standard = options.file == "-";
    const std::string name = standard ? "standard input" : fs::path(options.file).filename().string();
    if (!standard && fs::is_directory(options.file)) throw std::runtime_error(name + ": is a folder");
    std::ifstream file;
    if (!standard) {
        const auto pipe = await_pipe(options.file);
        file.open(options.file, std::ios::binary);
        if (!file) throw std::runtime_error(name + ": " + std::strerror(errno));
    }
    std::error_code no_size;
    const auto size = standard ? 0.0 : static_cast<double>(fs::file_size(options.file, no_size));
    if (options.fps && !(*options.fps >= 0.001 && *options.fps <= 1e6))
        throw std::runtime_error("--fps: must be 0.001 to 1000000, got " + std::to_string(*options.fps));
    std::istream& in = standard ? std::cin : file;
    Progress progress;
    try {
        TraceReader reader(in, options.conventions, options.fps);
        std::uint64_t read = 0;
        const TraceFindings findings = find_incidents(reader, [&] {
            if (++read % 1024 == 0 && !standard && !no_size && size > 0.0)
                progress.show("reading", static_cast<double>(file.tellg()) / size);
        });
        Output out(progress);
        std::uint64_t frames = 0;
        Json list = Json::array();
        if (options.csv) out.write("chain,frame,last_frame,joint,kind,amount,unit,cause\n");
        for (const auto& chain : findings.chains) {
            frames += chain.frames;
            for (const TracedIncident& each : chain.incidents) {
                if (options.json) list.push_back(incident_json(each, chain.name, reader.conventions()));
                if (options.csv) out.write(csv_row(each, chain.name));
            }
        }
        if (options.json) {
            out.write(list.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
        } else if (!options.csv) {
            char rate[60];
            std::snprintf(rate, sizeof rate, reader.fps_known() ? "%.4g fps" : "%.4g fps (not given)",
                          reader.fps());
            out.write(printable(name) + ": " + count_text(frames, "frame") + ", " + rate + ", " +
                      reader.conventions().text() + '\n');
            print_lines(findings, reader, out);
            out.write(count_text(findings.count(), "incident") + '\n');
        }
        out.finish();
        for (const std::string& note : reader.notes()) complain(name + ": " + note);
        return findings.count();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

const char* const trace_help =
    R"(FILE is an engine's output: JSON Lines, CSV, .trc, or any log with positions in
it, such as (X=1.0 Y=2.0 Z=3.0), new Vector3(1f, 2f, 3f), (1, 2, 3) or rows of numbers.
With - it is read from standard input. Only the joints are required:
  {"tendril": "trace", "up": "z", "handed": "left", "unit": "cm", "fps": 60,
   "bones": ["upper_arm", "lower_arm"], "limits": [null, [0, 150]]}
  {"joints": [[0,0,140],[28,0,138],[52,3,130]], "target": [60,0,130],
   "pole": [30,-50,140], "t": 0.0, "chain": "left"}
  time,j0x,j0y,j0z,j1x,j1y,j1z,j2x,j2y,j2z,tx,ty,tz,px,py,pz
The target is the last joint's or, where it is far nearer, another's; "target_joint"
in the first line, or --target-joint, says whose. Limits are degrees between the
bones before and after a joint; 0 is straight. Up, hand and unit are guessed where
they are not given, and the first line says how.
Prints a line for each incident, with its frame from 0, joint from 0 at the root,
amount and cause; with --json one array:
  [{"frame", "last_frame", "joint", "kind": "flip" | "nan" | "length" | "limit" |
    "missed" | "lag" | "jitter" | "repeated" | "target_jump" | "pole_jump" |
    "misplaced", "amount", "unit", "cause"}]
A flip also lists small changes that prevent it, each tried: with any of them
Tendril's solve of the same input does not flip. Without them this solver does:
  "flips_in": "two_bone", "prevented_by": [{"change": "pole" | "soft_zone" |
    "hinge" | "method", "solver", "to": [x, y, z], "soft_zone", "joint"}]
Files of any length are read as a stream. Damaged input is refused with its line
or, after the first frames, read up to there.
Exit code 0: nothing was found; 1: something was; 2: the file cannot be read.
To open a scene file that is named trace, write ./trace.)";

}  // namespace tendril::app
