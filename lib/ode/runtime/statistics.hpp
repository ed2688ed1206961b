// What this thread's queries did.
#pragma once

#include "supernormal/proximity/proximity.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// A pair of bodies was solved; `warm`: it started from a remembered normal.
void count_query(const Proximity& result, bool warm) noexcept;

/// A pair was settled without iteration.
void count_closed_form() noexcept;

void count_contact() noexcept;

snStatistics thread_statistics() noexcept;

/// Replaces this thread's counts and returns what they were: what is counted for another thread is taken out here and added there.
snStatistics exchange_statistics(const snStatistics& statistics) noexcept;
void add_statistics(const snStatistics& more) noexcept;

}  // namespace supernormal::ode
