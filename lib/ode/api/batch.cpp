// The snBatch… functions.
#include "ode/batch/batch.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "ode/api/registration.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

using namespace supernormal::ode;

namespace {

constexpr int kMostThreads = 256;

}  // namespace

struct snBatch : Batch {
  using Batch::Batch;
  std::atomic_flag is_busy;  // two calls would change one list of pairs
};

extern "C" snBatchID snBatchCreate(int threads) {
  return guarded("snBatchCreate", snBatchID{}, [&] {
    if (threads < 0 || threads > kMostThreads) {
      throw std::invalid_argument("threads = " + std::to_string(threads) + " is outside [0, " + std::to_string(kMostThreads) + "]");
    }
    const int available = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
    return std::make_unique<snBatch>(threads == 0 ? available : threads).release();
  });
}

extern "C" snBatchID snBatchCreateOn(snParallelFor* run, void* pool) {
  return guarded("snBatchCreateOn", snBatchID{}, [&] {
    if (run == nullptr) throw std::invalid_argument("run = NULL, but must be a function");
    return std::make_unique<snBatch>(run, pool).release();
  });
}

extern "C" void snBatchDestroy(snBatchID batch) { delete batch; }

extern "C" int snBatchCollide(snBatchID batch, dSpaceID space, int max_contacts, void* data, snPairFilter* wanted,
                              snContactsCallback* contacts) {
  return guarded("snBatchCollide", -1, [&] {
    require_not_null("batch", batch);
    require_not_null("space", space);
    require_space(space);
    if (contacts == nullptr) throw std::invalid_argument("contacts = NULL, but must be a function");
    if (max_contacts < 1 || max_contacts > 0xffff) {
      throw std::invalid_argument("max_contacts = " + std::to_string(max_contacts) + " is outside [1, 65535]");
    }
    if (batch->is_busy.test_and_set(std::memory_order_acquire)) {
      throw std::logic_error(
          "the batch is in use by another call of snBatchCollide, but must be free: a callback or thread needs its own");
    }
    const auto release = [](std::atomic_flag* busy) { busy->clear(std::memory_order_release); };
    const std::unique_ptr<std::atomic_flag, decltype(release)> hold(&batch->is_busy, release);
    return batch->collide(space, max_contacts, {data, wanted, contacts});
  });
}
