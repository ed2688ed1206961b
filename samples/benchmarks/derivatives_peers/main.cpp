// Our derivatives and two other libraries' on the same pairs, as a Markdown table: dgd (growth distance) and iDCOL (scaling).
//
//     derivatives_peers [--pairs 1024] [--rounds 5] [--seed 7]
//
// Each library is asked for what it has: ours for the gap, dgd and iDCOL for the factor by which both bodies grow until they touch.
// Each derivative is compared with differences of the exact answer along a random twist of both bodies, extrapolated from steps of
// 4e-4, 2e-4 and 1e-4. The exact answers of both kinds come from our queries, with the normal after Newton's last steps. A pair has
// no reference if the last two extrapolations differ by 1e-7.
#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/idcol_contactpair.hpp"
#include "dgd/dgd.h"
#include "dgd/geometry/3d/cuboid.h"
#include "dgd/geometry/3d/ellipsoid.h"
#include "dgd/geometry/xd/capsule.h"
#include "supernormal/proximity/derivatives.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "support/drawn_pairs.hpp"

namespace {

using namespace supernormal;

enum class Partner { Same, Box, Capsule };

struct Kind {
  const char* name;
  double exponent;
  double gap;  // in units of the smallest half-extent
  Partner partner = Partner::Same;
};

constexpr Kind kKinds[] = {{"ellipsoids, apart", 2, 1},
                           {"ellipsoids, overlap 1 %", 2, -0.01},
                           {"ellipsoid and box, apart", 2, 1, Partner::Box},
                           {"ellipsoid and capsule, apart", 2, 1, Partner::Capsule},
                           {"exponents 4, apart", 4, 1},
                           {"exponents 4, overlap 1 %", 4, -0.01},
                           {"exponents 8, apart", 8, 1},
                           {"exponents 8, overlap 1 %", 8, -0.01}};

using Body = std::function<std::unique_ptr<Shape>(double scale)>;

struct Pair {
  Body body1, body2;
  std::unique_ptr<Shape> shape1, shape2;
  std::unique_ptr<dgd::ConvexSet<3>> set1, set2;
  std::optional<idcol::ContactPair> contact;
  Pose pose1, pose2;
  TwistVector twist = TwistVector::Zero();
};

/// What a library answers: value, normal and two points. And its derivative along a twist, where it has one.
using Answer = Eigen::Matrix<double, 10, 1>;

Pose moved(const Pose& pose, const Vector3& v, const Vector3& w) {
  const double angle = w.norm();
  const Vector3 axis = angle > 0 ? Vector3(w / angle) : Vector3::UnitX();
  return {pose.position + v, Eigen::AngleAxisd(angle, axis).toRotationMatrix() * pose.rotation};
}

dgd::Transform3r transform(const Pose& pose) {
  dgd::Transform3r result = dgd::Transform3r::Identity();
  result.topLeftCorner<3, 3>() = pose.rotation;
  result.topRightCorner<3, 1>() = pose.position;
  return result;
}

// The capsules of dgd lie along x, ours along z.
dgd::Transform3r transform2(const Pair& pair, const Pose& pose) {
  dgd::Transform3r result = transform(pose);
  if (dynamic_cast<const dgd::Capsule*>(pair.set2.get()) != nullptr) {
    const Matrix3 turned = pose.rotation * Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3::UnitY()).toRotationMatrix();
    result.topLeftCorner<3, 3>() = turned;
  }
  return result;
}

Pair draw_pair(const Kind& kind, drawn_pairs::Draw& draw) {
  Pair pair;
  const Vector3 a = draw.within(0.5, 1.5), b = draw.within(0.5, 1.5);
  const auto body = [exponent = kind.exponent](const Vector3& half_axes) -> Body {
    return [=](double scale) -> std::unique_ptr<Shape> {
      if (exponent == 2) return std::make_unique<Ellipsoid>(scale * half_axes);
      return std::make_unique<Superellipsoid>(scale * half_axes, exponent, exponent);
    };
  };
  pair.body1 = body(a);
  if (kind.exponent == 2) pair.set1 = std::make_unique<dgd::Ellipsoid>(a[0], a[1], a[2]);
  const double radius = 0.5 * b[0];
  switch (kind.partner) {
    case Partner::Same:
      pair.body2 = body(b);
      if (kind.exponent == 2) pair.set2 = std::make_unique<dgd::Ellipsoid>(b[0], b[1], b[2]);
      pair.contact.emplace(idcol::make_se(0.5 * kind.exponent, a[0], a[1], a[2]),
                           idcol::make_se(0.5 * kind.exponent, b[0], b[1], b[2]));
      break;
    case Partner::Box:
      pair.body2 = [=](double scale) { return std::make_unique<Box>(scale * b); };
      pair.set2 = std::make_unique<dgd::Cuboid>(b[0], b[1], b[2]);
      break;
    case Partner::Capsule:
      pair.body2 = [=](double scale) { return std::make_unique<Capsule>(scale * radius, scale * b[1]); };
      pair.set2 = std::make_unique<dgd::Capsule>(b[1], radius);
      break;
  }
  pair.shape1 = pair.body1(1);
  pair.shape2 = pair.body2(1);
  draw.place(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, kind.gap);
  pair.twist << draw.direction(), draw.direction(), draw.direction(), draw.direction();
  return pair;
}

