// Tests of the reported error where the model of the gap function says too little: cases that the soak program found.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cfenv>
#include <cmath>
#include <memory>
#include <vector>

#include "proximity/covers.hpp"
#include "relative.hpp"
#include "shapes/without_hessian.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "z_axis_to.hpp"

using namespace supernormal;
using supernormal::test::gap_at;
using supernormal::test::without_hessian;
using supernormal::test::z_axis_to;

namespace {

/// The largest excess of the gap function over the reported bound around the answer, m; 0 if there is none.
double excess_around(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Proximity& answer) {
  const Vector3 across = answer.normal.unitOrthogonal();
  double excess = 0;
  for (int k = 0; k < 60; ++k) {
    for (int way = 0; way < 36; ++way) {
      const Vector3 aside = Eigen::AngleAxisd(way * 0.1745, answer.normal) * across;
      const Vector3 n = (answer.normal + std::pow(0.7, k) * aside).normalized();
      const double bound = answer.gap + answer.error + (k < 10 ? answer.global_error : 0);
      excess = std::max(excess, gap_at(shape1, pose1, shape2, pose2, n) - bound);
    }
  }
  return excess;
}

/// The error that a rough answer reports must cover the gap that an exact one finds.
void check_rough_answers(const Shape& body, const Pose& pose2) {
  const Proximity exact = find_proximity(body, {}, body, pose2, {});
  Settings settings;
  for (const double tolerance : {1e-5, 1e-4, 1e-3, 1e-2}) {
    settings.tolerance = tolerance;
    const Proximity rough = find_proximity(body, {}, body, pose2, settings);
    CHECK(exact.gap <= rough.gap + rough.error + exact.error);
  }
}

Pose pose_of(const Vector3& position, double w, double x, double y, double z) {
  return {position, Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix()};
}

}  // namespace

// Both have their sharpest vertex there: s = -depth cos(turn), and a program's functions show no radius of curvature.
TEST_CASE("vertex in vertex without Hessians: the normal between is a minimum, and the reported error covers the hill around it") {
  const auto sharp1 = std::make_shared<Superellipsoid>(Vector3(1.1, 0.635, 0.75), 1.108, 1.143);
  const Superellipsoid body1(*sharp1);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(Vector3(0.529, 1.3, 0.964), 1.162, 1.113));
  for (const double depth : {1e-10, 1e-9, 5e-9, 2e-8, 5e-8}) {
    const Pose pose2{Vector3(0, 0.635 + 1.3 - depth, 0), Matrix3::Identity()};
    const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
    CAPTURE(depth);
    CHECK(answer.status == Status::Converged);
    for (int k = 0; k < 45; ++k) {
      const double turn = std::pow(0.7, k);
      for (int way = 0; way < 12; ++way) {
        const double angle = way * 0.5236;
        const Vector3 n = Vector3(turn * std::cos(angle), 1, turn * std::sin(angle)).normalized();
        REQUIRE(gap_at(body1, {}, body2, pose2, n) <= answer.gap + answer.error + 1e-16);
      }
    }
  }
}

// Both are turned by a millionth from one another. The flat top has an infinite radius of curvature, near which the first steps
// end: the promised gain falls to nothing there, and rises again on the other side.
TEST_CASE("apex on a flat top: a step that ends beside an infinite radius of curvature is no convergence") {
  const Superellipsoid apex(Vector3(0.611306, 1.00865, 0.507747), 3.33016, 1.31775);
  const Superellipsoid top(Vector3(0.658949, 1.03858, 0.716509), 1.33293, 3.87141);
  const Vector3 n(-6.1304644873200358e-07, -7.8583620252973426e-08, 1);
  const Pose pose2{Vector3(0.0043862700608445059, 5.6630166193835717e-05, 1.2252065452805536), z_axis_to(n)};
  const Proximity answer = find_proximity(apex, {}, top, pose2, {});
  CHECK(answer.status == Status::Converged);
  for (int i = -200; i <= 200; ++i) {
    for (int k = -40; k <= 40; ++k) {
      REQUIRE(gap_at(apex, {}, top, pose2, Vector3(1e-8 * i, 1e-8 * k, 1).normalized()) <= answer.gap + answer.error + 1e-15);
    }
  }
}

