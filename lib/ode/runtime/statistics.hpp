// Counts of what this thread's queries did.
#pragma once

#include "supernormal/proximity/proximity.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// Counts a pair of bodies that was solved; `warm`: it started from a remembered normal.
void count_query(const Proximity& result, bool warm) noexcept;

/// Counts a pair that was settled without iteration.
void count_closed_form() noexcept;

/// Counts a contact that was given; `status`: how its query ended.
void count_contact(Status status) noexcept;

/// The counts of this thread so far.
snStatistics thread_statistics() noexcept;

/// Replaces this thread's counts and returns the old ones: jobs that are done for another thread are taken out here and added
/// there.
snStatistics exchange_statistics(const snStatistics& statistics) noexcept;
void add_statistics(const snStatistics& more) noexcept;

}  // namespace supernormal::ode
