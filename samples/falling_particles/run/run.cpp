#include "run.hpp"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "base/interrupt.hpp"
#include "base/output_folder.hpp"
#include "checkpoints.hpp"
#include "common/input_error.hpp"
#include "stepwise_run.hpp"

namespace falling_particles {
namespace {

RunEnd finish(StepwiseRun& run, const OutputFolder& folder, bool quiet) {
  run.finish();
  std::fputs(run.summary().c_str(), stdout);
  std::fflush(stdout);  // before what follows on stderr, where both go to one file
  if (!run.is_at_end()) {
    std::fprintf(stderr, "Interrupted after step %d of %d: what there is was written.\n", run.step(), run.scene().time.steps());
  }
  const LeakWatch& leaks = run.simulation().watches.leaks;
  if (leaks.first()) {
    std::fprintf(stderr, "Leak: %zu of %zu grains; the first: %s\n", leaks.count(), run.simulation().world.grains().size(),
                 describe(*leaks.first()).c_str());
  }
  for (const std::string& sentence : free_walls_outside(run.simulation().world)) {
    std::fprintf(stderr, "Leak: %s\n", sentence.c_str());
  }
  if (!quiet) std::fprintf(stderr, "Results: %s\n", folder.path().c_str());
  return {!run.is_at_end(), leaks.count() > 0, folder.path(), run.renderings()};
}

constexpr const char* kStopNote =
    "falling_particles: the run ends at its next checkpoint; a second signal ends it at once, and --resume then goes on from the "
    "last one\n";

RunEnd run_in(OutputFolder& folder, Checkpoints& checkpoints, const Scene& scene, const RunOptions& options) {
  if (checkpoints.are_on()) catch_stop_requests(kStopNote);
  StepwiseRun run(scene, options.threads, StepwiseRun::Files{folder, checkpoints});
  // This message appears also with --quiet.
  if (options.resume && !folder.is_resumed()) {
    std::fprintf(stderr, "No checkpoint: starts at step %d of %d\n", run.step(), scene.time.steps());
  } else if (options.resume && !options.quiet) {
    std::fprintf(stderr, "Goes on after step %d of %d\n", run.step(), scene.time.steps());
  }
  std::optional<Progress> progress;
  if (!options.quiet) progress.emplace(stderr, scene.time.steps(), run.step());
  run.advance(scene.time.steps(), progress ? &*progress : nullptr);
  progress.reset();
  if (run.is_at_end() || !checkpoints.are_on()) return finish(run, folder, options.quiet);
  std::fprintf(stderr, "Stopped after step %d of %d: --resume goes on from there.\n", run.step(), scene.time.steps());
  return {true, false, folder.path(), {}};
}

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);

}  // namespace

RunEnd run(const Scene& scene, const RunOptions& options) {
  OutputFolder folder(options.out, scene.name, result_names(), options.resume);
  Checkpoints checkpoints(folder, scene, options.checkpoint_every);
  try {
    return run_in(folder, checkpoints, scene, options);
  } catch (const InputError&) {
    throw;  // the files of the last checkpoint are damaged: the run cannot be resumed
  } catch (const std::exception&) {
    const std::filesystem::path unfinished = folder.file("");  // empty if the run was complete and could not be moved to its place
    if (checkpoints.last() && !unfinished.empty()) {
      std::fprintf(stderr, "The last checkpoint is in \"%s\": --resume goes on from there.\n", unfinished.c_str());
    }
    throw;
  }
}

Progress::Progress(std::FILE* stream, int steps, int done)
    : stream_(stream), terminal_(isatty(fileno(stream)) == 1), steps_(steps), done_(done), start_(Clock::now()), last_(start_) {}

void Progress::update(int step, double simulated, std::size_t contacts) {
  const Clock::time_point now = Clock::now();
  const int tenths = static_cast<int>(10LL * step / steps_);
  if (terminal_ ? now - last_ < kRedrawInterval && step < steps_ : tenths == tenths_) return;
  last_ = now;
  tenths_ = tenths;
  const double left = std::chrono::duration<double>(now - start_).count() * (steps_ - step) / (step - done_);
  // \033[K clears the rest of a longer line.
  std::fprintf(stream_, "%s%3d %%  t = %.3f s  %zu contacts  %.0f s left%s", terminal_ ? "\r" : "",
               terminal_ ? static_cast<int>(100LL * step / steps_) : 10 * tenths, simulated, contacts, left,
               terminal_ ? "\033[K" : "\n");
  std::fflush(stream_);
}

Progress::~Progress() {
  if (terminal_) std::fputc('\n', stream_);
}

}  // namespace falling_particles