// Along a needle the radius of curvature falls from step to step as fast as the slope: the promised gain says nothing about what
// follows.
TEST_CASE("needles tip to tip: steps that grow are no convergence") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  Pose pose2{Vector3(1.1836731558009868, 0.081589419827538659, -0.97956557560407753), Matrix3::Identity()};
  pose2.rotation << 9, -32, -36, 4, -36, 33, -48, -9, -4;
  pose2.rotation /= 49;
  Settings settings;
  const Proximity exact = find_proximity(needle, {}, needle, pose2, settings);
  CHECK(exact.status == Status::Converged);
  for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    settings.tolerance = tolerance;
    const Proximity loose = find_proximity(needle, {}, needle, pose2, settings);
    CHECK(exact.gap <= loose.gap + loose.error + exact.error);
  }
}

// The rim has a boundary point for every such normal, 1e-12 beside that of the face: their cuts differ in the last digits.
TEST_CASE("on a cylinder's face from a normal beside it: the face's depth to rounding") {
  const Cylinder cylinder(1.104268465, 0.6836455581);
  const Superellipsoid body(Vector3(1.2002188, 0.70805422, 0.79908887), 15.2757819, 10.33515995);
  const Matrix3 R = Eigen::AngleAxisd(2.1, Vector3(0.3, -0.9, 0.4).normalized()).toRotationMatrix();
  const double height = body.support(-(R.transpose() * Vector3::UnitZ()));
  const Pose pose2{Vector3(0.1, -0.2, 0.6836455581 + height - 1.2e-5), R};
  Settings settings;
  settings.tolerance = 1e-15;
  const Proximity cold = find_proximity(cylinder, {}, body, pose2, settings);
  CHECK(cold.gap == test::relative(-1.2e-5).epsilon(1e-9));
  for (int k = 0; k < 35; ++k) {
    const double beside = 1e-14 * std::pow(1.7, k);
    for (int way = 0; way < 8; ++way) {
      const Vector3 first = Vector3(beside * std::cos(0.7 * way), beside * std::sin(0.7 * way), 1).normalized();
      const Proximity warm = find_proximity(cylinder, {}, body, pose2, settings, &first);
      REQUIRE(std::abs(warm.gap - cold.gap) <= warm.error + cold.error);
    }
  }
}

// Both are symmetric about the plane in which the normal climbs: it ends on a saddle, and has never seen a turn out of the plane.
TEST_CASE("vertices in a common plane of symmetry, one without a Hessian: the direction out of the plane is tried") {
  const Superellipsoid body1(Vector3(1.32053, 1.33285, 1.40549), 1.298, 1.236);
  const CallbackShape body2 =
      without_hessian(std::make_shared<Superellipsoid>(Vector3(0.596023, 0.555018, 0.950173), 1.1784, 1.1886));
  const Pose pose2{Vector3(0, 1.33285 + 0.555018 - 0.006, 0), Matrix3::Identity()};
  const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
  CHECK(answer.status == Status::Converged);
  for (int k = 0; k < 45; ++k) {
    const Vector3 n = (answer.normal + std::pow(0.7, k) * Vector3::UnitZ()).normalized();
    REQUIRE(gap_at(body1, {}, body2, pose2, n) <= answer.gap + answer.error + 1e-16);
  }
}

