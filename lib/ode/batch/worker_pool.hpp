// Threads that wait for work.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace supernormal::ode {

/// Runs a task many times at once: on its own threads and on the one that asks.
class WorkerPool {
 public:
  using Task = void (*)(void* context, int index);

  /// `threads` in [1, …], the calling one among them.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// task(context, i) once for every i in [0, count); returns when all are done. One call at a time. The task must not throw.
  void run(int count, Task task, void* context);

 private:
  void wait_for_work();
  void do_tasks(int count, Task task, void* context);
  void stop();

  std::mutex mutex_;
  std::condition_variable begins_, ends_;
  // Guarded by the mutex.
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
