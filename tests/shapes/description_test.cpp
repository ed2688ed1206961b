// Tests of shapes and poses as text, of copies and of equality.
#include "supernormal/shapes/description.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <locale>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/draw.hpp"
#include "support/refusal.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace grains {

/// A class of a program.
struct Pebble : Shape {
  void evaluate(const Vector3& n, Order order, Jet& jet) const override { Sphere(1).evaluate(n, order, jet); }
};

}  // namespace grains

namespace {

using ShapePointer = std::shared_ptr<const Shape>;

/// Numbers of all magnitudes and with all digits.
class Numbers {
 public:
  double length() { return std::pow(10.0, exponent_(engine_)) * (1 + uniform_(engine_)); }
  Vector3 lengths() { return {length(), length(), length()}; }
  double between(double low, double high) { return low + (high - low) * uniform_(engine_); }
  Vector3 point() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  Matrix3 matrix() {
    Matrix3 M = Matrix3::Identity();
    for (double& entry : M.reshaped()) entry += between(-0.3, 0.3);
    return M;
  }

 private:
  std::mt19937_64 engine_{5};
  std::uniform_real_distribution<double> uniform_, exponent_{-29, 29};
};

const std::vector<Vector3> kHull = {{1, 0, -0.0}, {0, 1 / 3.0, 0}, {0, 0, 1e-17}, {-1, -1, -1}};

/// One shape of each kind.
std::vector<ShapePointer> one_of_each(Numbers& numbers) {
  const auto grain = std::make_shared<Superellipsoid>(numbers.lengths(), numbers.between(1.01, 1000), numbers.between(1.01, 3));
  const auto hull = std::make_shared<Polytope>(kHull);
  return {std::make_shared<Sphere>(numbers.length()),
          std::make_shared<Ellipsoid>(numbers.lengths()),
          grain,
          std::make_shared<Superovoid>(numbers.lengths(), numbers.between(1.01, 9), 1.7, numbers.between(0, 0.1), 0),
          std::make_shared<Box>(numbers.lengths()),
          std::make_shared<Capsule>(numbers.length(), numbers.length()),
          std::make_shared<Cylinder>(numbers.length(), 0),
          hull,
          std::make_shared<Rounded>(grain, numbers.length()),
          std::make_shared<MinkowskiSum>(grain, hull),
          std::make_shared<LinearImage>(std::make_shared<Rounded>(hull, numbers.length()), numbers.matrix())};
}

bool same_bits(const Vector3& a, const Vector3& b) {
  for (int k = 0; k < 3; ++k) {
    if (std::bit_cast<std::uint64_t>(a[k]) != std::bit_cast<std::uint64_t>(b[k])) return false;
  }
  return true;
}

void check_same_digits(const Shape& a, const Shape& b) {
  for (const Vector3& n : all_normals(20, 3)) {
    const Jet of_a = a.jet(n), of_b = b.jet(n);
    CHECK(std::bit_cast<std::uint64_t>(of_a.h) == std::bit_cast<std::uint64_t>(of_b.h));
    CHECK(same_bits(of_a.r, of_b.r));
  }
}

std::string refusal_of(const std::string& text) {
  return refusal([&] { read_shape(text); });
}

}  // namespace

TEST_CASE("description: the text of every kind reads back as an equal shape with the same digits") {
  Numbers numbers;
  for (int round = 0; round < 300; ++round) {
    for (const ShapePointer& shape : one_of_each(numbers)) {
      const std::string text = describe(*shape);
      CAPTURE(text);
      const ShapePointer read = read_shape(text);
      CHECK(*read == *shape);
      CHECK(describe(*read) == text);
      if (round == 0) check_same_digits(*read, *shape);
    }
  }
}

TEST_CASE("description: the texts are what the page says") {
  const auto brick = std::make_shared<Superellipsoid>(Vector3(0.02, 0.015, 0.008), 8, 8);
  CHECK(describe(Rounded(brick, 0.001)) ==
        "Rounded(core=Superellipsoid(half_axes=(0.02, 0.015, 0.008), delta=8, epsilon=8), radius=0.001)");
  CHECK(describe(Polytope(kHull)) == "Polytope(points=[(1, 0, -0.0), (0, 0.3333333333333333, 0), (0, 0, 1e-17), (-1, -1, -1)])");
  CHECK(describe(LinearImage(std::make_shared<Sphere>(1), Vector3(1, 2, 3).asDiagonal().toDenseMatrix())) ==
        "LinearImage(shape=Sphere(radius=1), matrix=((1, 0, 0), (0, 2, 0), (0, 0, 3)))");
  CHECK(*read_shape(" Rounded ( core=\n Sphere( radius =1.0 ) ,\tradius= 2 )\n") == Rounded(std::make_shared<Sphere>(1), 2));
}

