#include "shapes/lanes/four_normals.hpp"
#include "shapes/lanes/superellipsoid_jet.hpp"

namespace supernormal {

// Two and two side by side: the powers of the one do not wait for those of the other.
void evaluate_in_two_lanes(const LaneBody& body, const double* normals, double* h, double* points) {
  using R = Two<Real<2>>;
  const auto from = [](const double* numbers) { return R(load<2>(numbers), load<2>(numbers + 2)); };
  const auto put = [](double* to, const R& a) {
    store(to, a.a);
    store(to + 2, a.b);
  };
  const PointJet<R> jet = point_jet(power_body<R>(body), Vec<R>{from(normals), from(normals + 4), from(normals + 8)});
  put(h, jet.h);
  put(points, jet.r.x);
  put(points + 4, jet.r.y);
  put(points + 8, jet.r.z);
}

}  // namespace supernormal
