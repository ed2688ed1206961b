// Tests that the kernel does not allocate. Its executable replaces operator new for everything in it.
#include <doctest/doctest.h>

#include "support/counted_allocations.hpp"
#include "two_bodies.hpp"

using namespace granular;
using namespace granular::test;

TEST_CASE("lammps: a pair in contact or apart is solved without allocation") {
  for (const NormalLaw law : {NormalLaw::Hooke, NormalLaw::Hertz}) {
    const ContactMaterial material{.law = law, .stiffness = 1e5, .restitution = 0.5, .friction = 0.3, .rolling_length = 1e-4};
    TwoBodies pair{{{0.02, 0.015, 0.01}, 3, 1.5}, {{0.01, 0.01, 0.02}, 8, 8}, prepared(material)};
    pair.settings.stop_when_apart = true;
    // The first deep overlap allocates the scratch memory of the thread.
    pair.second.place({0.02, 0, 0}, Eigen::Quaterniond::Identity());
    pair.find(1e-5);
    int touching = 0;
    const long before = supernormal::test::allocations();
    for (int i = 0; i < 400; ++i) {
      pair.second.place({0.036 - 2e-5 * i, 0.008, 0.004}, {1, 0.2, 0.1 + 1e-3 * i, 0.3});
      touching += pair.find(1e-5).state == PairState::Touching ? 1 : 0;
    }
    CHECK(supernormal::test::allocations() == before);
    CHECK(touching > 50);
    CHECK(touching < 350);
  }
}
