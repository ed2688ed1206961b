#include "parallel_for.hpp"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "supernormal/python/interpreter_lock.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

constexpr int kMostThreads = 256;
constexpr std::ptrdiff_t kLeastShare = 256;  // of the cheapest queries, 40 us: a thread takes 20 to 30 us to start
constexpr std::ptrdiff_t kLongestChunk = 256;
constexpr std::chrono::milliseconds kBetweenSignals{50};

using Body = std::function<void(std::ptrdiff_t& i, std::ptrdiff_t end)>;

class Loop {
 public:
  Loop(std::ptrdiff_t count, int threads, const Body& body)
      : count_(count), chunk_(std::clamp<std::ptrdiff_t>(count / (8 * threads), 1, kLongestChunk)), body_(body) {}

  /// Chunks are taken in order, and each is finished or ends with an exception. So all iterations before the smallest i that throws
  /// are finished, and this i does not depend on the threads.
  void work(const std::function<void()>& between_chunks = {}) {
    for (;;) {
      const std::ptrdiff_t begin = next_.fetch_add(chunk_);
      if (begin >= count_) return;
      std::ptrdiff_t i = begin;
      try {
        if (between_chunks) between_chunks();
        body_(i, std::min(begin + chunk_, count_));
      } catch (...) {
        fail(i, std::current_exception());
      }
    }
  }

  /// Rethrows the exception of the loop.
  void finish() const {
    if (!failure_) return;
    try {
      std::rethrow_exception(failure_);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::to_string(failed_) + ": " + error.what());
    }
  }

 private:
  void fail(std::ptrdiff_t i, std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    next_ = count_;
    if (i >= failed_) return;
    failed_ = i;
    failure_ = std::move(failure);
  }

  const std::ptrdiff_t count_, chunk_;
  const Body& body_;
  std::atomic<std::ptrdiff_t> next_{0};
  std::mutex mutex_;
  std::ptrdiff_t failed_ = std::numeric_limits<std::ptrdiff_t>::max();
  std::exception_ptr failure_;
};

int number_of_threads(std::ptrdiff_t count, int threads) {
  if (threads < 0 || threads > kMostThreads) {
    throw std::invalid_argument("threads = " + std::to_string(threads) + " is outside [0, " + std::to_string(kMostThreads) + "]");
  }
  if (threads > 0) return static_cast<int>(std::clamp<std::ptrdiff_t>(count, 1, threads));
  static const std::ptrdiff_t processors =
      std::clamp(std::thread::hardware_concurrency(), 1U, unsigned{kMostThreads});  // reads /sys
  return static_cast<int>(std::clamp<std::ptrdiff_t>(count / kLeastShare, 1, processors));
}

/// Periodically raises KeyboardInterrupt, or whatever a signal handler of the program raises.
class SignalWatch {
 public:
  void look() {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < kBetweenSignals) return;
    last_ = now;
    const HoldingTheLock lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

void parallel_for(std::ptrdiff_t count, int threads, const std::function<void(std::ptrdiff_t)>& body) {
  parallel_for_ranges(count, threads, [&body](std::ptrdiff_t& i, std::ptrdiff_t end) {
    for (; i < end; ++i) body(i);
  });
}

void parallel_for_ranges(std::ptrdiff_t count, int threads, const Body& body) {
  const int used = number_of_threads(count, threads);
  const WithoutTheLock unlocked;
  Loop loop(count, used, body);
  {
    std::vector<std::future<void>> helpers;  // each waits for its thread, as std::jthread does, which libc++ lacks
    for (int k = 1; k < used; ++k) helpers.push_back(std::async(std::launch::async, [&loop] { loop.work(); }));
    SignalWatch watch;
    loop.work([&watch] { watch.look(); });
  }
  loop.finish();
}

}  // namespace supernormal::python
