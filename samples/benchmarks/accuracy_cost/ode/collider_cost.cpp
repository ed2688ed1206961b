#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <optional>
#include <vector>

#include "../costs.hpp"
#include "colliders.hpp"
#include "common/measured_tables.hpp"
#include "common/ode_geom.hpp"
#include "measurement.hpp"
#include "pairs.hpp"
#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using Clock = std::chrono::steady_clock;
using common::icosahedron;
using common::make_convex;
using common::make_trimesh;
using common::MeshSize;
using common::OdeGeom;
using common::Random;
using common::superellipsoid_mesh;
using common::terrain;
using common::text;
using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Vector3;

constexpr double kA = 0.5, kB = 0.4, kC = 0.3;  // m; half-axes of all bodies
constexpr double kExponent = 4;
constexpr MeshSize kConvexSize{24, 20};  // 960 triangles, 482 vertices
constexpr unsigned kTerrainCells = 40;   // 3200 triangles
constexpr double kDepth = 0.02 * kC;     // m; depth of the overlap
constexpr double kNudge = 1e-3;          // m and rad; motion of the body between two consecutive queries
constexpr double kTerrainReach = 2;      // m; bodies are scattered over this range
constexpr double kFar = 3;               // m; nothing collides at this distance
constexpr double kSearchStep = 0.02;     // m
constexpr int kBisections = 40;
constexpr int kMaxRepeats = 4096;  // even, for equal counts of both poses

struct OdeBody {
  const char* name;
  OdeGeom (*make)();
  bool is_warm = false;  ///< ours, with a warm start; the other classes have none
};

OdeGeom superellipsoid() { return OdeGeom(snCreateSuperellipsoid(nullptr, kA, kB, kC, kExponent, kExponent)); }
OdeGeom ellipsoid() { return OdeGeom(snCreateEllipsoid(nullptr, kA, kB, kC)); }

/// Our bodies and the ODE bodies that a program would use instead.
constexpr std::array<OdeBody, 7> kBodies = {
    {{"superellipsoid 4, cold", superellipsoid},
     {"superellipsoid 4, warm", superellipsoid, true},
     {"ellipsoid, cold", ellipsoid},
     {"ellipsoid, warm", ellipsoid, true},
     {"dBox", [] { return OdeGeom(dCreateBox(nullptr, 2 * kA, 2 * kB, 2 * kC)); }},
     {"dCapsule", [] { return OdeGeom(dCreateCapsule(nullptr, kC, 2 * (kA - kC))); }},
     {"dConvex 960", [] {
        return make_convex(superellipsoid_mesh({kA, kB, kC}, kExponent, kExponent, 0, kConvexSize));
      }}}};

struct Collider {
  const char* name;
  OdeGeom (*make)();
  bool is_ground = false;  ///< level and wide: bodies come from above
};
constexpr std::array<Collider, 7> kColliders = {
    {{"dPlane", [] { return OdeGeom(dCreatePlane(nullptr, 0, 0, 1, 0)); }, true},
     {"dSphere", [] { return OdeGeom(dCreateSphere(nullptr, 0.4)); }},
     {"dBox", [] { return OdeGeom(dCreateBox(nullptr, 0.8, 0.6, 1.0)); }},
     {"dCapsule", [] { return OdeGeom(dCreateCapsule(nullptr, 0.3, 0.5)); }},
     {"dCylinder", [] { return OdeGeom(dCreateCylinder(nullptr, 0.35, 0.7)); }},
     {"dConvex of 20 triangles", [] { return make_convex(icosahedron(0.5)); }},
     {"dTriMesh of 3200 triangles", [] { return make_trimesh(terrain(kTerrainCells, 0.25, 0.05)); }, true}}};

/// The approach of a body to its collider, the same for all bodies.
struct Approach {
  Matrix3 orientation;  ///< of the body
  Matrix3 collider_orientation;
  Vector3 start = Vector3::Zero();  ///< m; of its centre, inside the collider
  Vector3 direction;                ///< unit; out of the collider
  Pose nudge;                       ///< motion of the body between two consecutive poses

  Approach(bool is_ground, Random& random)
      : orientation(random_orientation(random)),
        collider_orientation(random_orientation(random)),
        direction(is_ground ? Vector3(Vector3::UnitZ()) : random_normal(random)) {
    if (is_ground) {
      for (const int axis : {0, 1}) start[axis] = uniform(random, -kTerrainReach, kTerrainReach);
    }
    nudge.position = kNudge * random_normal(random);
    nudge.rotation = Eigen::AngleAxisd(kNudge, random_normal(random)).toRotationMatrix();
  }

  std::array<Pose, 2> poses_at(double distance) const {
    const Vector3 position = start + distance * direction;
    return {Pose{position, orientation}, Pose{position + nudge.position, nudge.rotation * orientation}};
  }
};

