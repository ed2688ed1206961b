// The digits of the answers for random pairs, as one number, to compare processors, C libraries and compilers:
// tests/proximity/same_digits.cmake and tests/platforms/run.
//
//     digits [PAIRS [WAY]]     one number of PAIRS pairs (5000). WAY: alone (default), together (find_proximities), or 1, 2, 4 or 8
//                              lanes. Exit code 77: this processor has no such lanes
//     digits PAIRS WAY each    a line for each pair: what its bodies are, and its number
//     digits c_library         a number of the C library's pow, exp, log and sin, whose digits may differ
//
// The pairs have bodies of every class, overlaps up to 30 %, cold and warm starts and various settings. They are made without the
// functions of the C library and without an order of evaluation that the compiler chooses.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <memory>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "proximity/among_many.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/painted_stack.hpp"
#include "support/without_hessian.hpp"
#include "whole_number.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kPairs = 5000;

/// FNV-1a of 64-bit words.
class Sum {
 public:
  void add(double number) { sum_ = (sum_ ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211U; }
  void add(const Proximity& answer) {
    for (const double number : numbers_of(answer)) add(number);
  }
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 14695981039346656037U;
};

struct Body {
  const char* name;
  std::shared_ptr<const Shape> shape;
};

struct Pair {
  Body body1, body2;
  Pose pose1, pose2;
  Vector3 first_normal;
};

class Pairs {
 public:
  Pair draw() {
    Pair pair;
    pair.body1 = body();
    pair.body2 = body();
    pair.pose1 = {vector(-1, 1), rotation()};
    pair.pose2 = {Vector3::Zero(), rotation()};
    constexpr std::array kGaps = {1.0, 0.1, 1e-3, 0.0, -1e-3, -0.01, -0.1, -0.3};
    const double gap = kGaps[engine_() % kGaps.size()];
    const Vector3 n = unit(vector(-1, 1));
    const Vector3 point1 = pair.pose1.rotation * pair.body1.shape->point(pair.pose1.rotation.transpose() * n);
    const Vector3 point2 = pair.pose2.rotation * pair.body2.shape->point(-(pair.pose2.rotation.transpose() * n));
    pair.pose2.position = pair.pose1.position + point1 + gap * n - point2;
    pair.first_normal = unit(pair.pose1.rotation.transpose() * n + 1e-3 * vector(-1, 1));
    return pair;
  }

  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }

 private:
  // Braces, here and below, fix the order of evaluation.
  Vector3 vector(double low, double high) { return Vector3{uniform(low, high), uniform(low, high), uniform(low, high)}; }

  static Vector3 unit(const Vector3& v) { return v / std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()); }

  Matrix3 rotation() {
    double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1), w = 1;
    const double scale = 1 / std::sqrt(x * x + y * y + z * z + w * w);
    x *= scale, y *= scale, z *= scale, w *= scale;
    Matrix3 out;
    out << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z),
        2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
    return out;
  }

  /// Most are below 5, some up to 100.
  double exponent() {
    const double x = uniform(0, 1);
    return 1.02 + 4 * x + 95 * x * x * x * x * x * x;
  }

  std::shared_ptr<const Shape> superellipsoid() {
    const Vector3 half = vector(0.5, 1.5);
    const double delta = exponent(), other = exponent();
    return std::make_shared<Superellipsoid>(half, delta, engine_() % 4 == 0 ? delta : other);
  }

  /// A half are those that go in lanes.
  Body body() {
    const Vector3 half = vector(0.5, 1.5);
    switch (engine_() % 20) {
      case 0:
      case 1:
      case 2:
        return {"ellipsoid", std::make_shared<Ellipsoid>(half)};
      case 3: {
        const double delta = 2 + exponent(), epsilon = 2 + exponent(), taper = uniform(-0.2, 0.2);
        return {"superovoid", std::make_shared<Superovoid>(half, delta, epsilon, taper, taper)};
      }
      case 4:
        return {"box", std::make_shared<Box>(half)};
      case 5:
        return {"cylinder", std::make_shared<Cylinder>(half.x(), half.y())};
      case 6:
        return {"capsule", std::make_shared<Capsule>(half.x(), half.y())};
      case 7: {
        std::array<Vector3, 12>& points = points_.emplace_back();
        for (Vector3& point : points) point = half.cwiseProduct(unit(vector(-1, 1)));
        return {"polytope", std::make_shared<Polytope>(points)};
      }
      case 8:
        return {"rounded", std::make_shared<Rounded>(superellipsoid(), 0.2)};
      case 9: {
        Matrix3 matrix = rotation();
        matrix(0, 1) += 0.3;
        return {"linear image", std::make_shared<LinearImage>(superellipsoid(), matrix)};
      }
      case 10:
        return {"Minkowski sum", std::make_shared<MinkowskiSum>(superellipsoid(), std::make_shared<Box>(half))};
      case 11:
        return {"without Hessian", std::make_shared<CallbackShape>(without_hessian(superellipsoid()))};
      default:
        return {"superellipsoid", superellipsoid()};
    }
  }

  std::mt19937_64 engine_{21};
  std::deque<std::array<Vector3, 12>> points_;
};

