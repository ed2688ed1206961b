#include "world_thread.hpp"

#include <ode/ode.h>
#include <pthread.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "supernormal/python/interpreter_lock.hpp"

namespace falling_particles::python {
namespace {

constexpr auto kBetweenSignals = std::chrono::milliseconds(50);  // Ctrl-C feels immediate, and waking costs nothing

/// What is global in ODE belongs to one job at a time, whose thread holds the mutex.
class GlobalOde {
 public:
  GlobalOde() {
    pthread_atfork(nullptr, nullptr, [] { global().continue_in_fork(); });
  }
  static GlobalOde& global() {
    static GlobalOde ode;
    return ode;
  }
  std::mutex& mutex() { return *mutex_; }

  std::atomic<const char*> failure = nullptr;  ///< why no job may run any more

 private:
  // The thread that holds the mutex is not in the fork, and its job has left ODE at any place.
  void continue_in_fork() {
    if (mutex_->try_lock()) {
      mutex_->unlock();
      return;
    }
    failure = "this process was forked while a world was at work; allowed: a fork between two calls";
    mutex_ = new std::mutex;  // nobody can unlock the other one
  }

  std::mutex* mutex_ = new std::mutex;  // is never destroyed: threads may outlive static objects
};

/// ODE's own handlers end the process.
[[noreturn]] void raise_ode_error(int /*number*/, const char* text, va_list arguments) {
  std::array<char, 512> message{};
  std::vsnprintf(message.data(), message.size(), text, arguments);
  GlobalOde::global().failure = "ODE has failed in this process; allowed: worlds in a new process";
  throw std::runtime_error(std::string("ODE: ") + message.data());
}

/// Gives ODE's global settings to a job, and returns them afterwards.
class OdeOfJob {
 public:
  explicit OdeOfJob(unsigned long& seed)
      : seed_(seed), outer_seed_(dRandGetSeed()), outer_debug_(dGetDebugHandler()), outer_error_(dGetErrorHandler()) {
    dSetDebugHandler(&raise_ode_error);
    dSetErrorHandler(&raise_ode_error);
    dRandSetSeed(seed_);
  }
  OdeOfJob(const OdeOfJob&) = delete;
  OdeOfJob(OdeOfJob&&) = delete;
  OdeOfJob& operator=(const OdeOfJob&) = delete;
  OdeOfJob& operator=(OdeOfJob&&) = delete;
  ~OdeOfJob() {
    seed_ = dRandGetSeed();
    dRandSetSeed(outer_seed_);
    dSetDebugHandler(outer_debug_);
    dSetErrorHandler(outer_error_);
  }

 private:
  unsigned long& seed_;
  unsigned long outer_seed_;
  dMessageFunction* outer_debug_;
  dMessageFunction* outer_error_;
};

}  // namespace

WorldThread::WorldThread()
    : process_(getpid()), shared_(std::make_unique<Shared>()), thread_([shared = shared_.get()] { run_jobs(*shared); }) {}

WorldThread::~WorldThread() {
  if (is_in_other_process()) {
    if (thread_.joinable()) thread_.detach();  // it does not exist here
    [[maybe_unused]] Shared* const left = shared_.release();
    return;
  }
  end();
}

void WorldThread::end() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->is_closing = true;
  }
  shared_->changed.notify_all();
  thread_.join();
}

bool WorldThread::ode_has_failed() { return GlobalOde::global().failure != nullptr; }

bool WorldThread::is_in_other_process() const { return getpid() != process_; }

void WorldThread::post(const std::function<void()>& job) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->job = &job;
  }
  shared_->changed.notify_all();
}

/// Returns whether the job has ended.
bool WorldThread::wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(shared_->mutex);
  return shared_->changed.wait_for(lock, longest, [this] { return shared_->job == nullptr; });
}

void WorldThread::run(const std::function<void()>& job) {
  post(job);
  const auto wait_unlocked = [this] {
    const supernormal::python::WithoutTheLock unlocked;
    return wait(kBetweenSignals);
  };
  std::optional<pybind11::error_already_set> signal;
  while (!wait_unlocked()) {
    if (signal || PyErr_CheckSignals() == 0) continue;
    signal.emplace();
    shared_->is_stopping = true;
  }
  shared_->is_stopping = false;
  if (const std::exception_ptr error = std::exchange(shared_->error, nullptr)) std::rethrow_exception(error);
  if (signal) throw pybind11::error_already_set(std::move(*signal));
}

// The lock is kept: it cannot be released while the interpreter ends, and the job does not need it.
void WorldThread::run_last(const std::function<void()>& job) noexcept {
  post(job);
  while (!wait(kBetweenSignals)) continue;
  shared_->error = nullptr;
}

void WorldThread::run_jobs(Shared& shared) {
  std::unique_lock lock(shared.mutex);
  while (true) {
    shared.changed.wait(lock, [&] { return shared.job != nullptr || shared.is_closing; });
    if (shared.job == nullptr) return;
    lock.unlock();
    run_one(shared);
    lock.lock();
    shared.job = nullptr;
    shared.changed.notify_all();
  }
}

void WorldThread::run_one(Shared& shared) {
  GlobalOde& global = GlobalOde::global();
  const std::lock_guard lock(global.mutex());
  try {
    if (const char* const failure = global.failure) throw std::runtime_error(failure);
    const OdeOfJob ode(shared.seed);
    (*shared.job)();
  } catch (...) {
    shared.error = std::current_exception();
  }
}

}  // namespace falling_particles::python
