#include "ode/batch/batch.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "ode/colliders/contact.hpp"
#include "ode/geom/body.hpp"
#include "ode/runtime/statistics.hpp"
#include "supernormal/proximity/batch.hpp"

namespace supernormal::ode {
namespace {

// Vector lanes are full, the wait for a lock is short beside some 20 µs, and no thread ends much later.
constexpr std::size_t kJobsAtOnce = 32;
constexpr std::size_t kPrefetch = 8;  // pairs between the prefetch of an entry and its use

bool is_solid_pair(dGeomID g1, dGeomID g2) {
  const dBodyID body = dGeomGetBody(g1);
  return g1 != g2 && (body == nullptr || body != dGeomGetBody(g2));  // the same test as in dCollide
}

}  // namespace

int Batch::collide(dSpaceID space, int max_contacts, const BatchCallbacks& callbacks) {
  max_contacts_ = max_contacts;
  max_contacts_of_job_ = std::min(max_contacts, ContactManifold::kMaxCorners);
  callbacks_ = &callbacks;
  failure_ = nullptr;
  items_.clear();
  jobs_.clear();
  other_contacts_.clear();
  dSpaceCollide(space, this, list_pair);
  if (failure_) std::rethrow_exception(failure_);
  for (std::size_t i = 0; i < items_.size(); ++i) prepare(i);
  solve_jobs();
  return report(callbacks);
}

// ODE calls this function. No exception may pass through ODE, which would leave its space locked: also none of the callback.
void Batch::list_pair(void* self, dGeomID g1, dGeomID g2) {
  auto& batch = *static_cast<Batch*>(self);
  if (dGeomIsSpace(g1) != 0 || dGeomIsSpace(g2) != 0) {
    dSpaceCollide2(g1, g2, self, list_pair);
    return;
  }
  if (batch.failure_) return;
  try {
    const BatchCallbacks& callbacks = *batch.callbacks_;
    if (callbacks.wanted == nullptr || callbacks.wanted(callbacks.data, g1, g2) != 0) batch.add_item(g1, g2);
  } catch (...) {
    batch.failure_ = std::current_exception();
  }
}

void Batch::add_item(dGeomID g1, dGeomID g2) {
  const bool is_ours = find_body(g1) != nullptr && find_body(g2) != nullptr;
  if (is_ours && !is_solid_pair(g1, g2)) return;
  items_.push_back({g1, g2, is_ours, jobs_.size()});
  if (is_ours) jobs_.push_back({BodyPair(g1, g2), {}});
}

// Items are prepared in the order of ODE, because the warm-start table evicts entries by the order of calls.
void Batch::prepare(std::size_t item) {
  if (const std::size_t ahead = item + kPrefetch; ahead < items_.size() && items_[ahead].is_ours) {
    prefetch_entry(jobs_[items_[ahead].index].pair.key());
  }
  Item& current = items_[item];
  if (current.is_ours) {
    Job& job = jobs_[current.index];
    job.cached = reserve_entry(job.pair.key());
  } else {
    current.count = collide_one_by_one(current);
  }
}

int Batch::collide_one_by_one(Item& item) {
  item.index = other_contacts_.size();
  other_contacts_.resize(item.index + static_cast<std::size_t>(max_contacts_));
  const int count = dCollide(item.g1, item.g2, max_contacts_, &other_contacts_[item.index], sizeof(dContactGeom));
  other_contacts_.resize(item.index + static_cast<std::size_t>(count));
  return count;
}

void Batch::solve_jobs() {
  const std::size_t contacts = jobs_.size() * static_cast<std::size_t>(max_contacts_of_job_);
  if (job_contacts_.size() < contacts) job_contacts_.resize(contacts);
  statistics_ = {};
  solved_ = 0;
  const int chunks = static_cast<int>((jobs_.size() + kJobsAtOnce - 1) / kJobsAtOnce);
  if (pool_) {
    pool_->run(chunks, solve_some, this);
  } else {
    run_(run_pool_, chunks, solve_some, this);
  }
  add_statistics(statistics_);
  if (solved_ == chunks) return;
  throw std::logic_error("run called task " + std::to_string(solved_) + " times, but must call it once for each i in [0, " +
                         std::to_string(chunks) + ")");
}

void Batch::solve_some(void* self, int chunk) {
  auto& batch = *static_cast<Batch*>(self);
  const std::size_t first = static_cast<std::size_t>(chunk) * kJobsAtOnce;
  const std::size_t end = std::min(first + kJobsAtOnce, batch.jobs_.size());
  const snStatistics of_thread = exchange_statistics({});
  batch.solve_range(first, end);
  const snStatistics of_jobs = exchange_statistics(of_thread);
  const std::lock_guard lock(batch.statistics_mutex_);
  const snStatistics mine = exchange_statistics(batch.statistics_);
  add_statistics(of_jobs);
  batch.statistics_ = exchange_statistics(mine);
  ++batch.solved_;
}

// The pairs with the settings of the first, which are nearly always all, are solved together.
void Batch::solve_range(std::size_t first, std::size_t end) {
  std::array<PreparedPair, kJobsAtOnce> prepared;
  std::array<ProximityQuery, kJobsAtOnce> queries{};
  std::array<Proximity, kJobsAtOnce> found;
  std::array<std::size_t, kJobsAtOnce> together{};
  std::size_t count = 0;
  for (std::size_t index = first; index < end; ++index) {
    Job& job = jobs_[index];
    prepared[count] = job.pair.prepare(job.cached, kind(), job.last);
    if (prepared[count].least_gap > 0) {
      finish_job(job, [&] { return BodyPair::finish_apart(prepared[count], job.last); });
      continue;
    }
    queries[count] = job.pair.query_of(prepared[count]);
    if (prepared[count].settings == prepared[0].settings) {
      together[count++] = index;
    } else {
      finish_job(job, [&] { return job.pair.solve(job.cached, kind(), job.last); });
    }
  }
  bool is_answered = true;
  try {
    find_proximities({queries.data(), count}, prepared[0].settings, {found.data(), count});
  } catch (...) {
    is_answered = false;  // a user shape threw: alone, each pair tells whether it was its own
  }
  for (std::size_t k = 0; k < count; ++k) {
    Job& job = jobs_[together[k]];
    finish_job(job, [&] {
      return job.pair.finish(prepared[k], is_answered ? found[k] : find_proximity(queries[k], prepared[k].settings), kind(),
                             job.last);
    });
  }
}

void Batch::finish_job(Job& job, const auto& solve) {
  const auto [g1, g2] = job.pair.geoms();
  const auto index = static_cast<std::size_t>(&job - jobs_.data());
  dContactGeom* const first = &job_contacts_[index * static_cast<std::size_t>(max_contacts_of_job_)];
  try {
    job.count = write_contacts(solve(), {g1, g2, max_contacts_of_job_, first, sizeof(dContactGeom)});
  } catch (...) {
    job.is_refused = true;  // a user shape threw: collide the pair again where the error can be reported
  }
}

int Batch::report(const BatchCallbacks& callbacks) {
  int total = 0;
  for (Item& item : items_) {
    if (item.is_ours) {
      const Job& job = jobs_[item.index];
      if (job.is_refused) {
        item.is_ours = false;
        item.count = collide_one_by_one(item);
      } else {
        job.last.store(job.pair.key());
        item.count = job.count;
      }
    }
    total += item.count;
  }
  for (const Item& item : items_) {
    if (item.count > 0) callbacks.contacts(callbacks.data, item.g1, item.g2, contacts_of(item), item.count);
  }
  return total;
}

const dContactGeom* Batch::contacts_of(const Item& item) const {
  return item.is_ours ? &job_contacts_[item.index * static_cast<std::size_t>(max_contacts_of_job_)] : &other_contacts_[item.index];
}

}  // namespace supernormal::ode
