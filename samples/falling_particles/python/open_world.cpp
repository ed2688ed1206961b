#include "open_world.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/input_error.hpp"
#include "output/picture.hpp"
#include "output/rendering.hpp"
#include "run/changes.hpp"
#include "run/doubts.hpp"

namespace falling_particles::python {
namespace {

/// The settings of [query] hold for the process. Jobs change these numbers, one at a time.
int open_worlds = 0;
int worlds_with_query = 0;

}  // namespace

Admission::Admission(const Scene& scene) : has_query_(scene.query.has_value()) {
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

OpenWorld::OpenWorld(Source source, Options options) : source_(std::move(source)), options_(std::move(options)) {
  thread_.run([this] {
    try {
      open();
    } catch (...) {
      release();
      throw;
    }
  });
}

OpenWorld::~OpenWorld() {
  if (thread_.is_in_other_process() || !scene_) return;
  thread_.run([this] { release(); });
}

void OpenWorld::open() {
  scene_ = source_.load();
  if (!options_.pictures) scene_->pictures.clear();
  if (options_.checkpoint_every > 0 && source_.text) {
    throw InputError("checkpoint_every is " + std::to_string(options_.checkpoint_every) +
                     "; allowed: 0 for a scene that is no file, with which a resumed run could be compared");
  }
  admission_.emplace(*scene_);
  refuse_overlapping_start(*scene_);
  std::optional<StepwiseRun::Files> files;
  if (options_.out) {
    folder_.emplace(*options_.out, scene_->name, result_names(), options_.resume);
    checkpoints_.emplace(*folder_, *scene_, options_.checkpoint_every);
    files.emplace(StepwiseRun::Files{*folder_, *checkpoints_});
  }
  run_.emplace(*scene_, options_.threads, files);
}

void OpenWorld::release() {
  run_.reset();
  checkpoints_.reset();
  folder_.reset();
  admission_.reset();
  scene_.reset();
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
  return *run_;
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
}

void OpenWorld::step(int count, bool forces) {
  require_unfinished("step");
  const int left = run_->scene().time.steps() - run_->step();
  if (count < 0 || count > left) {
    throw std::invalid_argument("count is " + std::to_string(count) + "; allowed: 0 to " + std::to_string(left) +
                                ", the steps that are left until time.duration of the scene");
  }
  work([&] {
    const int end = run_->step() + count;
    while (run_->step() < end && !thread_.is_stopping()) {
      run_->measure_forces(forces && run_->step() + 1 == end);
      run_->advance(run_->step() + 1, nullptr);
    }
  });
}

void OpenWorld::change(const std::vector<std::string>& values) {
  require_unfinished("change");
  if (checkpoints_ && checkpoints_->are_on()) {
    throw std::invalid_argument("values: a checkpoint does not hold changes; allowed: none in a world with checkpoints");
  }
  work([&] {
    const Scene changed = source_.load(values);
    change_values(*run_, *scene_, changed, values);
  });
  source_.values.insert(source_.values.end(), values.begin(), values.end());
}

void OpenWorld::set_pushes(std::vector<Push> pushes) {
  require_unfinished("set_forces");
  if (checkpoints_ && checkpoints_->are_on()) {
    throw std::invalid_argument("forces: a checkpoint does not hold them; allowed: none in a world with checkpoints");
  }
  run_->set_pushes(std::move(pushes));
}

std::string OpenWorld::finish(bool draws) {
  require_unfinished("finish");
  if (!options_.out) throw std::runtime_error("World.finish(): out is None; allowed: a folder, which the results are written to");
  work([&] {
    run_->finish();
    is_finished_ = true;
    if (draws) render(run_->renderings(), folder_->path(), true);
  });
  return folder_->path().string();
}

void OpenWorld::close() {
  if (is_closed()) return;
  require_open("close");
  occupy([this] { release(); });
}

std::string about(const Source& source, const std::function<std::string(const Scene&)>& tell) {
  std::string text;
  WorldThread thread;
  thread.run([&] {
    const Scene scene = source.load();
    const Admission admission(scene);
    text = tell(scene);
  });
  return text;
}

}  // namespace falling_particles::python
