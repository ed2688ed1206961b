// Pairs of balls, boxes, capsules and cylinders in motion: the time of impact by FCL's conservative advancement and by ours, and
// what the gap is then.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "smooth_shape.hpp"

namespace {

using namespace supernormal;

constexpr int kPairs = 1000;
constexpr double kHorizon = 1;  // s

struct Body {
  std::shared_ptr<const Shape> shape;
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  Motion motion;

  Pose at(double t) const { return pose_at(motion, t); }
};

fcl::Transform3d transform_of(const Pose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = pose.rotation;
  transform.translation() = pose.position;
  return transform;
}

class RandomBodies {
 public:
  Body draw() {
    const double a = uniform(0.5, 1.5), b = uniform(0.5, 1.5);
    switch (std::uniform_int_distribution<int>(0, 3)(engine_)) {
      case 0:
        return {std::make_shared<Sphere>(a), std::make_shared<fcl::Sphered>(a), {}};
      case 1:
        return {std::make_shared<Box>(Vector3(a, b, 1)), std::make_shared<fcl::Boxd>(2 * a, 2 * b, 2), {}};
      case 2:
        return {std::make_shared<Capsule>(a, b), std::make_shared<fcl::Capsuled>(a, 2 * b), {}};
      default:
        return {std::make_shared<Cylinder>(a, b), std::make_shared<fcl::Cylinderd>(a, 2 * b), {}};
    }
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vector3 direction() { return Vector3{normal_(engine_), normal_(engine_), normal_(engine_)}.normalized(); }
  Matrix3 rotation() {
    return Eigen::Quaterniond{normal_(engine_), normal_(engine_), normal_(engine_), normal_(engine_)}
        .normalized()
        .toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_{1};
  std::normal_distribution<double> normal_;
};

struct Tally {
  int hits = 0, missed = 0, passed = 0;
  double microseconds = 0, evaluations = 0, sum = 0, widest = 0;

  /// Judges the time at which the bodies are said to meet: `t` beyond the horizon says that they do not.
  void judge(double t, const Impact& proved, const std::function<double(double)>& gap) {
    if (!proved.may_hit()) return;
    ++hits;
    if (t > kHorizon) {
      ++missed;
      return;
    }
    double deepest = 0;
    for (int k = 0; k <= 100; ++k) deepest = std::min(deepest, gap(t * k / 100));
    if (deepest < -1e-6) ++passed;
    sum += gap(t);
    widest = std::max(widest, gap(t));
  }

  void print(const char* name) const {
    std::printf(
        "%s: %.1f us a pair; of %d impacts %d missed, %d with an overlap above 1e-6 m before; gap then %.1e m, at most %.1e m\n",
        name, microseconds / kPairs, hits, missed, passed, sum / std::max(hits - missed, 1), widest);
  }
};

/// The least of five times: another program may have had the processor.
double microseconds_of(const std::function<void()>& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 5; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

double time_by_fcl(const Body& one, const Body& other) {
  const fcl::ContinuousCollisionRequestd request(1000, 1e-9, fcl::CCDM_LINEAR, fcl::GST_LIBCCD, fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide<double>(one.geometry.get(), transform_of(one.at(0)), transform_of(one.at(kHorizon)), other.geometry.get(),
                                 transform_of(other.at(0)), transform_of(other.at(kHorizon)), request, result);
  return result.is_collide ? result.time_of_contact * kHorizon : 2 * kHorizon;
}

}  // namespace

int main() {
  RandomBodies random;
  Settings as_coarse;
  as_coarse.tolerance = 2e-3;  // what FCL leaves
  Tally ours, coarse, theirs;
  for (int k = 0; k < kPairs; ++k) {
    Body one = random.draw(), other = random.draw();
    for (Body* body : {&one, &other}) {
      body->motion.pose.rotation = random.rotation();
      body->motion.angular_velocity = random.uniform(0, 2) * random.direction();
    }
    other.motion.pose.position = random.uniform(6.1, 8) * random.direction();
    one.motion.velocity = random.uniform(0, 2) * (other.motion.pose.position + 2 * random.direction());
    const auto gap = [&](double t) { return find_proximity(*one.shape, one.at(t), *other.shape, other.at(t)).gap; };
    Impact impact;
    double t = 0;
    ours.microseconds +=
        microseconds_of([&] { impact = find_time_of_impact(*one.shape, one.motion, *other.shape, other.motion, kHorizon); });
    theirs.microseconds += microseconds_of([&] { t = time_by_fcl(one, other); });
    Impact rough;
    coarse.microseconds += microseconds_of(
        [&] { rough = find_time_of_impact(*one.shape, one.motion, *other.shape, other.motion, kHorizon, as_coarse); });
    coarse.judge(rough.may_hit() ? rough.time : 2 * kHorizon, impact, gap);
    ours.evaluations += impact.evaluations;
    coarse.evaluations += rough.evaluations;
    ours.judge(impact.may_hit() ? impact.time : 2 * kHorizon, impact, gap);
    theirs.judge(t, impact, gap);
  }
  ours.print("ours, 1e-9");
  coarse.print("ours, 2e-3");
  theirs.print("FCL       ");
  std::printf("ours: %.1f and %.1f evaluations of the gap function a pair\n", ours.evaluations / kPairs,
              coarse.evaluations / kPairs);
  return ours.hits > kPairs / 10 && ours.missed + ours.passed == 0 && ours.widest < 1e-8 ? 0 : 1;
}
