// Fits ellipsoids, superellipsoids or superovoids to a mesh or a point cloud, or one kind of grain to many of them.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "kind/grain_kind.hpp"
#include "kind/kind_text.hpp"
#include "output/picture.hpp"
#include "output/report.hpp"
#include "output/results.hpp"
#include "program/options.hpp"
#include "program/scan.hpp"

namespace {

namespace fs = std::filesystem;

enum ExitCode { Done = 0, Failed = 1, BadInput = 2, BadFit = 3 };

/// The files that a run writes. The constructor refuses a folder or a name that cannot be written, before the fit.
class Results {
 public:
  Results(const fit::Options& options, const std::string& source_name, const std::vector<std::string>& endings)
      : folder_(options.out) {
    name_ = options.name.empty() ? fit::identifier(source_name) : options.name;
    if (options.name.empty() && name_ != source_name) {
      fit::say("the grain is called \"" + name_ + "\": a name has letters, digits and _, no digit first (--name)");
    }
    if (options.is_quick) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw fit::InputError("fit: --out " + folder_.string() + ": the folder cannot be made: " + error.message());
    for (const std::string& ending : endings) {
      const fs::path path = folder_ / (name_ + ending);
      const bool is_there = fs::exists(path, error);
      if (!std::ofstream(path, std::ios::app)) {
        throw fit::InputError("fit: --out " + folder_.string() + ": " + path.string() +
                              " cannot be written: " + std::strerror(errno));
      }
      if (!is_there) fs::remove(path, error);
    }
  }

  const std::string& name() const { return name_; }

  void write(const std::string& ending, const std::string& text) const {
    const fs::path path = folder_ / (name_ + ending);
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot be written");
  }

  std::string path() const { return (folder_ / name_).string(); }

 private:
  fs::path folder_;
  std::string name_;
};

ExitCode verdict(const std::vector<std::string>& doubts) {
  std::fflush(stdout);
  for (const std::string& doubt : doubts) std::fprintf(stderr, "fit: warning: %s\n", doubt.c_str());
  return doubts.empty() ? Done : BadFit;
}

fit::Provenance provenance_of(const fit::Options& options, const std::string& name, const std::string& source) {
  fit::Provenance provenance;
  provenance.name = name;
  provenance.source = source;
  provenance.scale = options.scale;
  provenance.density = options.density;
  return provenance;
}

void write_results(const fit::Options& options, const Results& results, const std::vector<fit::FittedBody>& fitted,
                   const fit::Scan& scan, const fit::FitError& error, const std::vector<std::string>& doubts) {
  const std::string file = fs::path(scan.path).filename().string();
  const std::string source = "fitted to " + file + " by samples/fit";
  const std::string& name = results.name();
  const std::string toml = fit::toml_lines(fitted, name, options.density, source);
  const std::string c = fit::c_lines(fitted, name, source, error.body, options.density);
  fit::Provenance provenance = provenance_of(options, name, source);
  provenance.is_mesh = !scan.data.triangles.empty();
  provenance.open = scan.open;
  std::printf("\n%s\n%s", toml.c_str(), c.c_str());
  results.write(".toml", toml);
  results.write(".c", c);
  results.write(".svg", fit::draw(fit::bodies_of(fitted), scan.data.vertices, error.rms, file));
  results.write(".json", fit::json_text(fitted, error, doubts, provenance));
  results.write("_aligned.ply", fit::aligned_ply(scan.data, fitted));
  std::printf("\nwritten: %s.toml, .c, .svg and .json, and the data in the frame of the grain: %s_aligned.ply\n",
              results.path().c_str(), name.c_str());
}

ExitCode fit_one(const std::string& path, const fit::Options& options) {
  const fit::Scan scan = fit::read_scan(path, options);
  for (const std::string& remark : scan.remarks) fit::say(remark);
  const Results results(options, fs::path(path).stem().string(), {".toml", ".c", ".svg", ".json", "_aligned.ply"});
  const std::vector<fit::FittedBody> fitted = fit::fit_scan(scan, options);
  if (fitted.size() < static_cast<std::size_t>(options.bodies)) {
    fit::say(std::to_string(fitted.size()) + (fitted.size() == 1 ? " body fits" : " bodies fit") + " as well as " +
             std::to_string(options.bodies) +
             ": more do not bring the points nearer by a twentieth, noise and the sharpest edges apart");
  }
  for (const fit::FittedBody& each : fitted) std::fputs(fit::describe(each).c_str(), stdout);
  if (scan.data.triangles.empty()) std::fputs(fit::describe_outliers(fitted, scan.points).c_str(), stdout);
  if (options.is_quick) return verdict(fit::doubts_about(fitted, fit::find_distances(scan, fitted)));
  fit::say("comparing surfaces and volumes");
  const fit::FitError error = fit::find_error(scan, fitted);
  std::fputs(fit::describe(error).c_str(), stdout);
  const std::vector<std::string> doubts = fit::doubts_about(fitted, error);
  write_results(options, results, fitted, scan, error, doubts);
  return verdict(doubts);
}

/// The scans of a folder, sorted. Announces what else it has.
std::vector<std::string> scans_in(const std::string& folder) {
  std::vector<std::string> scans;
  std::string others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const bool is_scan = fit::is_scan(entry.path().string()) && !entry.is_directory();
    if (is_scan) scans.push_back(entry.path().string());
    if (!is_scan) others.append(others.empty() ? "" : ", ").append(entry.path().filename().string());
  }
  if (!others.empty()) fit::say(folder + ": left out, as they are no scans: " + others);
  std::ranges::sort(scans);
  return scans;
}

