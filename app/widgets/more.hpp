// A section's rarely needed rows. They are collected while the section is drawn and come last, below a
// heading "More" that starts folded. The heading counts the values that differ from their defaults.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tendril::app {

/// The command and arguments that a row sets, so that palette and cards find it. Empty for read-only rows.
struct RowOf {
    std::string command{};
    std::vector<std::string> arguments{};
};

class MoreRows {
  public:
    /// `label` is listed in the heading's tooltip unless empty; `draw` must be valid until the section ends.
    void add(std::string label, RowOf of, bool changed, std::function<void()> draw);

    bool empty() const { return rows_.empty(); }
    /// "More", or "More (2 changed)".
    std::string title() const;
    /// Draws the heading; true in a frame in which it is clicked.
    bool head(bool open) const;
    void draw() const;

  private:
    struct Row {
        std::string label;
        RowOf of;
        std::function<void()> draw;
    };
    std::vector<Row> rows_;
    int changed_ = 0;
};

}  // namespace tendril::app
