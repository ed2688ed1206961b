// A run in steps, which its caller counts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/output_folder.hpp"
#include "checkpoints.hpp"
#include "common/stopwatch.hpp"
#include "observe/measuring.hpp"
#include "observe/simulation.hpp"
#include "output/recorder.hpp"
#include "output/summary.hpp"
#include "run.hpp"

namespace falling_particles {

/// A force and a torque from outside, on a grain.
struct Push {
  Point force;   ///< N, at the centre of mass, in the world's frame
  Point torque;  ///< N m, in the world's frame
};

/// m/s and rad/s. Faster grains end in numbers that ODE cannot take: it aborts if the square of a square overflows.
inline constexpr double kFastest = 1e30;

/// A simulation with its results. The same steps write the same bytes, whether they are taken one by one or all at once.
class StepwiseRun {
 public:
  /// The folder of the results, and the checkpoints in it.
  struct Files {
    OutputFolder& folder;
    Checkpoints& checkpoints;
  };
  /// Starts, or resumes from the last checkpoint. Without `files` the run leaves nothing. Finds contacts on `threads` (0: as many
  /// as the machine has). The arguments must outlive this object.
  StepwiseRun(const Scene& scene, int threads, std::optional<Files> files);

  /// Advances to step `until` of the scene, with a frame at every interval, and with the checkpoints that are due. Ends early after
  /// an interrupt, or at a checkpoint after a request to stop (interrupt.hpp). `progress` may be null.
  void advance(int until, Progress* progress);

  /// Writes the last frame, if it is due, the summary and the pictures, and moves the results to their place. Needs files.
  void finish();

  const Scene& scene() const { return scene_; }
  int step() const { return step_; }
  double time() const;  ///< s
  bool is_at_end() const { return step_ == scene_.time.steps(); }
  const Simulation& simulation() const { return *simulation_; }
  const std::string& summary() const { return summary_; }  ///< TOML; empty before finish()
  std::vector<Rendering> renderings() const { return recorder_->renderings(); }

  /// Measures the forces of the next steps, also if no result needs them. Motion and results are the same.
  void measure_forces(bool on) { measures_forces_ = on; }
  bool measures_forces() const { return measures_forces_; }

  /// Sets what acts on the grains in each step from now on, by their index; further grains get nothing. Grains with a force or a
  /// torque wake. Throws std::invalid_argument for numbers that are not finite, or that move a grain by more than kFastest in a
  /// step. advance() throws std::runtime_error when a grain with a push has become faster than kFastest.
  void set_pushes(std::vector<Push> pushes);

  /// Calls `change`, which may give the scene `effects` and other settings that the world reads when it is made. Then continues
  /// from the saved state, as at a checkpoint. All grains wake. The change of the energy is neither a gain nor a loss.
  void change(const std::vector<supernormal::effects::Effect>& effects, const std::function<void()>& change);

 private:
  void go_on(const std::string& checkpoint);
  void make_simulation_again(const std::string& state);
  void save();
  void advance_to(int until, Progress* progress);
  void record();
  void push() const;
  Summary summarize();

  const Scene& scene_;
  int threads_;
  std::optional<Files> files_;
  std::optional<Simulation> simulation_;
  std::optional<Measuring> measuring_;
  std::optional<Recorder> recorder_;
  int step_ = 0;
  int recorded_step_ = 0;
  bool results_need_forces_ = false;  // of the last step
  bool measures_forces_ = false;
  std::vector<Push> pushes_;
  Stopwatch time_;  // of the steps and their output
  CheckpointCost cost_;
  std::string summary_;
};

}  // namespace falling_particles
