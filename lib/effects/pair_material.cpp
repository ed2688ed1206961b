#include "effects/pair_material.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "ode/geom/convert.hpp"
#include "supernormal/contact/hertz.hpp"

namespace supernormal::effects {
namespace {

constexpr Material kOther = -2;  // stands for every material that is not listed

double geometric(double a, double b) { return std::sqrt(a) * std::sqrt(b); }
double in_series(double a, double b) { return a > 0 && b > 0 ? 1 / (1 / a + 1 / b) : 0; }

Friction combined(const Friction& a, const Friction& b) { return {geometric(a.coefficient, b.coefficient), {}}; }
RollingResistance combined(const RollingResistance& a, const RollingResistance& b) {
  return {geometric(a.rolling, b.rolling), geometric(a.spinning, b.spinning), {}};
}
Restitution combined(const Restitution& a, const Restitution& b) {
  return {geometric(a.coefficient, b.coefficient), std::max(a.threshold, b.threshold), {}};
}
Adhesion combined(const Adhesion& a, const Adhesion& b) { return {geometric(a.pull_off, b.pull_off), {}}; }

template <typename E>
struct Sides {
  const E* first = nullptr;
  const E* second = nullptr;
};

/// The entries that apply to the two materials of a pair, or null: one for the pair applies to both, then one for the material
/// itself, then one for all materials.
template <typename E>
Sides<E> find_sides(const std::vector<Effect>& list, Material a, Material b) {
  Sides<E> sides;
  for (const Effect& effect : list) {
    const E* const entry = std::get_if<E>(&effect);
    if (entry == nullptr) continue;
    const MaterialSelector& on = entry->on;
    const bool is_pair = on.is_pair();
    if (is_pair && ((on.first() == a && on.second() == b) || (on.first() == b && on.second() == a))) return {entry, entry};
    const auto applies = [&](Material m, const E* known) { return !is_pair && (on.is_all() ? known == nullptr : on.first() == m); };
    if (applies(a, sides.first)) sides.first = entry;
    if (applies(b, sides.second)) sides.second = entry;
  }
  return sides;
}

/// The combined values of an effect. Empty if one of the two materials has no entry.
template <typename E>
std::optional<E> find_common(const std::vector<Effect>& list, Material a, Material b) {
  const auto [first, second] = find_sides<E>(list, a, b);
  if (first == nullptr || second == nullptr) return std::nullopt;
  return first->on.is_pair() ? *first : combined(*first, *second);
}

/// Writes the parameters of one ordered pair of materials.
class PairMaterialWriter {
 public:
  PairMaterialWriter(const std::vector<Effect>& list, Solver solver, Material a, Material b, PairMaterial& pair)
      : list_(list), is_of_stepper_(solver == Solver::Stepper), a_(a), b_(b), pair_(pair) {}

  // Adhesion comes first, because it adds to the forces that friction anticipates. Springs come last, because they reorder the
  // contacts.
  void write() {
    write_adhesion();
    if (!write_anisotropic_friction()) write_friction();
    write_rolling();
    write_restitution();
    write_compliance();
    write_hertz();
    write_speculative_contacts();
  }

 private:
  enum class Acts { OnTouch, AlsoAhead };

  template <typename E>
  void add(int rows, void (*pass)(const PairMaterial&, Patch&), Acts acts = Acts::OnTouch) {
    constexpr EffectIndex kIndex = index_of<E>();
    pair_.listed.push_back(kIndex);
    pair_.rows[kIndex] = rows;
    if (pass != nullptr) pair_.passes.push_back({kIndex, pass, acts == Acts::AlsoAhead});
  }

  void write_adhesion() {
    const auto found = find_common<Adhesion>(list_, a_, b_);
    if (!found) return;
    pair_.pull_off = found->pull_off;
    pair_.surface.mode |= dContactMotionN;
    add<Adhesion>(0, add_adhesion);
  }

  void write_friction() {
    const auto found = find_common<Friction>(list_, a_, b_);
    if (!found) return;
    // With Approx1 mu is a coefficient; without it ODE takes mu for a force in newtons. sqrt(0.5) makes the square of forces
    // inscribed in the circle.
    pair_.surface.mode |= dContactApprox1 | (is_of_stepper_ ? 0 : dContactFDir1);
    pair_.surface.mu = pair_.surface.mu2 = ode::to_real(found->coefficient * (is_of_stepper_ ? 1 : std::sqrt(0.5)));
    add<Friction>(2, is_of_stepper_ ? nullptr : align_friction, Acts::AlsoAhead);
  }

  bool write_anisotropic_friction() {
    const auto [first, second] = find_sides<AnisotropicFriction>(list_, a_, b_);
    if (first == nullptr && second == nullptr) return false;
    const bool is_pair = first != nullptr && first->on.is_pair();
    const bool on_second = is_pair ? first->on.first() != a_ : first == nullptr || (second != nullptr && b_ < a_);
    const AnisotropicFriction& found = on_second ? *second : *first;
    pair_.axes = {found.along, found.across, found.direction, on_second, is_of_stepper_};
    pair_.surface.mode |= dContactApprox1 | dContactFDir1 | dContactMu2;
    add<AnisotropicFriction>((found.along > 0 ? 1 : 0) + (found.across > 0 ? 1 : 0), align_anisotropic_friction, Acts::AlsoAhead);
    return true;
  }

