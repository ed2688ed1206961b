#include "bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "support/expect.hpp"

namespace supernormal::fuzz {
namespace {

constexpr double kLeastLength = 1e-30, kLargestLength = 1e30;  // m
constexpr double kLeastExponent = 1.01, kLargestExponent = 1000;

// Tolerance of the bound on the tapers, which the library computes in another order.
constexpr double kRounding = 1e-12;

// Limit of evaluations. The library may otherwise take a million evaluations, and all of the fuzzer's time.
constexpr int kPatience = 10000;

bool is_length(double value) { return value >= kLeastLength && value <= kLargestLength; }
bool is_exponent(double value) { return value >= kLeastExponent && value <= kLargestExponent; }

struct Superellipsoid {
  double axes[3];
  double delta = 2, epsilon = 2;

  bool is_valid() const {
    return std::all_of(std::begin(axes), std::end(axes), is_length) && is_exponent(delta) && is_exponent(epsilon);
  }
};

/// Draws parameters. Half of them are valid, so that there are bodies to query.
Superellipsoid draw_superellipsoid(ByteReader& bytes, bool is_ellipsoid) {
  const bool is_wild = bytes.flag();
  Superellipsoid result{};
  for (double& axis : result.axes) axis = is_wild ? bytes.number() : bytes.everyday();
  if (is_ellipsoid) return result;
  for (double* exponent : {&result.delta, &result.epsilon}) *exponent = is_wild ? bytes.number() : 1.01 + bytes.everyday();
  return result;
}

/// The largest taper is 2^(1/epsilon) (epsilon - 1)/epsilon.
double largest_taper(double epsilon) { return std::exp2(1 / epsilon) * (epsilon - 1) / epsilon; }

const UserShape& shape_of(const void* user) { return *static_cast<const UserShape*>(user); }

double error_at(const UserShape& shape, int part, const dReal* n) {
  return shape.wrong_part == part && n[shape.axis] > shape.above ? shape.wrong : 0;
}

// The ellipsoid's h is the length of (a nx, b ny, c nz), computed with its largest component factored out.
double support_of_ellipsoid(const UserShape& shape, const dReal* n) {
  double scaled[3];
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    scaled[i] = shape.half_axes[i] * n[i];
    largest = std::max(largest, std::abs(scaled[i]));
  }
  if (!(largest > 0) || !std::isfinite(largest)) return largest;
  double sum = 0;
  for (const double component : scaled) sum += (component / largest) * (component / largest);
  return largest * std::sqrt(sum);
}

dReal support(const void* user, const dReal* n) {
  const UserShape& shape = shape_of(user);
  return support_of_ellipsoid(shape, n) + error_at(shape, 1, n);
}

void point(const void* user, const dReal* n, dReal* r) {
  const UserShape& shape = shape_of(user);
  const double h = support_of_ellipsoid(shape, n);
  for (int i = 0; i < 3; ++i) r[i] = shape.half_axes[i] * (h > 0 ? shape.half_axes[i] * n[i] / h : 0);
  r[shape.axis] += error_at(shape, 2, n);
}

void hessian(const void* user, const dReal* n, dReal* H) {
  const UserShape& shape = shape_of(user);
  const double h = support_of_ellipsoid(shape, n);
  const double* const a = shape.half_axes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double diagonal = h > 0 && i == j ? a[i] * (a[i] / h) : 0;
      H[3 * i + j] = h > 0 ? diagonal - a[i] * (a[i] * n[i] / h) * (a[j] * (a[j] * n[j] / h) / h) : 0;
    }
  }
  H[4 * shape.axis] += error_at(shape, 3, n);
}

void release(void* user) { ++static_cast<UserShape*>(user)->releases; }

// Draws a rotation from any four numbers. ODE programs have rotations or, after an accident, matrices that are not finite.
void draw_rotation(ByteReader& bytes, dMatrix3 R) {
  dQuaternion q;
  double sum = 0;
  for (dReal& component : q) {
    component = 2 * bytes.share() - 1;
    sum += component * component;
  }
  if (sum < 0.01) {
    dRSetIdentity(R);
  } else {
    for (dReal& component : q) component /= std::sqrt(sum);
    dQtoR(q, R);
  }
  if (bytes.choice(16) != 15) return;
  const double accident = bytes.number();
  if (!std::isfinite(accident)) R[bytes.choice(11)] = accident;
}

}  // namespace

