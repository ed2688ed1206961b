#include "scene.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace falling_particles {
namespace {

constexpr double kBytesPerGrain = 20 * 1024;
constexpr double kBytesOfProgram = 32 * 1024 * 1024;  // code, libraries, the table of warm starts

}  // namespace

int Time::steps() const { return static_cast<int>(std::lround(duration / step)); }
int Time::steps_per_frame() const { return static_cast<int>(std::lround(frame / step)); }

std::string name_of(snSolver solver) {
  return solver == SN_SOLVER_HYBRID ? "hybrid" : solver == SN_SOLVER_NEWTON ? "newton" : "fixed_point";
}

const supernormal::effects::Gravity* Scene::gravity() const {
  for (const supernormal::effects::Effect& effect : effects) {
    if (const auto* gravity = std::get_if<supernormal::effects::Gravity>(&effect)) return gravity;
  }
  return nullptr;
}

bool Scene::looks_ahead() const {
  return solver.stepper || std::ranges::any_of(effects, [](const supernormal::effects::Effect& effect) {
           return std::holds_alternative<supernormal::effects::SpeculativeContacts>(effect);
         });
}

std::span<const Wall> Scene::parts() const { return {std::ranges::find_if(walls, &Wall::is_part), walls.end()}; }

double GrainCount::smallest_scale() const {
  if (!size) return 1;
  return is_fed || scales.empty() ? size->smallest() : std::ranges::min(scales);
}

double GrainCount::largest_scale() const {
  if (!size) return 1;
  return is_fed || scales.empty() ? size->largest() : std::ranges::max(scales);
}

bool Scene::has_grains_of(const GrainCount& kind) const {
  const auto is_kind = [&](const FedKind& fed) { return &kinds[fed.kind] == &kind; };
  return kind.count > 0 ||
         std::ranges::any_of(feeders, [&](const Feeder& feeder) { return std::ranges::any_of(feeder.mixture, is_kind); });
}

int Scene::grains_at_start() const {
  int sum = 0;
  for (const GrainCount& entry : kinds) sum += entry.count;
  return sum;
}

std::size_t Scene::kind_of(const GrainKind& kind) const {
  const auto is_kind = [&](const GrainCount& entry) { return &entry.kind == &kind; };
  return static_cast<std::size_t>(std::ranges::find_if(kinds, is_kind) - kinds.begin());
}

bool Scene::has_sizes() const {
  return std::ranges::any_of(kinds, [](const GrainCount& entry) { return entry.size.has_value(); });
}

bool Scene::has_compounds() const {
  return std::ranges::any_of(kinds, [](const GrainCount& entry) { return !entry.kind.components.empty(); });
}

double Scene::smallest_half_axis() const {
  double smallest = INFINITY;
  for (const GrainCount& entry : kinds) smallest = std::min(smallest, entry.smallest_scale() * entry.kind.smallest_half_axis());
  return smallest;
}

double Scene::largest_bounding_radius() const {
  double largest = 0;
  for (const GrainCount& entry : kinds) largest = std::max(largest, entry.largest_scale() * entry.kind.bounding_radius());
  return largest;
}

double Scene::smallest_cell() const { return 2 * largest_bounding_radius() * (1 + drop.gap); }

bool is_inside(const Scene& scene, const Point& point) {
  // Along a periodic axis every coordinate but a NaN is inside.
  Point within = point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (scene.periodic[axis] && std::isfinite(point[axis])) within[axis] = scene.periodic[axis]->middle();
  }
  const Point image = wrapped(scene.periodic, point);
  return contains(scene.container, within) ||
         std::ranges::any_of(scene.sinks, [&](const Sink& sink) { return sink.contains(image); });
}

double StartState::largest_speed() const {
  double largest = 0;
  for (const StartGrain& grain : grains) {
    largest = std::max(largest, std::hypot(grain.velocity[0], grain.velocity[1], grain.velocity[2]));
  }
  return largest;
}

double memory_needed(int grains) { return kBytesOfProgram + kBytesPerGrain * grains; }

int most_grains(double bytes) {
  const double grains = (bytes - kBytesOfProgram) / kBytesPerGrain;
  return static_cast<int>(std::clamp(grains, 0.0, static_cast<double>(std::numeric_limits<int>::max())));
}

double memory_of_machine() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  for (const auto kind : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(kind, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  }
  return bytes;
}

}  // namespace falling_particles
