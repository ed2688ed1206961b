// Pairs whose highest normal is hard to find: the interval of every answer covers a normal that is known to be high, and where the
// bodies are apart, touch, or overlap by less than the ball that rolls inside them, the answer is proved.
#include <doctest/doctest.h>

#include "proximity/covers.hpp"
#include "support/hard_cases/catalogue.hpp"

using namespace supernormal;
using supernormal::samples::HardCase;
using supernormal::samples::KnownNormal;

TEST_CASE("hard cases: no search misses a normal that is known to be high") {
  for (const KnownNormal& one : samples::known_normals()) {
    const HardCase& bodies = one.bodies;
    CAPTURE(bodies.name);
    Settings settings;
    settings.tolerance = one.tolerance;
    test::check_covers(*bodies.shape1, *bodies.shape2, bodies.pose2, one.higher, settings,
                       bodies.first_normal ? &*bodies.first_normal : nullptr);
  }
}
