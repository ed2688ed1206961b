// Parses a body on the command line.
#pragma once

#include <array>
#include <span>
#include <string>

#include "pair/pair.hpp"

namespace explain_pair {

/// The kinds of bodies with their parameters, one per line, for the help text.
std::string body_kinds();

/// Makes body 1 or 2 from a text such as "superellipsoid 1 0.8 0.5 2.5 8". Throws falling_particles::InputError, with the option,
/// such as --body1.
PlacedBody described_body(const std::string& number, const std::string& text, double rounding);

/// Throws falling_particles::InputError if a coordinate (m) is not finite or absurdly large.
Vector3 position_of(const std::string& option, std::span<const double, 3> position);

/// The rotation of a quaternion w, x, y, z of unit length to 1e-3. Throws falling_particles::InputError.
Matrix3 rotation_of(const std::string& option, std::span<const double, 4> quaternion);

}  // namespace explain_pair
