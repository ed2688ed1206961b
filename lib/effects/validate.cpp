#include "effects/validate.hpp"

#include <string>

#include "effects/laws.hpp"

namespace supernormal::effects {
namespace {

/// The materials that the effect applies to; null for an effect that is not about contacts.
const MaterialSelector* surfaces_of(const Effect& effect) {
  return std::visit(
      [](const auto& e) -> const MaterialSelector* {
        if constexpr (requires { e.on; }) {
          return &e.on;
        } else {
          return nullptr;
        }
      },
      effect);
}

bool is_same(const MaterialSelector& a, const MaterialSelector& b) {
  return a == b || (a.is_pair() && b.is_pair() && a.first() == b.second() && a.second() == b.first());
}

void require_listed_once(const std::vector<Effect>& list, const Effect& effect) {
  const MaterialSelector* const on = surfaces_of(effect);
  for (const Effect& other : list) {
    if (&other == &effect || other.index() != effect.index()) continue;
    if (on == nullptr || is_same(*on, *surfaces_of(other))) {
      const std::string name = descriptions()[effect.index()].name;
      throw BadEffect(name, "",
                      name + " is listed twice" + (on == nullptr ? "" : " for the same surfaces") + "; it must be listed once");
    }
  }
}

void require_company(const std::vector<Effect>& list) {
  if (has<Buoyancy>(list) && !has<Gravity>(list)) {
    throw BadEffect("buoyancy", "", "buoyancy is listed without gravity, which it is the reaction to: list both or none");
  }
  if (has<MaxCorrectingVelocity>(list) && (has<Compliance>(list) || has<Hertz>(list))) {
    throw BadEffect("max_correcting_velocity", "",
                    "max_correcting_velocity is listed with compliance or hertz, whose forces it would cut: list one of them");
  }
}

}  // namespace

void require_valid(const std::vector<Effect>& list) {
  for (const Effect& effect : list) {
    require_parameters(effect);
    require_listed_once(list, effect);
  }
  require_company(list);
}

}  // namespace supernormal::effects
