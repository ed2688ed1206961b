// The data of a picture of a pair.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <supernormal/contact/contact_manifold.hpp>
#include <vector>

#include "method/solver_path.hpp"
#include "pair/pair.hpp"

namespace explain_pair {

struct Explanation {
  Pair pair;
  std::vector<SolverPath> paths;  ///< the path of the hybrid first
  supernormal::ContactManifold manifold;

  const SolverPath& hybrid() const { return paths.front(); }
  const supernormal::Proximity& answer() const { return hybrid().answer; }

  /// The manifold points if the bodies touch at more than one point. Empty if all of them are within a hundredth of the largest
  /// half-extent of the smaller body.
  std::span<const supernormal::ManifoldCorner> corners() const;

  /// The number of evaluations in a picture: all of the hybrid, and for each other solver at most twice as many.
  std::size_t shown_evaluations() const;
  std::size_t shown_evaluations(const SolverPath& path) const { return std::min(path.evaluations.size(), shown_evaluations()); }
};

/// The methods with a path in the picture.
enum class Methods { OfLibrary, OfLiteratureToo };

/// Solves the pair with every solver that the library has for it, with these settings except for the solver. Adds the literature
/// methods on request. Throws std::runtime_error if there is no result, because a pose or a shape has numbers that are not finite.
Explanation explain(const Pair& pair, const supernormal::Settings& settings, Methods methods = Methods::OfLibrary);

/// The slack of a normal after some evaluations, m: the smallest bound by a supporting half-space minus the best value so far. n
/// may still be the best normal unless this is negative.
double room_left(const SolverPath& path, std::size_t evaluations, double rolling_radius, const Vector3& n);

}  // namespace explain_pair
