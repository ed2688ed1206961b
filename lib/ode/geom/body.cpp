#include "ode/geom/body.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "ode/geom/geom_class.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/support/last_error.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace supernormal::ode {
namespace {

std::mutex default_mutex;
Settings default_value;

}  // namespace

/// Calls `release` when it dies, if it is armed.
class ReleaseCallback {
 public:
  ReleaseCallback(void (*release)(void*), void* user) : release_(release), user_(user) {}
  ~ReleaseCallback() {
    if (!is_armed_) return;
    succeeds("release", [&] { release_(user_); });
  }
  ReleaseCallback(const ReleaseCallback&) = delete;
  ReleaseCallback(ReleaseCallback&&) = delete;
  ReleaseCallback& operator=(const ReleaseCallback&) = delete;
  ReleaseCallback& operator=(ReleaseCallback&&) = delete;

  void arm() noexcept { is_armed_ = true; }

 private:
  void (*release_)(void*);
  void* user_;
  bool is_armed_ = false;
};

namespace {

std::atomic<std::uint32_t> last_serial{0};

std::shared_ptr<const Shape> make_superellipsoid(const SuperellipsoidParameters& p) {
  if (p.delta == 2 && p.epsilon == 2) return std::make_shared<Ellipsoid>(p.half_axes);
  return std::make_shared<Superellipsoid>(p.half_axes, p.delta, p.epsilon);
}

std::shared_ptr<const Shape> make_superovoid(const SuperovoidParameters& p) {
  return std::make_shared<Superovoid>(p.straight.half_axes, p.straight.delta, p.straight.epsilon, p.taper_x, p.taper_y);
}

}  // namespace

Body::Body(std::shared_ptr<const Shape> core)
    : core_(std::move(core)),
      shape_(core_),
      size_(shape_->half_extents().minCoeff()),
      radius_(shape_->bounding_radius()),
      settings_(default_settings()),
      look_ahead_(default_look_ahead()),
      serial_(++last_serial) {}

Body::Body(const SuperellipsoidParameters& parameters) : Body(make_superellipsoid(parameters)) { parameters_ = parameters; }

Body::Body(const SuperovoidParameters& parameters) : Body(make_superovoid(parameters)) { parameters_ = parameters; }

Body::~Body() = default;

std::unique_ptr<Body> Body::of(const std::shared_ptr<const Shape>& shape) {
  if (const auto* rounded = dynamic_cast<const Rounded*>(shape.get()); rounded != nullptr && rounded->radius() > 0) {
    auto body = of({shape, &rounded->core()});
    // Another rounding within remains a part of the core.
    if (body->rounding_ > 0) body = std::make_unique<Body>(std::shared_ptr<const Shape>(shape, &rounded->core()));
    body->set_rounding(rounded->radius());
    return body;
  }
  if (const auto* ellipsoid = dynamic_cast<const Ellipsoid*>(shape.get())) {
    return std::make_unique<Body>(SuperellipsoidParameters{ellipsoid->half_axes(), 2, 2});
  }
  if (const auto* powers = dynamic_cast<const Superellipsoid*>(shape.get())) {
    return std::make_unique<Body>(SuperellipsoidParameters{powers->half_axes(), powers->delta(), powers->epsilon()});
  }
  if (const auto* egg = dynamic_cast<const Superovoid*>(shape.get())) {
    return std::make_unique<Body>(
        SuperovoidParameters{{egg->half_axes(), egg->delta(), egg->epsilon()}, egg->taper_x(), egg->taper_y()});
  }
  return std::make_unique<Body>(shape);
}

std::unique_ptr<Body> Body::copy() const {
  std::unique_ptr<Body> body(new Body(*this));
  body->serial_ = ++last_serial;
  body->impacts_.reset();
  return body;
}

void Body::set_release_callback(void (*release)(void*), void* user) {
  if (release != nullptr) release_ = std::make_shared<ReleaseCallback>(release, user);
}

void Body::arm_release_callback() noexcept {
  if (release_ != nullptr) release_->arm();
}

void Body::set_superellipsoid(const SuperellipsoidParameters& parameters) {
  set_shape(make_superellipsoid(parameters), rounding_);
  parameters_ = parameters;
}

void Body::set_superovoid(const SuperovoidParameters& parameters) {
  set_shape(make_superovoid(parameters), rounding_);
  parameters_ = parameters;
}

void Body::set_rounding(double radius) { set_shape(core_, radius); }

void Body::set_shape(std::shared_ptr<const Shape> core, double rounding) {
  std::shared_ptr<const Shape> shape = core;
  if (rounding != 0) shape = std::make_shared<Rounded>(core, rounding);  // the constructor refuses an invalid radius
  // These calls run user callbacks and may throw. Nothing has changed before them.
  const double size = shape->half_extents().minCoeff();
  const double bounding_radius = shape->bounding_radius();
  size_ = size;
  radius_ = bounding_radius;
  core_ = std::move(core);
  shape_ = std::move(shape);
  rounding_ = rounding;
  serial_ = ++last_serial;
}

Body* find_body(dGeomID geom) noexcept {
  if (geom == nullptr || dGeomGetClass(geom) != geom_class()) return nullptr;
  return static_cast<ClassData*>(dGeomGetClassData(geom))->body;
}

Body& require_body(dGeomID geom, const char* name) {
  if (geom == nullptr) throw std::invalid_argument(std::string(name) + " = 0, but must be a body made by snCreate…");
  Body* const body = find_body(geom);
  if (body != nullptr) return *body;
  throw std::invalid_argument(std::string(name) + " is " + geom_class_name(geom) + ", but must be a body made by snCreate…");
}

Settings default_settings() {
  const std::lock_guard lock(default_mutex);
  return default_value;
}

void set_default_settings(const Settings& settings) {
  const std::lock_guard lock(default_mutex);
  default_value = settings;
}

Settings combined(const Settings& settings1, const Settings& settings2) {
  Settings both;
  both.solver = settings1.solver == settings2.solver ? settings1.solver : Solver::Hybrid;
  both.tolerance = std::min(settings1.tolerance, settings2.tolerance);
  both.max_evaluations = std::max(settings1.max_evaluations, settings2.max_evaluations);
  return both;
}

}  // namespace supernormal::ode
