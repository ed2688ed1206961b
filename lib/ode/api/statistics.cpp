// Reads and resets the counters of this thread.
#include "ode/runtime/statistics.hpp"

#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

using namespace supernormal::ode;

extern "C" void snGetStatistics(snStatistics* out) {
  guarded("snGetStatistics", 0, [&] {
    require_not_null("out", out);
    *out = thread_statistics();
    return 1;
  });
}

extern "C" void snResetStatistics(void) { exchange_statistics({}); }
