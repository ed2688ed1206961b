// Collision of all pairs of a space in one call.
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

/// The callbacks of the program.
struct BatchCallbacks {
  void* data;
  snPairFilter* wanted;  ///< null: all pairs
  snContactsCallback* contacts;
};

/// A run has three parts: ODE names the pairs; pairs of ours get their last normals from this thread's table, in order, and the
/// others their contacts from dCollide; then pairs of ours are solved, on several threads, each from its own input. So the
/// results are those of one dCollide after the other, whichever thread does what and when.
class Batch {
 public:
  explicit Batch(int threads) : pool_(std::in_place, threads) {}
  Batch(snParallelFor* run, void* pool) : run_(run), run_pool_(pool) {}

  /// Returns the number of contacts.
  int collide(dSpaceID space, int room, const BatchCallbacks& callbacks);

 private:
  /// A pair, in ODE's order. For a pair of ours `index` is that of its job, for others that of its first contact.
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

  std::optional<WorkerPool> pool_;  // null if run_ is used
  snParallelFor* run_ = nullptr;
  void* run_pool_ = nullptr;

  int room_ = 0;         // room for the contacts of a dCollide
  int room_of_job_ = 0;  // no pair of ours has more contacts than this
  const BatchCallbacks* callbacks_ = nullptr;
  bool has_run_out_ = false;  // memory has run out in a callback of ODE
  std::vector<Item> items_;
  std::vector<Job> jobs_;
  std::vector<dContactGeom> job_contacts_;    // room_of_job_ contacts for each job
  std::vector<dContactGeom> other_contacts_;  // contacts of the other pairs, one after the other
  std::mutex statistics_mutex_;
  snStatistics statistics_{};  // statistics of the jobs
};

}  // namespace supernormal::ode
