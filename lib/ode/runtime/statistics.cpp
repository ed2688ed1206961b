#include "ode/runtime/statistics.hpp"

#include <utility>

namespace supernormal::ode {
namespace {

thread_local snStatistics statistics{};

}  // namespace

void count_query(const Proximity& result, bool warm) noexcept {
  (warm ? statistics.queries_warm : statistics.queries_cold) += 1;
  (warm ? statistics.evaluations_warm : statistics.evaluations_cold) += static_cast<unsigned long long>(result.evaluations);
  const bool settled = result.status == Status::Converged || result.status == Status::Apart;
  if (!settled) ++statistics.not_converged;
}

void count_closed_form() noexcept { ++statistics.closed_forms; }

void count_contact() noexcept { ++statistics.contacts; }

snStatistics thread_statistics() noexcept { return statistics; }

snStatistics exchange_statistics(const snStatistics& other) noexcept { return std::exchange(statistics, other); }

void add_statistics(const snStatistics& more) noexcept {
  statistics.queries_cold += more.queries_cold;
  statistics.queries_warm += more.queries_warm;
  statistics.evaluations_cold += more.evaluations_cold;
  statistics.evaluations_warm += more.evaluations_warm;
  statistics.closed_forms += more.closed_forms;
  statistics.contacts += more.contacts;
  statistics.not_converged += more.not_converged;
}

}  // namespace supernormal::ode
