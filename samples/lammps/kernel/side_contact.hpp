// The contacts of straight sides: with flat ground, and with each other.
#pragma once

#include <optional>
#include <span>

#include "kernel/body.hpp"
#include "kernel/face_contact.hpp"

namespace granular {

/// The contact of a body's side with the ground. The common line has two corners, its ends, with half of the weight each. Nothing
/// if the body has no side there, or if `share` is 0.
std::optional<FaceContact> find_side_contact(const Body& body, const Ground& ground);

/// The contact of two sides that run around their bodies, such as two cans with parallel axes. Each end of the common line has
/// the depth of the two sections across the mean axis. `normal` (unit, from body 1 to body 2) is a guess. `share` also falls if
/// the bodies cross, so that the middle of the line is deeper than its ends.
std::optional<FaceContact> find_side_pair_contact(const Body& body1, const Body& body2, const Vector3& normal);

/// The contact of a side that runs around a body with a pipe along it, at the contact `which` of those with these normals (unit,
/// outwards). Each end of the side is a corner of the contact whose normal is nearest to the normal of the end: askew, a can
/// touches with each end at another place. No corner belongs to a `which` past the last.
std::optional<FaceContact> find_pipe_contact(const Body& body, const Pipe& pipe, std::span<const Vector3> normals,
                                             std::size_t which);

}  // namespace granular
