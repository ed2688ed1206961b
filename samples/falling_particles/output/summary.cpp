#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <variant>

#include "common/toml_string.hpp"

namespace falling_particles {
namespace {

/// Lines of the form key = value, with aligned values and aligned comments.
class Lines {
 public:
  explicit Lines(Times times) : times_(times) {}
  void section(const char* name) { text_ += (text_.empty() ? "[" : "\n[") + std::string(name) + "]\n"; }
  void add(const char* key, const std::string& value, const char* comment = "") {
    text_ += padded(key, 32) + "= " + (*comment == '\0' ? value : padded(value, 12) + "# " + comment) + '\n';
  }
  void add(const char* key, unsigned long long value, const char* comment = "") { add(key, std::to_string(value), comment); }
  void add(const char* key, bool value, const char* comment = "") { add(key, std::string(value ? "true" : "false"), comment); }
  void add(const char* key, double value, const char* comment = "") {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    std::string number = buffer;
    if (number.find_first_of(".en") == std::string::npos) number += ".0";  // a TOML float needs one of them
    add(key, number, comment);
  }
  /// Adds seconds, or a fraction of seconds.
  void add_time(const char* key, double value, const char* comment = "") {
    if (times_ == Times::Told) add(key, value, comment);
  }
  const std::string& text() const { return text_; }

 private:
  static std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size() + 1, width), ' ');
    return text;
  }
  Times times_;
  std::string text_;
};

