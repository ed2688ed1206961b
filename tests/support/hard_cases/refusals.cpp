// Input that must be refused: unusable parameters and poses.
#include <limits>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
constexpr double kTiny = std::numeric_limits<double>::min();

struct Value {
  const char* name;
  double value;
};

constexpr Value kBadNumbers[] = {{"not a number", kNan}, {"infinite", kInfinity}, {"minus infinite", -kInfinity}};
constexpr Value kBadHalfAxes[] = {
    {"denormal", kDenormal}, {"nearly denormal", kTiny}, {"zero", 0}, {"negative", -1}, {"1e300", 1e300}};
constexpr Value kBadExponents[] = {
    {"1", 1}, {"just below 1.01", 1.00999999}, {"just above 1000", 1000.00001}, {"denormal", kDenormal}};

void refuse(std::vector<Refusal>& all, const std::string& name, const std::string& reason, const Body& body) {
  all.push_back({name, reason, [body] { make_shape(body); }});
}

/// Refusals of every parameter with one value.
void refuse_everywhere(std::vector<Refusal>& all, const Value& bad) {
  const std::string reason = "no number of a body may be " + std::string(bad.name);
  const double x = bad.value;
  const auto add = [&](const std::string& what, const Body& body) { refuse(all, what + " " + bad.name, reason, body); };
  for (int axis = 0; axis < 3; ++axis) {
    Vector3 lengths = Vector3::Ones();
    lengths[axis] = x;
    add("half-axis " + std::to_string(axis) + " of an ellipsoid", ellipsoid(lengths));
    add("half-axis " + std::to_string(axis) + " of a superellipsoid", superellipsoid(lengths, 3, 4));
    add("half-axis " + std::to_string(axis) + " of a superovoid", superovoid(lengths, 2, 2, 0.1, 0.1));
    add("half-length " + std::to_string(axis) + " of a box", box(lengths));
    add("coordinate " + std::to_string(axis) + " of a triangle's corner", polytope({Vector3::Zero(), Vector3::UnitX(), lengths}));
  }
  add("delta", superellipsoid(Vector3::Ones(), x, 4));
  add("epsilon", superellipsoid(Vector3::Ones(), 4, x));
  add("delta of a superovoid", superovoid(Vector3::Ones(), x, 2, 0.1, 0.1));
  add("epsilon of a superovoid", superovoid(Vector3::Ones(), 2, x, 0.1, 0.1));
  add("taper x", superovoid(Vector3::Ones(), 2, 2, x, 0.1));
  add("taper y", superovoid(Vector3::Ones(), 2, 2, 0.1, x));
  add("radius of a capsule", capsule(x, 1));
  add("half-length of a capsule", capsule(1, x));
  add("radius of a cylinder", cylinder(x, 1));
  add("half-length of a cylinder", cylinder(1, x));
}

/// Refusals of bodies described by the program.
void refuse_functions(std::vector<Refusal>& all, const Value& bad) {
  const std::string reason = "no number of a body may be " + std::string(bad.name);
  const double x = bad.value;
  const auto support = [](const Vector3&) { return 1.; };
  const auto point = [](const Vector3& n) { return n; };
  const auto add = [&](const std::string& what, const std::function<void()>& attempt) {
    all.push_back({what + " " + bad.name, reason, attempt});
  };
  add("support function", [=] { CallbackShape([x](const Vector3&) { return x; }, point); });
  add("boundary point", [=] { CallbackShape(support, [x](const Vector3&) { return Vector3(0, x, 0); }); });
  add("Hessian", [=] { CallbackShape(support, point, [x](const Vector3&) { return Matrix3(Matrix3::Constant(x)); }); });
  add("linear image", [=] { LinearImage(make_shape(ellipsoid(Vector3::Ones())), Vector3(1, x, 1).asDiagonal()); });
}

void refuse_settings(std::vector<Refusal>& all, const std::string& name, const Settings& settings) {
  const auto attempt = [settings] {
    const auto shape = make_shape(ellipsoid(Vector3::Ones()));
    find_proximity(*shape, {}, *shape, at({3, 0, 0}), settings);
  };
  all.push_back({name, "out of the range that the header gives", attempt});
}

}  // namespace

std::vector<Refusal> refusals() {
  std::vector<Refusal> all;
  for (const Value& bad : kBadNumbers) {
    refuse_everywhere(all, bad);
    refuse_functions(all, bad);
  }
  for (const Value& bad : kBadHalfAxes) {
    const std::string reason = "outside [1e-30, 1e30] m: second moments, fifth powers, would leave the range of numbers";
    refuse(all, "half-axis of an ellipsoid " + std::string(bad.name), reason, ellipsoid({1, bad.value, 1}));
    refuse(all, "half-axis of a superellipsoid " + std::string(bad.name), reason, superellipsoid({1, 1, bad.value}, 3, 3));
  }
  for (const Value& bad : kBadExponents) {
    const std::string reason = "outside [1.01, 1000]";
    refuse(all, "delta " + std::string(bad.name), reason, superellipsoid(Vector3::Ones(), bad.value, 2));
    refuse(all, "epsilon " + std::string(bad.name), reason, superellipsoid(Vector3::Ones(), 2, bad.value));
  }
  refuse(all, "taper beyond the limit", "not convex", superovoid(Vector3::Ones(), 2, 2, 0.7072, 0.7072));
  refuse(all, "different tapers with epsilon 4", "sides are saddles: not convex", superovoid(Vector3::Ones(), 2, 4, 0.1, 0.2));
  refuse(all, "rounding infinite", "no number of a body may be infinite", ellipsoid(Vector3::Ones()).rounded(kInfinity));
  refuse(all, "polytope of no points", "it is nowhere", polytope({}));
  refuse_settings(all, "tolerance not a number", {.tolerance = kNan});
  refuse_settings(all, "tolerance zero", {.tolerance = 0});
  refuse_settings(all, "tolerance denormal", {.tolerance = kDenormal});
  refuse_settings(all, "no evaluations", {.max_evaluations = 0});
  return all;
}

std::vector<HardCase> cases_without_answer() {
  std::vector<HardCase> all;
  const Body body = superellipsoid({1, 0.75, 0.5}, 3, 4);
  for (const Value& bad : kBadNumbers) {
    const auto add = [&](const std::string& what, const Pose& pose2) {
      all.push_back(pair(what + " " + bad.name, "there is no answer", body, body, pose2));
    };
    for (int axis = 0; axis < 3; ++axis) {
      Pose pose = at({0, 0, 1.5});
      pose.position[axis] = bad.value;
      add("coordinate " + std::to_string(axis) + " of a position", pose);
      pose = at({0, 0, 1.5});
      pose.rotation(axis, 1) = bad.value;
      add("entry (" + std::to_string(axis) + ", 1) of a rotation", pose);
    }
  }
  all.push_back(pair("both positions infinite", "their difference is not a number", body, body, at(Vector3::Constant(kInfinity))));
  all.back().pose1.position = Vector3::Constant(kInfinity);
  return all;
}

}  // namespace supernormal::samples
