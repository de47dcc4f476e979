// The unit and the range of a field, appended to its explanation.
#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>

#include "app/shell/input.hpp"
#include "app/shell/ui.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"
#include "app/window/window.hpp"

namespace tendril::app {
namespace {

/// The text of a part of the interface in a panel, and its tooltips, without the window around it.
class TooltipFinder {
  public:
    /// The text that `draw` writes into a panel, and the tooltip under the mouse.
    template <class Draw>
    std::string read(const Draw& draw, glm::vec2 mouse = glm::vec2(-100.0f)) {
        std::string text;
        for (int i = 0; i < 2; ++i) {  // the item under the mouse is known one frame later
            const Event moved = MouseMove{mouse};
            input_.take(&moved);
            ui_.begin({window_->size(), window_->size(), 1.0f}, Theme::Dark, input_, &moved, true);
            ImGui::SetNextWindowPos({0.0f, 0.0f});
            ImGui::SetNextWindowSize({300.0f, 300.0f});
            ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
            ImGui::LogToClipboard();
            draw();
            ImGui::LogFinish();
            text = ImGui::GetClipboardText();
            ImGui::End();
            ui_.end();
        }
        return text;
    }
    void press(bool down) {
        const Event event = MousePress{MouseButton::Left, down};
        input_.take(&event);
    }

  private:
    std::unique_ptr<Window> window_ = open_offscreen({1280, 800});
    Ui ui_;
    Input input_;
};

class Explained : public testing::Test {
  protected:
    /// The tooltip at a position in a panel with this row alone.
    template <class Row>
    std::string at(glm::vec2 mouse, const Row& row) {
        const auto draw = [&] {
            row();
            explain("What it does.");
        };
        const std::string all = finder_.read(draw, mouse);
        const std::size_t begin = all.find("What it does.");
        return begin == all.npos ? "" : all.substr(begin, all.find_first_of("\r\n", begin) - begin);
    }
    std::string of_number(float low, float high, const char* format) {
        return at(field, [&] {
            float value = 0.5f;
            number_field("value", value, 0.1f, low, high, format);
        });
    }

