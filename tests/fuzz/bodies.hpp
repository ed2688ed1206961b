// Bodies and colliders for the fuzzer of the C interface, made from bytes, and what must hold for making them.
#pragma once

#include <memory>

#include "byte_reader.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::fuzz {

/// Has the text of the last error be one that no function under test writes.
void forget_last_error();

/// A call has been refused: since forget_last_error() its text has become that of `function`, and says more than the name.
void expect_refusal(const char* function);

/// What a user-defined body of the fuzzer is: an ellipsoid that gives wrong answers for some of the directions.
struct UserShape {
  double half_axes[3] = {1, 1, 1};
  int wrong_part = 0;  ///< 0 none, 1 h, 2 r, 3 H
  int axis = 0;        ///< of the directions with a component above `above`
  double above = 0;    ///< along the axis
  double wrong = 0;    ///< is added
  int releases = 0;    ///< how often the library has let go of it

  bool is_sound() const { return wrong_part == 0; }
};

/// A body of ours or nothing, and what it was made from.
class FuzzedBody {
 public:
  FuzzedBody() = default;
  ~FuzzedBody() { destroy(); }
  FuzzedBody(const FuzzedBody&) = delete;
  FuzzedBody(FuzzedBody&&) = delete;
  FuzzedBody& operator=(const FuzzedBody&) = delete;
  FuzzedBody& operator=(FuzzedBody&&) = delete;

  /// Another body in the place of this one; a unit sphere where the library refuses, as it must outside of the documented ranges.
  void create(ByteReader& bytes);
  void destroy();

  void set_parameters(ByteReader& bytes);
  void set_rounding(ByteReader& bytes);
  void set_solver(ByteReader& bytes);

  dGeomID geom() const { return geom_; }

  /// Whether its support function is one: everything but a user-defined body that gives wrong answers.
  bool is_sound() const { return user_ == nullptr || user_->is_sound(); }

 private:
  dGeomID create_superellipsoid(ByteReader& bytes, bool is_ellipsoid);
  static dGeomID create_superovoid(ByteReader& bytes);
  dGeomID create_user_shape(ByteReader& bytes);

  dGeomID geom_ = nullptr;
  std::unique_ptr<UserShape> user_;
};

/// One of ODE's own: sphere, plane, box, capsule, cylinder or ray; only with what ODE's own assertions let pass.
dGeomID create_collider(ByteReader& bytes);

/// A pose of numbers of all kinds; the rotation is one, or holds something that is not finite.
void place(dGeomID geom, ByteReader& bytes);

}  // namespace supernormal::fuzz
