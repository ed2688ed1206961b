#include "shapes/lanes/four_normals.hpp"
#include "shapes/lanes/superellipsoid_jet.hpp"

namespace supernormal {

void evaluate_in_four_lanes(const LaneBody& body, const double* normals, double* h, double* points) {
  using R = Real<4>;
  const PointJet<R> jet = point_jet(power_body<R>(body), Vec<R>{load<4>(normals), load<4>(normals + 4), load<4>(normals + 8)});
  store(h, jet.h);
  store(points, jet.r.x);
  store(points + 4, jet.r.y);
  store(points + 8, jet.r.z);
}

}  // namespace supernormal