// Seen from the needle's flat side the rim's radius of curvature is overestimated to one side and to the other: without the cuts
// the normal zigzags down to that of the cap, 1e-6 beside the maximum.
TEST_CASE("needle across a cylinder's rim: steps that stay as long as the last are no convergence") {
  const Cylinder cylinder(2.7598075274203726, 0.41336571351567486);
  const Superellipsoid needle(Vector3(0.80612899117088677, 0.14950435281593677, 0.067824181045325865), 5.8889, 50.876);
  const Pose pose2{Vector3(0.0105, -2.8766, -0.41336571351567486 - 0.067824181045325865 - 5.7e-7), Matrix3::Identity()};
  const Proximity answer = find_proximity(cylinder, {}, needle, pose2, {});
  CHECK(answer.status == Status::Converged);
  for (int k = 0; k < 60; ++k) {
    const Vector3 n = Vector3(0, -1e-3 * std::pow(0.7, k), -1).normalized();
    REQUIRE(gap_at(cylinder, {}, needle, pose2, n) <= answer.gap + answer.error + 1e-15);
  }
}

// The azimuth is that of a point 1e-312 m off the axis: dividing by that overflows.
TEST_CASE("next to nothing beside a cylinder's axis: the depth along the axis") {
  const Cylinder cylinder(1, 1.077920734531224);
  const Superellipsoid body(Vector3(1.486, 0.68, 1.317), 1.268, 1.151);
  const Pose pose2{Vector3(0, -2e-312, -1.077920734531224 - 1.317 + 1e-3), Matrix3::Identity()};
  const Proximity answer = find_proximity(body, {}, cylinder, pose2, {});
  CHECK(answer.status == Status::Converged);
  CHECK(answer.gap == test::relative(-1e-3).epsilon(1e-12));
}

// The normal is that of a face of the box whose nearest corner is exactly on the vertex: the other corners do not hold the normal
// there.
TEST_CASE("a box's corner exactly on a vertex: the normal between them is a minimum") {
  const Superellipsoid body(Vector3(0.520313, 0.775239, 1.29591), 1.0616, 1.0239);
  const Box box(Vector3(0.8265, 1.3193, 0.51));
  const Pose pose2{Vector3(0.8265, 1.3193, 0.51 + 1.29591 - 2.4e-4), Matrix3::Identity()};
  const Vector3 first = Vector3::UnitZ();
  const Proximity answer = find_proximity(box, {}, body, pose2, {}, &first);
  CHECK(answer.status == Status::Converged);
  for (int k = 0; k < 45; ++k) {
    const Vector3 n = (answer.normal + std::pow(0.7, k) * Vector3(0.55, 0.83, 0)).normalized();
    REQUIRE(gap_at(box, {}, body, pose2, n) <= answer.gap + answer.error + answer.global_error + 1e-15);
  }
}

// The radii of curvature vanish towards the normals of a tip, however fast the last step seemed to converge.
TEST_CASE("needles tip to tip, roughly: two evaluations do not tell how far s rises") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  Pose pose2{Vector3(1.183667999427793, 0.081650939054187716, -0.97954861724386533), Matrix3::Identity()};
  pose2.rotation << 9, -32, -36, 4, -36, 33, -48, -9, -4;
  pose2.rotation /= 49;
  check_rough_answers(needle, pose2);
}

// The slope of the cut there is rounding: it must not be taken for a sign that s falls in all directions.
TEST_CASE("a flat body's corner exactly on a vertex of a box's face: s rises on the diagonals, where no side holds it") {
  const Box box(Vector3(0.72989501794897538, 0.79928615824471605, 0.84201670054762578));
  const Superellipsoid body(Vector3(0.7953834282105523, 0.56502996152231855, 1.0054773742418535), 57.562407695671922,
                            144.93771480429729);
  const Pose pose1 = pose_of({0.00082552098681764436, 0.00021585302048299476, -0.00095495234618931367}, -0.07450031130389677,
                             0.16298126569026355, -0.25921826045645474, 0.9490483149426859);
  const Pose pose2 = pose_of({-0.77981086383396725, -0.22770545166419867, 1.0262306366291594}, 0.5837279432390982,
                             0.33459936874724605, 0.542624431613146, -0.5028555229211538);
  const Proximity answer = find_proximity(box, pose1, body, pose2, {});
  CHECK(answer.status == Status::Converged);
  CHECK(excess_around(box, pose1, body, pose2, answer) <= 1e-15);
}

