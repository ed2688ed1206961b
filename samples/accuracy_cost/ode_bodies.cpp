#include "ode_bodies.hpp"

#include <stdexcept>

#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

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

std::string name_of(PartnerClass partner) {
  switch (partner) {
    case PartnerClass::Plane:
      return "dPlane";
    case PartnerClass::Sphere:
      return "dSphere";
    case PartnerClass::Box:
      return "dBox";
    case PartnerClass::Capsule:
      return "dCapsule";
    case PartnerClass::Cylinder:
      return "dCylinder";
    case PartnerClass::Convex:
      return "dConvex of 20 triangles";
    case PartnerClass::Trimesh:
      return "dTriMesh of 3200 triangles";
    case PartnerClass::Ray:
      return "dRay";
    case PartnerClass::Itself:
      return "another of the same";
  }
  throw std::logic_error("no such partner");
}

OdeGeom make_partner(PartnerClass partner, const OdeBody& body) {
  switch (partner) {
    case PartnerClass::Plane:
      return OdeGeom(dCreatePlane(nullptr, 0, 0, 1, 0));
    case PartnerClass::Sphere:
      return OdeGeom(dCreateSphere(nullptr, 0.4));
    case PartnerClass::Box:
      return OdeGeom(dCreateBox(nullptr, 0.8, 0.6, 1.0));
    case PartnerClass::Capsule:
      return OdeGeom(dCreateCapsule(nullptr, 0.3, 0.5));
    case PartnerClass::Cylinder:
      return OdeGeom(dCreateCylinder(nullptr, 0.35, 0.7));
    case PartnerClass::Convex:
      return make_convex(icosahedron(0.5));
    case PartnerClass::Trimesh:
      return make_trimesh(terrain(kTerrainCells, 0.25, 0.05));
    case PartnerClass::Ray:
      return OdeGeom(dCreateRay(nullptr, 4));
    case PartnerClass::Itself:
      return body.make();
  }
  throw std::logic_error("no such partner");
}

}  // namespace accuracy_cost
