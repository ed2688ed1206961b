#include "ode_bodies.hpp"

#include <stdexcept>

#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using common::icosahedron;
using common::make_convex;
using common::make_trimesh;
using common::MeshSize;
using common::OdeGeom;
using common::superellipsoid_mesh;
using common::terrain;

constexpr double kA = 0.5, kB = 0.4, kC = kSmallestHalfAxis;
constexpr double kExponent = 4;
constexpr MeshSize kConvexSize{24, 20};  // 960 triangles, 482 vertices
constexpr unsigned kTerrainCells = 40;   // 3200 triangles

OdeGeom superellipsoid() { return OdeGeom(snCreateSuperellipsoid(nullptr, kA, kB, kC, kExponent, kExponent)); }
OdeGeom ellipsoid() { return OdeGeom(snCreateEllipsoid(nullptr, kA, kB, kC)); }
OdeGeom box() { return OdeGeom(dCreateBox(nullptr, 2 * kA, 2 * kB, 2 * kC)); }
OdeGeom capsule() { return OdeGeom(dCreateCapsule(nullptr, kC, 2 * (kA - kC))); }
OdeGeom convex() {
  return make_convex(superellipsoid_mesh(supernormal::Vector3(kA, kB, kC), kExponent, kExponent, 0, kConvexSize));
}

}  // namespace

std::vector<OdeBody> ode_bodies() {
  return {{"superellipsoid 4, cold", superellipsoid, false},
          {"superellipsoid 4, warm", superellipsoid, true},
          {"ellipsoid, cold", ellipsoid, false},
          {"ellipsoid, warm", ellipsoid, true},
          {"dBox", box, false},
          {"dCapsule", capsule, false},
          {"dConvex 960", convex, false}};
}

std::string name_of(ColliderClass collider) {
  switch (collider) {
    case ColliderClass::Plane:
      return "dPlane";
    case ColliderClass::Sphere:
      return "dSphere";
    case ColliderClass::Box:
      return "dBox";
    case ColliderClass::Capsule:
      return "dCapsule";
    case ColliderClass::Cylinder:
      return "dCylinder";
    case ColliderClass::Convex:
      return "dConvex of 20 triangles";
    case ColliderClass::Trimesh:
      return "dTriMesh of 3200 triangles";
    case ColliderClass::Ray:
      return "dRay";
    case ColliderClass::Itself:
      return "another of the same";
  }
  throw std::logic_error("no such collider");
}

OdeGeom make_collider(ColliderClass collider, const OdeBody& body) {
  switch (collider) {
    case ColliderClass::Plane:
      return OdeGeom(dCreatePlane(nullptr, 0, 0, 1, 0));
    case ColliderClass::Sphere:
      return OdeGeom(dCreateSphere(nullptr, 0.4));
    case ColliderClass::Box:
      return OdeGeom(dCreateBox(nullptr, 0.8, 0.6, 1.0));
    case ColliderClass::Capsule:
      return OdeGeom(dCreateCapsule(nullptr, 0.3, 0.5));
    case ColliderClass::Cylinder:
      return OdeGeom(dCreateCylinder(nullptr, 0.35, 0.7));
    case ColliderClass::Convex:
      return make_convex(icosahedron(0.5));
    case ColliderClass::Trimesh:
      return make_trimesh(terrain(kTerrainCells, 0.25, 0.05));
    case ColliderClass::Ray:
      return OdeGeom(dCreateRay(nullptr, 4));
    case ColliderClass::Itself:
      return body.make();
  }
  throw std::logic_error("no such collider");
}

}  // namespace accuracy_cost