double ratio(unsigned long long part, unsigned long long whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::string array_of(const std::vector<std::string>& texts) {
  std::string array;
  for (const std::string& text : texts) array += (array.empty() ? "" : ", ") + toml_string(text);
  return '[' + array + ']';
}

void add_run(Lines& lines, const Summary& s) {
  lines.section("run");
  lines.add("scene", toml_string(s.scene.name));
  if (!s.scene.overrides.empty()) lines.add("set", array_of(s.scene.overrides), "in place of the scene's values");
  lines.add("seed", static_cast<unsigned long long>(s.scene.seed));
  lines.add("container", toml_string(kind_of(s.scene.container)));
  lines.add("bodies", static_cast<unsigned long long>(s.scene.grains_at_start()),
            s.scene.changes_population() ? "at the start" : "");
  for (const GrainCount& entry : s.scene.kinds) {
    lines.add(("bodies_of." + entry.kind.name).c_str(), static_cast<unsigned long long>(entry.count));
  }
  lines.add("steps", static_cast<unsigned long long>(s.steps));
  if (s.scene.solver.stepper)
    lines.add("parts", s.simulation.stepper.costs().parts, "of steps: after an impact the stepper ends a step early");
  lines.add("simulated", s.steps * s.scene.time.step, "s");
  lines.add("interrupted", s.interrupted, "whether the run ended before time.duration");
}

void add_sizes(Lines& lines, const std::vector<DrawnSizes>& all) {
  if (all.empty()) return;
  lines.section("sizes");
  for (const DrawnSizes& sizes : all) {
    const auto add = [&](const char* key, auto value, const char* comment = "") {
      lines.add((sizes.kind + '.' + key).c_str(), value, comment);
    };
    add("number", static_cast<unsigned long long>(sizes.number));
    add("mass", sizes.mass, "kg, of all");
    add("mean", sizes.mean, "m, of the sieve sizes: the middle one of a grain's three widths; by number");
    add("standard_deviation", sizes.standard_deviation, "m");
    add("smallest", sizes.smallest, "m");
    add("largest", sizes.largest, "m");
    add("median", sizes.median, "m, by number");
    add("d10", sizes.by_mass[0], "m, below which a tenth of the mass is");
    add("d50", sizes.by_mass[1], "m, half of the mass");
    add("d90", sizes.by_mass[2], "m, nine tenths of the mass");
  }
}

unsigned long long contacts_ahead(const Summary& s) {
  if (s.scene.solver.stepper) return s.simulation.stepper.costs().contacts_ahead;
  const std::vector<supernormal::effects::Cost> costs = s.simulation.effect_costs();
  const auto cost = std::ranges::find(costs, std::string_view("speculative_contacts"), &supernormal::effects::Cost::name);
  return cost == costs.end() ? 0 : cost->contacts;
}

void add_queries(Lines& lines, const Summary& s) {
  const snStatistics& n = s.statistics;
  const Stepper& stepper = s.simulation.stepper;
  const auto steps = static_cast<unsigned long long>(s.steps);
  lines.section("collision");
  lines.add("pairs_tested", stepper.costs().pairs_tested, "whose bounding boxes met, in all steps");
  lines.add("sweep_axis", toml_string(name_of(s.simulation.world.sweep().axis())), "of the broad phase, in the last step");
  if (s.scene.query) lines.add("solver", toml_string(name_of(s.scene.query->solver)), "of the queries of two smooth bodies");
  lines.add("queries_cold", n.queries_cold, "pairs without a remembered normal; mesh and ground have none");
  lines.add("queries_warm", n.queries_warm, "with one");
  lines.add("evaluations_per_cold_query", ratio(n.evaluations_cold, n.queries_cold), "of the gap function, mean");
  lines.add("evaluations_per_warm_query", ratio(n.evaluations_warm, n.queries_warm));
  lines.add("closed_forms", n.closed_forms, "pairs settled without iteration: grain and wall");
  lines.add("not_converged", n.not_converged, "queries whose error bound exceeds the tolerance");
  if (n.not_converged > 0) {
    lines.add("stalled", n.stalled, "of these, without further ascent in double precision");
    lines.add("out_of_evaluations", n.out_of_evaluations, "of these, with max_evaluations used up");
    lines.add("diverged", n.diverged, "of these, out of the domain of an unguarded solver");
    lines.add("contacts_not_converged", n.contacts_not_converged,
              "of these queries; they separate the bodies, along an estimated normal");
  }
  lines.add("contacts", stepper.costs().contacts, "in all steps");
  if (s.scene.looks_ahead()) lines.add("contacts_ahead", contacts_ahead(s), "of these, ahead of touch: the bodies were apart");
  lines.add("contacts_per_step", ratio(stepper.costs().contacts, steps), "mean");
  lines.add("contacts_at_end", static_cast<unsigned long long>(stepper.contacts()), "in the last step");
  lines.add("deepest_contact", stepper.deepest_contact(), "m, of all steps: grains hit one another in flight");
}

void add_bed(Lines& lines, const Bed& bed, const char* about_height) {
  lines.add("bed_height", bed.height, about_height);
  lines.add("volume_fraction", bed.volume_fraction,
            "of the slab from 5 % to 80 % of bed_height, from wall to wall; overlaps count once");
  lines.add("volume_fraction_standard_error", bed.standard_error, "of the sampling (stratified points, snGeomPointDepth)");
}

void add_end_state(Lines& lines, const Summary& s) {
  const double size = s.scene.smallest_half_axis();
  const Watches& watches = s.simulation.watches;
  lines.section("end");
  lines.add("smallest_half_axis", size, "m, of all grains");
  lines.add("deepest_overlap", s.overlap.depth, "m, over all pairs of grains and walls");
  lines.add("deepest_overlap_relative", s.overlap.depth / size, "to smallest_half_axis");
  lines.add("deepest_overlap_of_pair", s.overlap.relative_to_pair, "largest of depth / smallest half-axis of the pair itself");
  lines.add("overlapping_pairs", static_cast<unsigned long long>(s.overlap.pairs));
  lines.add("bodies_outside", static_cast<unsigned long long>(s.outside), "beyond a wall or the floor, or below all parts");
  lines.add("bodies_leaked", static_cast<unsigned long long>(watches.leaks.count()), "outside after any step");
  if (s.scene.gravity() != nullptr) {
    const double height = kinetic_height(s.simulation.world, s.scene);
    lines.add("kinetic_height", height, "m, to which the kinetic energy would lift all grains");
    lines.add("settled", height < kSettledHeight * size, "kinetic_height below 0.1 % of smallest_half_axis");
  }
  lines.add("largest_kinetic_energy", largest_kinetic_energy(s.simulation.world), "J, of the grain that has most");
  lines.add("energy_lost", watches.energy.lost(), "J, from the start to the least of all steps");
  lines.add("energy_gained", watches.energy.gained(), "J, largest rise over any step before");
  if (s.bed) add_bed(lines, *s.bed, "m, twice the mean height of the grains' volume");
}

/// Adds the mass flow and the mass flow of Beverloo's law. Keys without a value, as before any discharge, are left out.
void add_mass_flow(Lines& lines, const Scene& scene, const Hopper& hopper, const Discharge& discharge) {
  const Charge& charge = *discharge.charge();
  const std::optional<double> flow = discharge.mass_flow();
  if (flow) lines.add("mass_flow", *flow, "kg/s, mean from 20 % to 60 % of the charge");
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr) return;
  const double predicted =
      beverloo_mass_flow(hopper.outlet, charge.grain_diameter, charge.bed.bulk_density, gravity->acceleration.norm());
  lines.add("beverloo", predicted, "kg/s, 0.58 rho_b sqrt(g) (D - 1.4 d)^2.5 (Beverloo et al. 1961), flat bottom");
  if (flow && predicted > 0) lines.add("mass_flow_relative", *flow / predicted, "to beverloo");
}

