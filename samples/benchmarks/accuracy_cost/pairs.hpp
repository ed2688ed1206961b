// The pairs of bodies for all methods, and the random numbers that they are drawn with.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/random.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace accuracy_cost {

double uniform(common::Random& random, double low, double high);

/// A unit vector, uniform on the sphere.
supernormal::Vector3 random_normal(common::Random& random);

/// A uniform rotation.
supernormal::Matrix3 random_orientation(common::Random& random);

/// Classes of bodies by their exponents, uniform in: 2; 1.3...5; 6...20; 1.1...1.3; 2...5; 2. Half-axes are 0.5...1.5 m. In a
/// needle, two of them are a tenth of this. Those of a sphere are equal.
enum class BodyClass { Ellipsoid, Moderate, Boxy, Octahedral, Needle, Sphere };
inline constexpr std::array kBodyClasses = {BodyClass::Ellipsoid, BodyClass::Moderate, BodyClass::Boxy};
inline constexpr std::array kAllBodyClasses = {BodyClass::Ellipsoid, BodyClass::Moderate, BodyClass::Boxy, BodyClass::Octahedral,
                                               BodyClass::Needle};

/// Relative poses. Percentages are relative to the smallest half-axis of the two bodies.
enum class Situation { Shallow, Deep, Near, Far, Touching };  // 1 % overlap, 30 % overlap, 1 % apart, 1…5 m apart, 0
inline constexpr std::array kAllSituations = {Situation::Touching, Situation::Shallow, Situation::Deep, Situation::Near,
                                              Situation::Far};

char letter(BodyClass body_class);
char letter(Situation situation);

struct Pair {
  BodyClass body_class;
  Situation situation;
  std::shared_ptr<const supernormal::Shape> shape1, shape2;
  supernormal::Pose pose1, pose2;
  double size = 0;                   ///< m; smallest half-axis
  double gap = 0;                    ///< m; reference: the highest known maximum of the gap function
  supernormal::Vector3 normal;       ///< of this maximum, world frame
  supernormal::Vector3 contact;      ///< m; of this maximum
  supernormal::Vector3 warm_normal;  ///< body 1's frame; the result for a pose 1e-3 (m and rad) away
};

/// A random body of one class.
std::shared_ptr<const supernormal::Shape> random_body(common::Random& random, BodyClass body_class);

/// Draws `count` pairs of one class and situation. The same seed gives the same pairs on every machine. The bodies touch along a
/// random normal and are then moved along it by the given distance. This is their gap unless another normal is better.
std::vector<Pair> draw_pairs_of(BodyClass body_class, Situation situation, std::size_t count, std::uint64_t seed);

/// Ascends from a world-frame normal with tolerance 1e-14. If the maximum is higher, it becomes the reference of the pair.
void improve_reference(Pair& pair, const supernormal::Vector3& world_normal);

}  // namespace accuracy_cost
