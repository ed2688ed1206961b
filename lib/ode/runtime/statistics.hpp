// Counters of the queries of this thread.
#pragma once

#include "supernormal/proximity/proximity.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// Counts a pair that was solved. `warm`: it used a cached normal.
void count_query(const Proximity& result, bool warm) noexcept;

/// Counts the query of a mesh. `first`: the contact with the smallest gap, or null.
void count_mesh_query(const Proximity* first, int evaluations) noexcept;

/// Counts a pair with a closed form: no iteration.
void count_closed_form() noexcept;

/// Counts contacts that were written. `status`: how their query ended.
void count_contacts(int count, Status status) noexcept;

/// The counters of this thread.
snStatistics thread_statistics() noexcept;

/// Replaces the counters of this thread and returns the old ones. A job for another thread moves its counts to that thread with
/// these two functions.
snStatistics exchange_statistics(const snStatistics& statistics) noexcept;
void add_statistics(const snStatistics& more) noexcept;

}  // namespace supernormal::ode