void forget_last_error() { snSetDefaultSolver(SN_SOLVER_HYBRID, 0, 1); }

void expect_refusal(const char* function) {
  const std::string prefix = std::string(function) + ": ";
  const char* const text = snLastError();
  expect(std::strncmp(text, prefix.c_str(), prefix.size()) == 0 && std::strlen(text) > prefix.size() + 3,
         "a refused call leaves its message:", (prefix + text).c_str());
}

void FuzzedBody::destroy() {
  if (geom_ != nullptr) dGeomDestroy(geom_);
  geom_ = nullptr;
  if (user_ != nullptr) expect(user_->releases == 1, "a user's shape is released once");
  user_.reset();
}

void FuzzedBody::create(ByteReader& bytes) {
  destroy();
  forget_last_error();
  const unsigned kind = bytes.choice(4);
  if (kind == 0) geom_ = create_superellipsoid(bytes, true);
  if (kind == 1) geom_ = create_superellipsoid(bytes, false);
  if (kind == 2) geom_ = create_superovoid(bytes);
  if (kind == 3) geom_ = create_user_shape(bytes);
  if (geom_ == nullptr) geom_ = snCreateEllipsoid(nullptr, 1, 1, 1);
  expect(geom_ != nullptr, "a unit sphere is created");
}

dGeomID FuzzedBody::create_superellipsoid(ByteReader& bytes, bool is_ellipsoid) {
  const Superellipsoid s = draw_superellipsoid(bytes, is_ellipsoid);
  const dGeomID geom = is_ellipsoid ? snCreateEllipsoid(nullptr, s.axes[0], s.axes[1], s.axes[2])
                                    : snCreateSuperellipsoid(nullptr, s.axes[0], s.axes[1], s.axes[2], s.delta, s.epsilon);
  expect((geom != nullptr) == s.is_valid(), "a superellipsoid is created where its parameters are valid, and only there");
  if (geom == nullptr) expect_refusal(is_ellipsoid ? "snCreateEllipsoid" : "snCreateSuperellipsoid");
  return geom;
}

dGeomID FuzzedBody::create_superovoid(ByteReader& bytes) {
  const Superellipsoid s = draw_superellipsoid(bytes, false);
  const bool is_wild = bytes.flag();
  const double taper_x = is_wild ? bytes.number() : bytes.share();
  const double taper_y = bytes.flag() ? taper_x : (is_wild ? bytes.number() : bytes.share());
  const dGeomID geom = snCreateSuperovoid(nullptr, s.axes[0], s.axes[1], s.axes[2], s.delta, s.epsilon, taper_x, taper_y);
  const double bound = s.is_valid() ? largest_taper(s.epsilon) : 0;
  const double largest = std::max(std::abs(taper_x), std::abs(taper_y));
  if (geom == nullptr) {
    expect_refusal("snCreateSuperovoid");
    const bool must_be_created = s.is_valid() && taper_x == taper_y && largest <= bound * (1 - kRounding);
    expect(!must_be_created, "a superovoid with two equal, small tapers is created");
  } else {
    expect(s.is_valid() && largest <= bound * (1 + kRounding), "a superovoid with invalid parameters is refused", snLastError());
  }
  return geom;
}

dGeomID FuzzedBody::create_user_shape(ByteReader& bytes) {
  auto user = std::make_unique<UserShape>();
  const Superellipsoid ellipsoid = draw_superellipsoid(bytes, true);
  std::copy(std::begin(ellipsoid.axes), std::end(ellipsoid.axes), user->half_axes);
  user->wrong_part = static_cast<int>(bytes.choice(4));
  user->axis = static_cast<int>(bytes.choice(3));
  user->above = bytes.share();
  user->wrong = user->wrong_part == 0 ? 0 : bytes.number();
  const snShape shape = {support, point, bytes.flag() ? hessian : nullptr, user.get(), release};
  const dGeomID geom = snCreateConvex(nullptr, &shape);
  if (geom == nullptr) {
    expect_refusal("snCreateConvex");
    expect(user->releases == 0, "a refused shape is not released");
    return nullptr;
  }
  user_ = std::move(user);
  return geom;
}

