// The parameters of contacts between two materials, compiled from a list of effects.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "effects/patch.hpp"
#include "supernormal/effects.hpp"

namespace supernormal::effects {

/// The index of an effect in Effect and in descriptions().
using EffectIndex = std::size_t;

template <typename E>
constexpr EffectIndex index_of() {
  EffectIndex index = 0;
  [&]<std::size_t... kIs>(std::index_sequence<kIs...>) {
    ((index = std::is_same_v<E, std::variant_alternative_t<kIs, Effect::variant>> ? kIs : index), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Effect::variant>>());
  return index;
}

struct PairMaterial;

struct Pass {
  EffectIndex effect;
  void (*run)(const PairMaterial& pair, Patch& patch);
  bool acts_ahead = false;  ///< whether contacts ahead of touch need the pass too; it must then treat each contact by itself
};

/// Coefficients of friction along and across a direction that is fixed to one of the bodies.
struct FrictionAxes {
  double along = 0;
  double across = 0;
  Vector3 direction = Vector3::UnitX();
  bool is_on_second = false;  ///< whether the direction is fixed to the body of geom.g2, not geom.g1
  bool is_ellipse = false;    ///< whether the solver keeps the ellipse, and needs no rectangle in it
};

struct PairMaterial {
  dSurfaceParameters surface{};  ///< the parameters that all contacts start from
  FrictionAxes axes;
  double rolling = 0;                      ///< m
  double spinning = 0;                     ///< m
  EffectIndex spring = std::variant_npos;  ///< the effect that makes the contact soft, or none
  double stiffness = 0;                    ///< N/m
  double damping = 0;                      ///< N s/m
  double elastic_modulus = 0;              ///< E*, Pa
  double damping_ratio = 0;                ///< b of Hertz's damper
  double pull_off = 0;                     ///< N
  double restitution = 0;
  double threshold = 0;         ///< m/s; there is restitution above this approach velocity
  bool is_speculative = false;  ///< whether contacts ahead of touch become constraints on the step
  bool takes_ahead = false;     ///< whether contacts ahead of touch are attached

  std::vector<Pass> passes;                                      ///< the passes that contacts also need
  std::vector<EffectIndex> listed;                               ///< the effects that apply to these contacts
  std::array<int, std::variant_size_v<Effect::variant>> rows{};  ///< the rows that each effect adds to a contact
  unsigned long long contacts = 0;                               ///< contacts set up so far
  unsigned long long ahead = 0;                                  ///< how many of them were ahead of touch
  unsigned long long coarse = 0;
};

/// The parameters of all ordered pairs of materials. There is one row and one column for each material up to the largest that is
/// listed, and one more for all other materials.
class PairMaterials {
 public:
  /// Throws std::invalid_argument when two effects of a pair exclude each other.
  PairMaterials(const std::vector<Effect>& list, Solver solver);

  PairMaterial& of(Material material1, Material material2) { return pairs_[slot(material1) * size_ + slot(material2)]; }
  const std::vector<PairMaterial>& all() const { return pairs_; }

 private:
  std::size_t slot(Material material) const {
    const auto number = static_cast<std::size_t>(material);  // a negative number becomes a large one
    return number < size_ ? number : size_ - 1;
  }
  std::size_t size_ = 1;
  std::vector<PairMaterial> pairs_;
};

// The passes are in friction.cpp and normal_forces.cpp.
void align_friction(const PairMaterial& pair, Patch& patch);
void align_anisotropic_friction(const PairMaterial& pair, Patch& patch);
void align_rolling(const PairMaterial& pair, Patch& patch);
void set_spring(const PairMaterial& pair, Patch& patch);
void set_hertz(const PairMaterial& pair, Patch& patch);
void add_adhesion(const PairMaterial& pair, Patch& patch);

}  // namespace supernormal::effects