void add_discharge(Lines& lines, const Scene& scene, const Discharge& discharge) {
  const auto& hopper = std::get<Hopper>(scene.container);
  lines.section("discharge");
  lines.add("opened", discharge.charge().has_value());
  if (!discharge.charge()) return;
  const Charge& charge = *discharge.charge();
  lines.add("opened_at", charge.time, "s");
  lines.add("charge", charge.mass, "kg, all grains");
  lines.add("grain_diameter", charge.grain_diameter, "m, d: of the sphere of the grains' mean volume");
  lines.add("outlet_relative", hopper.outlet / charge.grain_diameter, "diameter D of the outlet / d");
  add_bed(lines, charge.bed, "m, above the outlet when it opens, of a level bed with the grains' mean height");
  lines.add("bulk_density", charge.bed.bulk_density, "kg/m^3, rho_b, of the same slab");
  lines.add("discharged", discharge.mass(), "kg");
  lines.add("discharged_grains", static_cast<unsigned long long>(discharge.count()), "whose centre has passed the outlet");
  if (discharge.count() > 0) lines.add("last_passage", discharge.last_passage(), "s");
  add_mass_flow(lines, scene, hopper, discharge);
}

void add_amount(Lines& lines, const std::string& name, const Amount& amount, const char* comment = "") {
  lines.add((name + ".grains").c_str(), amount.grains, comment);
  lines.add((name + ".mass").c_str(), amount.mass, "kg");
}

void add_population(Lines& lines, const Summary& s) {
  const Population& population = s.simulation.population;
  lines.section("population");
  add_amount(lines, "at_start", population.at_start());
  add_amount(lines, "fed", population.fed(), "by all feeders");
  add_amount(lines, "taken", population.taken(), "by all sinks");
  add_amount(lines, "present", population.present(), "at the end: at_start + fed - taken");
  for (const Feeding& feeding : population.feeders()) {
    for (std::size_t i = 0; i < feeding.feeder().mixture.size(); ++i) {
      add_amount(lines, "fed_by." + feeding.feeder().name + '.' + feeding.kind(i).name, feeding.state().fed[i]);
    }
  }
  for (std::size_t sink = 0; sink < s.scene.sinks.size(); ++sink) {
    for (std::size_t kind = 0; kind < s.scene.kinds.size(); ++kind) {
      const Amount& taken = population.taken(sink)[kind];
      add_amount(lines, "taken_by." + s.scene.sinks[sink].name + '.' + s.scene.kinds[kind].kind.name, taken);
    }
  }
}

