#include "world_thread.hpp"

#include <ode/ode.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "python/core/interpreter_lock.hpp"

namespace falling_particles::python {
namespace {

constexpr auto kBetweenSignals = std::chrono::milliseconds(50);  // Ctrl-C feels immediate, and waking costs nothing

/// What is global in ODE belongs to one job at a time.
std::mutex ode_mutex;

/// ODE's own handlers end the process.
[[noreturn]] void raise_ode_error(int /*number*/, const char* text, va_list arguments) {
  std::array<char, 512> message{};
  std::vsnprintf(message.data(), message.size(), text, arguments);
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

bool WorldThread::is_in_other_process() const { return getpid() != process_; }

void WorldThread::run(const std::function<void()>& job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
  }
  changed_.notify_all();
  std::optional<pybind11::error_already_set> signal;
  while (!wait_a_while()) {
    if (signal || PyErr_CheckSignals() == 0) continue;
    signal.emplace();
    is_stopping_ = true;
  }
  is_stopping_ = false;
  if (const std::exception_ptr error = std::exchange(error_, nullptr)) std::rethrow_exception(error);
  if (signal) throw pybind11::error_already_set(std::move(*signal));
}

/// Whether the job has ended.
bool WorldThread::wait_a_while() {
  const supernormal::python::WithoutTheLock unlocked;
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, kBetweenSignals, [this] { return job_ == nullptr; });
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
    const OdeOfJob ode(seed_);
    job();
  } catch (...) {
    error_ = std::current_exception();
  }
}

}  // namespace falling_particles::python
