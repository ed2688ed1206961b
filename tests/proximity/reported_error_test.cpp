// The reported error, which is a bound of bodies that are apart, touch, or overlap by less than the ball that rolls inside them,
// and the proved interval of deeper ones: pairs on which a local model of the gap function says too little.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cfenv>
#include <cmath>
#include <memory>
#include <vector>

#include "proximity/covers.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/relative.hpp"
#include "support/without_hessian.hpp"
#include "support/z_axis_to.hpp"

using namespace supernormal;
using supernormal::test::gap_at;
using supernormal::test::must_be_proved;
using supernormal::test::without_hessian;
using supernormal::test::z_axis_to;

namespace {

/// Apart, touching, or within the ball that rolls inside: such answers have converged to the maximum, which is proved.
void check_proved(const Proximity& answer) {
  CHECK(answer.status == Status::Converged);
  CHECK(answer.is_global);
}

/// What a rough answer reports must cover what an exact one finds.
void check_rough_answers(const Shape& body, const Pose& pose2) {
  const Proximity exact = find_proximity(body, {}, body, pose2, {});
  Settings settings;
  for (const double tolerance : {1e-5, 1e-4, 1e-3, 1e-2}) {
    settings.tolerance = tolerance;
    const Proximity rough = find_proximity(body, {}, body, pose2, settings);
    check_proved(rough);
    CHECK(exact.gap <= rough.gap + rough.error + exact.error);
  }
}

Pose pose_of(const Vector3& position, double w, double x, double y, double z) {
  return {position, Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix()};
}

}  // namespace

// Both have their sharpest vertex there: s = -depth cos(angle), and no curvature that a program's functions would show.
TEST_CASE("vertex in vertex without Hessians: the interval covers the maxima around the normal between, which is a minimum") {
  const auto sharp1 = std::make_shared<Superellipsoid>(Vector3(1.1, 0.635, 0.75), 1.108, 1.143);
  const Superellipsoid body1(*sharp1);
  const CallbackShape body2 = without_hessian(std::make_shared<Superellipsoid>(Vector3(0.529, 1.3, 0.964), 1.162, 1.113));
  for (const double depth : {1e-10, 1e-9, 5e-9, 2e-8, 5e-8}) {
    const Pose pose2{Vector3(0, 0.635 + 1.3 - depth, 0), Matrix3::Identity()};
    const Proximity answer = find_proximity(body1, {}, body2, pose2, {});
    CAPTURE(depth);
    if (must_be_proved(GapFunction(body1, {}, body2, pose2), {}, answer.gap)) check_proved(answer);
    for (int k = 0; k < 45; ++k) {
      const double turn = std::pow(0.7, k);
      for (int way = 0; way < 12; ++way) {
        const double angle = way * 0.5236;
        const Vector3 n = Vector3(turn * std::cos(angle), 1, turn * std::sin(angle)).normalized();
        REQUIRE(gap_at(body1, {}, body2, pose2, n) <= answer.gap + answer.global_error + 1e-16);
      }
    }
  }
}

// They are rotated by a millionth from each other.
TEST_CASE("apex on a flat top, apart: the error covers every normal around, beside which the curvature is infinite") {
  const Superellipsoid apex(Vector3(0.611306, 1.00865, 0.507747), 3.33016, 1.31775);
  const Superellipsoid top(Vector3(0.658949, 1.03858, 0.716509), 1.33293, 3.87141);
  const Vector3 n(-6.1304644873200358e-07, -7.8583620252973426e-08, 1);
  const Pose pose2{Vector3(0.0043862700608445059, 5.6630166193835717e-05, 1.2252065452805536), z_axis_to(n)};
  const Proximity answer = find_proximity(apex, {}, top, pose2, {});
  check_proved(answer);
  for (int i = -200; i <= 200; ++i) {
    for (int k = -40; k <= 40; ++k) {
      REQUIRE(gap_at(apex, {}, top, pose2, Vector3(1e-8 * i, 1e-8 * k, 1).normalized()) <= answer.gap + answer.error + 1e-15);
    }
  }
}

// Along a needle the curvature falls from step to step as fast as the slope.
TEST_CASE("needles tip to tip, apart: rough answers cover the exact one") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  Pose pose2{Vector3(1.1836731558009868, 0.081589419827538659, -0.97956557560407753), Matrix3::Identity()};
  pose2.rotation << 9, -32, -36, 4, -36, 33, -48, -9, -4;
  pose2.rotation /= 49;
  Settings settings;
  const Proximity exact = find_proximity(needle, {}, needle, pose2, settings);
  check_proved(exact);
  for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    settings.tolerance = tolerance;
    const Proximity loose = find_proximity(needle, {}, needle, pose2, settings);
    check_proved(loose);
    CHECK(exact.gap <= loose.gap + loose.error + exact.error);
  }
}

