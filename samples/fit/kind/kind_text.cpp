#include "kind_text.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/report.hpp"

namespace fit {
namespace {

using Json = nlohmann::ordered_json;

// A lognormal distribution needs bounds. 0.27 % of the grains are beyond three deviations. See constants.md for others.
constexpr double kBound = 3;
constexpr double kLargestRatio = 1000;  // of the bounds of `size` in a scene (scene_files.md)
constexpr double kOneSize = 1 + 1e-9;   // the geometric deviation of scans that differ by rounding

bool is_too_wide(const GrainKind& kind) { return std::pow(kind.geometric_deviation, 2 * kBound) > kLargestRatio; }

/// The numbers of the shape that the family has, with their names.
std::vector<std::pair<const char*, Spread>> shape_of(const GrainKind& kind) {
  std::vector<std::pair<const char*, Spread>> shape = {{"b_over_a", kind.b_over_a}, {"c_over_a", kind.c_over_a}};
  if (kind.body.family != Family::Ellipsoid) {
    shape.emplace_back("delta", kind.delta);
    shape.emplace_back("epsilon", kind.epsilon);
  }
  if (kind.body.family == Family::Superovoid) shape.emplace_back("taper", kind.taper);
  return shape;
}

Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const Body& body) {
  return {{"family", name_of(body.family)},
          {"half_axes", {body.half_axes.x(), body.half_axes.y(), body.half_axes.z()}},
          {"delta", body.delta},
          {"epsilon", body.epsilon},
          {"taper", body.taper}};
}

}  // namespace

std::string describe(const GrainKind& kind, std::span<const KindScan> scans) {
  std::string text =
      format("%-24s %12s %8s %8s %8s %8s %8s %10s\n", "scan", "size, m", "b/a", "c/a", "delta", "epsilon", "taper", "rms, %");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Body& body = scans[i].fitted.body;
    text += format("%-24s %12.5g %8.4f %8.4f %8.4g %8.4g %8.4f %10.3g\n", scans[i].file.c_str(), kind.sizes[i],
                   body.half_axes.y() / body.half_axes.x(), body.half_axes.z() / body.half_axes.x(), body.delta, body.epsilon,
                   body.taper, 100 * scans[i].error.rms / scans[i].error.radius);
  }
  text += format("shape of %zu scans, %ss: mean, standard deviation between scans, standard error of one fit\n", scans.size(),
                 name_of(kind.body.family));
  for (const auto& [name, spread] : shape_of(kind)) {
    text += format("  %-10s %10.5g %10.2g ", name, spread.mean, spread.deviation);
    text += std::isfinite(spread.error) ? format("%10.2g\n", spread.error) : std::string("  not determined by the data\n");
  }
  const auto [smallest, largest] = std::ranges::minmax(kind.sizes);
  return text + format("size, the cube root of the volume: median %.5g m, geometric deviation %.4g, from %.5g to %.5g m\n",
                       kind.median, kind.geometric_deviation, smallest, largest);
}

std::string scene_lines(const GrainKind& kind, const std::string& name) {
  std::string text = "[[grain]]\nname = \"" + name + "\"\ncount = " + std::to_string(kind.sizes.size()) + "\n";
  if (kind.geometric_deviation < kOneSize || is_too_wide(kind)) return text;
  return text + format(
                    "size = { distribution = \"lognormal\", unit = \"catalogue\", median = 1.0, geometric_deviation = %.9g, "
                    "smallest = %.9g, largest = %.9g }\n",
                    kind.geometric_deviation, std::pow(kind.geometric_deviation, -kBound),
                    std::pow(kind.geometric_deviation, kBound));
}

std::vector<std::string> doubts_about(const GrainKind& kind, std::span<const KindScan> scans) {
  std::vector<std::string> doubts;
  for (const KindScan& scan : scans) {
    for (const std::string& doubt : scan.doubts) doubts.push_back(scan.file + ": " + doubt);
  }
  if (is_too_wide(kind)) {
    doubts.push_back(
        format("the sizes have a geometric deviation of %.4g; allowed: up to %.4g, for bounds of three deviations in a "
               "scene; make several kinds",
               kind.geometric_deviation, std::pow(kLargestRatio, 1 / (2 * kBound))));
  }
  return doubts;
}

std::string json_text(const GrainKind& kind, std::span<const KindScan> scans, const std::vector<std::string>& warnings,
                      const Provenance& provenance) {
  Json json = {{"name", provenance.name},
               {"source", provenance.source},
               {"units", {{"lengths", "m"}, {"volumes", "m^3"}, {"density", "kg/m^3"}, {"ratios, exponents, tapers", "1"}}},
               {"metres_per_unit_of_file", provenance.scale},
               {"density", provenance.density},
               {"body", json_of(kind.body)}};
  for (const auto& [name, spread] : shape_of(kind)) {
    json["shape"][name] = {{"mean", spread.mean}, {"standard_deviation", spread.deviation}, {"fit_error", json_of(spread.error)}};
  }
  const auto [smallest, largest] = std::ranges::minmax(kind.sizes);
  json["size"] = {{"of", "cube root of the volume"},
                  {"median", kind.median},
                  {"geometric_deviation", kind.geometric_deviation},
                  {"smallest", smallest},
                  {"largest", largest}};
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Json scan = {{"file", scans[i].file}, {"size", kind.sizes[i]}};
    scan.update(json_of(scans[i].fitted.body));
    scan["volume"] = scans[i].error.body.volume;
    scan["volume_error"] = scans[i].error.volume_error;
    scan["distance_rms"] = scans[i].error.rms;
    scan["radius_of_data"] = scans[i].error.radius;
    scan["warnings"] = scans[i].doubts;
    json["scans"].push_back(scan);
  }
  json["warnings"] = warnings;
  return json.dump(2) + "\n";
}

}  // namespace fit
