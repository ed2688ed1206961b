// A pool of threads that wait for work.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace supernormal::ode {

/// Runs a task many times in parallel, on its own threads and on the calling thread.
class WorkerPool {
 public:
  using Task = void (*)(void* context, int index);

  /// `threads` >= 1 includes the calling thread.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Calls task(context, i) once for every i in [0, count). Returns when all calls have returned. Only one run at a time. The task
  /// must not throw.
  void run(int count, Task task, void* context);

 private:
  void wait_for_work();
  void do_tasks(int count, Task task, void* context);
  void stop();

  std::mutex mutex_;
  std::condition_variable begins_, ends_;
  // The mutex guards these members.
  unsigned round_ = 0;
  int busy_ = 0;
  bool stops_ = false;
  int count_ = 0;
  Task task_ = nullptr;
  void* context_ = nullptr;

  std::atomic<int> next_{0};
  std::vector<std::thread> threads_;
};

}  // namespace supernormal::ode
