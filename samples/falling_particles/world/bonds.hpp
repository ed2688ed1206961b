// The bonds of a world: breakable elastic joints.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "grain.hpp"
#include "model/bond.hpp"

namespace falling_particles {

class World;

/// A bond between two steps.
struct Bond {
  static constexpr std::uint64_t kPart = std::numeric_limits<std::uint64_t>::max();

  std::uint64_t rule = 0;   ///< index into Scene::bonds
  std::uint64_t first = 0;  ///< index of a grain; kPart for the part of the rule
  std::uint64_t second = 0;
  double radius = 0;  ///< m
  BondRest rest;
  bool is_broken = false;
  /// m, of a broken bond: contacts of its grains leave this overlap. It is the overlap at the break, and shrinks with the overlap.
  double overlap = 0;

  void serialize(auto& archive) { archive(rule, first, second, radius, rest, is_broken, overlap); }
};

/// The stresses of a bond in its outermost fibre, after Potyondy and Cundall, Int. J. Rock Mech. Min. Sci. 41 (2004), eq. 15. The
/// bending moment is that of the end where it is largest.
struct BondStress {
  double tension = 0;  ///< Pa, by the normal force; negative if it presses
  double bending = 0;  ///< Pa, by the bending moment
  double shear = 0;    ///< Pa, by the shear force
  double torsion = 0;  ///< Pa, by the twisting moment

  void serialize(auto& archive) { archive(tension, bending, shear, torsion); }
};

/// The break of a bond.
struct BondBreak {
  double time = 0;         ///< s
  std::uint64_t bond = 0;  ///< index into Bonds::all()
  Point place = {};        ///< m, the middle of the bond
  BondStress stress;
  bool is_removed = false;  ///< whether a sink has removed a grain of the bond

  void serialize(auto& archive) { archive(time, bond, place, stress, is_removed); }
};

/// What broke a bond: the largest part of the stress that exceeds its strength.
std::string cause_of(const BondBreak& failure, const BondRule& rule);

struct BondsState {
  std::uint64_t steps = 0;
  std::uint64_t rows = 0;
  std::vector<Bond> bonds;
  std::vector<BondBreak> breaks;

  void serialize(auto& archive) { archive(steps, rows, bonds, breaks); }
};

/// The bonds of a world. A beam between two centres is an Euler-Bernoulli beam with the shear of Timoshenko. About its middle its
/// stiffnesses decouple. They act as forces of the pose at the start of a step. Joints of ODE at the middle add what the motion of
/// the step changes, implicitly. In equilibrium the joints have no force, so deflections are exact with any number of iterations.
class Bonds {
 public:
  /// Bonds the grains of a world at its start. The world must outlive this object.
  explicit Bonds(const World& world);
  /// Resumes from a state of the same scene.
  Bonds(const World& world, const BondsState& state);
  ~Bonds();
  Bonds(const Bonds&) = delete;
  Bonds& operator=(const Bonds&) = delete;

  const std::vector<Bond>& all() const { return state_.bonds; }               ///< broken ones included
  const std::vector<BondBreak>& breaks() const { return state_.breaks; }      ///< in the order of time
  std::size_t intact() const { return all().size() - state_.breaks.size(); }  ///< number of bonds
  double energy() const { return energy_; }                                   ///< J, elastic, of all bonds
  std::uint64_t rows() const { return state_.rows; }                          ///< of the solver, in all steps
  /// Whether the geoms belong to bonded bodies that do not collide.
  bool hide(dGeomID g1, dGeomID g2) const { return !hidden_.empty() && hidden_.contains(key_of(g1, g2)); }
  /// Reduces the contacts of broken bonds whose grains still overlap by the overlap that they had.
  void reduce(std::vector<dContactGeom>& contacts);

  /// Applies the forces of the bonds. Call it before the step of ODE, with the walls ready.
  void before_step();
  /// Breaks the bonds whose strength is exceeded. Call it after the step.
  void after_step();
  /// Breaks the bonds of a grain that is removed. Call it while the grain is present.
  void release(std::size_t grain);

  /// 2 step^2 times the sum of stiffness / mass over the bonds of a grain, of the grain where it is largest. Explicit bonds are
  /// unstable from 4 on. Without bonds 0.
  struct Stiffness {
    double relative = 0;
    std::size_t grain = 0;
    std::size_t bond = 0;  ///< its stiffest one, an index into all()
  };
  Stiffness stiffness() const;

  const BondsState& save() const { return state_; }

 private:
  static constexpr std::size_t kRows = 6;  // along and across the bond, about it and about the axes across
  using Rows = std::array<double, kRows>;

  /// A bond in its present pose. Forces act on the second body.
  struct Strain {
    Vector3 middle;            // m
    Eigen::Quaterniond frame;  // of the bond
    Vector3 force, moment;     // N, N m, in this frame, at the middle
    double energy;             // J
  };
  /// The bodies and joints of an intact bond.
  struct Joints {
    dBodyID first = nullptr, second = nullptr;
    dJointID linear = nullptr, angular = nullptr;  // the second one is null for a ball
    Eigen::Quaterniond axes;                       // of the bond in the frame of the first body: x along it
    Rows stiffness = {};                           // N/m, N m
    bool has_anchor = false;                       // whether `first` is a body of its own, for a part
    std::optional<Strain> before;                  // at the start of the step; empty if both bodies sleep
    Vector3 first_arm, second_arm;                 // m, of the same time: from the bodies to the middle
  };

  void find_touching(std::size_t rule);
  void add(std::size_t rule, const BondedPair& pair);
  /// Throws InputError if the bond is shorter than `least` (m).
  void refuse_zero_length(const Bond& bond, double least) const;
  void add_joints(std::size_t bond);
  void remove_joints(std::size_t bond);
  void place_anchor(const Bond& bond, const Joints& joints) const;
  std::array<Rows, 2> inverse_masses(const Bond& bond, const Joints& joints) const;
  std::array<double, 2> rates_of(std::size_t bond) const;
  Strain strain_of(const Bond& bond, const Joints& joints) const;
  Strain in_step(const Joints& joints) const;
  BondStress stress_of(const Bond& bond, const Strain& strain) const;
  void break_bond(std::size_t bond, const Strain& strain, const BondStress& stress, bool is_removed);
  void measure_energy();
  double time() const;
  std::uint64_t key_of(dGeomID g1, dGeomID g2) const;
  std::uint64_t key_of(const Bond& bond) const;

  const World& world_;
  double step_;  // s
  BondsState state_;
  std::vector<Joints> joints_;  // in the order of the bonds
  double energy_ = 0;
  std::unordered_map<std::uint64_t, std::size_t> bonded_;  // bonds of intact pairs
  std::unordered_map<std::uint64_t, std::size_t> hidden_;  // of these, those whose bodies do not collide
  std::map<std::uint64_t, std::size_t> parting_;           // broken bonds whose bodies still overlap
};

}  // namespace falling_particles
