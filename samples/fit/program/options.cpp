#include "options.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <stdexcept>
#include <supernormal/shapes/superellipsoid.hpp>

#include "output/results.hpp"

namespace fit {
namespace {

constexpr int kBadInput = 2;

const std::map<std::string, double> kUnits = {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}};

/// Accepts finite numbers above 0. CLI::PositiveNumber accepts nan.
const CLI::Validator kPositive(
    [](std::string& text) {
      double value = 0;
      const bool is_positive = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
      return is_positive ? std::string() : text + "; allowed: a number in (0, inf)";
    },
    "POSITIVE");

/// Throws std::invalid_argument for options that contradict one another.
void require_consistent(const Options& options) {
  const ShapeLimits& limits = options.limits;
  if (options.shape == "ellipsoid" && (limits.delta || limits.epsilon)) {
    throw std::invalid_argument("--delta and --epsilon: the exponents of --shape ellipsoid are 2; allowed: another shape");
  }
  if (limits.has_round_section && limits.delta && *limits.delta != 2) {
    throw std::invalid_argument("--delta " + std::to_string(*limits.delta) + " with --round; allowed: 2");
  }
  if (!options.name.empty() && options.name != identifier(options.name)) {
    throw std::invalid_argument("--name \"" + options.name + "\"; allowed: letters, digits and _, no digit first");
  }
  for (const std::optional<double>& exponent : {limits.delta, limits.epsilon}) {
    if (exponent && *exponent > limits.max_exponent) {
      throw std::invalid_argument("--delta and --epsilon: " + std::to_string(*exponent) + "; allowed: at most --max-exponent, " +
                                  std::to_string(limits.max_exponent));
    }
  }
}

}  // namespace

std::optional<int> read_options(int argc, char** argv, Options& options) {
  CLI::App app("Finds the ellipsoid, superellipsoid or superovoid that is nearest to a mesh or to points.", "fit");
  app.add_option("file", options.paths,
                 "mesh (.stl, .obj, .off, .glb, .ply) or points (.ply, .obj, .off, .xyz); several, or a folder: one kind of grain")
      ->required();
  app.add_option("--shape", options.shape, "what to look for; auto: what the data call for")
      ->check(CLI::IsMember({"auto", "ellipsoid", "superellipsoid", "superovoid"}))
      ->capture_default_str();
  app.add_option("--bodies", options.bodies, "the most bodies that a union may have")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  std::string unit_name = "m";
  CLI::Option* const unit = app.add_option("--unit", unit_name, "of the file's lengths")
                                ->check(CLI::IsMember({"m", "cm", "mm", "um", "in"}))
                                ->capture_default_str();
  CLI::Option* const scale =
      app.add_option("--scale", options.scale, "metres in a unit of the file, instead of --unit")->check(kPositive)->excludes(unit);
  app.add_option("--group", options.group, "one object of a file with several: a group of an .obj, a node or mesh of a .glb");
  app.add_option("--density", options.density, "kg/m^3, for the catalogue of grains")->check(kPositive)->capture_default_str();
  app.add_option("--name", options.name, "of the grain in what is written; the file's or folder's if not given");
  app.add_option("--noise", options.noise,
                 "how points scatter: alike in all directions, or along the surface's normal only; auto: the first of points, the "
                 "second of a mesh")
      ->check(CLI::IsMember({"auto", "isotropic", "normal"}))
      ->capture_default_str();
  app.add_option("--outliers", options.outliers, "points beyond 5 standard deviations; auto: reject in a cloud, keep in a mesh")
      ->check(CLI::IsMember({"auto", "reject", "keep"}))
      ->capture_default_str();
  app.add_option("--table", options.table, "the plane under a scanned object; auto: left out, if there is one")
      ->check(CLI::IsMember({"auto", "keep"}))
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
  app.add_flag(
      "--quick", options.is_quick,
      "fit only: nothing written; the warnings are about the root mean square, outliers and half-axes, not about reach and volume");
  app.footer("Exit codes: 0: done; 1: failed; 2: bad input; 3: the fit is bad, as the warnings say, and written nevertheless.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  if (scale->empty()) options.scale = kUnits.at(unit_name);
  require_consistent(options);
  return std::nullopt;
}

}  // namespace fit
