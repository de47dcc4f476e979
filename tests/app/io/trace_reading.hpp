// Shared by tests of traces: reading a whole trace, and printing points.
#pragma once

#include <sstream>

#include "app/io/trace/trace.hpp"
#include "tests/app/io/trace_support.hpp"

namespace tendril::app {

struct ReadTrace {
    TraceFindings findings;
    Conventions conventions;
    std::vector<std::string> notes, bones;
    const std::vector<TracedIncident>& incidents() const { return findings.chains.front().incidents; }
    std::string text() const {
        std::string all;
        for (const auto& each : incidents())
            all += std::string(ik::name(each.kind)) + " at " + std::to_string(each.frame) + " joint " +
                   std::to_string(static_cast<int>(each.joint)) + " " + std::to_string(each.amount) + ": " +
                   each.cause + "\n";
        return all;
    }
};

inline ReadTrace read_trace(const std::string& text, const ConventionChoice& choice = {}) {
    std::istringstream in(text);
    TraceReader reader(in, choice);
    ReadTrace result{find_incidents(reader), reader.conventions(), reader.notes(), reader.header().bones};
    return result;
}

inline std::string trace_refusal(const std::string& text) {
    try {
        read_trace(text);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "read";
}

inline std::string printed(const glm::dvec3& p, const char* format = "(%.4f, %.4f, %.4f)") {
    char text[200];
    std::snprintf(text, sizeof text, format, p.x, p.y, p.z);
    return text;
}

}  // namespace tendril::app