TEST_CASE("description: numbers of every size read back, also in a program whose locale has commas") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  using Limits = std::numeric_limits<double>;
  for (const double number : {Limits::denorm_min(), 4.07935020697694e-309, Limits::min(), 0.1, 1.5, 1e150}) {
    const Pose pose{Vector3(number, -number, 1), Matrix3::Identity()};
    CHECK(same_bits(read_pose(describe(pose)).position, pose.position));
  }
  for (const std::string number : {"+1", "1e-999", "-", "1.2.3", "1,5"}) {
    CHECK_FALSE(refusal_of("Sphere(radius=" + number + ")").empty());
  }
  std::locale::global(before);
}

TEST_CASE("description: what is no description is refused with the place and what must be there") {
  CHECK(refusal_of("") ==
        "text at character 1 is at its end, but must be one of Sphere, Ellipsoid, Superellipsoid, Superovoid, "
        "Box, Capsule, Cylinder, Polytope, Rounded, MinkowskiSum, LinearImage");
  CHECK(refusal_of("Elipsoid(half_axes=(1, 2, 3))")
            .starts_with("text at character 1 is \"Elipsoid(half_axes=(…\", but must be one of "));
  CHECK(refusal_of("Sphere(size=1)") == "text at character 8 is \"size=1)\", but must be \"radius\"");
  CHECK(refusal_of("Sphere(radius=nan)") == "text at character 15 is \"nan)\", but must be a finite number");
  CHECK(refusal_of("Sphere(radius=1e999)") == "text at character 15 is \"1e999)\", but must be a finite number");
  CHECK(refusal_of("Sphere(radius=1") == "text at character 16 is at its end, but must be \")\"");
  CHECK(refusal_of("Sphere(radius=1) Box") == "text at character 18 is \"Box\", but must be at its end");
  CHECK(refusal_of("Sphere(radius=-1)") == "the Sphere at character 1: radius = -1 m is outside [0, 1e+30] m");
  CHECK(refusal_of("Rounded(core=Box(half_lengths=(1, 2)), radius=1)") ==
        "text at character 36 is \")), radius=1)\", but must be \",\"");
  CHECK(refusal_of("Rounded(core=Superellipsoid(half_axes=(1, 1, 1), delta=0.5, epsilon=2), radius=1)") ==
        "the Superellipsoid at character 14: delta = 0.5 is outside [1.01, 1000]");
  CHECK(refusal_of("Polytope(points=[])") == "the Polytope at character 1: points is empty; at least one is needed");
}

TEST_CASE("description: no part of a text can be left out or doubled") {
  Numbers numbers;
  for (const ShapePointer& shape : one_of_each(numbers)) {
    const std::string text = describe(*shape);
    for (std::size_t length = 0; length < text.size(); ++length) CHECK_FALSE(refusal_of(text.substr(0, length)).empty());
    CHECK_FALSE(refusal_of(text + text).empty());
  }
}

TEST_CASE("description: a nesting of 100 reads back, a deeper one is refused before the stack ends") {
  ShapePointer shape = std::make_shared<Sphere>(1);
  for (int depth = 1; depth < 100; ++depth) shape = std::make_shared<Rounded>(shape, 1);
  CHECK(*read_shape(describe(*shape)) == *shape);
  const Rounded deeper(shape, 1);
  CHECK(refusal([&] { describe(deeper); }).ends_with("core is not a shape that is nested at most 100 deep"));
  std::string text;
  for (int depth = 0; depth < 1000000; ++depth) text += "Rounded(core=";
  CHECK(refusal_of(text).ends_with("must be a shape that is nested at most 100 deep"));
}

TEST_CASE("description: shapes of functions and of a program's classes are refused by name") {
  const auto pebble = std::make_shared<grains::Pebble>();
  const auto ball = std::make_shared<CallbackShape>([](const Vector3&) { return 1.0; }, [](const Vector3& n) { return n; });
  CHECK(refusal([&] { describe(*pebble); }) ==
        "shape is a grains::Pebble, which has no description; shapes with one are Sphere, Ellipsoid, Superellipsoid, Superovoid, "
        "Box, Capsule, Cylinder, Polytope, Rounded, MinkowskiSum, LinearImage");
  const MinkowskiSum sum(std::make_shared<Sphere>(1), std::make_shared<Rounded>(ball, 1));
  CHECK(
      refusal([&] { describe(sum); }).starts_with("shape.second.core is a supernormal::CallbackShape, which has no description; "));
  CHECK(refusal([&] { clone(Rounded(pebble, 1)); }).starts_with("shape.core is a grains::Pebble, which has no copy; "));
}

