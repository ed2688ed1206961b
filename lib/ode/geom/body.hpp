// The body behind a geom of our class: shape, parameters, solver settings, serial number.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <memory>
#include <variant>

#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// (|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon = 1.
struct SuperellipsoidParameters {
  Vector3 half_axes;
  double delta = 2;
  double epsilon = 2;
};

/// The same with |x/(a X)| and |y/(b Y)|, X = 1 + taper_x z/c, Y = 1 + taper_y z/c.
struct SuperovoidParameters {
  SuperellipsoidParameters straight;
  double taper_x = 0;
  double taper_y = 0;
};

/// The C++ object behind a geom. Nothing in it depends on where the geom is.
class Body {
 public:
  explicit Body(const SuperellipsoidParameters& parameters);
  explicit Body(const SuperovoidParameters& parameters);
  explicit Body(std::shared_ptr<const Shape> core);
  ~Body();
  Body(const Body&) = delete;
  Body(Body&&) = delete;
  Body& operator=(const Body&) = delete;
  Body& operator=(Body&&) = delete;

  /// The shape with its rounding.
  const Shape& shape() const { return *shape_; }

  /// The smallest half-extent of shape(), m.
  double size() const { return size_; }

  /// The number 1, 2, ... of the shape, in the order of creation and of changes; never used again in this process (unless 2^32
  /// shapes wrap it around). What is kept under it, in any thread, is of this shape alone.
  std::uint32_t serial() const { return serial_; }

  const Settings& settings() const { return settings_; }
  void set_settings(const Settings& settings) { settings_ = settings; }

  /// s; contacts of pairs that may meet within this time are found too; 0: overlaps only.
  double look_ahead() const { return look_ahead_; }
  void set_look_ahead(double time) { look_ahead_ = time; }

  /// Null for a body of another kind.
  const SuperellipsoidParameters* superellipsoid() const { return std::get_if<SuperellipsoidParameters>(&parameters_); }
  const SuperovoidParameters* superovoid() const { return std::get_if<SuperovoidParameters>(&parameters_); }

  /// These setters leave the body as it was when they throw.
  void set_superellipsoid(const SuperellipsoidParameters& parameters);
  void set_superovoid(const SuperovoidParameters& parameters);
  void set_rounding(double radius);

  /// `release` is called once, when the body dies; it may be null.
  void set_release_callback(void (*release)(void*), void* user) {
    release_ = release;
    user_ = user;
  }

 private:
  void set_shape(std::shared_ptr<const Shape> core, double rounding);

  std::shared_ptr<const Shape> core_;  // the shape without rounding
  std::shared_ptr<const Shape> shape_;
  double rounding_ = 0;                                                                      // m
  double size_;                                                                              // m
  std::variant<std::monostate, SuperellipsoidParameters, SuperovoidParameters> parameters_;  // monostate: a user-defined body
  Settings settings_;
  double look_ahead_;  // s
  std::uint32_t serial_;
  void (*release_)(void*) = nullptr;
  void* user_ = nullptr;
};

/// The memory that ODE keeps for a geom of ours: all zeros at first, aligned as malloc does it, and neither constructed nor
/// destroyed.
struct ClassData {
  Body* body;
};

/// The geom's body; null when the geom is null, of another class, or came from dCreateGeom(snGeomClass()), which leaves it empty.
Body* find_body(dGeomID geom) noexcept;

/// The geom's body; throws std::invalid_argument where find_body() returns null.
Body& require_body(dGeomID geom);

}  // namespace supernormal::ode