// Each corner would hold the normal for less than 1e-7: within the tolerance that is as if it did not.
TEST_CASE("box in box, turned by a ten millionth: the normal of a face that hardly holds") {
  const Box box(Vector3::Constant(0.5));
  const Pose pose2 = pose_of({1.3748568243853568e-08, -3.1177642634196993e-10, -6.9627227468344387e-09}, 0.9999999999999679,
                             1.3317806604611997e-07, 1.6158147001579212e-07, 1.4281887258799618e-07);
  const Proximity answer = find_proximity(box, {}, box, pose2, {});
  CHECK(answer.status == Status::Converged);
  CHECK(excess_around(box, {}, box, pose2, answer) <= 1e-15);
}

// The first step is 0.6 long: its contraction does not tell how fast the next ones will converge.
TEST_CASE("needles tip to tip, after a long step: it tells no contraction") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  const Pose pose2 = pose_of({1.1836648306002431, 0.081643334851451546, -0.9796003455933715}, -0.3030032323743363,
                             0.7070555157317914, -0.20201529605587054, -0.606177662903718);
  check_rough_answers(needle, pose2);
}

// The climb ends in an overlap, after many steps along the edges, although another normal shows that the bodies are apart.
TEST_CASE("a flat needle beside a double cone: apart, although there is a local maximum with an overlap") {
  const Superellipsoid needle(Vector3(1.6790171512040069, 2.0476593148463227, 0.16420325352277118), 6.4159154608386988,
                              1.4480098049660433);
  const Superellipsoid cone(Vector3(0.082902375784658811, 0.44837378304008602, 0.74551334662045432), 1.626519172290662,
                            1.0212950666636207);
  const Pose pose2 = pose_of({-1.6886113101810354, -2.4409871389638296, -0.36826986861923156}, 0.7565702401024116,
                             -0.11918715197486376, 0.4906198430251132, 0.4155575341941394);
  const Proximity answer = find_proximity(needle, {}, cone, pose2, {});
  CHECK(answer.is_global);
  CHECK(answer.gap == test::relative(1.1460826404430247e-4).epsilon(1e-6));
}

// The model has just been wrong, so its small promise within a small trust region is no convergence.
TEST_CASE("boxes of exponent 200 in one another: a step that the trust region holds back is no convergence") {
  const Superellipsoid body1(Vector3(1.0000428164011124, 0.80005228989775901, 0.50001453720695488), 200.00356326936449,
                             199.99596973295817);
  const Superellipsoid body2(Vector3(1, 0.8, 0.5), 200, 200);
  const Pose pose2 = pose_of({-0.0021088538195574106, -0.011320296924982558, -0.0049370286283952165}, 0.9999999999999778,
                             1.729331805779211e-07, 1.142049584492155e-07, 3.64012557878181e-08);
  const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
  CHECK(answer.status == Status::Converged);
  CHECK(excess_around(body1, {}, body2, pose2, answer) <= 1e-15);
}

// A step leads to a normal 1e-160 away: dividing the next gain by that of this step would overflow.
TEST_CASE("next to nothing beside a plane of symmetry: no overflow") {
  const Superellipsoid body1(Vector3(0.50084521668798021, 0.8799530275640064, 1.3617083385272106), 1.0256029248035792,
                             1.0772194785899689);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(
      Vector3(0.94171784691969096, 0.5574478084197092, 1.2885276416047349), 1.175895557386629, 1.1777243209332211));
  Settings settings;
  settings.tolerance = 1e-15;
  std::feclearexcept(FE_ALL_EXCEPT);
  const Proximity answer =
      find_proximity(body1, {}, body2, {Vector3(-1.0730493914807038, 2.0703247356784026e-162, 0), Matrix3::Identity()}, settings);
  CHECK(std::fetestexcept(FE_OVERFLOW | FE_INVALID | FE_DIVBYZERO) == 0);
  CHECK(answer.gap < 0);
}

