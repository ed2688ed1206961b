// Measures the cost of each picture format in a run, and the size of its files. Prints a Markdown table. Programs that draw after
// the run are not included.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "observe/measuring.hpp"
#include "observe/simulation.hpp"
#include "output/picture.hpp"

namespace {

using namespace falling_particles;
namespace fs = std::filesystem;

struct Options {
  std::string scene;
  double duration = 1;
  int frames = 30;
};

/// The processor time of this process, s. Unlike wall-clock time it excludes other programs.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double seconds_of(const Work& work) {
  const double start = processor_seconds();
  work();
  return processor_seconds() - start;
}

/// A format that writes into its own folder.
struct Candidate {
  std::string name;
  std::unique_ptr<OutputFolder> folder;  // deleted together with its files
  std::unique_ptr<Picture> picture;
  double adding = 0;     // s, for all frames
  double finishing = 0;  // s

  double megabytes() const {
    double bytes = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder->file(""))) {
      if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
    }
    return 1e-6 * bytes;
  }
};

std::vector<Candidate> candidates(const Contents& contents) {
  std::vector<Candidate> all;
  for (const PictureFormat& format : picture_formats()) {
    Candidate candidate;
    candidate.name = format.name;
    candidate.folder = std::make_unique<OutputFolder>(fs::temp_directory_path(), "pictures_cost", result_names());
    candidate.picture = format.make(*candidate.folder, format, contents);
    all.push_back(std::move(candidate));
  }
  return all;
}

void measure(const Options& options) {
  const Scene scene = load_scene(options.scene);
  const int steps = static_cast<int>(std::lround(options.duration / scene.time.step));
  Simulation simulation(scene, 1);
  const World& world = simulation.world;
  Stepper& stepper = simulation.stepper;
  const Contents contents = contents_of(world, scene);
  std::vector<Candidate> all = candidates(contents);
  OutputFolder tables(fs::temp_directory_path(), "pictures_cost", result_names());
  const fs::path path = tables.file("trajectory.csv");
  const std::unique_ptr<Measurement> trajectory = find_measurement_kind("trajectory")->on_by_default->make(world);
  TableFile file(path, trajectory->columns());
  double stepping = 0, writing = 0, framing = 0;
  int frames = 0;
  for (int step = 0; step <= steps; ++step) {
    if (step > 0) stepping += seconds_of([&] { stepper.step(); });
    if (static_cast<long long>(step) * options.frames < static_cast<long long>(frames) * steps) continue;
    ++frames;
    const double time = step * scene.time.step;
    writing += seconds_of([&] {
      TableText table;
      trajectory->measure({time, world, {}, &simulation}, table);
      file.write(table.text());
    });
    Frame frame;
    framing +=
        seconds_of([&] { frame = frame_of(time, measure_energy(world, scene), contents, world, step == 0 ? nullptr : &stepper); });
    for (Candidate& candidate : all) candidate.adding += seconds_of([&] { candidate.picture->add(frame); });
  }
  for (Candidate& candidate : all) candidate.finishing = seconds_of([&] { candidate.picture->finish(""); });

  std::printf("%d bodies, %d steps, %d frames\n\n", scene.grains_at_start(), steps, frames);
  std::printf("| | processor time, s | at the end, s | of the run | MB |\n|---|---:|---:|---:|---:|\n");
  const double run = stepping + writing;
  std::printf("| steps | %.2f | | | |\n| trajectory.csv | %.3f | | %.1f %% | %.2f |\n", stepping, writing, 100 * writing / run,
              1e-6 * static_cast<double>(fs::file_size(path)));
  for (const Candidate& candidate : all) {
    const double seconds = framing + candidate.adding + candidate.finishing;
    std::printf("| %s | %.3f | %.3f | %.1f %% | %.2f |\n", candidate.name.c_str(), seconds, candidate.finishing,
                100 * seconds / run, candidate.megabytes());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Measures what the pictures of a run cost.", "pictures_cost");
    Options options;
    app.add_option("scene", options.scene, "scene file (TOML)")->required();
    app.add_option("--duration", options.duration, "simulated seconds")->check(CLI::PositiveNumber)->capture_default_str();
    app.add_option("--frames", options.frames, "frames after the start, evenly")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    measure(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pictures_cost: %s\n", error.what());
    return 1;
  }
  return 0;
}
