// One body from several geoms.
#pragma once

#include <supernormal/supernormal.h>

#include <vector>

/// A geom of this library's and where it belongs, in the frame in which the body is designed.
struct Part {
  dGeomID geom;
  double density;     ///< kg/m^3
  dVector3 position;  ///< m
  dMatrix3 rotation;  ///< of the geom's frame
};

/// A part whose own z-axis is turned by `angle` (rad) about the x-axis of the design.
Part make_part(dGeomID geom, double density, double x, double y, double z, double angle = 0);

/// A body of all parts, with the mass and inertia of their sum and its centre of mass in the origin. Parts that overlap count twice
/// where they do. `mass` is the body's.
dBodyID assemble(dWorldID world, const std::vector<Part>& parts, dMass& mass);

/// The least gap (m) between any two parts that stand in their places: 0 where they touch, negative where they overlap.
double least_gap(const std::vector<Part>& parts);