// Across its tip body 1 is flat one way and sharp the other: the gain of the one falls fast, while the other's steps stay long.
TEST_CASE("apex on a rounded edge: one direction converges fast, and does not tell of the other") {
  const Superellipsoid apex(Vector3(0.78537879085655571, 1.1282138075496573, 0.55363311558776052), 2.5402751031119326,
                            1.3617909698610691);
  const auto edged = std::make_shared<Superellipsoid>(Vector3(1.0662647456452168, 0.67443400665535003, 0.97664828872076181),
                                                      1.1406372857137788, 15.538109841992609);
  const Rounded body2(edged, 0.0011092896722160654);
  const Pose pose2 = pose_of({-0.49601856291949104, -4.9282185875166977e-05, 1.5313969584815448}, 0.9999999998786778,
                             -3.04007631221937e-06, 6.748831069300234e-06, 1.3706040401892649e-05);
  const Proximity answer = find_proximity(apex, {}, body2, pose2, {});
  CHECK(answer.status == Status::Converged);
  CHECK(answer.gap + answer.error >= -4.4543813082498218e-11 - 1e-15);  // the bodies were placed with that gap
}

// The faces are parallel but for rounding: the model of the flat face, far from where it ends, sees the body's point between the
// corners of the edge.
TEST_CASE("a box's corner over the rim of a flat face: the edge does not hold the normal, and the bodies are apart") {
  const Superellipsoid body1(Vector3(1.0106766395349354, 1.1199663975031902, 0.93721208263966826), 50.378808016519002,
                             93.708399580680634);
  const Box box(Vector3(1.4393928801921916, 0.63778120268802896, 0.63705217643466394));
  const Pose pose2 = pose_of({-2.4131399614737408, 0.63778120268802918, 1.5739590135933721}, 1, 8.022369665304116e-16,
                             -4.886896275868019e-16, -4.165030878349209e-16);
  const Proximity answer = find_proximity(body1, {}, box, pose2, {});
  CHECK(answer.is_global);
  CHECK(answer.gap == test::relative(5.0747044678667308e-06).epsilon(1e-3));
}

// The steps end at the rounding of the boundary points: the differences between those give no radius of curvature.
TEST_CASE("vertex in vertex without a Hessian, as exactly as can be: rounding is not taken for a radius of curvature that holds") {
  const Superellipsoid body1(Vector3(0.57808874109912955, 0.65892262340956331, 1.129978841879919), 1.0347375952555244,
                             1.0686434521814809);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(
      Vector3(0.95570924194021956, 0.99097304158845334, 1.1201359115970475), 1.0536246603371802, 1.2957508292981013));
  Pose pose2{Vector3(-2.7549160037065582e-15, -6.8192142169786934e-15, 2.2501139455497614), Matrix3::Identity()};
  pose2.rotation << 1, -1.4011441413626117e-14, -2.4594479787534914e-15,  //
      1.4011441413626117e-14, 1, -6.0878453644577068e-15,                 //
      2.4594479787534914e-15, 6.0878453644577068e-15, 1;
  Settings settings;
  settings.tolerance = 1e-15;
  CHECK(excess_around(body1, {}, body2, pose2, find_proximity(body1, {}, body2, pose2, settings)) <= 1e-15);
}

