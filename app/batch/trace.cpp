#include "app/batch/trace.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "app/batch/output.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/text.hpp"
#include "app/document/units.hpp"
#include "app/io/trace/trace.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using ik::ChainIncident;
using ik::IncidentKind;

std::string place_of(const ChainIncident& incident, const TraceHeader& header) {
    if (incident.joint == ik::no_joint) return {};
    std::string place = "joint " + std::to_string(incident.joint);
    if (incident.joint < header.bones.size()) place += " (" + printable(header.bones[incident.joint]) + ")";
    return place + ", ";
}

std::string frames_of(const ChainIncident& incident) {
    std::string text = "frame " + std::to_string(incident.frame);
    if (incident.last_frame > incident.frame) text += " to " + std::to_string(incident.last_frame);
    return text;
}

std::string amount_of(const ChainIncident& incident) {
    char text[80];
    const double amount = incident.amount;
    switch (incident.kind) {
        case IncidentKind::Flip:
            std::snprintf(text, sizeof text, "turned %.0f degrees", amount);
            return text;
        case IncidentKind::Limit:
            std::snprintf(text, sizeof text, "%.1f degrees beyond its limit", amount);
            return text;
        case IncidentKind::Length:
            std::snprintf(text, sizeof text, "%.3g mm %s", 1000.0 * std::abs(amount),
                          amount < 0.0 ? "shorter" : "longer");
            return text;
        case IncidentKind::Jitter:
            std::snprintf(text, sizeof text, "%.3g mm to either side, %.3g Hz", 1000.0 * amount,
                          incident.hertz);
            return text;
        case IncidentKind::Lag:
            std::snprintf(text, sizeof text, "%.0f frame%s late", amount, amount == 1.0 ? "" : "s");
            return text;
        case IncidentKind::Missed:
            std::snprintf(text, sizeof text, "%.3g mm short", 1000.0 * amount);
            return text;
        case IncidentKind::TargetJump:
            std::snprintf(text, sizeof text, "%.3g m", amount);
            return text;
        case IncidentKind::Repeated:
            return "drawn twice";
        case IncidentKind::Nan:
            break;
    }
    return "not a number";
}

Json incident_json(const ChainIncident& incident, const std::string& chain) {
    Json json{{"frame", incident.frame},
              {"last_frame", incident.last_frame},
              {"joint", incident.joint == ik::no_joint ? Json() : Json(incident.joint)},
              {"kind", ik::name(incident.kind)},
              {"amount", incident.kind == IncidentKind::Nan ? Json() : Json(incident.amount)},
              {"unit", ik::unit(incident.kind)},
              {"cause", incident.cause}};
    if (incident.kind == IncidentKind::Jitter) json["hertz"] = incident.hertz;
    if (!chain.empty()) json["chain"] = chain;
    return json;
}

std::string csv_row(const ChainIncident& incident, const std::string& chain) {
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
        for (const ChainIncident& each : chain.incidents)
            out.write(name + frames_of(each) + ": " + ik::name(each.kind) + ", " +
                      place_of(each, reader.header()) + amount_of(each) + ": " + each.cause + '\n');
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
            for (const ChainIncident& each : chain.incidents) {
                if (options.json) list.push_back(incident_json(each, chain.name));
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
    R"(FILE is what an engine wrote, one frame a line: JSON Lines, CSV, or any log with
positions in it, such as (X=1.0 Y=2.0 Z=3.0), new Vector3(1f, 2f, 3f) or (1, 2, 3).
With - it is read from standard input. Only the joints are required:
  {"tendril": "trace", "up": "z", "handed": "left", "unit": "cm", "fps": 60,
   "bones": ["upper_arm", "lower_arm"], "limits": [null, [0, 150]]}
  {"joints": [[0,0,140],[28,0,138],[52,3,130]], "target": [60,0,130],
   "pole": [30,-50,140], "t": 0.0, "chain": "left"}
  time,j0x,j0y,j0z,j1x,j1y,j1z,j2x,j2y,j2z,tx,ty,tz,px,py,pz
Limits are degrees between the bones before and after a joint; 0 is straight. Up,
hand and unit are guessed where they are not given, and the first line says how.
Prints a line for each incident, with its frame from 0, joint from 0 at the root,
amount and cause; with --json one array:
  [{"frame", "last_frame", "joint", "kind": "flip" | "nan" | "length" | "limit" |
    "missed" | "lag" | "jitter" | "repeated" | "target_jump", "amount", "unit",
    "cause"}]
Files of any length are read as a stream. What is damaged is refused with its line,
or, after the first frames, read up to it.
Exit code 0: nothing was found; 1: something was; 2: the file cannot be read.
To open a scene file that is named trace, write ./trace.)";

}  // namespace tendril::app
