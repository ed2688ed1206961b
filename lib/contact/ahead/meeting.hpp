// Where two bodies are when they meet, or at the end of the time in which they might.
#pragma once

#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

// An overlap by less than this share of the size on the way is no impact.
inline constexpr double kGraze = 0.01;

struct Meeting {
  double time = 0;      ///< s from now; 0: the poses of now will do
  Proximity there;      ///< of the bodies, moved without rotation for so long
  bool hits = false;    ///< whether they meet within the time
  int evaluations = 0;  ///< of the gap function
};

/// The smallest half-extent of those of two bodies that have a thickness, m.
double smaller_thickness(const Shape& shape1, const Shape& shape2);

/// The body after `time` at its velocity, without rotation.
BodyAhead moved(const BodyAhead& body, double time);

/// Where the bodies overlap by a small share of `size` (m) for the first time on the way along their velocities, if they do within
/// `time`, and otherwise where they are after it. An overlap by less is passed over: so a body does not hit the edge of the next
/// one where it slides over two that are flush.
///
/// No impact is missed. The gap of bodies that are moved without rotation is convex in time (a maximum of linear functions, one for
/// each normal), and no tangent to it lies above it: so Newton's steps do not pass the first time at which it has a given value.
///
/// If the way is not worth a step or leads out of the range of poses, the answer is that of now.
Meeting find_meeting(const BodyAhead& body1, const BodyAhead& body2, double time, double size, const Settings& settings,
                     const Proximity& now);

}  // namespace supernormal