// The promised gain is rounding, but only because the model was made with other radii of curvature than those of the normals
// around.
TEST_CASE(
    "concentric bodies of exponents 50 and 2, as exactly as can be: a radius of curvature that has just changed promises nothing") {
  const Superellipsoid body(Vector3(1, 0.8, 0.5), 50, 2);
  const Pose pose2 = pose_of({2.2943614940614911e-06, 3.504289014228068e-08, -1.0213569298247613e-06}, 1, -1.5533454596453008e-12,
                             7.621408478987834e-13, 3.7524472547362336e-13);
  Settings settings;
  settings.tolerance = 1e-12;
  CHECK(excess_around(body, {}, body, pose2, find_proximity(body, {}, body, pose2, settings)) <= 1e-15);

  const Superellipsoid other(Vector3(0.99999999987539379, 0.80000000017434747, 0.50000000006820589), 49.9999999989762,
                             1.9999999998172231);
  const Pose pose_of_other{Vector3(1.7309494666010041e-06, -9.1551727213599139e-07, 9.5425382754125488e-06), Matrix3::Identity()};
  settings.tolerance = 1e-15;
  CHECK(excess_around(body, {}, other, pose_of_other, find_proximity(body, {}, other, pose_of_other, settings)) <= 1e-15);
}

// Out of a plane of symmetry both are flat, but not for as far as the overlap is deep: s rises again beyond.
TEST_CASE("deep in one another on a plane of symmetry, roughly: no more is claimed than was asked for") {
  const Superellipsoid body1(Vector3(0.73002180059886235, 0.56683809566604848, 0.62266994040512536), 2.119437673850507,
                             1.3131646722902539);
  const Superellipsoid body2(Vector3(0.65528541551416686, 1.092746153907642, 0.92671333436035175), 2.8873780785639553,
                             1.7148107806140822);
  const Pose pose2{Vector3(5.2657600938117704e-191, -1.1903173577266656e-57, -1.3187070210755167), Matrix3::Identity()};
  Settings settings;
  settings.tolerance = 1e-3;
  const Proximity answer = find_proximity(body1, {}, body2, pose2, settings);
  CHECK_FALSE(answer.is_global);
  CHECK(gap_at(body1, {}, body2, pose2, Vector3(0.058365145784997553, 0.023409028784580899, -0.99802080495792211)) <=
        answer.gap + answer.error);
}

// The edge holds the normal where the step begins. Where it ends, the tip's radius of curvature, which is large one way only, has
// turned the slopes: both corners rise the other way.
TEST_CASE("an octahedron's tip beside a corner of a polytope: an edge that holds the normal here need not do so there") {
  const Superellipsoid tip(Vector3(1.4246107994091295, 1.4552453147657094, 1.4980420995776373), 1.0611851224682807,
                           1.1857292548358858);
  const std::vector<Vector3> corners{{-0.22475503103533237, -1.0839390061168674, 0.1805641183498764},
                                     {0.52294833316291045, 0.020090764293210203, -0.1466002124326875},
                                     {-0.47532449665319415, 0.21874580023164641, 0.35950123906777054},
                                     {0.29395868278280018, 0.79533662169481623, -0.46282027745092369},
                                     {0.13644121938065543, 1.1629449333018775, -0.17109004755354093},
                                     {0.075545205753441799, -1.1831437140554164, -0.20153666395955599},
                                     {-0.2923423139466001, -0.87115665614451399, 0.38890632535536901}};
  const Polytope polytope(corners);
  Pose pose2{Vector3(1.5969316929970585, 0.74040962281354361, 0.72443197034332307), Matrix3::Identity()};
  pose2.rotation << -0.86675865923410567, 0.41618509602994036, -0.27480791925496728,  //
      0.32247637655485839, 0.88802063803451159, 0.32776261682630642,                  //
      0.38044501995261348, 0.19547202425750937, -0.90390943933887935;
  const Proximity answer = find_proximity(tip, {}, polytope, pose2, {});
  CHECK(answer.is_global);
  CHECK(answer.gap + answer.global_error >= 2.9898827857977039e-10);  // the bodies were placed with that gap
}

