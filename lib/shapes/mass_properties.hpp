// Volume integrals that several shapes share.
#pragma once

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

class Superovoid;

/// The mass properties of any convex body by quadrature over its normals: spectrally accurate when h is smooth. The reported
/// error covers surfaces that normals do not see, such as flat faces. Throws std::domain_error when the shape delivers values
/// that are not finite.
MassProperties quadrature_mass_properties(const Shape& shape);

/// The mass properties of the layer that is added to a superovoid by sweeping it with a sphere of `radius`: integrals between the
/// two boundaries.
MassProperties superovoid_layer(const Superovoid& core, double radius);

}  // namespace supernormal