void FuzzedBody::set_parameters(ByteReader& bytes) {
  const Superellipsoid s = draw_superellipsoid(bytes, false);
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0;
  forget_last_error();
  const bool is_superellipsoid = snGeomSuperellipsoidGetParams(geom_, &a, &b, &c, &delta, &epsilon) == 1;
  if (!is_superellipsoid) expect_refusal("snGeomSuperellipsoidGetParams");
  forget_last_error();
  const bool done = snGeomSuperellipsoidSetParams(geom_, s.axes[0], s.axes[1], s.axes[2], s.delta, s.epsilon) == 1;
  expect(done == (is_superellipsoid && s.is_valid()), "parameters are set where they are valid, and only there");
  if (!done) expect_refusal("snGeomSuperellipsoidSetParams");
  forget_last_error();
  const double taper = bytes.number();
  if (snGeomSuperovoidSetParams(geom_, s.axes[0], s.axes[1], s.axes[2], s.delta, s.epsilon, taper, taper) == 0) {
    expect_refusal("snGeomSuperovoidSetParams");
  } else {
    expect(s.is_valid() && std::abs(taper) <= largest_taper(s.epsilon) * (1 + kRounding), "invalid tapers are refused");
  }
}

void FuzzedBody::set_rounding(ByteReader& bytes) {
  const double radius = bytes.number();
  forget_last_error();
  const bool done = snGeomSetRounding(geom_, radius) == 1;
  if (!done) expect_refusal("snGeomSetRounding");
  const bool is_valid = radius >= 0 && radius <= kLargestLength;
  expect(!done || is_valid, "an invalid rounding is refused");
  expect(done || !is_valid || !is_sound(), "a valid rounding is not refused", snLastError());
}

void FuzzedBody::set_solver(ByteReader& bytes) {
  const auto solver = static_cast<snSolver>(bytes.choice(4));
  const double tolerance = bytes.number();
  const int limit = bytes.integer();
  forget_last_error();
  const bool is_valid = solver <= SN_SOLVER_FIXED_POINT && tolerance >= 1e-15 && tolerance <= 1 && limit >= 1 && limit <= 1000000;
  const bool done = snGeomSetSolver(geom_, solver, tolerance, limit) == 1;
  expect(done == is_valid, "solver settings are taken where they are valid, and only there", snLastError());
  if (!done) return expect_refusal("snGeomSetSolver");
  if (limit > kPatience) snGeomSetSolver(geom_, solver, tolerance, kPatience);
}

dGeomID create_collider(ByteReader& bytes) {
  const unsigned kind = bytes.choice(6);
  // ODE asserts that lengths are not negative, so a NaN also fails. Zero and infinity pass.
  const auto length = [&] {
    const double value = std::abs(bytes.number());
    return std::isnan(value) ? 1.0 : value;
  };
  const double a = length(), b = length(), c = length();
  if (kind == 0) return dCreateSphere(nullptr, a);
  if (kind == 1) return dCreateBox(nullptr, a, b, c);
  if (kind == 2) return dCreateCapsule(nullptr, a, b);
  if (kind == 3) return dCreateCylinder(nullptr, a, b);
  const double x = bytes.share(), y = bytes.share(), z = bytes.share() + 0.01;  // ODE asserts that it can normalise them
  if (kind == 4) return dCreatePlane(nullptr, x, y, z, bytes.number());
  const dGeomID ray = dCreateRay(nullptr, a);
  const dVector3 start = {bytes.number(), bytes.number(), bytes.number()};
  dGeomRaySet(ray, start[0], start[1], start[2], x, -y, z);
  return ray;
}

void place(dGeomID geom, ByteReader& bytes) {
  if (dGeomGetClass(geom) == dPlaneClass) return;
  const bool is_wild = bytes.choice(4) == 0;
  double position[3];
  for (double& coordinate : position) coordinate = is_wild ? bytes.number() : 4 * bytes.share() - 2;
  dGeomSetPosition(geom, position[0], position[1], position[2]);
  dMatrix3 R;
  draw_rotation(bytes, R);
  dGeomSetRotation(geom, R);
}

}  // namespace supernormal::fuzz