// The edge has a boundary point for every such normal, 1e-12 beside the face's: their cuts differ in the last digits.
TEST_CASE("on a cylinder's face from a normal beside it: the face's depth to rounding") {
  const Cylinder cylinder(1.104268465, 0.6836455581);
  const Superellipsoid body(Vector3(1.2002188, 0.70805422, 0.79908887), 15.2757819, 10.33515995);
  const Matrix3 R = Eigen::AngleAxisd(2.1, Vector3(0.3, -0.9, 0.4).normalized()).toRotationMatrix();
  const double height = body.support(-(R.transpose() * Vector3::UnitZ()));
  const Pose pose2{Vector3(0.1, -0.2, 0.6836455581 + height - 1.2e-5), R};
  Settings settings;
  settings.tolerance = 1e-15;
  const Proximity cold = find_proximity(cylinder, {}, body, pose2, settings);
  check_proved(cold);
  CHECK(cold.gap == test::relative(-1.2e-5).epsilon(1e-9));
  for (int k = 0; k < 35; ++k) {
    const double beside = 1e-14 * std::pow(1.7, k);
    for (int way = 0; way < 8; ++way) {
      const Vector3 first = Vector3(beside * std::cos(0.7 * way), beside * std::sin(0.7 * way), 1).normalized();
      const Proximity warm = find_proximity(cylinder, {}, body, pose2, settings, &first);
      check_proved(warm);
      REQUIRE(std::abs(warm.gap - cold.gap) <= warm.error + cold.error);
    }
  }
}

// Seen from the needle's flat side the edge's curvature is overestimated to one side and to the other; the maximum is 1e-6 beside
// the normal of the cap.
TEST_CASE("needle across a cylinder's edge, apart: the error covers the normals between the cap's and the maximum") {
  const Cylinder cylinder(2.7598075274203726, 0.41336571351567486);
  const Superellipsoid needle(Vector3(0.80612899117088677, 0.14950435281593677, 0.067824181045325865), 5.8889, 50.876);
  const Pose pose2{Vector3(0.0105, -2.8766, -0.41336571351567486 - 0.067824181045325865 - 5.7e-7), Matrix3::Identity()};
  const Proximity answer = find_proximity(cylinder, {}, needle, pose2, {});
  check_proved(answer);
  for (int k = 0; k < 60; ++k) {
    const Vector3 n = Vector3(0, -1e-3 * std::pow(0.7, k), -1).normalized();
    REQUIRE(gap_at(cylinder, {}, needle, pose2, n) <= answer.gap + answer.error + 1e-15);
  }
}

// The azimuth of a point that is 1e-312 m off the axis: a division by that overflows.
TEST_CASE("next to nothing beside a cylinder's axis: the depth along the axis") {
  const Cylinder cylinder(1, 1.077920734531224);
  const Superellipsoid body(Vector3(1.486, 0.68, 1.317), 1.268, 1.151);
  const Pose pose2{Vector3(0, -2e-312, -1.077920734531224 - 1.317 + 1e-3), Matrix3::Identity()};
  const Proximity answer = find_proximity(body, {}, cylinder, pose2, {});
  CHECK(answer.gap == test::relative(-1e-3).epsilon(1e-12));
}

// The nearest vertex of the box's face is exactly on the tip, and the other vertices have zero multipliers there.
TEST_CASE("a box's vertex exactly on a tip: the interval covers the maxima around the normal between them, which is a minimum") {
  const Superellipsoid body(Vector3(0.520313, 0.775239, 1.29591), 1.0616, 1.0239);
  const Box box(Vector3(0.8265, 1.3193, 0.51));
  const Pose pose2{Vector3(0.8265, 1.3193, 0.51 + 1.29591 - 2.4e-4), Matrix3::Identity()};
  const Vector3 first = Vector3::UnitZ();
  const Proximity answer = find_proximity(box, {}, body, pose2, {}, &first);
  for (int k = 0; k < 45; ++k) {
    const Vector3 n = (answer.normal + std::pow(0.7, k) * Vector3(0.55, 0.83, 0)).normalized();
    REQUIRE(gap_at(box, {}, body, pose2, n) <= answer.gap + answer.global_error + 1e-15);
  }
}

// The radii of curvature vanish towards the normals of a tip.
TEST_CASE("needles tip to tip, apart: rough answers cover the exact one, in another place") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  Pose pose2{Vector3(1.183667999427793, 0.081650939054187716, -0.97954861724386533), Matrix3::Identity()};
  pose2.rotation << 9, -32, -36, 4, -36, 33, -48, -9, -4;
  pose2.rotation /= 49;
  check_rough_answers(needle, pose2);
}

