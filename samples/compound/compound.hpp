// Assembles a body from several geoms.
#pragma once

#include <supernormal/supernormal.h>

#include <vector>

/// A geom of Supernormal and its pose in the design frame of the body.
struct Part {
  dGeomID geom;
  double density;     ///< kg/m^3
  dVector3 position;  ///< m
  dMatrix3 rotation;  ///< orientation of the geom's frame
};

/// Makes a part. Its z-axis is rotated by `angle` (rad) about the x-axis of the body.
Part make_part(dGeomID geom, double density, double x, double y, double z, double angle = 0);

/// Makes a body of all parts. Mass and inertia are the sums over the parts, and the centre of mass is the origin. Volumes in which
/// parts overlap count twice. `mass` receives the body's mass.
dBodyID assemble(dWorldID world, const std::vector<Part>& parts, dMass& mass);

/// The smallest gap (m) between any two parts in their poses: 0 if they touch, negative if they overlap.
double least_gap(const std::vector<Part>& parts);
