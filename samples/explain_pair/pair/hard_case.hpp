// The hard cases of tests/support by name.
#pragma once

#include <string>

#include "pair/pair.hpp"

namespace explain_pair {

/// The case with this name. Throws falling_particles::InputError.
Pair hard_case(const std::string& name);

/// The names of all cases and why each is hard, two lines per case.
std::string list_of_hard_cases();

}  // namespace explain_pair
