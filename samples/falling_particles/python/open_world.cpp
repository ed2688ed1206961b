#include "open_world.hpp"

#include <ode/ode.h>
#include <pthread.h>
#include <pybind11/pybind11.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "advise/refusals.hpp"
#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "output/picture.hpp"
#include "output/rendering.hpp"
#include "run/changes.hpp"
#include "supernormal/python/interpreter_lock.hpp"

namespace falling_particles::python {
namespace {

/// The settings of [query] hold for the process. Jobs change these numbers, one at a time.
int open_worlds = 0;
int worlds_with_query = 0;
pid_t counted_in = 0;  // a fork has none of the worlds

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

Admission::Admission(const Scene& scene) : has_query_(scene.query.has_value()) {
  if (std::exchange(counted_in, getpid()) != getpid()) open_worlds = worlds_with_query = 0;
  if (open_worlds > 0 && (has_query_ || worlds_with_query > 0)) {
    throw std::runtime_error("[query] of " + std::string(worlds_with_query > 0 ? "an open world" : "the scene") +
                             " holds for all worlds of the process; allowed: one open world with it, and no other beside it");
  }
  ++open_worlds;
  if (has_query_) ++worlds_with_query;
}

Admission::~Admission() {
  --open_worlds;
  if (has_query_) --worlds_with_query;
}

Scene Source::load(const std::vector<std::string>& further_values) const {
  std::vector<std::string> all = values;
  all.insert(all.end(), further_values.begin(), further_values.end());
  return text ? load_scene_text(*text, path, all) : load_scene(path, all);
}

Source Source::of(std::string path, std::optional<std::string> text, std::vector<std::string> values) {
  Source source;
  source.path = std::move(path);
  source.text = std::move(text);
  source.values = std::move(values);
  source.scene_ = std::make_shared<const Scene>(source.load());
  return source;
}

OpenWorld::OpenWorld(Source source, Options options) : source_(std::move(source)), options_(std::move(options)) {
  try {
    thread_.run([this] { open(); });
  } catch (...) {  // also a signal, after the world was made
    thread_.run_last([this] { release(); });
    throw;
  }
}

OpenWorld::~OpenWorld() {
  if (is_closed() || abandon()) return;
  thread_.run_last([this] { release(); });
}

void OpenWorld::open() {
  if (options_.checkpoint_every > 0 && source_.text) {
    throw InputError("checkpoint_every is " + std::to_string(options_.checkpoint_every) +
                     "; allowed: 0 for a scene that is no file, with which a resumed run could be compared");
  }
  parts_ = std::make_unique<Parts>(source_.scene());
  Scene& scene = parts_->scene;
  if (!options_.pictures) scene.pictures.clear();
  refuse_bad_start(scene);
  std::optional<StepwiseRun::Files> files;
  if (options_.out) {
    parts_->folder.emplace(*options_.out, scene.name, result_names(), options_.resume);
    parts_->checkpoints.emplace(*parts_->folder, scene, options_.checkpoint_every);
    files.emplace(StepwiseRun::Files{*parts_->folder, *parts_->checkpoints});
  }
  parts_->run.emplace(scene, options_.threads, files);
}

bool OpenWorld::abandon() {
  if (!thread_.is_in_other_process() && !WorldThread::ode_has_failed()) return false;
  [[maybe_unused]] Parts* const left = parts_.release();
  return true;
}

void OpenWorld::release() {
  if (!abandon()) parts_.reset();
}

void OpenWorld::require_open(const char* method) const {
  const std::string name = std::string("World.") + method + "(): the world ";
  if (thread_.is_in_other_process()) throw std::runtime_error(name + "was opened in another process; allowed: in its own");
  if (is_busy_) throw std::runtime_error(name + "is at work in another thread; allowed: one thread at a time");
  if (is_closed()) throw std::runtime_error(name + why_closed_ + "; allowed: an open world");
}

void OpenWorld::require_unfinished(const char* method) const {
  require_open(method);
  if (is_finished_) {
    throw std::runtime_error(std::string("World.") + method + "(): the results are complete; allowed: before finish()");
  }
}

StepwiseRun& OpenWorld::run(const char* method) {
  require_open(method);
  return *parts_->run;
}

void OpenWorld::occupy(const std::function<void()>& job) {
  struct Occupation {
    explicit Occupation(bool& flag) : is_busy(flag) { is_busy = true; }
    Occupation(const Occupation&) = delete;
    Occupation& operator=(const Occupation&) = delete;
    ~Occupation() { is_busy = false; }
    bool& is_busy;
  };
  const Occupation occupation(is_busy_);
  thread_.run(job);
}

// An exception may leave a step half done.
void OpenWorld::work(const std::function<void()>& job) {
  try {
    occupy([&] {
      try {
        job();
      } catch (const InputError&) {
        throw;  // before anything was changed
      } catch (const std::exception& error) {
        why_closed_ = std::string("ended with an error (") + error.what() + ")";
        release();
        throw;
      }
    });
  } catch (...) {
    if (is_closed()) thread_.end();
    throw;
  }
}

void OpenWorld::step(int count, bool forces) {
  require_unfinished("step");
  const int left = parts_->run->scene().time.steps() - parts_->run->step();
  if (count < 0 || count > left) {
    throw std::invalid_argument("count is " + std::to_string(count) + "; allowed: 0 to " + std::to_string(left) +
                                ", the steps that are left until time.duration of the scene");
  }
  work([&] {
    const int end = parts_->run->step() + count;
    while (parts_->run->step() < end && !thread_.is_stopping()) {
      parts_->run->measure_forces(forces && parts_->run->step() + 1 == end);
      parts_->run->advance(parts_->run->step() + 1, nullptr);
    }
  });
}

void OpenWorld::change(const std::vector<std::string>& values) {
  require_unfinished("change");
  if (parts_->checkpoints && parts_->checkpoints->are_on()) {
    throw std::invalid_argument("values: a checkpoint does not hold changes; allowed: none in a world with checkpoints");
  }
  work([&] {
    change_values(*parts_->run, parts_->scene, values, [&] { return source_.load(values); });
    const std::string since = " from " + shortest(parts_->run->time()) + " s";
    for (const std::string& value : values) parts_->scene.overrides.push_back(value + since);  // for the summary
    source_.values.insert(source_.values.end(), values.begin(), values.end());
  });
}

void OpenWorld::set_pushes(std::vector<Push> pushes) {
  require_unfinished("set_forces");
  if (parts_->checkpoints && parts_->checkpoints->are_on()) {
    throw std::invalid_argument("forces: a checkpoint does not hold them; allowed: none in a world with checkpoints");
  }
  parts_->run->set_pushes(std::move(pushes));
  std::vector<std::string>& set = parts_->scene.overrides;  // for the summary, once
  if (std::ranges::any_of(set, [](const std::string& value) { return value.starts_with("set_forces()"); })) return;
  set.push_back("set_forces() from " + shortest(parts_->run->time()) + " s");
}

std::string OpenWorld::finish(bool draws) {
  require_unfinished("finish");
  if (!options_.out) throw std::runtime_error("World.finish(): out is None; allowed: a folder, which the results are written to");
  work([&] {
    parts_->run->finish();
    is_finished_ = true;
    if (draws) render(parts_->run->renderings(), parts_->folder->path(), true);
  });
  return parts_->folder->path().string();
}

void OpenWorld::close() {
  if (is_closed() || abandon()) return;
  require_open("close");
  occupy([this] { release(); });
  thread_.end();
}

std::string about(const Scene& scene, const std::function<std::string(const Scene&)>& tell) {
  std::string text;
  WorldThread thread;
  thread.run([&] {
    const Admission admission(scene);
    text = tell(scene);
  });
  return text;
}

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
