// The backends without a display that are available on this machine.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>

#include "app/view/picture.hpp"
#include "app/view/renderer.hpp"
#include "app/window/window.hpp"
#include "tests/labels.hpp"

namespace tendril::test {

/// The reason why it cannot open a window; empty if it can.
inline std::string why_missing(app::Backend backend) {
    static std::map<app::Backend, std::string> known;
    const auto [found, is_new] = known.try_emplace(backend);
    try {
        if (is_new) static_cast<void>(app::open_window(backend, {8, 8}));
    } catch (const std::exception& error) {
        found->second = error.what();
    }
    return found->second;
}

/// For testing::ValuesIn: OSMesa and EGL, if available.
inline std::vector<app::Backend> backends_here() {
    std::vector<app::Backend> here;
    for (const app::Backend each : {app::Backend::OsMesa, app::Backend::Egl})
        if (why_missing(each).empty()) here.push_back(each);
    return here;
}

}  // namespace tendril::test
