// Everything that a picture shows of a pair.
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
  std::vector<SolverPath> paths;  ///< the hybrid's first
  supernormal::ContactManifold manifold;

  const SolverPath& hybrid() const { return paths.front(); }
  const supernormal::Proximity& answer() const { return hybrid().answer; }

  /// The contact points beside the deepest, if the bodies touch in more than a point: none if they are all as good as one, within
  /// a hundredth of the largest half-extent of the smaller body.
  std::span<const supernormal::ManifoldCorner> corners() const;

  /// How many evaluations a picture shows: all of the hybrid's, of the others at most twice as many.
  std::size_t shown_evaluations() const;
  std::size_t shown_evaluations(const SolverPath& path) const { return std::min(path.evaluations.size(), shown_evaluations()); }
};

/// Whose paths are shown.
enum class Methods { OfLibrary, OfLiteratureToo };

/// Solves the pair with every solver that the library has for it, with these settings but for the solver, and by the methods of the
/// literature if they are wanted. Throws std::runtime_error if there is no answer: a pose or a shape with numbers that are not
/// finite.
Explanation explain(const Pair& pair, const supernormal::Settings& settings, Methods methods = Methods::OfLibrary);

/// What the cuts leave of the sphere after some evaluations: n may still be the best normal where this is not negative. It is the
/// least of the cuts less the best value so far, m.
double room_left(const SolverPath& path, std::size_t evaluations, double rolling_radius, const Vector3& n);

}  // namespace explain_pair
