// N pairs of bodies, and the arguments of calls for them: one for all, or one for each.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "poses.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

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
      refuse_type(name, argument, "a Shape, Shapes or a sequence of Shape");
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
      refuse_type(name, argument, "a Pose or Poses");
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

/// Bodies, poses and first normals: one for all pairs, or one for each.
class Pairs {
 public:
  Pairs(const pybind11::object& shapes1, const pybind11::object& poses1, const pybind11::object& shapes2,
        const pybind11::object& poses2, const std::optional<Doubles>& first_normals = std::nullopt)
      : shapes1_("shapes1", shapes1, count_),
        poses1_("poses1", poses1, count_),
        shapes2_("shapes2", shapes2, count_),
        poses2_("poses2", poses2, count_) {
    if (first_normals) first_.emplace("first_normals", *first_normals, count_);
  }

  std::ptrdiff_t count() const { return count_.value(); }
  PairCount& counted() { return count_; }  ///< for further arguments

  /// The question about pair i. `first` keeps its first normal.
  ProximityQuery query(std::ptrdiff_t i, Vector3& first) const {
    if (first_) first = require_direction(first_->name(i), (*first_)[i]);
    return {&shapes1_[i], &poses1_[i], &shapes2_[i], &poses2_[i], first_ ? &first : nullptr};
  }

  /// Pairs that are asked together: vector lanes are full, and the stack takes 20 kB.
  static constexpr std::size_t kAtOnce = 64;

  /// Asks the pairs from i to `end`, and advances i: many(queries, pairs) of bodies that never throw, one(query, pair) of others.
  template <typename Many, typename One>
  void for_batches(std::ptrdiff_t& i, std::ptrdiff_t end, Many many, One one) const {
    std::array<Vector3, kAtOnce> normals;
    std::array<ProximityQuery, kAtOnce> queries{};
    std::array<std::ptrdiff_t, kAtOnce> pairs{};
    std::size_t size = 0;
    const auto ask = [&] {
      many(std::span<const ProximityQuery>(queries.data(), size), std::span<const std::ptrdiff_t>(pairs.data(), size));
    };
    for (; i < end; ++i) {
      pairs[size] = i;
      queries[size] = query(i, normals[size]);
      // A shape of the program's own may throw, and then its index counts.
      if (!is_power_body(*queries[size].shape1) || !is_power_body(*queries[size].shape2)) {
        one(queries[size], i);
      } else if (++size == kAtOnce) {
        ask();
        size = 0;
      }
    }
    ask();
  }

 private:
  static bool is_power_body(const Shape& shape) {
    return dynamic_cast<const Superellipsoid*>(&shape) != nullptr || dynamic_cast<const Ellipsoid*>(&shape) != nullptr;
  }

  PairCount count_;
  ShapesArgument shapes1_;
  PosesArgument poses1_;
  ShapesArgument shapes2_;
  PosesArgument poses2_;
  std::optional<VectorsArgument> first_;
};

}  // namespace supernormal::python
