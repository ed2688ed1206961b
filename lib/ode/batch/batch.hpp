// All pairs of a space in one call.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "ode/batch/worker_pool.hpp"
#include "ode/colliders/solve_pair.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// What the program wants to know, and what it is told.
struct BatchCallbacks {
  void* data;
  snPairFilter* wanted;  ///< null: all pairs
  snContactsCallback* contacts;
};

/// A run has three parts: ODE names the pairs; pairs of ours get their last normals from this thread's table, in order, and the
/// others their contacts from dCollide; then pairs of ours are solved, on several threads, each from what it was given. So
/// the answers are those of one dCollide after the other, whichever thread does what and when.
class Batch {
 public:
  explicit Batch(int threads) : pool_(std::in_place, threads) {}
  Batch(snParallelFor* run, void* pool) : run_(run), run_pool_(pool) {}

  /// The number of contacts.
  int collide(dSpaceID space, int room, const BatchCallbacks& callbacks);

 private:
  /// A pair in the order of ODE. Of ours: `index` of its job; of others: of its first contact.
  struct Item {
    dGeomID g1, g2;
    bool is_ours;
    std::size_t index = 0;
    int count = 0;
  };
  struct Job {
    BodyPair pair;
    Remembered remembered;
    LastNormal last{};
    int count = 0;
    bool is_refused = false;  ///< an exception was thrown
  };

  static void name_pair(void* self, dGeomID g1, dGeomID g2);
  void add_item(dGeomID g1, dGeomID g2);
  void prepare(std::size_t item);
  void solve_jobs();
  static void solve_some(void* self, int chunk);
  void solve_job(std::size_t index);
  int report(const BatchCallbacks& callbacks);
  int collide_one_by_one(Item& item);
  const dContactGeom* contacts_of(const Item& item) const;

  std::optional<WorkerPool> pool_;  // or run_
  snParallelFor* run_ = nullptr;
  void* run_pool_ = nullptr;

  int room_ = 0;         // of a dCollide
  int room_of_job_ = 0;  // no pair of ours has more
  const BatchCallbacks* callbacks_ = nullptr;
  bool has_run_out_ = false;  // of memory, in a callback of ODE
  std::vector<Item> items_;
  std::vector<Job> jobs_;
  std::vector<dContactGeom> job_contacts_;    // room_of_job_ for each job
  std::vector<dContactGeom> other_contacts_;  // of the others, one after the other
  std::mutex statistics_mutex_;
  snStatistics statistics_{};  // of the jobs
};

}  // namespace supernormal::ode