    static constexpr glm::vec2 name{20.0f, 20.0f}, field{200.0f, 20.0f}, below{200.0f, 200.0f};
    TooltipFinder finder_;
};

TEST_F(Explained, EndsWithTheRangeAndTheUnitOfTheField) {
    EXPECT_EQ(of_number(0.0f, 10.0f, "%.3f m"), "What it does. 0 to 10 m.");
    EXPECT_EQ(of_number(0.1f, 0.25f, "%.2f"), "What it does. 0.1 to 0.25.");
    EXPECT_EQ(of_number(-180.0f, 180.0f, "%.0f deg"), "What it does. -180 to 180 degrees.");
    EXPECT_EQ(of_number(0.0f, 80.0f, "%.0f\u00b0"), "What it does. 0 to 80\u00b0.");
    EXPECT_EQ(of_number(0.0f, 100.0f, "%.0f %%"), "What it does. 0 to 100 %.");
    EXPECT_EQ(of_number(0.0f, 1e9f, "%.1f\u00b0/s, no limit"), "What it does. 0\u00b0/s or more.");
    EXPECT_EQ(of_number(1e-6f, 1e9f, "%.3f m"), "What it does. More than 0 m.");
    EXPECT_EQ(of_number(-1e9f, 1e9f, "%.3f m"), "What it does. In metres.");
    EXPECT_EQ(of_number(-1e9f, 1e9f, "%.3f"), "What it does.");
}

TEST_F(Explained, WholeNumbersHaveARangeToo) {
    int value = 3;
    EXPECT_EQ(at(field, [&] { integer_field("value", value, 1, 8); }), "What it does. 1 to 8.");
    EXPECT_EQ(at(field, [&] { integer_slider("value", value, 0, 7); }), "What it does. 0 to 7.");
}

TEST_F(Explained, IsShownAtTheNameToo) {
    float value = 0.5f;
    const auto row = [&] { number_field("value", value, 0.1f, 0.0f, 1.0f, "%.3f"); };
    EXPECT_EQ(at(name, row), "What it does. 0 to 1.");
    EXPECT_EQ(at(below, row), "");
}

TEST_F(Explained, CoversAllThreeFieldsOfAPoint) {
    glm::vec3 point(0.0f);
    for (const float y : {20.0f, 50.0f, 80.0f})
        EXPECT_EQ(at({200.0f, y}, [&] { point_field("at", point, 0.1f, 5.0f); }), "What it does. -5 to 5 m.");
    const auto vector = [&] {
        vector_field("by", point, 0.1f, glm::vec3(0.0f), glm::vec3(1.0f, 2.0f, 3.0f), "%.3f");
    };
    for (const float x : {20.0f, 150.0f, 280.0f})
        EXPECT_EQ(at({x, 45.0f}, vector), "What it does.") << "each has a range of its own";
}

TEST_F(Explained, IsHiddenAfterAClickUntilTheMouseLeaves) {
    const auto row = [] { option_button("a wide enough button", false); };
    EXPECT_EQ(at(name, row), "What it does.");
    finder_.press(true);
    EXPECT_EQ(at(name, row), "");
    finder_.press(false);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(at(name, row), "") << "what the click does is seen";
    EXPECT_EQ(at(below, row), "");
    EXPECT_EQ(at(name, row), "What it does.");
}

TEST_F(Explained, ARowWithoutANumberHasNoRange) {
    const char* const titles[] = {"one", "two"};
    int chosen = 0;
    float value = 0.5f;
    const auto rows = [&] {
        choice_field("choice", chosen, titles, 2);
        explain("What it does.");
        number_field("value", value, 0.1f, 0.0f, 1.0f, "%.3f");
    };
    EXPECT_EQ(at(field, rows), "What it does.");
}

// The marks of axes: round steps, one unit.

TEST(Plot, ValuesOfACurveAreThoseOfItsPointsAndBetweenThem) {
    const Curve curve{.name = "", .points = {{0, 1}, {1, 3}}};
    EXPECT_EQ(value_at(curve, 0.0f), 1.0f);
    EXPECT_EQ(value_at(curve, 0.5f), 2.0f);
    EXPECT_EQ(value_at(curve, 1.0f), 3.0f);
    for (const float outside : {-0.1f, 1.1f}) EXPECT_TRUE(std::isnan(value_at(curve, outside)));
}

TEST(Axis, StepsAreRound) {
    EXPECT_DOUBLE_EQ(axis_step(0.3), 0.5);
    EXPECT_DOUBLE_EQ(axis_step(1.0), 1.0);
    EXPECT_DOUBLE_EQ(axis_step(1.01), 2.0);
    EXPECT_DOUBLE_EQ(axis_step(7.0), 10.0);
    EXPECT_DOUBLE_EQ(axis_step(static_cast<double>(0.3f) / 3.0), 0.1)
        << "rounding is no reason for a wider one";
    for (double smallest = 1e-9; smallest < 1e9; smallest *= 1.37) {
        const double step = axis_step(smallest);
        EXPECT_GE(step, 0.999999 * smallest);
        EXPECT_LE(step, 2.51 * smallest);
    }
    EXPECT_GT(axis_step(0.0), 0.0);
}

TEST(Axis, AllMarksOfAnAxisHaveOneUnit) {
    EXPECT_EQ(axis_text(0.5, 0.5, 2.0, "s"), "0.5 s");
    EXPECT_EQ(axis_text(2.0, 0.5, 2.0, "s"), "2 s");
    EXPECT_EQ(axis_text(0.0, 0.5, 2.0, "s"), "0 s");
    EXPECT_EQ(axis_text(0.1, 0.1, 0.5, "s"), "100 ms");
    EXPECT_EQ(axis_text(0.05, 0.05, 0.25, "s"), "50 ms");
    EXPECT_EQ(axis_text(0.05, 0.05, 1.0, "s"), "0.05 s");
    EXPECT_EQ(axis_text(500.0, 500.0, 2000.0, "m"), "0.5 km");
    EXPECT_EQ(axis_text(120.0, 20.0, 360.0, "deg"), "120 deg");
    EXPECT_EQ(axis_text(-2.0, 1.0, 3.0, ""), "-2");
    EXPECT_EQ(axis_text(0.0, 0.0, 0.0, "s"), "0 s");
    for (double step = 1e-6; step < 1e6; step *= 10.0)
        for (const char* unit : {"s", "m", "deg", ""}) {
            const std::string first = axis_text(step, step, 9.0 * step, unit),
                              last = axis_text(9.0 * step, step, 9.0 * step, unit);
            const auto unit_of = [](const std::string& text) {
                const std::size_t space = text.find(' ');
                return space == text.npos ? "" : text.substr(space);
            };
            EXPECT_EQ(unit_of(first), unit_of(last));
            EXPECT_NE(first, last);
        }
}

}  // namespace
}  // namespace tendril::app