  void write_rolling() {
    const auto found = find_common<RollingResistance>(list_, a_, b_);
    if (!found || (found->rolling == 0 && found->spinning == 0)) return;
    pair_.rolling = found->rolling;
    pair_.spinning = found->spinning;
    // ODE makes a row without effect for a coefficient of 0, and no row for a negative coefficient.
    pair_.surface.mode |= dContactApprox1 | dContactRolling | dContactMu2;
    pair_.surface.rho = pair_.surface.rho2 = ode::to_real(found->rolling > 0 ? found->rolling : -1);
    pair_.surface.rhoN = ode::to_real(found->spinning > 0 ? found->spinning : -1);
    add<RollingResistance>((found->rolling > 0 ? 2 : 0) + (found->spinning > 0 ? 1 : 0), align_rolling, Acts::AlsoAhead);
  }

  void write_restitution() {
    const auto found = find_common<Restitution>(list_, a_, b_);
    if (!found) return;
    pair_.surface.mode |= dContactBounce;
    pair_.surface.bounce = ode::to_real(found->coefficient);
    pair_.surface.bounce_vel = ode::to_real(found->threshold);
    pair_.restitution = found->coefficient;
    pair_.threshold = found->threshold;
    add<Restitution>(0, nullptr);
  }

  void write_compliance() {
    const auto [first, second] = find_sides<Compliance>(list_, a_, b_);
    if (first == nullptr && second == nullptr) return;
    require_alone("compliance", "restitution", dContactBounce, "its damping decides how it rebounds");
    const bool are_materials = first != nullptr && second != nullptr && !first->on.is_pair();
    const bool two_springs = are_materials && !(first->on.is_all() && second->on.is_all());
    const Compliance& one = first != nullptr ? *first : *second;
    pair_.stiffness = two_springs ? in_series(first->stiffness, second->stiffness) : one.stiffness;
    pair_.damping = two_springs ? in_series(first->damping, second->damping) : one.damping;
    make_soft(index_of<Compliance>());
    add<Compliance>(0, set_spring);
  }

  void write_hertz() {
    const auto [first, second] = find_sides<Hertz>(list_, a_, b_);
    if (first == nullptr && second == nullptr) return;
    require_alone("hertz", "restitution", dContactBounce, "it has one of its own");
    require_alone("hertz", "compliance", dContactSoftCFM, "both are the spring of the contact");
    const auto softness = [](const Hertz* e) {
      return e == nullptr ? 0 : (1 - e->poisson_ratio * e->poisson_ratio) / e->youngs_modulus;
    };
    const auto restitution = [](const Hertz* e) { return e == nullptr ? 1 : e->restitution; };
    pair_.elastic_modulus = 1 / (softness(first) + softness(second));
    const bool two = first != nullptr && second != nullptr;
    const double e = two ? geometric(first->restitution, second->restitution) : restitution(first) * restitution(second);
    pair_.damping_ratio = hertz_damping_ratio(e);
    make_soft(index_of<Hertz>());
    add<Hertz>(0, set_hertz);
  }

  // A spring exerts no force before touch, so its contacts are not speculative.
  void write_speculative_contacts() {
    const auto [first, second] = find_sides<SpeculativeContacts>(list_, a_, b_);
    pair_.is_speculative = first != nullptr && second != nullptr && pair_.spring == std::variant_npos;
    pair_.takes_ahead = pair_.is_speculative || is_of_stepper_;
  }

  // motionN is the target velocity itself: with a soft ERP of 0, ODE adds nothing for the depth.
  void make_soft(EffectIndex spring) {
    pair_.spring = spring;
    pair_.surface.mode |= dContactSoftERP | dContactSoftCFM | dContactMotionN;
    pair_.surface.soft_erp = 0;
  }

  void require_alone(const char* name, const char* other, int mode_of_other, const char* why) const {
    if ((pair_.surface.mode & mode_of_other) == 0) return;
    const auto text = [](Material m) { return m == kOther ? std::string("the others") : std::to_string(m); };
    throw BadEffect(
        name, "", std::string(name) + " must be without " + other + ": " + why,
        std::string(name) + " and " + other + " are both listed for contacts of materials " + text(a_) + " and " + text(b_));
  }

  const std::vector<Effect>& list_;
  bool is_of_stepper_;
  Material a_, b_;
  PairMaterial& pair_;
};

Material last_listed(const std::vector<Effect>& list) {
  Material last = -1;
  for (const Effect& effect : list) {
    std::visit(
        [&](const auto& e) {
          if constexpr (requires { e.on; }) last = std::max({last, e.on.first(), e.on.second()});
        },
        effect);
  }
  return last;
}

}  // namespace

PairMaterials::PairMaterials(const std::vector<Effect>& list, Solver solver)
    : size_(static_cast<std::size_t>(last_listed(list) + 2)), pairs_(size_ * size_) {
  const auto material = [&](std::size_t slot) { return slot + 1 == size_ ? kOther : static_cast<Material>(slot); };
  for (std::size_t row = 0; row < size_; ++row) {
    for (std::size_t column = 0; column < size_; ++column) {
      PairMaterialWriter(list, solver, material(row), material(column), pairs_[row * size_ + column]).write();
    }
  }
}

}  // namespace supernormal::effects
