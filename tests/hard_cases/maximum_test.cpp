// Tests that the search for a normal that is higher than an answer's finds one where there is one on the same hill.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "cases/builders.hpp"
#include "invariants.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"

using namespace supernormal;
using namespace supernormal::samples;

namespace {

/// The answer of a climb that ends before the maximum, by an angle.
Proximity beside(const HardCase& one, Proximity answer, double angle) {
  answer.normal = (answer.normal + angle * answer.normal.unitOrthogonal()).normalized();
  GapFunction gap(*one.shape1, one.pose1, *one.shape2, one.pose2);
  GapJet jet;
  gap.evaluate(answer.normal, Order::Value, jet);
  answer.gap = jet.s;
  return answer;
}

/// Checks that the answer is a maximum, if not known to be the global one, and none is beside it by an angle.
void check_local_maximum(const HardCase& one, double tolerance, double angle) {
  Settings settings;
  settings.tolerance = tolerance;
  const Proximity answer = find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings);
  CHECK_FALSE(answer.is_global);
  CHECK(check_maximum(one, settings, answer).empty());
  CHECK_FALSE(check_maximum(one, settings, beside(one, answer, angle)).empty());
}

}  // namespace

TEST_CASE("an answer beside the maximum is found out, be it apart, touching or deep") {
  for (const double distance : {2.5, 2.0, 1.5}) {
    const HardCase one = pair("", "", ellipsoid(Vector3(1, 0.7, 0.5)), superball(1, 4), at(Vector3(distance, 0.3, 0.2)));
    const Proximity answer = find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, {});
    CHECK(check_maximum(one, {}, answer).empty());
    CHECK_FALSE(check_maximum(one, {}, beside(one, answer, 1e-3)).empty());
  }
}

// Around the pole of body 1, of exponent 1.6, there are several hills within 1e-5 radians; the valleys between them are 3e-14 m
// deep, and next to the answer's normal the depth is less than the rounding of s at worst.
TEST_CASE("a higher normal beyond a shallow valley is another maximum") {
  Pose pose2{Vector3(1.8493363468845583, 0.35813409845690192, -1.6271422410808503), Matrix3::Identity()};
  pose2.rotation << 0.89344973057470922, -0.31982929357466361, 0.31536772489827042,  //
      0.0035525899381533277, 0.70713266322715096, 0.70707197349492501,               //
      -0.44914914899252661, -0.63061289200967685, 0.63292370977115464;
  const HardCase one = pair(
      "", "",
      superellipsoid(Vector3(0.4903459476771726, 0.38967923981747343, 0.061520520560491412), 31.576372082447019,
                     1.6176656595678696),
      superellipsoid(Vector3(2.3743222585551198, 0.66988455851120476, 0.175064090576774), 160.56125457666411, 83.873937973465033),
      pose2);
  check_local_maximum(one, 1e-12, 1e-4);
}

// In extended precision the best path to the higher maximum, at (-9.5e-4, 0, -1), leads through a valley that is 3.7e-15 m deep.
TEST_CASE("a valley of 35 units in the last place is one, where s jitters by a few") {
  Pose pose2{Vector3(0.22385214070544279, 1.1057767157012071, -1.7466884145786477), Matrix3::Identity()};
  pose2.rotation << -0.78102248067361946, -0.18791655061990364, -0.59555961472009078,  //
      -0.19164098188548162, -0.8355228298294024, 0.51495177919474744,                  //
      -0.59437161670489802, 0.516322545350273, 0.61654960093947109;
  const HardCase one = pair("", "",
                            superellipsoid(Vector3(0.72741415512879237, 0.94970188447682291, 0.95011405855510633),
                                           3.7401182166858731, 1.3294011485345418),
                            polytope({{-0.086715633476586992, 1.3772566295119755, 0.055023349351227636},
                                      {-0.25931263253313253, -1.2256632599208348, -0.24402547104472544},
                                      {0.18370982536308836, -0.87664944787251287, 0.62658464790755075},
                                      {-0.46632042194546874, -0.7854544965018283, 0.40098997228068101},
                                      {-0.62300498670625148, 0.55438816035763472, 0.09935026695520946}}),
                            pose2);
  check_local_maximum(one, 1e-15, 1e-3);
}

// There is one maximum on either axis, 3e-7 radians from the pole. The valley between is 3.8e-16 m deep and drowns in the
// rounding of s; its slopes of -1.6e-8 do not. With an offset 1e4 times as large it is 1e8 times as deep there.
TEST_CASE("a valley that is shallower than the rounding of s is found by its slopes") {
  const auto body = [] { return superellipsoid(Vector3(1, 0.8, 0.5), 50, 2); };
  const Vector3 offset(-5.1523108982969034e-07, -4.827623616318814e-07, -4.6838088834834924e-07);
  check_local_maximum(pair("", "", body(), body(), at(offset)), 1e-15, 1e-6);
}
