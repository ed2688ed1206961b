#include "world_thread.hpp"

#include <ode/ode.h>
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

/// What is global in ODE belongs to one job at a time.
std::mutex ode_mutex;
std::atomic<bool> ode_failed = false;

/// ODE's own handlers end the process.
[[noreturn]] void raise_ode_error(int /*number*/, const char* text, va_list arguments) {
  std::array<char, 512> message{};
  std::vsnprintf(message.data(), message.size(), text, arguments);
  ode_failed = true;
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

WorldThread::WorldThread() : process_(getpid()), thread_([this] { run_jobs(); }) {}

WorldThread::~WorldThread() {
  if (is_in_other_process()) {
    thread_.detach();  // it does not exist here
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool WorldThread::ode_has_failed() { return ode_failed; }

bool WorldThread::is_in_other_process() const { return getpid() != process_; }

void WorldThread::post(const std::function<void()>& job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
  }
  changed_.notify_all();
}

/// Returns whether the job has ended.
bool WorldThread::wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, longest, [this] { return job_ == nullptr; });
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
    is_stopping_ = true;
  }
  is_stopping_ = false;
  if (const std::exception_ptr error = std::exchange(error_, nullptr)) std::rethrow_exception(error);
  if (signal) throw pybind11::error_already_set(std::move(*signal));
}

// The lock is kept: it cannot be released while the interpreter ends, and the job does not need it.
void WorldThread::run_last(const std::function<void()>& job) noexcept {
  post(job);
  while (!wait(kBetweenSignals)) continue;
  error_ = nullptr;
}

void WorldThread::run_jobs() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return job_ != nullptr || is_closing_; });
    if (job_ == nullptr) return;
    lock.unlock();
    run_one(*job_);
    lock.lock();
    job_ = nullptr;
    changed_.notify_all();
  }
}

void WorldThread::run_one(const std::function<void()>& job) {
  const std::lock_guard lock(ode_mutex);
  try {
    if (ode_failed) throw std::runtime_error("ODE has failed in this process; allowed: worlds in a new process");
    const OdeOfJob ode(seed_);
    job();
  } catch (...) {
    error_ = std::current_exception();
  }
}

}  // namespace falling_particles::python
