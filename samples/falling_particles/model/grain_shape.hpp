// The bodies of a kind of grain as shapes of the library's core, and as meshes.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <supernormal/proximity/pose.hpp>
#include <supernormal/shapes/shape.hpp>
#include <supernormal/shapes/tessellation.hpp>
#include <vector>

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

/// The mesh of a kind of grain in its own frame, with a closed mesh for each convex body. `chord_error`: relative to the smallest
/// half-axis of a body.
supernormal::Tessellation mesh_of(const GrainKind& kind, double chord_error);

/// Makes a kind of grain of these components, which may be given in any frame. The result is moved so that its centre of mass is
/// the origin. The mass is exact, by closed forms, where components do not overlap. Volume that several components share belongs to
/// the first one, with its density. A quadrature over lines integrates the shared volume to about 1e-4 of its size.
GrainKind make_compound(std::string name, std::vector<Component> components, std::string source);

}  // namespace falling_particles