void add_bonds(Lines& lines, const Scene& scene, const Bonds& bonds) {
  std::map<std::string, unsigned long long> by_cause;
  for (const BondBreak& failure : bonds.breaks()) ++by_cause[cause_of(failure, scene.bonds[bonds.all()[failure.bond].rule])];
  lines.section("bonds");
  lines.add("at_start", static_cast<unsigned long long>(bonds.all().size()));
  lines.add("broken", static_cast<unsigned long long>(bonds.breaks().size()));
  for (const auto& [cause, number] : by_cause) lines.add(("broken_by." + cause).c_str(), number);
  lines.add("elastic_energy", bonds.energy(), "J, at the end");
}

void add_packing(Lines& lines, const Packing& packing) {
  lines.section("packing");
  lines.add("cell_side", packing.side, "m");
  lines.add("volume_fraction", packing.volume_fraction, "volume of the grains / of the cell");
  lines.add("volume_fraction_at_contact", packing.at_contact, "of grains shrunk by mean_overlap");
  lines.add("mean_overlap", packing.overlap.relative,
            "of all contacts, relative to the distance of their tangent planes from centre to centre");
  lines.add("contacts_per_grain", packing.contacts_per_grain, "that overlap in the last step, mean; rattlers included");
}

void add_heap(Lines& lines, const Heap& heap) {
  lines.section("heap");
  if (!heap.has_flank) {
    lines.add("heap_grains", static_cast<unsigned long long>(heap.grains), "on the dish, none where the flank is measured");
    return;
  }
  lines.add("angle_of_repose", heap.angle, "degrees, of the flank from a quarter to 85 % of the dish's radius");
  lines.add("angle_standard_error", heap.standard_error, "degrees, of the mean of twelve sectors");
  lines.add("heap_height", heap.height, "m, of the flank continued to the axis, above the dish");
  lines.add("heap_grains", static_cast<unsigned long long>(heap.grains), "on the dish");
}

void add_costs(Lines& lines, const Summary& s) {
  const StepCosts& c = s.simulation.stepper.costs();
  const double total = s.real_seconds;
  const double narrow = c.narrow_phase_seconds();
  const double solver = c.solver.seconds();
  lines.section("cost");
  lines.add_time("real", total, "s, steps and output");
  lines.add_time("real_per_step", total / s.steps, "s");
  lines.add_time("share_broad_phase", c.broad_phase.seconds() / total, "bounding boxes, the sweep along them, and walls");
  lines.add_time("share_narrow_phase", narrow / total, "contacts of the pairs, on all threads");
  lines.add_time("share_contact_setup", c.contact_setup.seconds() / total, "contact joints made and removed");
  lines.add_time("share_solver", solver / total, s.scene.solver.stepper ? "snStepperStep" : "dWorldQuickStep");
  if (s.simulation.world.bonds() != nullptr) lines.add_time("share_bonds", c.bonds.seconds() / total, "forces and breaks of bonds");
  const double known = c.collision.seconds() + c.contact_setup.seconds() + solver + c.bonds.seconds();
  lines.add_time("share_output", (total - known) / total, "the rest");
  if (s.checkpoints.number > 0) {
    lines.add("checkpoints", s.checkpoints.number, "written");
    lines.add_time("checkpoint_seconds", s.checkpoints.watch.seconds(), "s, besides real: to write them and to go on from them");
  }
  lines.add_time("seconds_per_pair", c.pairs_tested == 0 ? 0 : narrow / static_cast<double>(c.pairs_tested), "s, of narrow phase");
}

