// Bodies and colliders for the fuzzer of the C interface, made from bytes, and the expectations on making them.
#pragma once

#include <memory>

#include "byte_reader.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::fuzz {

/// Replaces the text of the last error by one that no function under test writes.
void forget_last_error();

/// Expects that a call was refused: since forget_last_error() the text has become that of `function`, and says more than the
/// name.
void expect_refusal(const char* function);

/// A user-defined body of the fuzzer: an ellipsoid that gives wrong answers for some of the directions.
struct UserShape {
  double half_axes[3] = {1, 1, 1};
  int wrong_part = 0;  ///< 0 none, 1 h, 2 r, 3 H
  int axis = 0;        ///< axis of the directions that have a component larger than `above`
  double above = 0;    ///< bound on the component along the axis
  double wrong = 0;    ///< is added to the answer
  int releases = 0;    ///< how often the library has released it

  bool is_sound() const { return wrong_part == 0; }
};

/// A body of ours or none, and the parameters that it was made from.
class FuzzedBody {
 public:
  FuzzedBody() = default;
  ~FuzzedBody() { destroy(); }
  FuzzedBody(const FuzzedBody&) = delete;
  FuzzedBody(FuzzedBody&&) = delete;
  FuzzedBody& operator=(const FuzzedBody&) = delete;
  FuzzedBody& operator=(FuzzedBody&&) = delete;

  /// Replaces the body by another one; a unit sphere if the library refuses, as it must outside of the documented ranges.
  void create(ByteReader& bytes);
  void destroy();

  void set_parameters(ByteReader& bytes);
  void set_rounding(ByteReader& bytes);
  void set_solver(ByteReader& bytes);

  dGeomID geom() const { return geom_; }

  /// Whether it is a convex body: everything but a user-defined body that gives wrong answers.
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

/// Sets a pose of numbers of all kinds; the rotation is valid, or holds a number that is not finite.
void place(dGeomID geom, ByteReader& bytes);

}  // namespace supernormal::fuzz
