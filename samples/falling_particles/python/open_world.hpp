// A world of a scene that a program of Python holds open.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/output_folder.hpp"
#include "model/scene.hpp"
#include "run/checkpoints.hpp"
#include "run/stepwise_run.hpp"
#include "world_thread.hpp"

namespace falling_particles::python {

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
