// The values of all controls as one list of numbers that a descent may change. Not installed.
//
// Each number of a rotation is an angle about an axis of its parent's space, relative to the rotation at the
// start; all others are the values themselves.
#pragma once

#include <cstddef>
#include <vector>

#include "tendril/rig/rig.hpp"

namespace tendril::rig {

class Parameters {
  public:
    /// The numbers of these control values; bools have none.
    Parameters(const Definition& definition, std::vector<Value> start);

    std::size_t size() const noexcept { return parts_.size(); }
    double value(std::size_t parameter) const noexcept { return numbers_[parameter]; }
    void set(std::size_t parameter, double value) noexcept { numbers_[parameter] = value; }
    /// Clamps every number to its range.
    void clamp() noexcept;
    bool at_minimum(std::size_t parameter) const noexcept;
    bool at_maximum(std::size_t parameter) const noexcept;

    /// The control values for the current numbers.
    void write(std::vector<Value>& controls) const;

  private:
    enum class Kind : unsigned char { Translation, Rotation, Scale, Number };
    struct Part {
        std::size_t element;
        Kind kind;
        int axis;
        double minimum, maximum;
    };

    std::vector<Part> parts_;
    std::vector<double> numbers_;
    std::vector<Value> start_;
};

}  // namespace tendril::rig
