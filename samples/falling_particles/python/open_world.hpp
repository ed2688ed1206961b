// A world of a scene that a program of Python holds open.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/output_folder.hpp"
#include "model/scene.hpp"
#include "run/checkpoints.hpp"
#include "run/stepwise_run.hpp"

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

/// A scene, and what it was loaded from.
struct Source {
  std::string path;                 ///< of the file; with a text, where it would be
  std::optional<std::string> text;  ///< instead of a file
  std::vector<std::string> values;  ///< KEY=VALUE, in place of the scene's own

  /// Loads the scene with further values. Throws InputError.
  Scene load(const std::vector<std::string>& further_values = {}) const;
  const Scene& scene() const { return *scene_; }

  /// Throws InputError.
  static Source of(std::string path, std::optional<std::string> text, std::vector<std::string> values);

 private:
  std::shared_ptr<const Scene> scene_;  // loaded once: the masses of compounds take seconds
};

/// The options of falling_particles.
struct Options {
  std::optional<std::string> out;  ///< parent of the folder of the results; without it there are none
  int threads = 0;
  bool pictures = true;
  int checkpoint_every = 0;
  bool resume = false;
};

/// A scene's share of the settings that hold for the process: those of [query]. Made and destroyed in jobs.
class Admission {
 public:
  /// Throws std::runtime_error when another open world excludes the scene.
  explicit Admission(const Scene& scene);
  ~Admission();
  Admission(const Admission&) = delete;
  Admission(Admission&&) = delete;
  Admission& operator=(const Admission&) = delete;
  Admission& operator=(Admission&&) = delete;

 private:
  bool has_query_;
};

/// A scene and its run in a thread of its own. Every function but the destructor throws std::runtime_error if the world is closed,
/// is in use by another thread of Python, or was made in another process. An error during a step closes the world.
class OpenWorld {
 public:
  /// Throws InputError for scenes that falling_particles refuses, and std::runtime_error when another open world excludes this one.
  OpenWorld(Source source, Options options);
  ~OpenWorld();
  OpenWorld(const OpenWorld&) = delete;
  OpenWorld(OpenWorld&&) = delete;
  OpenWorld& operator=(const OpenWorld&) = delete;
  OpenWorld& operator=(OpenWorld&&) = delete;

  /// Throws std::invalid_argument for steps beyond the end of the scene.
  void step(int count, bool forces);
  void change(const std::vector<std::string>& values);
  void set_pushes(std::vector<Push> pushes);
  /// Returns the folder of the results. `draws`: makes the pictures that other programs draw, too.
  std::string finish(bool draws);
  void close();

  bool is_closed() const { return parts_ == nullptr; }
  bool is_finished() const { return is_finished_; }
  bool has_files() const { return options_.out.has_value(); }
  /// For reading. `method` names the caller in messages.
  StepwiseRun& run(const char* method);

 private:
  void require_open(const char* method) const;
  void require_unfinished(const char* method) const;
  void work(const std::function<void()>& job);
  void occupy(const std::function<void()>& job);
  void open();
  void release();
  bool abandon();  // leaves what cannot be destroyed, and returns whether it did

  Source source_;
  Options options_;
  bool is_busy_ = false;
  bool is_finished_ = false;
  std::string why_closed_ = "was closed";
  struct Parts {
    Scene scene;
    Admission admission;
    std::optional<OutputFolder> folder = {};
    std::optional<Checkpoints> checkpoints = {};
    std::optional<StepwiseRun> run = {};

    explicit Parts(Scene loaded) : scene(std::move(loaded)), admission(scene) {}
  };
  std::unique_ptr<Parts> parts_;  // null if the world is closed
  WorldThread thread_;
};

/// What `tell` says of the scene, in a thread of its own.
std::string about(const Scene& scene, const std::function<std::string(const Scene&)>& tell);

}  // namespace falling_particles::python