/// Adds the cost of the joints of driven walls, of the bonds, and of each effect that the scene names, rigid contact first. The
/// seconds are the time of its own passes and, by rows, its share of the solver's time.
void add_costs_by_rows(Lines& lines, const Summary& s) {
  constexpr const char* kSeconds = "s, in its passes and its rows' share of the solver";
  const StepCosts& c = s.simulation.stepper.costs();
  const Bonds* const bonds = s.simulation.world.bonds();
  const std::vector<supernormal::effects::Cost> effects = s.simulation.effect_costs();
  unsigned long long rows = c.rows_of_walls + (bonds == nullptr ? 0 : bonds->rows());
  for (const supernormal::effects::Cost& cost : effects) rows += cost.rows;
  if (c.rows_of_walls > 0) {
    lines.add_time("walls.seconds", ratio(c.rows_of_walls, rows) * c.solver.seconds(), "s, their joints' share of the solver");
    lines.add("walls.rows", c.rows_of_walls, "constraint rows added by joints of driven walls");
  }
  if (c.contacts_of_walls > 0) lines.add("walls.contacts", c.contacts_of_walls, "between walls, in rigid_contact too");
  if (bonds != nullptr) {
    const double seconds = c.bonds.seconds() + ratio(bonds->rows(), rows) * c.solver.seconds();
    lines.add_time("bonds.seconds", seconds, kSeconds);
    lines.add("bonds.rows", static_cast<unsigned long long>(bonds->rows()), "constraint rows added");
  }
  for (const supernormal::effects::Cost& cost : effects) {
    const std::string section = std::string("effect.") + cost.name + ".";
    const auto add = [&](const char* key, auto value, const char* comment) { lines.add((section + key).c_str(), value, comment); };
    lines.add_time((section + "seconds").c_str(), cost.seconds + ratio(cost.rows, rows) * c.solver.seconds(), kSeconds);
    if (cost.rows > 0) add("rows", cost.rows, "constraint rows added");
    const bool is_ahead = std::string_view(cost.name) == "speculative_contacts";
    if (cost.contacts > 0) add("contacts", cost.contacts, is_ahead ? "ahead of touch" : "touched");
    if (cost.coarse > 0) add("coarse", cost.coarse, "contacts of fewer than ten steps: a shorter step would be better");
    if (cost.bodies > 0) add("bodies", cost.bodies, "visited");
  }
}

void add_measurement_costs(Lines& lines, const Summary& s) {
  for (const MeasurementCost& cost : s.measurements) {
    const std::string section = "measurement." + cost.name + ".";
    const auto add = [&](const char* key, auto value, const char* comment) { lines.add((section + key).c_str(), value, comment); };
    lines.add_time((section + "seconds").c_str(), cost.seconds, "s");
    add("samples", cost.state.samples, "");
    add("lines", cost.state.lines, "of its table");
  }
  if (!s.measurements.empty())
    lines.add_time("measured_contacts_seconds", s.seconds_of_contacts, "s, shared: contacts put together");
}

}  // namespace

std::string to_toml(const Summary& summary, Times times) {
  Lines lines(times);
  add_run(lines, summary);
  add_sizes(lines, summary.sizes);
  add_queries(lines, summary);
  add_end_state(lines, summary);
  const Watches& watches = summary.simulation.watches;
  if (watches.discharge) add_discharge(lines, summary.scene, *watches.discharge);
  if (summary.scene.changes_population()) add_population(lines, summary);
  if (const Bonds* const bonds = summary.simulation.world.bonds()) add_bonds(lines, summary.scene, *bonds);
  if (watches.compressor) add_packing(lines, watches.compressor->packing());
  if (summary.heap) add_heap(lines, *summary.heap);
  add_costs(lines, summary);
  add_costs_by_rows(lines, summary);
  add_measurement_costs(lines, summary);
  return lines.text();
}

}  // namespace falling_particles