/// The distance from the start of the approach beyond which dCollide finds no contacts of the body. Empty if it never finds any.
std::optional<double> touching_distance(const OdePair& pair, const Approach& approach) {
  std::array<dContactGeom, kMaxContacts> contacts;
  const auto collides = [&](double distance) {
    pair.move_body(approach.poses_at(distance)[0]);
    return pair.collide(contacts) > 0;
  };
  int steps = static_cast<int>(kFar / kSearchStep);
  while (steps >= 0 && !collides(steps * kSearchStep)) --steps;
  if (steps < 0) return std::nullopt;
  double touching = steps * kSearchStep;
  double apart = touching + kSearchStep;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (touching + apart);
    (collides(middle) ? touching : apart) = middle;
  }
  return touching;
}

/// A pair at two consecutive poses.
struct OdeQuery {
  OdePair pair;
  std::array<Pose, 2> poses;
  std::size_t body;  // in kBodies
  int repeats = 2;
  // The shortest times of all rounds, s: to move the body, and to move it and call dCollide.
  double moving = std::numeric_limits<double>::infinity();
  double asking = std::numeric_limits<double>::infinity();
};

/// A sink, so that the compiler keeps the queries.
volatile int sink;

/// The time per query, alternating between the two poses, s.
double time_of(const OdeQuery& query, const auto& ask) {
  const auto start = Clock::now();
  for (int k = 0; k < query.repeats; ++k) {
    query.pair.move_body(query.poses[static_cast<std::size_t>(k % 2)]);
    sink = ask();
  }
  return std::chrono::duration<double>(Clock::now() - start).count() / query.repeats;
}

void time_once(OdeQuery& query) {
  snSetWarmStart(kBodies[query.body].is_warm ? 1 : 0);
  std::array<dContactGeom, kMaxContacts> contacts;
  query.pair.move_body(query.poses[1]);
  query.pair.collide(contacts);
  query.asking = std::min(query.asking, time_of(query, [&] { return query.pair.collide(contacts); }));
  query.moving = std::min(query.moving, time_of(query, [] { return 0; }));
}

/// Measures all queries in turns, so that a disturbance of the machine affects all of them.
void measure_queries(std::vector<OdeQuery>& queries, const Effort& effort) {
  for (OdeQuery& query : queries) {
    time_once(query);
    query.repeats = 2 * std::clamp(static_cast<int>(0.5 * effort.batch / query.asking), 1, kMaxRepeats / 2);
  }
  for (int round = 0; round < effort.rounds; ++round) {
    for (std::size_t turn = 0; turn < queries.size(); ++turn) {
      // The predecessor of a query varies.
      time_once(queries[(turn + static_cast<std::size_t>(round)) % queries.size()]);
    }
  }
}

/// The times (s) of dCollide of each body at a collider. All bodies collide with the same geom, so that a mesh is in the caches for
/// all or for none.
std::array<std::vector<double>, kBodies.size()> measure_collider(const Collider& collider, std::size_t poses, Random& random,
                                                                 const Effort& effort) {
  std::array<std::vector<double>, kBodies.size()> times;
  std::vector<OdeGeom> bodies;
  for (const OdeBody& body : kBodies) bodies.push_back(body.make());
  const OdeGeom geom = collider.make();
  for (std::size_t k = 0; k < poses; ++k) {
    const Approach approach(collider.is_ground, random);
    if (!collider.is_ground) set_rotation(geom.id(), approach.collider_orientation);
    std::vector<OdeQuery> queries;
    snSetWarmStart(0);
    for (std::size_t body = 0; body < bodies.size(); ++body) {
      const OdePair pair{bodies[body].id(), geom.id()};
      const std::optional<double> touching = touching_distance(pair, approach);
      if (touching) queries.push_back({pair, approach.poses_at(*touching - kDepth), body});
    }
    measure_queries(queries, effort);
    for (const OdeQuery& query : queries) times[query.body].push_back(query.asking - query.moving);
  }
  return times;
}

}  // namespace

void write_collider_costs(std::size_t poses, std::uint64_t seed, const Effort& effort, std::ostream& out) {
  out << "* poses of each body at each collider: " << poses
      << "\n\nMedian time of a dCollide, µs. Bodies have half-axes 0.5, 0.4, 0.3 m and overlap by 2 % of the smallest. Each query\n"
         "follows one of a pose 1e-3 (m and rad) away. Moving the body and its bounding box are not counted; what is left is good\n"
         "to about 0.01 µs.\n\n| collider |";
  for (const OdeBody& body : kBodies) out << ' ' << body.name << " |";
  out << "\n|---|---:|---:|---:|---:|---:|---:|---:|\n";
  Random random(seed);
  for (const Collider& collider : kColliders) {
    out << "| " << collider.name << " |";
    for (const auto& times : measure_collider(collider, poses, random, effort))
      out << ' ' << text("%.3f", median(times) * 1e6) << " |";
    out << std::endl;
  }
}

}  // namespace accuracy_cost