// Seen from five degrees aside they are as round as the overlap is deep, but not from nearer.
TEST_CASE("vertex in vertex without a Hessian: what is not reached is not claimed to be round") {
  const CallbackShape body1 = without_hessian(std::make_shared<Superellipsoid>(
      Vector3(0.51672908601276279, 0.98833782519962443, 0.98651173005067938), 1.1835505891400295, 1.1405561913876934));
  const Superellipsoid body2(Vector3(0.7412565493429647, 0.53304009409860575, 0.71259252494090819), 1.1915695538026552,
                             1.1332870028195809);
  Pose pose2{Vector3(1.1480640582756675e-05, 5.4190503248488957e-06, -1.6991042540033008), Matrix3::Identity()};
  pose2.rotation << 0.99999999978717513, 1.2887306830300617e-05, -1.6111087586427754e-05,  //
      -1.2887429351539794e-05, 0.99999999988804134, -7.6046971237851132e-06,               //
      1.6110989580560531e-05, 7.6049047526660086e-06, 0.99999999984130072;
  Settings settings;
  settings.tolerance = 1e-15;
  const Proximity answer = find_proximity(body1, {}, body2, pose2, settings);
  CHECK(answer.status == Status::Stalled);
  const Vector3 higher(0.00027239265596954397, 0.017589773913291116, -0.9998452508543112);
  CHECK(gap_at(body1, {}, body2, pose2, higher) <= answer.gap + answer.error);
}

// The steps end where s is nearly level, but s rises more steeply again beyond.
TEST_CASE("concentric bodies of exponents 50 and 2: a near-degenerate stationary point is no maximum") {
  const Superellipsoid body1(Vector3(1, 0.8, 0.5), 50, 2);
  const Superellipsoid body2(Vector3(0.99999999999983802, 0.80000000000007532, 0.49999999999998263), 49.999999999989086,
                             2.0000000000000786);
  const Pose pose2{Vector3(0.0008700175882708197, -0.00046653732960186245, 0.00026086288847033262), Matrix3::Identity()};
  const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
  CHECK(excess_around(body1, {}, body2, pose2, answer) <= 1e-15);
}

TEST_CASE("a ball deep in a ball a thousand times its size: what rounding says of the error is no less than 0") {
  const Sphere small(1), large(1000);
  for (int k = 0; k < 100; ++k) {
    const Pose pose2 = pose_of({0.1, 1.7, -0.9}, 0.9 - 0.017 * k, 0.3, -0.5 + 0.01 * k, 0.2);
    const Proximity answer = find_proximity(small, {}, large, pose2, {});
    CHECK(answer.error >= GapFunction(small, {}, large, pose2).rounding());
    CHECK(answer.global_error >= answer.error);
  }
}

// Five degrees from its vertex the points of the second body show a radius of curvature of 1e-4 m and more.
TEST_CASE("vertex in vertex, 5e-5 m deep, one without a Hessian: they are not as round as they seem from afar") {
  const Superellipsoid body1(Vector3(1.4101510110964472, 1.2836217351915686, 1.3660322909353744), 1.2269106873577822,
                             1.0814644158775701);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(
      Vector3(0.82889523666349763, 0.56200225548227212, 0.74337281839323055), 1.2924158517482134, 1.2344923434058641));
  const Pose pose2{Vector3(0, 0, -2.1093525448140267), Matrix3::Identity()};
  CHECK(excess_around(body1, {}, body2, pose2, find_proximity(body1, {}, body2, pose2, {})) <= 1e-15);
}

// The steps zigzag towards the normal of both faces, 1e-12 from it in the end; s rises by 0.4 m a radian across their way.
TEST_CASE("a brick's face on the border of a cylinder's: steps that shrink in a zigzag are no convergence") {
  const Superellipsoid brick(Vector3(0.89149106403377165, 2.1096758913725617, 0.16434391453892452), 53.271583303711246,
                             11.288821456855265);
  const Cylinder cylinder(3.9759904574194191, 0.19731531679932779);
  Pose pose2{Vector3(-4.230903875161891, 0.00042199446719581559, 0.36165922074330903), Matrix3::Identity()};
  pose2.rotation << 1, -1.2755978588381349e-16, 1.7957608729881174e-17,  //
      1.2755978588381349e-16, 1, 2.7343879781824106e-17,                 //
      -1.7957608729881174e-17, -2.7343879781824106e-17, 1;
  const Proximity answer = find_proximity(brick, {}, cylinder, pose2, {});
  CHECK(std::abs(answer.gap) <= answer.error);  // the bodies were placed to touch
}

