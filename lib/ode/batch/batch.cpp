#include "ode/batch/batch.hpp"

#include <algorithm>
#include <new>

#include "ode/colliders/contact.hpp"
#include "ode/geom/body.hpp"
#include "ode/runtime/statistics.hpp"

namespace supernormal::ode {
namespace {

constexpr std::size_t kJobsAtOnce = 16;  // some 20 µs: waiting for a lock is short beside it, and the last thread is soon done
constexpr std::size_t kPrefetch = 8;     // how many pairs ahead entries are prefetched

bool is_solid_pair(dGeomID g1, dGeomID g2) {
  const dBodyID body = dGeomGetBody(g1);
  return g1 != g2 && (body == nullptr || body != dGeomGetBody(g2));  // the same test as in dCollide
}

}  // namespace

int Batch::collide(dSpaceID space, int room, const BatchCallbacks& callbacks) {
  room_ = room;
  room_of_job_ = std::min(room, ContactManifold::kMaxCorners);
  callbacks_ = &callbacks;
  has_run_out_ = false;
  items_.clear();
  jobs_.clear();
  other_contacts_.clear();
  dSpaceCollide(space, this, name_pair);
  if (has_run_out_) throw std::bad_alloc();
  for (std::size_t i = 0; i < items_.size(); ++i) prepare(i);
  solve_jobs();
  return report(callbacks);
}

// ODE calls this function, and no exception may cross ODE.
void Batch::name_pair(void* self, dGeomID g1, dGeomID g2) {
  auto& batch = *static_cast<Batch*>(self);
  if (dGeomIsSpace(g1) != 0 || dGeomIsSpace(g2) != 0) {
    dSpaceCollide2(g1, g2, self, name_pair);
    return;
  }
  if (batch.callbacks_->wanted != nullptr && batch.callbacks_->wanted(batch.callbacks_->data, g1, g2) == 0) return;
  try {
    batch.add_item(g1, g2);
  } catch (...) {
    batch.has_run_out_ = true;
  }
}

void Batch::add_item(dGeomID g1, dGeomID g2) {
  const bool is_ours = find_body(g1) != nullptr && find_body(g2) != nullptr;
  if (is_ours && !is_solid_pair(g1, g2)) return;
  items_.push_back({g1, g2, is_ours, jobs_.size()});
  if (is_ours) jobs_.push_back({BodyPair(g1, g2), {}});
}

// Items are prepared in ODE's order, because the entries that the table of warm starts drops depend on the order.
void Batch::prepare(std::size_t item) {
  if (const std::size_t ahead = item + kPrefetch; ahead < items_.size() && items_[ahead].is_ours) {
    prefetch_entry(jobs_[items_[ahead].index].pair.key());
  }
  Item& current = items_[item];
  if (current.is_ours) {
    Job& job = jobs_[current.index];
    job.remembered = reserve_entry(job.pair.key());
  } else {
    current.count = collide_one_by_one(current);
  }
}

int Batch::collide_one_by_one(Item& item) {
  item.index = other_contacts_.size();
  other_contacts_.resize(item.index + static_cast<std::size_t>(room_));
  const int count = dCollide(item.g1, item.g2, room_, &other_contacts_[item.index], sizeof(dContactGeom));
  other_contacts_.resize(item.index + static_cast<std::size_t>(count));
  return count;
}

void Batch::solve_jobs() {
  const std::size_t room = jobs_.size() * static_cast<std::size_t>(room_of_job_);
  if (job_contacts_.size() < room) job_contacts_.resize(room);
  statistics_ = {};
  const int chunks = static_cast<int>((jobs_.size() + kJobsAtOnce - 1) / kJobsAtOnce);
  if (pool_) {
    pool_->run(chunks, solve_some, this);
  } else {
    run_(run_pool_, chunks, solve_some, this);
  }
  add_statistics(statistics_);
}

void Batch::solve_some(void* self, int chunk) {
  auto& batch = *static_cast<Batch*>(self);
  const std::size_t first = static_cast<std::size_t>(chunk) * kJobsAtOnce;
  const std::size_t end = std::min(first + kJobsAtOnce, batch.jobs_.size());
  const snStatistics of_thread = exchange_statistics({});
  for (std::size_t index = first; index < end; ++index) batch.solve_job(index);
  const snStatistics of_jobs = exchange_statistics(of_thread);
  const std::lock_guard lock(batch.statistics_mutex_);
  const snStatistics mine = exchange_statistics(batch.statistics_);
  add_statistics(of_jobs);
  batch.statistics_ = exchange_statistics(mine);
}

void Batch::solve_job(std::size_t index) {
  Job& job = jobs_[index];
  const auto [g1, g2] = job.pair.geoms();
  dContactGeom* const first = &job_contacts_[index * static_cast<std::size_t>(room_of_job_)];
  try {
    const ContactManifold manifold = job.pair.solve(job.remembered, room_ > 1 ? Goal::Contacts : Goal::OneContact, job.last);
    job.count = write_contacts(manifold, {g1, g2, room_of_job_, first, sizeof(dContactGeom)});
  } catch (...) {
    job.is_refused = true;  // a user-defined body threw: the pair is collided once more where the error can be reported
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
        job.last.remember(job.pair.key());
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
  return item.is_ours ? &job_contacts_[item.index * static_cast<std::size_t>(room_of_job_)] : &other_contacts_[item.index];
}

}  // namespace supernormal::ode