TEST_CASE("needles tip to tip, apart: rough answers cover the exact one, after a first step of 0.6 radians") {
  const Superellipsoid needle(Vector3(1, 1e-4, 1e-4), 1.3, 1.3);
  const Pose pose2 = pose_of({1.1836648306002431, 0.081643334851451546, -0.9796003455933715}, -0.3030032323743363,
                             0.7070555157317914, -0.20201529605587054, -0.606177662903718);
  check_rough_answers(needle, pose2);
}

// The climb comes to normals that overlap, after many steps along the edges, although another normal shows that the bodies are
// apart.
TEST_CASE("a flat needle beside a double cone: apart, although there is a local maximum with an overlap") {
  const Superellipsoid needle(Vector3(1.6790171512040069, 2.0476593148463227, 0.16420325352277118), 6.4159154608386988,
                              1.4480098049660433);
  const Superellipsoid cone(Vector3(0.082902375784658811, 0.44837378304008602, 0.74551334662045432), 1.626519172290662,
                            1.0212950666636207);
  const Pose pose2 = pose_of({-1.6886113101810354, -2.4409871389638296, -0.36826986861923156}, 0.7565702401024116,
                             -0.11918715197486376, 0.4906198430251132, 0.4155575341941394);
  const Proximity answer = find_proximity(needle, {}, cone, pose2, {});
  check_proved(answer);
  CHECK(answer.gap == test::relative(1.1460826404430247e-4).epsilon(1e-6));
}

// The gain of a step to a normal 1e-160 away: a division of the next one by that would overflow.
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

// Across its tip body 1 is flat one way and sharp the other.
TEST_CASE("apex on a rounded edge, touching: the error covers the placed gap") {
  const Superellipsoid apex(Vector3(0.78537879085655571, 1.1282138075496573, 0.55363311558776052), 2.5402751031119326,
                            1.3617909698610691);
  const auto edged = std::make_shared<Superellipsoid>(Vector3(1.0662647456452168, 0.67443400665535003, 0.97664828872076181),
                                                      1.1406372857137788, 15.538109841992609);
  const Rounded body2(edged, 0.0011092896722160654);
  const Pose pose2 = pose_of({-0.49601856291949104, -4.9282185875166977e-05, 1.5313969584815448}, 0.9999999998786778,
                             -3.04007631221937e-06, 6.748831069300234e-06, 1.3706040401892649e-05);
  const Proximity answer = find_proximity(apex, {}, body2, pose2, {});
  check_proved(answer);
  CHECK(answer.gap + answer.error >= -4.4543813082498218e-11 - 1e-15);  // the bodies were placed with that
}

// The faces are parallel but for rounding.
TEST_CASE("a box's vertex over the edge of a flat face: apart, with the right gap") {
  const Superellipsoid body1(Vector3(1.0106766395349354, 1.1199663975031902, 0.93721208263966826), 50.378808016519002,
                             93.708399580680634);
  const Box box(Vector3(1.4393928801921916, 0.63778120268802896, 0.63705217643466394));
  const Pose pose2 = pose_of({-2.4131399614737408, 0.63778120268802918, 1.5739590135933721}, 1, 8.022369665304116e-16,
                             -4.886896275868019e-16, -4.165030878349209e-16);
  const Proximity answer = find_proximity(body1, {}, box, pose2, {});
  check_proved(answer);
  CHECK(answer.gap == test::relative(5.0747044678667308e-06).epsilon(1e-3));
}

// The tip's curvature is large one way only, so the edge of the polytope soon has a zero multiplier.
TEST_CASE("an octahedron's tip beside a vertex of a polytope: apart, and the interval covers the placed gap") {
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
  check_proved(answer);
  CHECK(answer.gap + answer.global_error >= 2.9898827857977039e-10);  // the bodies were placed with that
}

TEST_CASE("a ball deep in a ball a thousand times its size: what rounding says of the error is no less than 0") {
  const Sphere small(1), large(1000);
  for (int k = 0; k < 100; ++k) {
    const Pose pose2 = pose_of({0.1, 1.7, -0.9}, 0.9 - 0.017 * k, 0.3, -0.5 + 0.01 * k, 0.2);
    const Proximity answer = find_proximity(small, {}, large, pose2, {});
    check_proved(answer);
    CHECK(answer.error >= GapFunction(small, {}, large, pose2).rounding());
    CHECK(answer.global_error >= answer.error);
  }
}

