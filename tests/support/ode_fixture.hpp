// Shared helpers of the tests of the ODE layer: ODE during a test case, poses, contacts.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "supernormal/supernormal.h"
#include "support/draw.hpp"

namespace supernormal::test {

inline const int kRepetitions = draws(10000);  ///< repetitions in a battery, each with its own bodies and poses

/// A program that uses ODE and this library, from its start to its end. Nothing remains for the next test case.
class OdeSession {
 public:
  OdeSession() {
    dInitODE2(0);
    dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
    snResetStatistics();
  }
  ~OdeSession() {
    snSetWarmStart(1);
    snSetDefaultSolver(SN_SOLVER_HYBRID, dReal(1e-9), 1000);
    snSetDefaultLookAhead(0);
    snClose();
    dCloseODE();
  }
  OdeSession(const OdeSession&) = delete;
  OdeSession(OdeSession&&) = delete;
  OdeSession& operator=(const OdeSession&) = delete;
  OdeSession& operator=(OdeSession&&) = delete;
};

/// A geom that is destroyed at the end of its scope.
class Geom {
 public:
  explicit Geom(dGeomID id) : id_(id) {}
  ~Geom() {
    if (id_ != nullptr) dGeomDestroy(id_);
  }
  Geom(const Geom&) = delete;
  Geom(Geom&& other) noexcept : id_(other.id_) { other.id_ = nullptr; }
  Geom& operator=(const Geom&) = delete;
  Geom& operator=(Geom&&) = delete;
  operator dGeomID() const { return id_; }  // NOLINT(google-explicit-constructor): as ODE's own dGeom

 private:
  dGeomID id_;
};

using Vec = std::array<double, 3>;

inline Vec to_vec(const dReal* v) { return {v[0], v[1], v[2]}; }
inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vec& a) { return std::sqrt(dot(a, a)); }
inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }

/// Draws for geoms.
class Random : public Draw {
 public:
  using Draw::Draw;

  Vec direction() {
    while (true) {
      const Vec v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double length = norm(v);
      if (length > 0.1 && length < 1) return (1 / length) * v;
    }
  }

  void turn(dGeomID geom) {
    dQuaternion q = {dReal(uniform(-1, 1)), dReal(uniform(-1, 1)), dReal(uniform(-1, 1)), dReal(uniform(-1, 1))};
    dNormalize4(q);
    dGeomSetQuaternion(geom, q);
  }
};

inline void place(dGeomID geom, const Vec& p) { dGeomSetPosition(geom, dReal(p[0]), dReal(p[1]), dReal(p[2])); }

inline void move(dGeomID geom, const Vec& by) { place(geom, to_vec(dGeomGetPosition(geom)) + by); }

/// Rotates a geom about an axis of the world.
inline void turn_by(dGeomID geom, double angle, const Vec& axis) {
  dMatrix3 turn, turned;
  dRFromAxisAndAngle(turn, dReal(axis[0]), dReal(axis[1]), dReal(axis[2]), dReal(angle));
  dMultiply0(turned, turn, dGeomGetRotation(geom), 3, 3, 3);
  dGeomSetRotation(geom, turned);
}

inline constexpr bool kIsSinglePrecision = sizeof(dReal) == sizeof(float);

/// A tolerance for double precision. In single precision it grows by the rounding of dReal: some units in the last place of poses,
/// normals and depths of about this size.
inline double within_rounding(double tolerance, double size = 1) {
  constexpr double kEpsilon = std::numeric_limits<dReal>::epsilon();
  return kIsSinglePrecision ? std::max(tolerance, 32 * kEpsilon * size) : tolerance;
}

/// All contacts of a pair, at most `room`.
inline std::vector<dContactGeom> collide(dGeomID g1, dGeomID g2, int room = 8) {
  std::vector<dContactGeom> contacts(static_cast<std::size_t>(room));
  const int count = dCollide(g1, g2, room, contacts.data(), sizeof(dContactGeom));
  contacts.resize(static_cast<std::size_t>(count));
  return contacts;
}

inline bool same_bits(const dContactGeom& a, const dContactGeom& b) {
  return to_vec(a.pos) == to_vec(b.pos) && to_vec(a.normal) == to_vec(b.normal) && a.depth == b.depth;
}

inline bool same_bits(const std::vector<dContactGeom>& a, const std::vector<dContactGeom>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& one, const auto& other) { return same_bits(one, other); });
}

inline snStatistics statistics() {
  snStatistics out;
  snGetStatistics(&out);
  return out;
}

inline snProximity proximity_of(dGeomID g1, dGeomID g2) {
  snProximity answer{};
  if (snGeomProximity(g1, g2, &answer) != 1) throw std::runtime_error(snLastError());
  return answer;
}

/// Whether the last refusal contains this text.
inline bool refused_with(const std::string& text) { return std::string(snLastError()).find(text) != std::string::npos; }

/// Whether a call returned 0 or NULL, with this text.
template <typename Result>
bool refused(Result result, const std::string& text) {
  return result == Result{} && refused_with(text);
}

/// The exponent of an ellipsoid, of a brick, or in between.
inline double any_exponent(Random& random) {
  constexpr double kExponents[] = {2, 4, 8, 20, 60};
  return kExponents[static_cast<int>(random.uniform(0, 5))];
}

/// Draws an ellipsoid or a superellipsoid with half-axes in 0.5...1.5.
inline dGeomID random_body(Random& random, dSpaceID space = nullptr) {
  const auto a = dReal(random.uniform(0.5, 1.5));
  const auto b = dReal(random.uniform(0.5, 1.5));
  const auto c = dReal(random.uniform(0.5, 1.5));
  dGeomID geom = nullptr;
  if (random.uniform(0, 1) < 0.5) {
    geom = snCreateEllipsoid(space, a, b, c);
  } else {
    geom = snCreateSuperellipsoid(space, a, b, c, dReal(random.uniform(1.5, 6)), dReal(random.uniform(1.5, 6)));
  }
  random.turn(geom);
  return geom;
}

}  // namespace supernormal::test
