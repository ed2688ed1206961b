// Collision of all pairs of a space in one call.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

#include "ode/batch/worker_pool.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// The callbacks of the caller.
struct BatchCallbacks {
  void* data;
  snPairFilter* wanted;  ///< null: all pairs
  snContactsCallback* contacts;
};

/// Collides all pairs of a space. A run has three phases:
/// 1. ODE lists the pairs.
/// 2. In the order of ODE: a pair of our bodies gets its warm start from this thread's table. Any other pair is passed to dCollide.
/// 3. The pairs of our bodies are solved in parallel, each from its own input.
/// So the results equal sequential calls of dCollide, whatever the scheduling of the threads.
class Batch {
 public:
  explicit Batch(int threads) : pool_(std::in_place, threads) {}
  Batch(snParallelFor* run, void* pool) : run_(run), run_pool_(pool) {}

  /// Returns the number of contacts.
  int collide(dSpaceID space, int max_contacts, const BatchCallbacks& callbacks);

 private:
  /// A pair, in the order of ODE. `index` is the job of a pair of our bodies. For other pairs it is the first contact.
  struct Item {
    dGeomID g1, g2;
    bool is_ours;
    std::size_t index = 0;
    int count = 0;
  };
  struct Job {
    BodyPair pair;
    CachedNormal cached;
    LastNormal last{};
    int count = 0;
    bool is_refused = false;  ///< an exception was thrown
  };

  static void list_pair(void* self, dGeomID g1, dGeomID g2);
  void add_item(dGeomID g1, dGeomID g2);
  void prepare(std::size_t item);
  void solve_jobs();
  static void solve_some(void* self, int chunk);
  void solve_range(std::size_t first, std::size_t end);
  QueryKind kind() const { return max_contacts_ > 1 ? QueryKind::Contacts : QueryKind::OneContact; }
  void finish_job(Job& job, const auto& solve);
  int report(const BatchCallbacks& callbacks);
  int collide_one_by_one(Item& item);
  const dContactGeom* contacts_of(const Item& item) const;

  std::optional<WorkerPool> pool_;  // null if run_ is used
  snParallelFor* run_ = nullptr;
  void* run_pool_ = nullptr;

  int max_contacts_ = 0;         // most contacts of a pair
  int max_contacts_of_job_ = 0;  // most contacts of a pair of our bodies
  const BatchCallbacks* callbacks_ = nullptr;
  std::exception_ptr failure_;  // thrown in a callback of ODE
  std::vector<Item> items_;
  std::vector<Job> jobs_;
  std::vector<dContactGeom> job_contacts_;    // max_contacts_of_job_ contacts for each job
  std::vector<dContactGeom> other_contacts_;  // contacts of the other pairs, consecutive
  std::mutex statistics_mutex_;
  snStatistics statistics_{};  // statistics of the jobs; guarded by statistics_mutex_, like the next
  int solved_ = 0;             // calls of solve_some() that have ended
};

}  // namespace supernormal::ode
