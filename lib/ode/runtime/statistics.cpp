#include "ode/runtime/statistics.hpp"

#include <utility>

namespace supernormal::ode {
namespace {

thread_local snStatistics statistics{};

bool is_settled(Status status) { return status == Status::Converged || status == Status::Apart; }

}  // namespace

void count_query(const Proximity& result, bool warm) noexcept {
  (warm ? statistics.queries_warm : statistics.queries_cold) += 1;
  (warm ? statistics.evaluations_warm : statistics.evaluations_cold) += static_cast<unsigned long long>(result.evaluations);
  if (!is_settled(result.status)) ++statistics.not_converged;
  if (result.status == Status::Stalled) ++statistics.stalled;
  if (result.status == Status::EvaluationLimit) ++statistics.out_of_evaluations;
  if (result.status == Status::Diverged) ++statistics.diverged;
}

void count_mesh_query(const Proximity* first, int evaluations) noexcept {
  Proximity all;
  all.status = first == nullptr ? Status::Apart : first->status;
  all.evaluations = evaluations;
  count_query(all, false);
}

void count_closed_form() noexcept { ++statistics.closed_forms; }

void count_contacts(int count, Status status) noexcept {
  statistics.contacts += static_cast<unsigned long long>(count);
  if (!is_settled(status)) statistics.contacts_not_converged += static_cast<unsigned long long>(count);
}

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
  statistics.stalled += more.stalled;
  statistics.out_of_evaluations += more.out_of_evaluations;
  statistics.diverged += more.diverged;
  statistics.contacts_not_converged += more.contacts_not_converged;
}

}  // namespace supernormal::ode
