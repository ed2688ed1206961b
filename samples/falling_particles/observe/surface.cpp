// The measurement surface: the free surface of a bed and its slope.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "bed.hpp"
#include "measurement.hpp"
#include "region.hpp"

namespace falling_particles {
namespace {

struct Settings {
  std::size_t along;    // axis of the profile, x or y
  std::size_t columns;  // along it
  std::size_t rays;     // across it, in each column
  double middle;        // fraction of the width to which the line is fitted
};

std::string surface_columns(const Settings& settings) {
  std::string text = "time_s,angle_deg,standard_error_deg,fitted_columns";
  for (std::size_t i = 1; i <= settings.columns; ++i) text += ",height_" + std::to_string(i) + "_m";
  return text;
}

/// m, the mean over the rays of a column that meet a grain.
std::optional<double> column_height(const Settings& settings, const Tops& tops, const Bounds& bounds, double share) {
  const auto along = static_cast<Eigen::Index>(settings.along);
  const Eigen::Index across = 1 - along;
  double sum = 0;
  int hits = 0;
  for (std::size_t k = 0; k < settings.rays; ++k) {
    Vector3 at = Vector3::Zero();
    at[along] = std::lerp(bounds.lower[along], bounds.upper[along], share);
    at[across] =
        std::lerp(bounds.lower[across], bounds.upper[across], (static_cast<double>(k) + 0.5) / static_cast<double>(settings.rays));
    const std::optional<double> height = tops.height_at(at[0], at[1], bounds.lower[2]);
    if (!height) continue;
    sum += *height;
    ++hits;
  }
  return hits == 0 ? std::nullopt : std::optional(sum / hits);
}

void measure_surface(const Sample& sample, TableText& table, const SamplingRegion& region, const Settings& settings) {
  const Bounds bounds = region.bounds(sample.world);
  Tops tops;
  sample.world.for_each_grain_geom([&](dGeomID geom) {
    const dReal z = dGeomGetPosition(geom)[2];
    if (z >= bounds.lower[2] && z < bounds.upper[2]) tops.add(geom);
  });
  std::vector<std::optional<double>> heights;
  std::vector<std::array<double, 2>> fitted;
  const auto axis = static_cast<Eigen::Index>(settings.along);
  for (std::size_t i = 0; i < settings.columns; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(settings.columns);
    heights.push_back(column_height(settings, tops, bounds, share));
    if (heights.back() && std::abs(share - 0.5) <= settings.middle / 2) {
      fitted.push_back({std::lerp(bounds.lower[axis], bounds.upper[axis], share), *heights.back()});
    }
  }
  table.add(sample.time);
  if (fitted.size() < 3) {
    table.blank(2);
  } else {
    const Line line = fit(fitted);
    constexpr double kDegrees = 180 / std::numbers::pi;
    table.add(std::atan(line.slope) * kDegrees).add(line.error / (1 + line.slope * line.slope) * kDegrees);
  }
  table.add(fitted.size());
  for (const std::optional<double>& height : heights) table.add(height);
  table.end_line();
}

Settings read_settings(const TomlTable& table) {
  constexpr std::int64_t kMostColumns = 1000;
  const bool is_about_x = table.has("axis") && table.choice("axis", {"x", "y"}) == "x";
  const auto count = [&table](const char* key, std::int64_t least, std::int64_t otherwise) {
    return static_cast<std::size_t>(table.has(key) ? table.integer(key, least, kMostColumns) : otherwise);
  };
  const std::size_t columns = count("columns", 3, 40);
  const std::size_t rays = count("rays", 1, 20);
  const double middle = table.has("middle") ? table.number("middle", Interval::positive(1, "(fraction of the width)")) : 0.5;
  return {is_about_x ? std::size_t{1} : std::size_t{0}, columns, rays, middle};
}

}  // namespace

MeasurementKind surface_kind() {
  return {.name = "surface",
          .measures = "the height of the bed in columns, and the slope of its middle: the dynamic angle of repose of a drum",
          .parameters = {{"lower, upper", "m, corners of a box; grains with centres between their heights count"},
                         {"axis", "x or y, the drum's: the profile runs along the other one; y without it"},
                         {"columns", "3 to 1000, along the profile; 40 without it"},
                         {"rays", "1 to 1000, vertical ones across each column, whose heights are averaged; 20 without it"},
                         {"middle", "in (0, 1], fraction of the width to which the line is fitted; 0.5 without it"}},
          .columns = "time, angle (positive where the bed rises along the axis), its standard error, columns of the fit, heights",
          .source = "line of least squares through the middle: Henein et al., Metallurgical Transactions B 14 (1983)",
          .read = [](const TomlTable& table, const Scene& scene) -> MeasurementMaker {
            const SamplingRegion region(table, scene, SamplingRegion::Without::Refused);
            const Settings settings = read_settings(table);
            return lines_of(surface_columns(settings),
                            [=](const Sample& sample, TableText& lines) { measure_surface(sample, lines, region, settings); });
          },
          .plotted = {"angle_deg"},
          .plot_label = "angle, degrees"};
}

}  // namespace falling_particles
