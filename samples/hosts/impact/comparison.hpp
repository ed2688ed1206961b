// Times of impact by a host and by this library, on the same random pairs of bodies in steady motion in the same run.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <supernormal/supernormal.hpp>
#include <vector>

namespace supernormal::impact_hosts {

inline constexpr double kHorizon = 1;  // s

struct MovingBody {
  std::shared_ptr<const Shape> shape;
  Motion motion;

  Pose at(double time) const { return pose_at(motion, time); }
};

struct MovingPair {
  MovingBody one, other;

  double gap(double time) const { return find_proximity(*one.shape, one.at(time), *other.shape, other.at(time)).gap; }  // m
  Impact impact(const Settings& settings) const {
    return find_time_of_impact(*one.shape, one.motion, *other.shape, other.motion, kHorizon, settings);
  }
};

enum class Bodies {
  Colliders,       ///< balls, boxes, capsules and cylinders
  Ellipsoids,      ///< half-axes of 0.5 to 1.5 m
  Superellipsoids  ///< the same, with exponents of 1.3 to 8
};

class RandomPairs {
 public:
  /// Each body rotates by up to `most_turn` (rad) within the horizon.
  MovingPair draw(Bodies bodies, double most_turn) {
    MovingPair pair{{draw_shape(bodies), {}}, {draw_shape(bodies), {}}};
    for (MovingBody* body : {&pair.one, &pair.other}) {
      body->motion.pose.rotation = rotation();
      body->motion.angular_velocity = uniform(0, most_turn / kHorizon) * direction();
    }
    Vector3& position = pair.other.motion.pose.position;
    position = uniform(6.1, 8) * direction();
    pair.one.motion.velocity = uniform(0, 2) * (position + 2 * direction());
    return pair;
  }

 private:
  std::shared_ptr<const Shape> draw_shape(Bodies bodies) {
    const double a = uniform(0.5, 1.5);
    const double b = uniform(0.5, 1.5);
    if (bodies == Bodies::Ellipsoids) return std::make_shared<Ellipsoid>(Vector3(a, b, 1));
    if (bodies == Bodies::Superellipsoids) {
      return std::make_shared<Superellipsoid>(Vector3(a, b, 1), uniform(1.3, 8), uniform(1.3, 8));
    }
    switch (std::uniform_int_distribution<int>(0, 3)(engine_)) {
      case 0:
        return std::make_shared<Sphere>(a);
      case 1:
        return std::make_shared<Box>(Vector3(a, b, 1));
      case 2:
        return std::make_shared<Capsule>(a, b);
      default:
        return std::make_shared<Cylinder>(a, b);
    }
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vector3 direction() { return Vector3{normal_(engine_), normal_(engine_), normal_(engine_)}.normalized(); }
  Matrix3 rotation() {
    return Eigen::Quaterniond{normal_(engine_), normal_(engine_), normal_(engine_), normal_(engine_)}
        .normalized()
        .toRotationMatrix();
  }

  std::mt19937_64 engine_{1};
  std::normal_distribution<double> normal_;
};

/// The result of a search that finds no impact until the horizon, s.
inline constexpr double kNoImpact = 2 * kHorizon;

/// A method that finds times of impact.
struct Contestant {
  std::string name;
  /// Makes the host's bodies of a pair, and returns the search. Only the search is timed. It returns the time of the impact in s,
  /// or kNoImpact.
  std::function<std::function<double()>(const MovingPair&)> prepare;
  bool follows_turns = true;  ///< whether the bodies may rotate
};

/// Compares the host's contestants with ours on 1000 pairs of every kind, and prints a line for each. The truth is our search with
/// a tolerance of 1e-12. The error of a time is the gap of the bodies at that time. Times are processor times, the smallest of five
/// alternating runs.
///
/// Returns true if two conditions hold. Ours, to 1e-9, has found every impact and nothing else. Each contestant of the host has
/// found more than half of the impacts of bodies that do not rotate; a contestant that finds fewer got other bodies.
bool compare(std::span<const Bodies> kinds, const std::vector<Contestant>& host);

}  // namespace supernormal::impact_hosts
