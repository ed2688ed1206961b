// One body from several geoms.
#pragma once

#include <supernormal/supernormal.h>

#include <vector>

/// A geom of this library and its pose in the frame in which the body is drawn up.
struct Part {
  dGeomID geom;
  double density;     ///< kg/m^3
  dVector3 position;  ///< m
  dMatrix3 rotation;  ///< rotation of the geom's frame
};

/// Makes a part whose own z-axis is turned by `angle` (rad) about the x-axis of the body.
Part make_part(dGeomID geom, double density, double x, double y, double z, double angle = 0);

/// Makes a body of all parts, with the mass and inertia of their sum and its centre of mass in the origin. Volumes in which parts
/// overlap count twice. `mass` receives the body's mass.
dBodyID assemble(dWorldID world, const std::vector<Part>& parts, dMass& mass);

/// The least gap (m) between any two parts in their places: 0 where they touch, negative where they overlap.
double least_gap(const std::vector<Part>& parts);