// On the way the normal zigzags towards the normal of both faces; s rises by 0.4 m a radian across its way.
TEST_CASE("a brick's face on the border of a cylinder's: touching, to within the error") {
  const Superellipsoid brick(Vector3(0.89149106403377165, 2.1096758913725617, 0.16434391453892452), 53.271583303711246,
                             11.288821456855265);
  const Cylinder cylinder(3.9759904574194191, 0.19731531679932779);
  Pose pose2{Vector3(-4.230903875161891, 0.00042199446719581559, 0.36165922074330903), Matrix3::Identity()};
  pose2.rotation << 1, -1.2755978588381349e-16, 1.7957608729881174e-17,  //
      1.2755978588381349e-16, 1, 2.7343879781824106e-17,                 //
      -1.7957608729881174e-17, -2.7343879781824106e-17, 1;
  const Proximity answer = find_proximity(brick, {}, cylinder, pose2, {});
  check_proved(answer);
  CHECK(std::abs(answer.gap) <= answer.error);  // placed to touch
}

// A rotation by 2e-15 brings the brick's point from one end of its face to the other.
TEST_CASE("a brick's edge on a box's, from a first normal: touching, to within the error") {
  const Box box(Vector3(0.58565179804385514, 1.3107073814951085, 0.71420637497054951));
  const Superellipsoid brick(Vector3(0.68207095075621638, 1.2143136173534945, 0.61676367917088692), 102.59479598454982,
                             196.71455901639888);
  Pose pose2{Vector3(0.10186405946100457, -2.5244670469364126, 1.3233201304787157), Matrix3::Identity()};
  pose2.rotation << 1, -9.071131668835325e-16, 2.1206262176702703e-15,  //
      9.071131668835325e-16, 1, -1.5916131447741001e-15,                //
      -2.1206262176702703e-15, 1.5916131447741001e-15, 1;
  const Vector3 start(0.30116993208668003, -0.89749896072442492, -0.32216810441985394);
  const Proximity answer = find_proximity(box, {}, brick, pose2, {}, &start);
  check_proved(answer);
  CHECK(answer.error <= 1e-9);
  CHECK(std::abs(answer.gap) <= answer.error);  // placed to touch
}

// The first normal, 0.9 radians from the maximum, is one of both tips: s rises along its slope as far as the normals of the tips
// go.
TEST_CASE("a tip in another's, one without a Hessian, touching at a loose tolerance: the error covers the exact answer") {
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
  check_proved(answer);
  CHECK(find_proximity(body1, {}, body2, pose2, {}).gap <= answer.gap + answer.error);
}

// On the cap's normal s rises along one azimuth only, the tip's to 1e-7: steps a thousandth beside it lead down.
TEST_CASE(
    "an octahedron's tip on the rim of a cylinder, at the finest tolerance: the error covers a normal between the cap's and the "
    "mantle's") {
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
  check_proved(answer);
  CHECK(2.7688962234151404e-13 <= answer.gap + answer.error);  // at a normal between the cap's and the side's
}

// The vertices that are near the normal tell of nothing more to gain; there is, a quarter of a radian away.
TEST_CASE("a box beside an edge of another one a million times as large, apart by next to nothing: what is claimed holds") {
  const Box large(Vector3(0x1.4283cd0da587cp-13, 0x1.b15e815497b9fp-10, 0x1.c496c7d07f13bp-13));
  const Rounded small(std::make_shared<Box>(Vector3(0x1.e9191175c41d6p-31, 0x1.37aaccef9e8e2p-29, 0x1.0bc78d47a46ebp-33)),
                      0x1.6d324f1074326p-49);
  const Pose pose1{Vector3(-0x1.b6404e4667d57p-12, -0x1.f57eee091f7f6p-14, 0x1.488d820e4ff09p-21), Matrix3::Identity()};
  Pose pose2{Vector3(-0x1.14fea4e2b7427p-12, -0x1.d0b6972a84749p-10, 0x1.c5df660f1b4ep-13), Matrix3::Identity()};
  pose2.rotation << -1, -0x1.ea620b47291a6p-31, 0x1.66563bddc833cp-30, 0x1.ea620b47291a6p-31, -1, 0x1.2d7f90bde592dp-28,
      0x1.66563bddc833cp-30, 0x1.2d7f90bde592dp-28, 1;
  const Proximity answer = find_proximity(large, pose1, small, pose2);
  GapFunction gap(large, pose1, small, pose2);
  GapJet jet;
  gap.evaluate(Vector3(2.93676e-11, -0.400022, 0.916505).normalized(), Order::Value, jet);
  CHECK(jet.s > gap.rounding());
  CHECK(jet.s - gap.rounding() <= answer.gap + answer.global_error);
}
