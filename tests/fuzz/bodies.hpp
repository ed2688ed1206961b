// Bodies and colliders for the fuzzer of the C interface, made from bytes, and the expectations on their creation.
#pragma once

#include <memory>

#include "byte_reader.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::fuzz {

/// Replaces the text of the last error by a text that no tested function writes.
void forget_last_error();

/// Expects that a call was refused. Since forget_last_error() the text has become a text of `function`, with more than its name.
void expect_refusal(const char* function);

/// A user-defined body of the fuzzer: an ellipsoid that gives wrong answers for some of the directions.
struct UserShape {
  double half_axes[3] = {1, 1, 1};
  int wrong_part = 0;  ///< 0: none, 1: h, 2: r, 3: H
  int axis = 0;        ///< axis of the wrong directions: their component along it exceeds `above`
  double above = 0;    ///< bound on the component along the axis
  double wrong = 0;    ///< added to the answer
  int releases = 0;    ///< how often the library has released it

  bool is_sound() const { return wrong_part == 0; }
};

/// A body of ours or none, with its parameters.
class FuzzedBody {
 public:
  FuzzedBody() = default;
  ~FuzzedBody() { destroy(); }
  FuzzedBody(const FuzzedBody&) = delete;
  FuzzedBody(FuzzedBody&&) = delete;
  FuzzedBody& operator=(const FuzzedBody&) = delete;
  FuzzedBody& operator=(FuzzedBody&&) = delete;

  /// Replaces the body by another one. If the library refuses, as it must outside the documented ranges, by a unit sphere.
  void create(ByteReader& bytes);
  void destroy();

  void set_parameters(ByteReader& bytes);
  void set_rounding(ByteReader& bytes);
  void set_solver(ByteReader& bytes);

  dGeomID geom() const { return geom_; }

  /// Whether it is a convex body: all bodies except user-defined ones with wrong answers.
  bool is_sound() const { return user_ == nullptr || user_->is_sound(); }

 private:
  dGeomID create_superellipsoid(ByteReader& bytes, bool is_ellipsoid);
  static dGeomID create_superovoid(ByteReader& bytes);
  dGeomID create_user_shape(ByteReader& bytes);

  dGeomID geom_ = nullptr;
  std::unique_ptr<UserShape> user_;
};

/// Creates one of ODE's own geoms: sphere, plane, box, capsule, cylinder or ray, with parameters that ODE's assertions accept.
dGeomID create_collider(ByteReader& bytes);

/// Sets a pose of numbers of all kinds. The rotation is valid, or contains a number that is not finite.
void place(dGeomID geom, ByteReader& bytes);

}  // namespace supernormal::fuzz