std::array<Settings, 6> all_settings() {
  std::array<Settings, 6> all;
  all[1].stop_when_apart = true;
  all[2].tolerance = 1e-14;
  all[3].certify_depth = true;
  all[3].max_evaluations = 300;
  all[4].tolerance = 1e-3;
  all[5].max_evaluations = 3;
  return all;
}

std::uint64_t number_of_c_library() {
  Sum sum;
  Pairs pairs;
  for (int k = 0; k < 100000; ++k) {
    const double x = pairs.uniform(0.1, 10), y = pairs.uniform(0.1, 10);
    for (const double value : {std::pow(x, y), std::exp(x), std::log(x), std::sin(x)}) sum.add(value);
  }
  return sum.value();
}

int usage() {
  std::fprintf(stderr, "usage: digits [PAIRS [alone | together | 1 | 2 | 4 | 8 [each]]] | digits c_library\n");
  return 2;
}

int print_digits(int count, const WayAmongMany& way, bool each) {
  constexpr int kBatch = 97;
  const std::array settings = all_settings();
  Pairs drawn;
  Sum sum;
  std::size_t turn = 0;
  for (int first = 0; first < count; first += kBatch) {
    std::vector<Pair> pairs;
    std::vector<ProximityQuery> queries;
    for (int k = first; k < std::min(count, first + kBatch); ++k) pairs.push_back(drawn.draw());
    for (const Pair& pair : pairs) {
      const Vector3* const normal = queries.size() % 2 == 0 ? nullptr : &pair.first_normal;
      queries.push_back({pair.body1.shape.get(), &pair.pose1, pair.body2.shape.get(), &pair.pose2, normal});
    }
    std::vector<Proximity> answers(pairs.size());
    way.ask(queries, settings[turn++ % settings.size()], answers);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      sum.add(answers[k]);
      if (!each) continue;
      Sum one;
      one.add(answers[k]);
      std::printf("%zu %s, %s: %.17g %d %016llx\n", static_cast<std::size_t>(first) + k, pairs[k].body1.name, pairs[k].body2.name,
                  answers[k].gap, answers[k].evaluations, static_cast<unsigned long long>(one.value()));
    }
  }
  if (!each) std::printf("%016llx\n", static_cast<unsigned long long>(sum.value()));
  return 0;
}

WayAmongMany alone() {
  return {"alone", [](std::span<const ProximityQuery> queries, const Settings& settings, std::span<Proximity> answers) {
            for (std::size_t k = 0; k < queries.size(); ++k) answers[k] = find_proximity(queries[k], settings);
          }};
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "", name = argc > 2 ? argv[2] : "alone";
  if (argc == 2 && first == "c_library") {
    std::printf("%016llx\n", static_cast<unsigned long long>(number_of_c_library()));
    return 0;
  }
  const int count = argc > 1 ? whole_number(argv[1]) : kPairs;
  const bool each = argc > 3;
  if (count < 1 || argc > 4 || (each && std::string_view(argv[3]) != "each")) return usage();
  if (name == "alone") return print_digits(count, alone(), each);
  if (name == "together") return print_digits(count, {"together", find_proximities}, each);
  const int lanes = whole_number(name.data());
  if (lanes != 1 && lanes != 2 && lanes != 4 && lanes != 8) return usage();
  for (int k = 0; k < lane_kernels().count; ++k) {
    const LaneKernel& kernel = *lane_kernels().kernels[k];
    if (kernel.width != lanes) continue;
    const auto ask = [&kernel](std::span<const ProximityQuery> queries, const Settings& settings, std::span<Proximity> answers) {
      find_in_lanes(queries, settings, kernel, answers);
    };
    return print_digits(count, {kernel.name, ask}, each);
  }
  std::fprintf(stderr, "this processor has no %d lanes\n", lanes);
  return 77;
}
