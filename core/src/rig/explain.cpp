#include "tendril/rig/explain.hpp"

#include "rig/math.hpp"

namespace tendril::rig {
namespace {

class Recorder final : public Observer {
  public:
    Recorder(ElementId element, Explanation& explanation) : element_(element), explanation_(explanation) {}

    void begin(State& state) override {
        explanation_.input = last_ = state.elements.get(element_, Space::Global);
    }
    void unit_done(std::size_t, State& state) override {
        Contribution step;
        step.before = last_;
        step.after = state.elements.get(element_, Space::Global);
        step.change = relative(step.before, step.after);
        step.metres = detail::length(detail::minus(step.after.translation, step.before.translation));
        step.radians = 2.0 * detail::half_angle_between(step.before.rotation, step.after.rotation);
        last_ = step.after;
        explanation_.units.push_back(step);
    }

  private:
    ElementId element_;
    Explanation& explanation_;
    Transform last_;
};

}  // namespace

Explanation explain(const Rig& rig, const State& state, std::size_t element, Workspace& workspace) {
    State copy = state;
    Explanation explanation;
    Recorder recorder(rig.id(element), explanation);
    rig.solve(copy, 0.0, workspace, &recorder);
    explanation.result = copy.elements.get(rig.id(element), Space::Global);
    return explanation;
}

}  // namespace tendril::rig
