// Volume integrals that several shapes share.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

class Superovoid;

/// Of any convex body, by quadrature over its normals: spectrally accurate when h is smooth. The reported error covers what the
/// normals do not see, such as flat faces. std::domain_error when the shape delivers values that are not finite.
MassProperties quadrature_mass_properties(const Shape& shape);

/// What sweeping a superovoid by a sphere of `radius` adds to it: the integrals over the layer between the two boundaries.
MassProperties superovoid_layer(const Superovoid& core, double radius);

}  // namespace supernormal
