// The canvas of a web page: WebGL 2, keyboard, mouse and touch, dropped files.
#pragma once

#include <memory>

#include "app/window/window.hpp"

namespace tendril::app {

/// The page's element #canvas. It follows the size that the page gives it; `poll` never waits.
/// One finger is the left button; two fingers shift the view and zoom.
std::unique_ptr<Window> open_canvas();

}  // namespace tendril::app
