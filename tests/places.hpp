// File locations, as configured. Compiled into one small source, so that all others are the same in every
// clone and a compiler cache recognises them.
#pragma once

#include <filesystem>
#include <string>

namespace tendril::test {

/// A path from the top of the project: "tests/app/golden/body.glb".
std::string source_path(const std::string& name);

/// Third-party characters; may be missing.
std::filesystem::path characters_folder();

/// Files that readers once failed on; may be missing.
std::filesystem::path found_path(const std::string& name);

/// Numeric cases of an independent implementation: $TENDRIL_REFERENCE_DIR, or else as configured; may be
/// missing.
std::filesystem::path reference_path(const std::string& name);

}  // namespace tendril::test
