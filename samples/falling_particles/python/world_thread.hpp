// A thread for the world of a scene.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace falling_particles::python {

/// Runs jobs in a thread of its own. ODE and Supernormal keep data for each thread, such as warm-start normals and counts. So a
/// world does the same whichever thread of Python calls it, and whatever else this thread does.
/// A fork of the process has no such thread. What the thread may hold is then left alone, also by the destructor: that of a
/// condition variable waits for those who wait.
class WorldThread {
 public:
  WorldThread();
  ~WorldThread();
  WorldThread(const WorldThread&) = delete;
  WorldThread(WorldThread&&) = delete;
  WorldThread& operator=(const WorldThread&) = delete;
  WorldThread& operator=(WorldThread&&) = delete;

  /// Runs the job and waits for its end, without the interpreter's lock. Jobs of all worlds run one after the other, because ODE's
  /// random numbers are global. Rethrows an exception of the job. Once ODE itself has failed, jobs are refused with
  /// std::runtime_error. If a signal handler of Python raises one, such as
  /// KeyboardInterrupt, is_stopping() is true from then on until the end of the job, and the exception is raised then.
  void run(const std::function<void()>& job);
  /// The same for a destructor, also while the interpreter ends: raises and throws nothing.
  void run_last(const std::function<void()>& job) noexcept;
  /// Ends the thread. No job may follow.
  void end();

  /// Whether the job shall end early.
  bool is_stopping() const { return shared_->is_stopping; }
  /// Whether this process is a fork of the one with the thread.
  bool is_in_other_process() const;
  /// Whether ODE has failed in this process. Then its worlds cannot even be destroyed: a failed step leaves work in a list that all
  /// worlds share.
  static bool ode_has_failed();

 private:
  struct Shared {
    std::mutex mutex;
    std::condition_variable changed;
    const std::function<void()>* job = nullptr;
    std::exception_ptr error;
    bool is_closing = false;
    std::atomic<bool> is_stopping = false;
    unsigned long seed = 0;  // of ODE's random numbers, in this thread's jobs
  };

  void post(const std::function<void()>& job);
  bool wait(std::chrono::milliseconds longest);
  static void run_jobs(Shared& shared);
  static void run_one(Shared& shared);

  pid_t process_;
  std::unique_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace falling_particles::python
