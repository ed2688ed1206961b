// Drops a body on a plane until it rests.
#pragma once

#include <supernormal/supernormal.h>

struct Drop {
  double first_energy;  ///< J, kinetic and potential (0 at the plane), at the start
  double flight_error;  ///< J; largest deviation from the integrator's exact energy before the first contact
  double largest_gain;  ///< J; largest rise of the energy above its earlier minimum
  double last_energy;   ///< J
  double rest_time;     ///< s; when it came to rest; negative if it did not
};

/// Steps the world until `body` rests. Gravity must point down the z-axis.
Drop drop(dWorldID world, dSpaceID space, dBodyID body);
