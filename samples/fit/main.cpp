// Fits an ellipsoid, superellipsoid or superovoid to a mesh or a point cloud.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <supernormal/shapes/superellipsoid.hpp>
#include <vector>

#include "input/read_data.hpp"
#include "input/table.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
#include "output/json.hpp"
#include "output/paste.hpp"
#include "output/picture.hpp"
#include "output/report.hpp"

namespace {

enum ExitCode { Done = 0, Failed = 1, BadInput = 2, BadFit = 3 };

constexpr std::size_t kSurfacePoints = 50000;  // of a mesh: their spacing is about 1.5 % of its extent

struct Options {
  std::string path;
  std::string shape = "auto";
  std::string noise = "auto";
  std::string outliers = "auto";
  std::string table = "auto";
  std::string group;
  std::string unit = "m";
  std::optional<double> scale;
  double density = 1000;
  std::string name;
  std::string out = "out/fit";
  std::string sides = "auto";
  fit::ShapeLimits limits;
  bool uses_vertices = false;
  bool is_quick = false;
  int bodies = 1;
  int threads = 1;
};

/// Announces the next step at once, also into a pipe.
void say(const std::string& step) {
  std::printf("%s\n", step.c_str());
  std::fflush(stdout);
}

/// The points to fit. For a mesh: random points of its triangles, as many as it has vertices, within bounds.
fit::Cloud points_of(const fit::Data& data, bool uses_vertices) {
  if (data.triangles.empty() || uses_vertices) return data.vertices;
  const std::size_t count = std::clamp<std::size_t>(data.vertices.points.size(), 2000, 20000);
  return fit::sample_triangles(data.vertices.points, data.triangles, count, 1);
}

fit::FitSettings settings_of(const Options& options, const fit::Data& data) {
  const bool is_mesh = !data.triangles.empty();
  const std::map<std::string, std::optional<fit::Family>> families = {{"auto", std::nullopt},
                                                                      {"ellipsoid", fit::Family::Ellipsoid},
                                                                      {"superellipsoid", fit::Family::Superellipsoid},
                                                                      {"superovoid", fit::Family::Superovoid}};
  fit::FitSettings settings;
  settings.family = families.at(options.shape);
  settings.noise = options.noise == "normal" ? fit::Noise::AlongNormal : fit::Noise::Isotropic;
  // A mesh is the surface itself. A distance from the body means another shape, not an outlier or noise.
  settings.rejects_outliers = options.outliers == "auto" ? !is_mesh : options.outliers == "reject";
  if (is_mesh && options.noise == "auto") settings.noise = fit::Noise::AlongNormal;
  settings.is_whole = fit::is_closed(data);
  if (settings.is_whole) settings.volume = fit::volume_target(data);
  if (is_mesh) settings.surface = fit::sample_triangles(data.vertices.points, data.triangles, kSurfacePoints, 4);
  const std::map<std::string, fit::Sides> sides = {
      {"auto", fit::Sides::Auto}, {"all", fit::Sides::All}, {"some", fit::Sides::Some}};
  settings.sides = sides.at(options.sides);
  settings.limits = options.limits;
  settings.threads = options.threads;
  settings.progress = say;
  return settings;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

void write_results(const Options& options, const std::vector<fit::FittedBody>& fitted, const std::vector<fit::Body>& bodies,
                   const fit::Data& data, const fit::FitError& error, const std::vector<std::string>& doubts) {
  const std::string file = std::filesystem::path(options.path).filename().string();
  const std::string name =
      options.name.empty() ? fit::identifier(std::filesystem::path(options.path).stem().string()) : options.name;
  const std::string source = "fitted to " + file + " by samples/fit";
  const std::string toml = fit::toml_lines(fitted, name, options.density, source);
  const std::string c = fit::c_lines(fitted, name, source);
  std::printf("\n%s\n%s", toml.c_str(), c.c_str());
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  write(folder / (name + ".toml"), toml);
  write(folder / (name + ".c"), c);
  write(folder / (name + ".svg"), fit::draw(bodies, data.vertices, error.rms, file));
  write(folder / (name + ".json"), fit::json_text(fitted, error, doubts, name, source));
  write(folder / (name + "_aligned.ply"), fit::aligned_ply(data, fitted));
  std::printf("\nwritten: %s.toml, .c, .svg and .json, and the data in the frame of the grain: %s_aligned.ply\n",
              (folder / name).c_str(), name.c_str());
}

std::vector<fit::FittedBody> fit_points(const fit::Cloud& points, const Options& options, const fit::Data& data) {
  try {
    return fit::fit_union(points, options.bodies, settings_of(options, data), [](int count, int largest) {
      say("looking for " + std::to_string(count) + " of at most " + std::to_string(largest) + " bodies");
    });
  } catch (const std::invalid_argument& error) {
    throw fit::InputError(options.path + ": " + error.what());
  }
}

/// The data without the outliers of the fit, which are on no surface. The fit of a mesh uses other points, so a mesh is unchanged.
fit::Data without_outliers(fit::Data data, const std::vector<fit::FittedBody>& fitted) {
  if (!data.triangles.empty()) return data;
  std::vector<std::size_t> outliers;
  for (const fit::FittedBody& each : fitted) outliers.insert(outliers.end(), each.outliers.begin(), each.outliers.end());
  data.vertices = fit::without(data.vertices, outliers);
  return data;
}

const std::map<std::string, double> kUnits = {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}};

/// Accepts finite numbers above 0. CLI::PositiveNumber accepts nan.
const CLI::Validator kPositive(
    [](std::string& text) {
      double value = 0;
      const bool is_positive = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
      return is_positive ? std::string() : text + "; allowed: a number in (0, inf)";
    },
    "POSITIVE");

/// Metres in a unit of the file.
double scale_of(const Options& options) { return options.scale.value_or(kUnits.at(options.unit)); }

ExitCode run(const Options& options) {
  fit::Data data = fit::read_data(options.path, scale_of(options), options.group);
  const bool is_mesh = !data.triangles.empty();
  say(options.path + ": " + std::to_string(data.vertices.points.size()) + " points, " + std::to_string(data.triangles.size()) +
      " triangles");
  if (!data.note.empty()) say(data.note);
  const std::string table = options.table == "auto" ? fit::remove_table(data) : "";
  if (!table.empty()) say(table);
  const fit::Cloud points = points_of(data, options.uses_vertices);
  const std::vector<fit::FittedBody> fitted = fit_points(points, options, data);
  if (fitted.size() < static_cast<std::size_t>(options.bodies)) {
    say(std::to_string(fitted.size()) + (fitted.size() == 1 ? " body fits" : " bodies fit") + " as well as " +
        std::to_string(options.bodies) +
        ": more do not bring the points nearer by a twentieth, noise and the sharpest edges apart");
  }
  for (const fit::FittedBody& each : fitted) std::fputs(fit::describe(each).c_str(), stdout);
  if (!is_mesh) std::fputs(fit::describe_outliers(fitted, points).c_str(), stdout);
  if (options.is_quick) return Done;
  say("comparing surfaces and volumes");
  std::vector<fit::Body> bodies(fitted.size());
  std::ranges::transform(fitted, bodies.begin(), &fit::FittedBody::body);
  fit::FitError error = fit::find_error(bodies, without_outliers(data, fitted));
  fit::add_uncertainty(error, fitted);
  std::fputs(fit::describe(error).c_str(), stdout);
  const std::vector<std::string> doubts = fit::doubts_about(fitted, error);
  write_results(options, fitted, bodies, data, error, doubts);
  std::fflush(stdout);
  for (const std::string& doubt : doubts) std::fprintf(stderr, "fit: warning: %s\n", doubt.c_str());
  return doubts.empty() ? Done : BadFit;
}

/// Throws std::invalid_argument for options that contradict one another.
void require_consistent(const Options& options) {
  const fit::ShapeLimits& limits = options.limits;
  if (options.shape == "ellipsoid" && (limits.delta || limits.epsilon)) {
    throw std::invalid_argument("--delta and --epsilon: the exponents of --shape ellipsoid are 2; allowed: another shape");
  }
  if (limits.has_round_section && limits.delta && *limits.delta != 2) {
    throw std::invalid_argument("--delta " + std::to_string(*limits.delta) + " with --round; allowed: 2");
  }
  for (const std::optional<double>& exponent : {limits.delta, limits.epsilon}) {
    if (exponent && *exponent > limits.max_exponent) {
      throw std::invalid_argument("--delta and --epsilon: " + std::to_string(*exponent) + "; allowed: at most --max-exponent, " +
                                  std::to_string(limits.max_exponent));
    }
  }
}

int run_program(int argc, char** argv) {
  CLI::App app("Finds the ellipsoid, superellipsoid or superovoid that is nearest to a mesh or to points.", "fit");
  Options options;
  app.add_option("file", options.path, "mesh (.stl, .obj, .off, .glb, .ply) or points (.ply, .obj, .xyz)")->required();
  app.add_option("--shape", options.shape, "what to look for; auto: what the data call for")
      ->check(CLI::IsMember({"auto", "ellipsoid", "superellipsoid", "superovoid"}))
      ->capture_default_str();
  app.add_option("--bodies", options.bodies, "the most bodies that a union may have")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  CLI::Option* const unit = app.add_option("--unit", options.unit, "of the file's lengths")
                                ->check(CLI::IsMember({"m", "cm", "mm", "um", "in"}))
                                ->capture_default_str();
  app.add_option("--scale", options.scale, "metres in a unit of the file, instead of --unit")->check(kPositive)->excludes(unit);
  app.add_option("--group", options.group, "one object of a file with several: a group of an .obj, a node or mesh of a .glb");
  app.add_option("--density", options.density, "kg/m^3, for the catalogue of grains")->check(kPositive)->capture_default_str();
  app.add_option("--name", options.name, "of the body in what is written; the file's if not given");
  app.add_option("--noise", options.noise,
                 "how points scatter: alike in all directions, or along the surface's normal only; auto: the first of points, the "
                 "second of a mesh")
      ->check(CLI::IsMember({"auto", "isotropic", "normal"}))
      ->capture_default_str();
  app.add_option("--outliers", options.outliers, "points beyond 5 standard deviations; auto: reject in a cloud, keep in a mesh")
      ->check(CLI::IsMember({"auto", "reject", "keep"}))
      ->capture_default_str();
  app.add_option(
         "--sides", options.sides,
         "where the data show the surface; all: no body shall extend beyond the data; some: it may where nothing was scanned; "
         "auto: all, if no body fits the data within the noise")
      ->check(CLI::IsMember({"auto", "all", "some"}))
      ->capture_default_str();
  const CLI::Range exponents(supernormal::Superellipsoid::kMinExponent, supernormal::Superellipsoid::kMaxExponent);
  app.add_option("--max-exponent", options.limits.max_exponent,
                 "the largest exponent; above 20, edges cost evaluations and show no more")
      ->check(exponents)
      ->capture_default_str();
  app.add_option("--delta", options.limits.delta, "fixes the exponent delta")->check(exponents);
  app.add_option("--epsilon", options.limits.epsilon, "fixes the exponent epsilon")->check(exponents);
  app.add_flag("--round", options.limits.has_round_section, "bodies of revolution about z: a = b, delta = 2");
  app.add_option("--out", options.out, "folder for the results")->capture_default_str();
  app.add_option("--threads", options.threads, "for the last descent; the same result to rounding")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_flag("--vertices", options.uses_vertices, "fit the vertices of a mesh and not random points of its triangles");
  app.add_flag("--quick", options.is_quick, "fit only: no comparison of volumes and surfaces, nothing written");
  app.footer("Exit codes: 0: done; 1: failed; 2: bad input; 3: the fit is bad, as the warnings say, and written nevertheless.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? Done : BadInput;
  }
  if (!options.name.empty() && options.name != fit::identifier(options.name)) {
    std::fprintf(stderr, "fit: --name \"%s\"; allowed: letters, digits and _, no digit first\n", options.name.c_str());
    return BadInput;
  }
  require_consistent(options);
  return run(options);
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