TEST_CASE("clone: a copy is equal, has the same digits and shares nothing") {
  Numbers numbers;
  std::vector<ShapePointer> copies;
  std::vector<std::string> texts;
  {
    auto points = std::make_unique<std::vector<Vector3>>(kHull);
    const auto hull = std::make_shared<Polytope>(*points);
    std::vector<ShapePointer> shapes = one_of_each(numbers);
    shapes.push_back(std::make_shared<Rounded>(std::make_shared<MinkowskiSum>(hull, hull), 0.1));
    for (const ShapePointer& shape : shapes) {
      copies.push_back(clone(*shape));
      CHECK(copies.back() != shape);
      CHECK(*copies.back() == *shape);
      check_same_digits(*copies.back(), *shape);
      texts.push_back(describe(*shape));
    }
    for (Vector3& point : *points) point.setConstant(kNan);
  }
  for (std::size_t k = 0; k < copies.size(); ++k) CHECK(describe(*copies[k]) == texts[k]);
}

TEST_CASE("clone: a shape of callbacks is copied with its functions, as a part, too") {
  const auto ball = std::make_shared<CallbackShape>([](const Vector3&) { return 2.0; }, [](const Vector3& n) { return 2 * n; });
  const ShapePointer copy = clone(Rounded(ball, 1));
  CHECK(copy->support(Vector3::UnitX()) == 3);
  CHECK(*ball == *ball);
  CHECK_FALSE(*clone(*ball) == *ball);
}

TEST_CASE("equality: shapes differ if the class, a parameter or a part differs") {
  Numbers numbers;
  const std::vector<ShapePointer> shapes = one_of_each(numbers), others = one_of_each(numbers);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j < shapes.size(); ++j) CHECK((*shapes[i] == *shapes[j]) == (i == j));
    const bool has_numbers = dynamic_cast<const Polytope*>(shapes[i].get()) == nullptr;
    CHECK((*shapes[i] != *others[i]) == has_numbers);
  }
  CHECK_FALSE(Ellipsoid(Vector3(1, 1, 1)) == Sphere(1));
  std::vector<Vector3> reversed(kHull.rbegin(), kHull.rend());
  CHECK_FALSE(Polytope(kHull) == Polytope(reversed));
}

TEST_CASE("pose: the text reads back as the same pose, to the bit") {
  Draw draw(2);
  for (int round = 0; round < 1000; ++round) {
    const Pose pose{1e3 * Vector3(draw.gauss(), draw.gauss(), -0.0), draw.rotation()};
    const Pose read = read_pose(describe(pose));
    CHECK(read == pose);
    CHECK(same_bits(read.position, pose.position));
  }
  CHECK(describe(Pose()) == "Pose(position=(0, 0, 0), rotation=((1, 0, 0), (0, 1, 0), (0, 0, 1)))");
  CHECK(read_pose("Pose(position=(0,0,1),rotation=((0,-1,0),(1,0,0),(0,0,1)))").rotation.col(0) == Vector3::UnitY());
  CHECK_FALSE(Pose{} == Pose{Vector3::UnitX(), Matrix3::Identity()});
}

TEST_CASE("pose: what is no pose is refused") {
  const auto refused = [](const char* text) { return refusal([&] { read_pose(text); }); };
  CHECK(refused("Pose(position=(0, 0, 0))") == "text at character 24 is \")\", but must be \",\"");
  CHECK(refused("Pose(position=(0, 0, 0), rotation=((1, 0, 0), (0, 1, 0), (0, 0, 2)))") ==
        "rotation = ((1, 0, 0), (0, 1, 0), (0, 0, 2)), but must be orthonormal and right-handed to 1e-5");
  CHECK(refused("Pose(position=(0, 0, 1e151), rotation=((1, 0, 0), (0, 1, 0), (0, 0, 1)))") ==
        "coordinate of position = 1e+151 m is outside [-1e+150, 1e+150] m");
  Pose broken;
  broken.position.x() = kNan;
  CHECK(refusal([&] { read_pose(describe(broken)); }).find("must be a finite number") != std::string::npos);
}