// The brick's point is at the wrong end of its face. A turn by 2e-15 brings it to the other end, but no further: the corners of
// the box's face do not hold the normal that way, its edge is to be found.
TEST_CASE("a brick's edge on a box's, started at the normal of the faces: the radius of curvature of a face holds nothing") {
  const Box box(Vector3(0.58565179804385514, 1.3107073814951085, 0.71420637497054951));
  const Superellipsoid brick(Vector3(0.68207095075621638, 1.2143136173534945, 0.61676367917088692), 102.59479598454982,
                             196.71455901639888);
  Pose pose2{Vector3(0.10186405946100457, -2.5244670469364126, 1.3233201304787157), Matrix3::Identity()};
  pose2.rotation << 1, -9.071131668835325e-16, 2.1206262176702703e-15,  //
      9.071131668835325e-16, 1, -1.5916131447741001e-15,                //
      -2.1206262176702703e-15, 1.5916131447741001e-15, 1;
  const Vector3 start(0.30116993208668003, -0.89749896072442492, -0.32216810441985394);
  const Proximity answer = find_proximity(box, {}, brick, pose2, {}, &start);
  CHECK(answer.error <= 1e-9);
  CHECK(std::abs(answer.gap) <= answer.error);  // the bodies were placed to touch
}

// The first normal, 0.9 radians from the maximum, is one of both tips: s rises along its slope as far as the normals of the tips
// go.
TEST_CASE(
    "a tip in another's, one without a Hessian, at a loose tolerance: before any radius of curvature is seen none is believed") {
  const Superellipsoid body1(Vector3(1.3307026937667679, 0.67791660216741145, 1.0579499391168263), 1.2734375926967885,
                             1.0277908818452606);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(
      Vector3(0.50522832563076037, 0.78192221662747452, 0.51572629986482765), 1.0532310556542768, 1.1400900862845573));
  Pose pose2{Vector3(-0.13277975266132355, -0.062569660579594039, 1.8255023465012892), Matrix3::Identity()};
  pose2.rotation << 0.83299510297149038, -0.1697472475102694, 0.52659759816030627,  //
      0.52106547373530498, -0.079344687909482126, -0.84982068260401211,             //
      0.1860374438292417, 0.98228829396630502, 0.022355693463802728;
  Settings settings;
  settings.tolerance = 1e-3;
  const Proximity answer = find_proximity(body1, {}, body2, pose2, settings);
  CHECK(find_proximity(body1, {}, body2, pose2, {}).gap <= answer.gap + answer.error);
}

// On the cap's normal, which is where the climb gets first, s rises along one azimuth only, that of the tip to 1e-7: steps a
// thousandth beside it lead down, until they are too short to gain anything.
TEST_CASE("an octahedron's tip on the rim of a cylinder, at the finest tolerance: steps held back show no convergence") {
  const Cylinder cylinder(1.2152125017461786, 1.2492630838922749);
  const Superellipsoid tip(Vector3(1.0703647978263131, 0.6217203905892974, 1.0821407905791396), 1.0551426130855197,
                           1.0376467731595393);
  Pose pose2{Vector3(1.0191886248774535, 1.2361743712840529, 2.2310606505785624), Matrix3::Identity()};
  pose2.rotation << 0.12376757649905845, 0.91826095498726024, -0.37613615294655495,  //
      0.37858245289481446, 0.30668447398198118, 0.87328114589663552,                 //
      0.91725509721543386, -0.25048243843487306, -0.30967989064197354;
  Settings settings;
  settings.tolerance = 1e-15;
  const Proximity answer = find_proximity(cylinder, {}, tip, pose2, settings);
  CHECK(2.7688962234151404e-13 <= answer.gap + answer.error);  // the gap of a normal between the cap's and the mantle's
}
