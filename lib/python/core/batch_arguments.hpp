// The arguments of calls for N pairs: one for all, or one for each.
#pragma once

#include <pybind11/pybind11.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "poses.hpp"
#include "shape_sequence.hpp"

namespace supernormal::python {

/// The number of pairs: the common length of all arguments that are sequences.
class PairCount {
 public:
  void add(const char* name, std::size_t count) {
    if (name_ != nullptr && count != count_) {
      throw std::invalid_argument(std::string(name) + " has " + std::to_string(count) + " entries and " + name_ + " has " +
                                  std::to_string(count_) + "; they must have as many, or be a single one for all");
    }
    name_ = name;
    count_ = count;
  }

  std::ptrdiff_t value() const { return static_cast<std::ptrdiff_t>(count_); }

 private:
  const char* name_ = nullptr;
  std::size_t count_ = 1;
};

/// One Shape for all pairs, or Shapes, or a sequence of Shape.
class ShapesArgument {
 public:
  ShapesArgument(const char* name, const pybind11::object& argument, PairCount& count) {
    if (pybind11::isinstance<Shape>(argument)) {
      single_ = argument.cast<std::shared_ptr<Shape>>();
      return;
    }
    if (pybind11::isinstance<ShapeSequence>(argument)) {
      shapes_ = argument.cast<std::shared_ptr<ShapeSequence>>();
    } else if (pybind11::isinstance<pybind11::sequence>(argument)) {
      shapes_ = make_shape_sequence(name, argument);
    } else {
      throw pybind11::type_error(std::string(name) + " is " + std::string(pybind11::repr(argument)) +
                                 ", but must be a Shape, Shapes or a sequence of Shape");
    }
    count.add(name, shapes_->size());
  }

  const Shape& operator[](std::ptrdiff_t i) const { return single_ ? *single_ : (*shapes_)[static_cast<std::size_t>(i)]; }

 private:
  std::shared_ptr<Shape> single_;
  std::shared_ptr<ShapeSequence> shapes_;
};

/// One Pose for all pairs, or Poses.
class PosesArgument {
 public:
  PosesArgument(const char* name, const pybind11::object& argument, PairCount& count) {
    if (pybind11::isinstance<Pose>(argument)) {
      single_ = argument.cast<Pose>();
      return;
    }
    if (!pybind11::isinstance<Poses>(argument)) {
      throw pybind11::type_error(std::string(name) + " is " + std::string(pybind11::repr(argument)) +
                                 ", but must be a Pose or Poses");
    }
    poses_ = argument.cast<std::shared_ptr<Poses>>();
    count.add(name, poses_->poses.size());
  }

  const Pose& operator[](std::ptrdiff_t i) const { return poses_ ? poses_->poses[static_cast<std::size_t>(i)] : single_; }

 private:
  Pose single_;
  std::shared_ptr<Poses> poses_;
};

/// Numbers: one for all pairs, or (N,).
class NumbersArgument {
 public:
  NumbersArgument(const char* name, Doubles values, PairCount& count) : name_(name), values_(std::move(values)) {
    if (values_.ndim() == 0) return;
    count.add(name, static_cast<std::size_t>(require_rows(name, values_, {})));
    stride_ = 1;
  }

  double operator[](std::ptrdiff_t i) const { return values_.data()[stride_ * i]; }

  /// Raises ValueError, with the entry, unless all numbers are finite. `unit` is that of the message.
  void require_finite(const char* unit) const {
    for (std::ptrdiff_t i = 0; i < values_.size(); ++i) {
      if (std::isfinite(values_.data()[i])) continue;
      throw std::invalid_argument(Name{name_, stride_ == 0 ? -1 : i}.text() + " = " + to_text(values_.data()[i]) + " " + unit +
                                  " is not finite");
    }
  }

 private:
  const char* name_;
  Doubles values_;
  std::ptrdiff_t stride_ = 0;
};

/// Vectors: (3,) for all pairs, or (N, 3).
class VectorsArgument {
 public:
  VectorsArgument(const char* name, Doubles values, PairCount& count) : name_(name), values_(std::move(values)) {
    if (values_.ndim() == 1 && values_.shape(0) == 3) return;
    count.add(name, static_cast<std::size_t>(require_rows(name, values_, {3})));
    stride_ = 3;
  }

  Vector3 operator[](std::ptrdiff_t i) const { return vector_at(values_.data() + stride_ * i); }
  Name name(std::ptrdiff_t i) const { return {name_, stride_ == 0 ? -1 : i}; }

 private:
  const char* name_;
  Doubles values_;
  std::ptrdiff_t stride_ = 0;
};

}  // namespace supernormal::python
