#include "pair/hard_case.hpp"

#include <algorithm>
#include <vector>

#include "base/input_error.hpp"
#include "base/nearest_word.hpp"
#include "support/hard_cases/catalogue.hpp"

namespace explain_pair {

using supernormal::samples::HardCase;

Pair hard_case(const std::string& name) {
  const std::vector<HardCase> cases = supernormal::samples::hard_cases();
  const auto found = std::ranges::find_if(cases, [&](const HardCase& one) { return one.name == name; });
  if (found == cases.end()) {
    std::vector<std::string> names(cases.size());
    std::ranges::transform(cases, names.begin(), &HardCase::name);
    throw falling_particles::InputError("--case: \"" + name + "\" is no hard case; allowed: one of the " +
                                        std::to_string(names.size()) + " names that --list prints" +
                                        falling_particles::did_you_mean(name, names));
  }
  return {.title = found->name,
          .body1 = {describe(found->body1), found->shape1, found->pose1},
          .body2 = {describe(found->body2), found->shape2, found->pose2},
          .first_normal = found->first_normal};
}

std::string list_of_hard_cases() {
  std::string text;
  for (const HardCase& one : supernormal::samples::hard_cases()) text += one.name + "\n    " + one.reason + '\n';
  return text;
}

}  // namespace explain_pair