Answer answer_of(double value, const Vector3& normal, const Vector3& point1, const Vector3& point2) {
  return (Answer() << value, normal, point1, point2).finished();
}

// %% Ours
double ask_ours(const Pair& pair) { return find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2).gap; }

// The normal to rounding, for bodies that have grown by the scale.
Vector3 exact_normal(const Pair& pair, const Pose& pose1, const Pose& pose2, double scale) {
  const std::unique_ptr<Shape> shape1 = pair.body1(scale), shape2 = pair.body2(scale);
  const Proximity p = find_proximity(*shape1, pose1, *shape2, pose2);
  return find_proximity_derivatives(*shape1, pose1, *shape2, pose2, p, {.hessian = false, .parameters = false}).common_normal;
}

// The point of body 1 is unique, because it is strictly convex. The other follows.
Answer exact_gap(const Pair& pair, const Pose& pose1, const Pose& pose2) {
  const Vector3 n = exact_normal(pair, pose1, pose2, 1);
  const Vector3 point1 = pose1.position + pose1.rotation * pair.shape1->point(pose1.rotation.transpose() * n);
  const Vector3 support2 = pose2.position + pose2.rotation * pair.shape2->point(-(pose2.rotation.transpose() * n));
  const double gap = n.dot(support2 - point1);
  return answer_of(gap, n, point1, point1 + gap * n);
}

// The largest s = n.(p2 - p1)/(h1(n) + h2(-n)): at this scale the bodies touch.
Answer exact_growth(const Pair& pair, const Pose& pose1, const Pose& pose2) {
  const Vector3 centres = pose2.position - pose1.position;
  double scale = 1;
  Vector3 n, arm1;
  for (int step = 0; step < 12; ++step) {
    n = exact_normal(pair, pose1, pose2, scale);
    arm1 = pose1.rotation * pair.shape1->point(pose1.rotation.transpose() * n);
    scale = n.dot(centres) / n.dot(arm1 - pose2.rotation * pair.shape2->point(-(pose2.rotation.transpose() * n)));
  }
  const Vector3 z1 = pose1.position + arm1;
  return answer_of(scale, n, z1, z1 + (1 - 1 / scale) * centres);
}

std::optional<Answer> differentiate_ours(const Pair& pair) {
  const Proximity p = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
  const ProximityDerivatives d =
      find_proximity_derivatives(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, p, {.hessian = false, .parameters = false});
  if (!d.has_points) return std::nullopt;
  return answer_of(d.gap_gradient.dot(pair.twist), d.normal * pair.twist, d.point1 * pair.twist, d.point2 * pair.twist);
}

// %% dgd
double ask_dgd(const Pair& pair, const dgd::Settings& settings) {
  dgd::Output3 out;
  return dgd::GrowthDistance<3>(pair.set1.get(), transform(pair.pose1), pair.set2.get(), transform2(pair, pair.pose2), settings,
                                out);
}

std::optional<Answer> differentiate_dgd(const Pair& pair, const dgd::Settings& settings) {
  dgd::Output3 out;
  const dgd::Transform3r tf1 = transform(pair.pose1), tf2 = transform2(pair, pair.pose2);
  dgd::GrowthDistance<3>(pair.set1.get(), tf1, pair.set2.get(), tf2, settings, out);
  dgd::DirectionalDerivative3 dd;
  dgd::TotalDerivative3 td;
  if (!dgd::FactorizeKktSystem<3>(pair.set1.get(), tf1, pair.set2.get(), tf2, settings, out, dd)) return std::nullopt;
  dgd::GdJacobian<3>(tf1, tf2, settings, out, dd, td);
  const Eigen::Matrix<double, 6, 1> t1 = pair.twist.head<6>(), t2 = pair.twist.tail<6>();
  return answer_of(td.d_gd_tf1.dot(t1) + td.d_gd_tf2.dot(t2), td.d_normal_tf1 * t1 + td.d_normal_tf2 * t2,
                   td.d_z1_tf1 * t1 + td.d_z1_tf2 * t2, td.d_z2_tf1 * t1 + td.d_z2_tf2 * t2);
}

// %% iDCOL
idcol::NewtonResult ask_idcol(Pair& pair) {
  Eigen::Matrix4d g = Eigen::Matrix4d::Identity();
  g.topLeftCorner<3, 3>() = pair.pose1.rotation.transpose() * pair.pose2.rotation;
  g.topRightCorner<3, 1>() = pair.pose1.rotation.transpose() * (pair.pose2.position - pair.pose1.position);
  pair.contact->reset_guess();
  return pair.contact->solve(g).newton;
}

// %% Table
struct Errors {
  std::vector<double> relative;
  int refused = 0, without_reference = 0;
};

using Ask = Answer (*)(const Pair&, const Pose&, const Pose&);