/// The scans of the files and folders.
std::vector<std::string> scans_of(const std::vector<std::string>& paths) {
  std::vector<std::string> scans;
  for (const std::string& path : paths) {
    const std::vector<std::string> own = fs::is_directory(path) ? scans_in(path) : std::vector{path};
    scans.insert(scans.end(), own.begin(), own.end());
  }
  if (scans.size() < 2) {
    throw fit::InputError(paths.front() + ": " + std::to_string(scans.size()) +
                          " scans; a folder or a list of files makes one kind of grain, and takes at least 2");
  }
  return scans;
}

/// The fits of all scans in one family, with the same axis as z.
std::vector<fit::FittedBody> fit_alike(const std::vector<std::string>& paths, const fit::Options& options) {
  std::vector<fit::FittedBody> fitted;
  for (const std::string& path : paths) {
    fit::say("fitting " + std::to_string(fitted.size() + 1) + " of " + std::to_string(paths.size()));
    const fit::Scan scan = fit::read_scan(path, options);
    for (const std::string& remark : scan.remarks) fit::say("  " + remark);
    fitted.push_back(fit::fit_scan(scan, options).front());
  }
  const fit::Family family = std::ranges::max(fitted, {}, [](const fit::FittedBody& each) { return each.body.family; }).body.family;
  fit::say(std::string("fitting each as a ") + name_of(family) + " with each of its axes as z");
  std::vector<fit::FitsByAxis> by_axis;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const fit::Scan scan = fit::read_scan(paths[i], options);
    fit::FitSettings settings = settings_of(options, scan);
    settings.progress = {};
    const bool is_tessellated = fitted[i].is_tessellated;
    if (is_tessellated) settings.volume.reset();
    by_axis.push_back(fit::fit_each_axis(fitted[i], family, is_tessellated ? scan.data.vertices : scan.points, settings));
  }
  const std::size_t axis = fit::common_axis(by_axis);
  const bool is_given = family == fit::Family::Ellipsoid || options.limits.has_round_section;
  if (!is_given)
    fit::say(std::string("z is the ") + (axis == 0 ? "shortest" : axis == 1 ? "middle" : "longest") + " axis of every scan");
  for (std::size_t i = 0; i < paths.size(); ++i) fitted[i] = by_axis[i][axis].fitted;
  return fitted;
}

ExitCode fit_kind(const fit::Options& options) {
  if (options.bodies > 1) {
    throw std::invalid_argument("--bodies " + std::to_string(options.bodies) + " with several scans; allowed: 1");
  }
  const std::vector<std::string> paths = scans_of(options.paths);
  const bool is_folder = fs::is_directory(options.paths.front());
  const fs::path folder =
      fs::weakly_canonical(is_folder ? fs::path(options.paths.front()) : fs::absolute(paths.front()).parent_path());
  const Results results(options, folder.filename().string(), {".toml", "_scene.toml", ".json"});
  for (const std::string& path : paths)
    fit::read_data(path, options.scale, options.group);  // refuses a bad file before the first fit
  const std::vector<fit::FittedBody> fitted = fit_alike(paths, options);
  std::vector<fit::KindScan> scans;
  if (!options.is_quick) fit::say("comparing surfaces and volumes");
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const fit::Scan scan = fit::read_scan(paths[i], options);
    const fit::FitError error = options.is_quick ? fit::find_distances(scan, {fitted[i]}) : fit::find_error(scan, {fitted[i]});
    scans.push_back({fs::path(paths[i]).filename().string(), fitted[i], error, fit::doubts_about(std::vector{fitted[i]}, error)});
  }
  const fit::GrainKind kind = fit::find_kind(fitted);
  std::fputs(fit::describe(kind, scans).c_str(), stdout);
  const std::vector<std::string> doubts = fit::doubts_about(kind, scans);
  if (options.is_quick) return verdict(doubts);
  const std::string source = "fitted to " + std::to_string(scans.size()) + " scans by samples/fit";
  fit::FittedBody mean;
  mean.body = kind.body;
  const std::string toml = fit::toml_lines(std::vector{mean}, results.name(), options.density, source);
  const std::string scene = fit::scene_lines(kind, results.name());
  std::printf("\n%s\n%s", toml.c_str(), scene.c_str());
  results.write(".toml", toml);
  results.write("_scene.toml", scene);
  results.write(".json", fit::json_text(kind, scans, doubts, provenance_of(options, results.name(), source)));
  std::printf("\nwritten: %s.toml, lines for a scene in _scene.toml, and .json\n", results.path().c_str());
  return verdict(doubts);
}

int run_program(int argc, char** argv) {
  fit::Options options;
  if (const std::optional<int> code = fit::read_options(argc, argv, options)) return *code;
  const bool is_kind = options.paths.size() > 1 || fs::is_directory(options.paths.front());
  return is_kind ? fit_kind(options) : fit_one(options.paths.front(), options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const fit::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return BadInput;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "fit: %s\n", error.what());
    return BadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fit: %s\n", error.what());
    return Failed;
  }
}
