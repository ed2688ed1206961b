// Volume integrals that several shapes use.
#pragma once

#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

class Superovoid;

/// The mass properties of any convex body by quadrature over its normals: spectrally accurate if h is smooth. relative_error covers
/// flat faces and edges, which normals do not see. Throws std::domain_error if the shape returns values that are not finite.
MassProperties quadrature_mass_properties(const Shape& shape);

/// The mass properties of the layer that sweeping a superovoid by a sphere of `radius` (m) adds to it. The integrals run between
/// the two boundaries.
MassProperties superovoid_layer(const Superovoid& core, double radius);

/// The mass properties of the hull of points (m), swept by a sphere of `radius` (m): see Polytope::mass_properties(). A hull
/// without an area has none.
MassProperties swept_polytope(std::span<const Vector3> points, double radius);

}  // namespace supernormal
