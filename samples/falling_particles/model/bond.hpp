// Bonds: breakable elastic joints between two grains, or between a grain and a part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/motion.hpp"

namespace falling_particles {

using namespace common;

/// The unstrained pose of a bond, in the frame of its first body: a grain, or the wall of a part.
struct BondRest {
  Vector3 start = Vector3::Zero();   ///< m, of the beam: the centre of the first grain, or a point of the wall
  Vector3 centre = Vector3::Zero();  ///< m, of the second grain, where the beam ends
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< of the second grain

  double length() const { return (centre - start).norm(); }  ///< m

  void serialize(auto& archive) {
    for (Vector3* vector : {&start, &centre}) archive((*vector)[0], (*vector)[1], (*vector)[2]);
    archive(rotation.w(), rotation.x(), rotation.y(), rotation.z());
  }
};

/// Two grains that a rule names, or a grain and the part of the rule.
struct BondedPair {
  std::size_t first = 0;              ///< index of a grain at the start; unused with a part
  std::size_t second = 0;             ///< the same
  std::optional<double> radius = {};  ///< m; as the rule says if empty
  std::optional<BondRest> rest = {};  ///< the unstrained pose; the start if empty
  unsigned line = 0;                  ///< of BondRule::file
};

enum class BondKind {
  Beam,  ///< resists stretching, shearing, bending and twisting
  Ball,  ///< resists displacements only
};

/// A section [[bond]] of a scene file: which grains are bonded, and how.
struct BondRule {
  static constexpr double kUnbreakable = std::numeric_limits<double>::infinity();

  std::string name;
  BondKind kind = BondKind::Beam;
  std::optional<double> touching = {};   ///< bonds all pairs with a gap up to this fraction of the smallest half-axis
  std::vector<BondedPair> pairs = {};    ///< the bonded pairs, if `touching` is empty
  std::filesystem::path file = {};       ///< from which the pairs are; empty if the scene names them
  std::optional<std::size_t> wall = {};  ///< index into Scene::walls: bonds grains to this part, not to one another
  double modulus = 0;                    ///< Pa, Young's
  double poisson_ratio = 0;
  std::optional<double> radius = {};       ///< m, of the beam's circular section
  double relative_radius = 1;              ///< the same, relative to the smallest half-axis of the smaller grain
  double tensile_strength = kUnbreakable;  ///< Pa
  double shear_strength = kUnbreakable;    ///< Pa
  double damping = 0;                      ///< fraction of the critical damping of a bond with its two grains
  bool contacts = false;                   ///< whether bonded grains collide with one another
};

}  // namespace falling_particles
