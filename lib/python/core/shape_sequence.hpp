// Sequences of shapes in Python programs.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::python {

/// N shapes of any classes; Python: Shapes. Shapes of one class are contiguous in memory.
class ShapeSequence {
 public:
  /// `owner` keeps the pointees alive.
  ShapeSequence(std::shared_ptr<const void> owner, std::vector<const Shape*> shapes)
      : owner_(std::move(owner)), shapes_(std::move(shapes)) {}

  std::size_t size() const { return shapes_.size(); }
  const Shape& operator[](std::size_t i) const { return *shapes_[i]; }

  /// The shape as a Python object, which keeps all of them alive.
  std::shared_ptr<Shape> share(std::size_t i) const { return {owner_, const_cast<Shape*>(shapes_[i])}; }

 private:
  std::shared_ptr<const void> owner_;
  std::vector<const Shape*> shapes_;
};

/// Shapes from a Python sequence. Raises TypeError, with the entry, unless all entries are Shapes.
std::shared_ptr<ShapeSequence> make_shape_sequence(const char* name, const pybind11::sequence& shapes);

}  // namespace supernormal::python
