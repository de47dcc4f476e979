// Where things are on this machine. Compiled into one small source, so that all others are the same in every
// clone and a compiler cache knows them again.
#pragma once

#include <filesystem>
#include <string>

namespace tendril::test {

/// From the top of the project: "tests/app/golden/body.glb".
std::string source_path(const std::string& name);

/// Characters that others made; may be missing.
std::filesystem::path characters_folder();

/// Numeric cases of an independent implementation: $TENDRIL_REFERENCE_DIR, else as configured; may be
/// missing.
std::filesystem::path reference_path(const std::string& name);

}  // namespace tendril::test
