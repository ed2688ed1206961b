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

/// The same equation with |x/(a X)| and |y/(b Y)|, X = 1 + taper_x z/c, Y = 1 + taper_y z/c.
struct SuperovoidParameters {
  SuperellipsoidParameters straight;
  double taper_x = 0;
  double taper_y = 0;
};

class ReleaseCallback;

/// The C++ object behind a geom. It does not depend on the pose.
class Body {
 public:
  explicit Body(const SuperellipsoidParameters& parameters);
  explicit Body(const SuperovoidParameters& parameters);
  explicit Body(std::shared_ptr<const Shape> core);

  /// The body of a shape of the core. Its parameters and its rounding are those of the shape.
  static std::unique_ptr<Body> of(const std::shared_ptr<const Shape>& shape);

  ~Body();
  Body(Body&&) = delete;
  Body& operator=(const Body&) = delete;
  Body& operator=(Body&&) = delete;

  /// The same shape and settings with a serial number of its own. The copies share the release callback.
  std::unique_ptr<Body> copy() const;

  /// The shape, rounding included.
  const Shape& shape() const { return *shape_; }

  /// The smallest half-extent of shape(), m.
  double size() const { return size_; }

  /// Shape::bounding_radius() of shape(), m.
  double radius() const { return radius_; }

  /// Whether the shape changes by the setters only, and with it the serial number. A user's callbacks may answer anything at any
  /// time.
  bool is_known() const { return parameters_.index() != 0; }

  /// The serial number of the shape: 1, 2, ... in the order of creation and change. It is unique in the process, up to 2^32 shapes.
  /// Data cached under it, in any thread, belong to this shape only.
  std::uint32_t serial() const { return serial_; }

  const Settings& settings() const { return settings_; }
  void set_settings(const Settings& settings) { settings_ = settings; }

  /// Contacts that may occur within this time (s) are found, too; 0: overlaps only.
  double look_ahead() const { return look_ahead_; }
  void set_look_ahead(double time) { look_ahead_ = time; }

  /// What lets the impacts of the body happen; null: nothing, or it is gone. A copy has none.
  std::shared_ptr<const void> impacts() const { return impacts_.lock(); }
  void set_impacts(const std::shared_ptr<const void>& impacts) { impacts_ = impacts; }

  /// Null for a body of another kind.
  const SuperellipsoidParameters* superellipsoid() const { return std::get_if<SuperellipsoidParameters>(&parameters_); }
  const SuperovoidParameters* superovoid() const { return std::get_if<SuperovoidParameters>(&parameters_); }

  /// Strong guarantee: a setter that throws leaves the body unchanged.
  void set_superellipsoid(const SuperellipsoidParameters& parameters);
  void set_superovoid(const SuperovoidParameters& parameters);
  void set_rounding(double radius);

  /// Calls `release` once, from the destructor of the last copy, if the callback is armed; null: no callback.
  void set_release_callback(void (*release)(void*), void* user);
  void arm_release_callback() noexcept;

 private:
  Body(const Body&) = default;  // for copy(): with the serial number of the other

  void set_shape(std::shared_ptr<const Shape> core, double rounding);

  std::shared_ptr<const Shape> core_;  // without rounding
  std::shared_ptr<const Shape> shape_;
  double rounding_ = 0;                                                                      // m
  double size_;                                                                              // m
  double radius_;                                                                            // m
  std::variant<std::monostate, SuperellipsoidParameters, SuperovoidParameters> parameters_;  // monostate: a user shape
  Settings settings_;
  double look_ahead_;  // s
  std::weak_ptr<const void> impacts_;
  std::uint32_t serial_;
  std::shared_ptr<ReleaseCallback> release_;  // null: none
};

/// The class data of a geom of ours in ODE. Initially zero, aligned as by malloc, neither constructed nor destroyed.
struct ClassData {
  Body* body;
};

/// The body of the geom. Null if the geom is null, of another class, or empty: created by dCreateGeom(snGeomClass()).
Body* find_body(dGeomID geom) noexcept;

/// The body of the geom. Throws std::invalid_argument where find_body() returns null.
Body& require_body(dGeomID geom, const char* name = "geom");

/// The settings of new geoms. Thread-safe.
Settings default_settings();
void set_default_settings(const Settings& settings);

/// The settings of a pair: the tighter tolerance and the larger limit. The solver is the common one, or the hybrid if they differ.
Settings combined(const Settings& settings1, const Settings& settings2);

}  // namespace supernormal::ode
