#include "ode/batch/worker_pool.hpp"

namespace supernormal::ode {

WorkerPool::WorkerPool(int threads) {
  try {
    for (int k = 1; k < threads; ++k) threads_.emplace_back([this] { wait_for_work(); });
  } catch (...) {
    stop();
    throw;
  }
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  begins_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::run(int count, Task task, void* context) {
  {
    const std::lock_guard lock(mutex_);
    count_ = count;
    task_ = task;
    context_ = context;
    next_.store(0, std::memory_order_relaxed);
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  begins_.notify_all();
  do_tasks(count, task, context);
  std::unique_lock lock(mutex_);
  ends_.wait(lock, [this] { return busy_ == 0; });
}

void WorkerPool::do_tasks(int count, Task task, void* context) {
  for (int i = next_.fetch_add(1, std::memory_order_relaxed); i < count; i = next_.fetch_add(1, std::memory_order_relaxed)) {
    task(context, i);
  }
}

void WorkerPool::wait_for_work() {
  unsigned done = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    begins_.wait(lock, [&] { return stops_ || round_ != done; });
    if (stops_) return;
    done = round_;
    const int count = count_;
    const Task task = task_;
    void* const context = context_;
    lock.unlock();
    do_tasks(count, task, context);
    lock.lock();
    if (--busy_ == 0) ends_.notify_one();
  }
}

}  // namespace supernormal::ode
