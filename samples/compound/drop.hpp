// The fall of a body on a plane until it rests.
#pragma once

#include <supernormal/supernormal.h>

struct Drop {
  double first_energy;  ///< J, kinetic and potential (0 at the plane), at the start
  double flight_error;  ///< J; largest deviation from the integrator's own energy before the first contact
  double largest_gain;  ///< J; largest rise of the energy above its least value before
  double last_energy;   ///< J
  double rest_time;     ///< s; time at which it came to rest; negative if it did not
};

/// Steps the world, whose gravity points down the z-axis, until `body` rests.
Drop drop(dWorldID world, dSpaceID space, dBodyID body);