Answer difference(const Pair& pair, Ask ask, double h) {
  const auto at = [&](double t) {
    const TwistVector d = t * pair.twist;
    return ask(pair, moved(pair.pose1, d.segment<3>(0), d.segment<3>(3)), moved(pair.pose2, d.segment<3>(6), d.segment<3>(9)));
  };
  return (at(h) - at(-h)) / (2 * h);
}

void compare(const Pair& pair, Ask ask, const std::optional<Answer>& derivative, Errors& errors) {
  const Answer d1 = difference(pair, ask, 4e-4), d2 = difference(pair, ask, 2e-4), d4 = difference(pair, ask, 1e-4);
  const Answer wide = d2 + (d2 - d1) / 3, narrow = d4 + (d4 - d2) / 3, reference = narrow + (narrow - wide) / 15;
  if (!((narrow - wide).norm() < 1e-7 * reference.norm())) {
    ++errors.without_reference;
  } else if (!derivative) {
    ++errors.refused;
  } else {
    errors.relative.push_back((*derivative - reference).norm() / reference.norm());
  }
}

void print_row(const Kind& kind, const char* library, double query, double derivatives, Errors& errors) {
  std::sort(errors.relative.begin(), errors.relative.end());
  const auto wrong = errors.relative.end() - std::upper_bound(errors.relative.begin(), errors.relative.end(), 1e-6);
  const double median = errors.relative.empty() ? 0 : errors.relative[errors.relative.size() / 2];
  const double worst = errors.relative.empty() ? 0 : errors.relative.back();
  std::printf("| %s | %s | %.0f | %.0f | %.0e | %.0e | %td | %d | %d |\n", kind.name, library, query, derivatives, median, worst,
              wrong, errors.refused, errors.without_reference);
}

// iDCOL's sources have no derivative, so its row has the errors of the value.
Errors value_errors(std::vector<Pair>& pairs) {
  Errors errors;
  for (Pair& pair : pairs) {
    const idcol::NewtonResult result = ask_idcol(pair);
    const double reference = exact_growth(pair, pair.pose1, pair.pose2)[0];
    if (result.converged) {
      errors.relative.push_back(std::abs(result.alpha - reference) / reference);
    } else {
      ++errors.refused;
    }
  }
  return errors;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Derivatives beside those of dgd and iDCOL.");
  std::size_t count = 1024;
  int rounds = 5;
  unsigned seed = 7;
  dgd::Settings settings;
  double tolerance = settings.rel_tol - 1;
  app.option_defaults()->always_capture_default();
  app.add_option("--pairs", count, "pairs of a row")->check(CLI::Range(1, 1000000));
  app.add_option("--rounds", rounds, "how often each way of asking is timed")->check(CLI::Range(1, 1000));
  app.add_option("--seed", seed, "another seed: other pairs");
  app.add_option("--dgd-tolerance", tolerance, "relative, of dgd's growth distance")->check(CLI::Range(1e-16, 1.0));
  CLI11_PARSE(app, argc, argv);
  settings.rel_tol = 1 + tolerance;
  double sum = 0;
  std::printf("| pairs | library | query, ns | derivatives, ns | median error | largest | above 1e-6 | refused | no reference |\n");
  std::printf("|---|---|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Kind& kind : kKinds) {
    drawn_pairs::Draw draw(seed);
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < count; ++k) pairs.push_back(draw_pair(kind, draw));
    const bool has_dgd = pairs[0].set1 != nullptr, has_idcol = pairs[0].contact.has_value();
    const auto add = [&](const std::optional<Answer>& a) { sum += a ? (*a)[0] + (*a)[4] : 0; };
    const std::vector<double> least = drawn_pairs::least_seconds(5, rounds, [&](std::size_t way) {
      for (Pair& pair : pairs) {
        if (way == 0) sum += ask_ours(pair);
        if (way == 1) add(differentiate_ours(pair));
        if (way == 2 && has_dgd) sum += ask_dgd(pair, settings);
        if (way == 3 && has_dgd) add(differentiate_dgd(pair, settings));
        if (way == 4 && has_idcol) sum += ask_idcol(pair).alpha;
      }
    });
    const auto ns = [&](std::size_t way) { return 1e9 * least[way] / static_cast<double>(count); };
    Errors ours, theirs;
    for (const Pair& pair : pairs) {
      compare(pair, exact_gap, differentiate_ours(pair), ours);
      if (has_dgd) compare(pair, exact_growth, differentiate_dgd(pair, settings), theirs);
    }
    print_row(kind, "ours", ns(0), ns(1) - ns(0), ours);
    if (has_dgd) print_row(kind, "dgd", ns(2), ns(3) - ns(2), theirs);
    if (has_idcol) {
      Errors values = value_errors(pairs);
      print_row(kind, "iDCOL, value", ns(4), 0, values);
    }
    std::fflush(stdout);
  }
  std::fprintf(stderr, "sum of the answers: %g\n", sum);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "derivatives_peers: %s\n", error.what());
  return 1;
}
