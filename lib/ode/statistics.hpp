// What this thread's queries did.
#pragma once

#include "supernormal/solvers/proximity.hpp"

namespace supernormal::ode {

/// A pair of bodies was solved; `warm`: it started from a remembered normal.
void count_query(const Proximity& result, bool warm) noexcept;

/// A pair was settled without iteration.
void count_closed_form() noexcept;

void count_contact() noexcept;

}  // namespace supernormal::ode
