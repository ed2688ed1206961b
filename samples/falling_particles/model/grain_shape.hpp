// The bodies of a kind of grain as shapes of the library's core.
#pragma once

#include <array>
#include <memory>
#include <supernormal/proximity/pose.hpp>
#include <supernormal/shapes/shape.hpp>

#include "grain_kind.hpp"

namespace falling_particles {

/// The shape of the geom that create_geom() makes.
std::shared_ptr<const supernormal::Shape> shape_of(const ConvexBody& body, double scale = 1);

/// kg m^2, in the world's frame: the inertia of a grain of one body as samples/lammps has it, where grains are not rounded.
supernormal::Matrix3 lammps_inertia(const GrainKind& kind, double scale, const std::array<double, 4>& quaternion);

/// kg, of a grain of scale 1.
double mass_of(const GrainKind& kind);

/// The pose of a component in the grain's frame.
supernormal::Pose pose_of(const Component& component, double scale = 1);

}  // namespace falling_particles
