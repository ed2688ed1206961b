#include "atlas_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "csv_table.hpp"
#include "text.hpp"

namespace accuracy_cost {
namespace {

constexpr std::array kClasses = {"E", "M", "B", "O", "N"};
constexpr std::array kClassNames = {"ellipsoids", "exponents 1.3…5", "exponents 6…20", "exponents 1.1…1.3", "needles"};
constexpr std::array kPoses = {"T", "S", "D", "N", "F"};
constexpr std::array kPoseNames = {"touching", "1 % overlap", "30 % overlap", "1 % apart", "far"};

std::string microseconds(double seconds) { return text(seconds < 1e-5 ? "%.2f" : "%.1f", 1e6 * seconds); }
std::string milliseconds(double seconds) { return text("%.2f", 1e3 * seconds); }

void write_row(std::ostream& out, const std::vector<std::string>& cells) {
  out << '|';
  for (const std::string& cell : cells) out << ' ' << cell << " |";
  out << '\n';
}

void write_head(std::ostream& out, const std::vector<std::string>& cells, std::size_t texts) {
  write_row(out, cells);
  out << '|';
  for (std::size_t k = 0; k < cells.size(); ++k) out << (k < texts ? "---|" : "---:|");
  out << '\n';
}

struct MethodName {
  const char* name;
  const char* accuracy;
};
constexpr std::array<MethodName, 10> kCompared = {{{"hybrid", "1e-09"},
                                                   {"hybrid (warm)", "1e-09"},
                                                   {"hybrid (early out)", "1e-09"},
                                                   {"Newton (Algorithm I)", "1e-09"},
                                                   {"fixed point (Algorithm II)", "1e-09"},
                                                   {"libccd GJK+EPA", "1e-06"},
                                                   {"libccd MPR", "1e-04"},
                                                   {"Bullet GJK+EPA (float)", ""},
                                                   {"FCL signed distance", "1e-06"},
                                                   {"Simbody MPR+Newton", "1e-09"}}};

/// The row of a method for one class and pose.
const Row* find_method(const CsvTable& table, const char* body_class, const char* pose, const MethodName& method) {
  return table.find({{"class", body_class}, {"pose", pose}, {"method", method.name}, {"accuracy", method.accuracy}});
}

void write_queries(const CsvTable& table, std::ostream& out) {
  out << "## Queries\n\n"
         "Median / 99th percentile of the time in µs; median error of the gap, of the normal (rad) and of the contact point (gap "
         "and "
         "point\nrelative to the smallest half-axis); failures: no answer, wrong verdict, or wrong by more than 10 % of the gap + "
         "0.001 of the\n"
         "half-axis. A dash: the method does not tell it (of bodies apart libccd says only that they are).\n\n"
         "![exponents 1.3 to 5](query_M.svg)\n![exponents 6 to 20](query_B.svg)\n\n"
         "More figures: [ellipsoids](query_E.svg), [octahedral](query_O.svg), [needles](query_N.svg).\n\n";
  write_head(out, {"class", "pose", "method", "accuracy", "time", "evaluations", "gap", "normal", "point", "failures"}, 4);
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    for (std::size_t p = 0; p < kPoses.size(); ++p) {
      for (const MethodName& method : kCompared) {
        const Row* const row = find_method(table, kClasses[c], kPoses[p], method);
        if (row == nullptr) continue;
        const auto get = [&](const char* column) { return number_in(*row, column); };
        write_row(out, {kClassNames[c], kPoseNames[p], method.name, method.accuracy,
                        microseconds(get("time_s")) + " / " + microseconds(get("time_p99_s")),
                        get("evaluations") > 0 ? text("%.3g", get("evaluations")) : "–", text("%.0e", get("gap_error")),
                        text("%.0e", get("normal_error")), text("%.0e", get("contact_error")),
                        row->at("failures") + " of " + row->at("queries")});
      }
    }
  }
  out << '\n';
}

void write_digits(const CsvTable& table, std::ostream& out) {
  constexpr std::array kTolerances = {"1e-01", "1e-02", "1e-03", "1e-04", "1e-06", "1e-09", "1e-12", "1e-14"};
  out << "## What each digit costs\n\nThe hybrid at 1 % overlap: median time in µs over its tolerance, and the worst error over "
         "the tolerance.\n\n";
  std::vector<std::string> head = {"class", "start"};
  head.insert(head.end(), kTolerances.begin(), kTolerances.end());
  head.emplace_back("worst error / tolerance");
  write_head(out, head, 2);
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    for (const bool warm : {false, true}) {
      std::vector<std::string> cells = {kClassNames[c], warm ? "warm" : "cold"};
      double worst = 0;
      for (const char* tolerance : kTolerances) {
        const Row* const row = find_method(table, kClasses[c], "S", {warm ? "hybrid (warm)" : "hybrid", tolerance});
        cells.push_back(row == nullptr ? "–" : microseconds(number_in(*row, "time_s")));
        const double asked = std::strtod(tolerance, nullptr);
        if (row != nullptr && asked > 1e-13) worst = std::max(worst, number_in(*row, "gap_error_worst") / asked);
      }
      cells.push_back(text("%.2g", worst));
      write_row(out, cells);
    }
  }
  out << '\n';
}

void write_ratios(const CsvTable& table, std::ostream& out) {
  out << "## Ratios\n\n"
         "Median time of the other over that of the hybrid at its default tolerance, cold; then warm over cold. Of bodies apart "
         "libccd\n"
         "says only that they are, and is compared with the hybrid that stops when it knows as much (early out).\n\n";
  write_head(out, {"class", "pose", "libccd GJK+EPA 1e-6", "libccd MPR 1e-4", "Bullet", "FCL 1e-6", "Simbody 1e-9", "cold / warm"},
             2);
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    for (std::size_t p = 0; p < kPoses.size(); ++p) {
      const auto time = [&](const MethodName& method) {
        const Row* const row = find_method(table, kClasses[c], kPoses[p], method);
        return row == nullptr ? std::nan("") : number_in(*row, "time_s");
      };
      const double hybrid = time(kCompared[0]);
      std::vector<std::string> cells = {kClassNames[c], kPoseNames[p]};
      const bool is_apart = p >= 3;
      for (std::size_t m = 5; m < kCompared.size(); ++m) {
        const bool is_verdict = is_apart && std::string_view(kCompared[m].name).starts_with("libccd");
        cells.push_back(text("%.1f", time(kCompared[m]) / (is_verdict ? time(kCompared[2]) : hybrid)));
      }
      cells.push_back(text("%.2f", hybrid / time(kCompared[1])));
      write_row(out, cells);
    }
  }
  out << '\n';
}

void write_floor(const CsvTable& table, std::ostream& out) {
  out << "## One evaluation and its floor\n\n"
         "Both bodies, at 1 % overlap, in ns. The floor are the eight logarithms and eight exponentials of the C library that two\n"
         "superellipsoids cannot do without (none of ellipsoids); the overhead is what the hybrid, cold, takes beyond its "
         "evaluations of "
         "h, r and H.\n\n";
  write_head(out, {"class", "floor", "h and r", "over the floor", "h, r and H", "evaluations", "overhead"}, 1);
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    const auto time = [&](const char* method) {
      return table.value({{"class", kClasses[c]}, {"pose", "S"}, {"method", method}, {"accuracy", ""}}, "time_s");
    };
    const Row* const hybrid = find_method(table, kClasses[c], "S", kCompared[0]);
    if (hybrid == nullptr) continue;
    const double floor = time("logarithms and exponentials");
    const double evaluations = number_in(*hybrid, "evaluations");
    const bool has_floor = c > 0;
    write_row(out, {kClassNames[c], has_floor ? text("%.0f", 1e9 * floor) : "–", text("%.0f", 1e9 * time("h and r")),
                    has_floor ? text("%.2f", time("h and r") / floor) : "–", text("%.0f", 1e9 * time("h and r and H")),
                    text("%.3g", evaluations),
                    text("%.0f %%", 100 * (number_in(*hybrid, "time_s") / (evaluations * time("h and r and H")) - 1))});
  }
  out << '\n';
}

/// The results of a method for a class of bodies.
struct Compared {
  std::string accuracy;
  double time = 0, warm_time = std::nan(""), evaluations = 0, error = 0;
  double no_answer = 0, wrong_verdict = 0, wrong_gap = 0, inexact = 0, queries = 0;
};

/// The rows of a method for a class at 1 % overlap, for all its accuracies.
std::vector<const Row*> accuracies_of(const CsvTable& table, const char* body_class, const std::string& method) {
  std::vector<const Row*> rows;
  for (const Row& row : table.rows()) {
    if (row.at("class") == body_class && row.at("pose") == "S" && row.at("method") == method) rows.push_back(&row);
  }
  return rows;
}

/// The loosest accuracy with a median gap error below 1e-9, cold or warm. If there is none, the tightest.
const Row& precise_enough(const std::vector<const Row*>& rows) {
  constexpr double kWanted = 1e-9;
  for (const Row* const row : rows) {
    if (number_in(*row, "gap_error") < kWanted) return *row;
  }
  return *rows.back();
}

Compared compared_at(const CsvTable& table, const char* body_class, const Row& chosen) {
  const std::string& method = chosen.at("method");
  Compared result;
  result.accuracy = chosen.at("accuracy");
  result.time = number_in(chosen, "time_s");
  result.evaluations = number_in(chosen, "evaluations");
  result.error = number_in(chosen, "gap_error");
  const std::vector<const Row*> warm = accuracies_of(table, body_class, method + " (warm)");
  if (!warm.empty()) result.warm_time = number_in(precise_enough(warm), "time_s");
  for (const char* pose : kPoses) {
    const Row* const row = table.find({{"class", body_class}, {"pose", pose}, {"method", method}, {"accuracy", result.accuracy}});
    if (row == nullptr) continue;
    result.no_answer += number_in(*row, "no_answer");
    result.wrong_verdict += number_in(*row, "wrong_verdict");
    result.wrong_gap += number_in(*row, "wrong_gap");
    result.inexact += number_in(*row, "inexact");
    result.queries += number_in(*row, "queries");
  }
  return result;
}

Compared compared(const CsvTable& table, const char* body_class, const std::string& method) {
  return compared_at(table, body_class, precise_enough(accuracies_of(table, body_class, method)));
}

/// The names of the methods in order, without warm-started ones.
std::vector<std::string> cold_methods(const CsvTable& table, const char* body_class) {
  std::vector<std::string> names;
  for (const Row& row : table.rows()) {
    const std::string& name = row.at("method");
    if (row.at("class") != body_class || name.ends_with("(warm)")) continue;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

void write_literature(const CsvTable& table, std::ostream& out) {
  constexpr const char* kReference = "surface angles (2)";
  const std::string algorithm1 = "Newton (Algorithm I)";
  out << "## The methods of the literature\n\n"
         "Each method at the loosest of its accuracies at which the median error of the gap is below 1e-9 of the smallest "
         "half-axis,\n"
         "or at its tightest. Meshes have their number of vertices there, and all of their sizes. Time, evaluations and error at 1 "
         "%\n"
         "overlap; failures in all five situations. Off: gaps that were told and are off by more than 1e-6.\n\n";
  write_head(out,
             {"class", "method", "accuracy", "cold, µs", "warm, µs", "evaluations", "error", "no answer", "wrong verdict",
              "wrong gap", "off", "of"},
             3);
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    for (const std::string& method : cold_methods(table, kClasses[c])) {
      const bool is_mesh = method == "dTriMesh" || method == "libccd GJK+EPA on hulls";
      for (const Row* const row : accuracies_of(table, kClasses[c], method)) {
        const Compared m = is_mesh ? compared_at(table, kClasses[c], *row) : compared(table, kClasses[c], method);
        const auto count = [](double value) { return text("%.0f", value); };
        write_row(out, {kClassNames[c], method, m.accuracy, microseconds(m.time), microseconds(m.warm_time),
                        m.evaluations > 0 ? text("%.3g", m.evaluations) : "–", text("%.0e", m.error), count(m.no_answer),
                        count(m.wrong_verdict), count(m.wrong_gap), count(m.inexact), count(m.queries)});
        if (!is_mesh) break;
      }
    }
  }
  out << "\n### Algorithm I beside the reference method\n\n"
         "The time of the Newton iteration in four surface angles over that of Algorithm I, each as accurate as above.\n\n";
  write_head(out, {"class", "cold", "warm"}, 1);
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    if (cold_methods(table, kClasses[c]).empty()) continue;
    const Compared reference = compared(table, kClasses[c], kReference), ours = compared(table, kClasses[c], algorithm1);
    write_row(out, {kClassNames[c], text("%.1f", reference.time / ours.time), text("%.1f", reference.warm_time / ours.warm_time)});
  }
  out << '\n';
}

void write_boxes(const CsvTable& table, std::ostream& out) {
  out << "## Bounding boxes\n\n"
         "1000 bodies of each class in random orientations, which fill 60 % of a cube. Times in µs for each body; volume over that "
         "of\n"
         "the smallest box, median and 99th percentile; pairs of overlapping boxes for each body, and those of them whose bodies "
         "are\n"
         "apart. The narrow phase needs the last times for these: the hybrid, which stops when it knows that they are. What it "
         "does with\n"
         "the others is the same for all boxes. Failures: no box, or one that is too small.\n\n";
  write_head(out, {"class", "box", "time", "volume", "99 %", "failures", "pairs", "apart", "their time", "box + their time"}, 2);
  for (const Row& row : table.rows()) {
    const auto get = [&](const char* column) { return number_in(row, column); };
    const auto c = static_cast<std::size_t>(std::find(kClasses.begin(), kClasses.end(), row.at("class")) - kClasses.begin());
    write_row(out, {kClassNames.at(c), row.at("box"), text("%.3f", 1e6 * get("time_s")), text("%.2f", get("volume")),
                    text("%.2f", get("volume_p99")), row.at("failures"), text("%.1f", get("pairs")), text("%.1f", get("apart")),
                    text("%.2f", 1e6 * get("narrow_s")), text("%.2f", 1e6 * (get("time_s") + get("narrow_s")))});
  }
  out << '\n';
}

void write_meshes(const CsvTable& table, std::ostream& out) {
  out << "## ODE's polyhedra\n\nAt 1 % overlap: median time in µs, median error of the gap, failures, over the number of "
         "vertices.\n\n";
  write_head(out, {"class", "method", "vertices", "time", "gap", "failures"}, 2);
  for (std::size_t c = 0; c < kClasses.size(); ++c) {
    for (const Row& row : table.rows()) {
      if (row.at("class") != kClasses[c] || row.at("pose") != "S") continue;
      const bool is_ours = row.at("method").starts_with("hybrid");
      write_row(out, {kClassNames[c], row.at("method"), is_ours ? "–" : row.at("accuracy"), microseconds(number_in(row, "time_s")),
                      text("%.0e", number_in(row, "gap_error")), row.at("failures") + " of " + row.at("queries")});
    }
  }
  out << '\n';
}

void write_colliders(const CsvTable& table, std::ostream& out) {
  out << "## Colliders\n\nA superellipsoid with exponents 4 that overlaps ODE's geoms by 2 %: a dCollide, over tolerance or number "
         "of "
         "vertices.\n\n![colliders](colliders.svg)\n\n";
  write_head(out, {"collider", "method", "accuracy", "time µs", "depth error", "worst", "contacts", "misses"}, 3);
  for (const Row& row : table.rows()) {
    const bool is_ours = row.at("method").starts_with("Supernormal");
    const std::string& accuracy = row.at("accuracy");
    if (is_ours && accuracy != "1e-02" && accuracy != "1e-04" && accuracy != "1e-09" && accuracy != "1e-12") continue;
    write_row(out, {row.at("collider"), row.at("method"), accuracy, microseconds(number_in(row, "time_s")),
                    text("%.0e", number_in(row, "depth_error")), text("%.0e", number_in(row, "depth_error_worst")),
                    text("%.3g", number_in(row, "contacts")), row.at("misses")});
  }
  out << '\n';
}

void write_forms(const CsvTable& table, std::ostream& out) {
  const Row* const ours = table.find({{"form", "Supernormal"}});
  if (ours == nullptr) return;
  out << "## A bed of 1000 grains\n\n"
         "One step of the settled bed in ms, one thread but where it says so, the same step and the same grains for all; contacts "
         "per "
         "step. The last\ncolumns are times over ours: of the whole step, and of finding the contacts (broad and narrow "
         "phase).\n\n";
  write_head(
      out,
      {"form", "vertices", "pairs", "contacts", "broad", "narrow", "joints", "quickstep", "step", "step / ours", "finding / ours"},
      1);
  const auto finding = [](const Row& row) { return number_in(row, "broad_s") + number_in(row, "narrow_s"); };
  for (const Row& row : table.rows()) {
    const auto get = [&](const char* column) { return number_in(row, column); };
    const bool is_mesh = row.at("form") == "dConvex" || row.at("form") == "dTriMesh";
    write_row(out, {row.at("form"), is_mesh ? row.at("accuracy") : "", text("%.0f", get("pairs")), text("%.0f", get("contacts")),
                    milliseconds(get("broad_s")), milliseconds(get("narrow_s")), milliseconds(get("joints_s")),
                    milliseconds(get("solver_s")), milliseconds(get("step_s")),
                    text("%.2f", get("step_s") / number_in(*ours, "step_s")), text("%.2f", finding(row) / finding(*ours))});
  }
  out << "\nQuickstep takes " << milliseconds(number_in(*ours, "solver_s")) << " ms of our "
      << milliseconds(number_in(*ours, "step_s"))
      << " ms and does not care what the grains are: no geometry, however fast, could make the step more than "
      << text("%.1f", number_in(*ours, "step_s") / (number_in(*ours, "solver_s") + number_in(*ours, "joints_s")))
      << " times faster than ours is.\n\n";
}

void write_growth(const CsvTable& table, std::ostream& out) {
  out << "## More grains\n\n"
         "One step of the bed in ms, in each of ODE's spaces; the bed of 500 grains is laid out again and again, side by side. The "
         "last row is the exponent\n"
         "x of N^x between the smallest and the largest.\n\n![growth](growth.svg)\n\n";
  write_head(out, {"space", "grains", "broad", "narrow", "quickstep", "step"}, 1);
  std::map<std::string, std::pair<const Row*, const Row*>> ends;
  for (const Row& row : table.rows()) {
    const auto get = [&](const char* column) { return number_in(row, column); };
    auto& [first, last] = ends[row.at("space")];
    if (first == nullptr) first = &row;
    last = &row;
    write_row(out, {row.at("space"), row.at("grains"), milliseconds(get("broad_s")), milliseconds(get("narrow_s")),
                    milliseconds(get("solver_s")), milliseconds(get("step_s"))});
  }
  for (const auto& [space, pair] : ends) {
    const auto& [first, last] = pair;
    const double size = std::log(number_in(*last, "grains") / number_in(*first, "grains"));
    const auto exponent = [&, f = first, l = last](const char* column) {
      return text("**%.2f**", std::log(number_in(*l, column) / number_in(*f, column)) / size);
    };
    write_row(out, {space, "exponent", exponent("broad_s"), exponent("narrow_s"), exponent("solver_s"), exponent("step_s")});
  }
  out << '\n';
}

void write_outcomes(const CsvTable& table, std::ostream& out) {
  out << "## What comes out of it\n\n"
         "1000 grains fall into a box and settle (0.6 s). All beds are measured with the same ruler: the exact grains in the "
         "places that they\n"
         "have come to. Deepest overlap relative to the smaller half-axis of the pair; share of the volume; the largest rise of "
         "the energy over\n"
         "what was lost; and, of a single body, the error of the period of an ellipsoid that rocks on a dBox, which is known "
         "exactly.\n\n"
         "![outcomes](outcomes.svg)\n\n";
  write_head(
      out,
      {"form", "accuracy", "step, ms", "narrow, ms", "contacts", "deepest overlap", "volume fraction", "energy gained", "period"},
      1);
  for (const Row& row : table.rows()) {
    const auto get = [&](const char* column) { return number_in(row, column); };
    write_row(out, {row.at("form"), row.at("accuracy"), milliseconds(get("step_s")), milliseconds(get("narrow_s")),
                    text("%.0f", get("contacts")), text("%.3f", get("overlap")), text("%.3f", get("volume_fraction")),
                    text("%.0e", get("energy_gained")),
                    std::isnan(get("rocking_error")) ? "does not rock" : text("%.0e", get("rocking_error"))});
  }
  out << '\n';
}

/// Writes conclusions. Their figures are in the tables below them.
void write_reading(const CsvTable& query, const CsvTable& forms, const CsvTable& outcomes, std::ostream& out) {
  out << "## Reading\n\n";
  const auto time = [&](const char* tolerance) {
    const Row* const row = find_method(query, "M", "S", {"hybrid", tolerance});
    return row == nullptr ? std::nan("") : number_in(*row, "time_s");
  };
  out << "* **Digits are cheap.** From 1e-2 to 1e-12 a query of two superellipsoids with moderate exponents becomes "
      << text("%.2f", time("1e-12") / time("1e-02"))
      << " times as expensive; at 1 % overlap EPA takes more for two digits than we for all of them. Only where bodies with sharp "
         "edges overlap deeply does our search for the shortest way out cost more than EPA, which does not search.\n";
  double smallest = 1;
  double largest = 0;
  for (const Row& row : outcomes.rows()) {
    if (row.at("form") != "Supernormal") continue;
    smallest = std::min(smallest, number_in(row, "volume_fraction"));
    largest = std::max(largest, number_in(row, "volume_fraction"));
  }
  out << "* **A simulation cannot tell the tolerances apart.** Beds settled with tolerances from 1e-1 to 1e-12 have volume "
         "fractions of "
      << text("%.3f", smallest) << " to " << text("%.3f", largest)
      << " in no order, which is how runs of a chaotic scene differ; their times differ as little. So there is nothing to gain "
         "from a looser "
         "tolerance than the default, 1e-9, and below it nothing to see.\n";
  out << "* **Polyhedra cannot buy it.** A hull of 482 vertices on the same grain takes "
      << text("%.1f",
              forms.value({{"form", "dConvex"}, {"accuracy", "482"}}, "step_s") / forms.value({{"form", "Supernormal"}}, "step_s"))
      << " times our time per step, a mesh "
      << text("%.1f",
              forms.value({{"form", "dTriMesh"}, {"accuracy", "482"}}, "step_s") / forms.value({{"form", "Supernormal"}}, "step_s"))
      << " times, and a body that rocks on its facets has a period that is wrong by "
      << text("%.0f %%", 100 * outcomes.value({{"form", "dConvex"}, {"accuracy", "482"}}, "rocking_error")) << "; ours is wrong by "
      << text("%.0e", outcomes.value({{"form", "Supernormal"}, {"accuracy", "1e-09"}}, "rocking_error")) << ".\n";
  out << "* **Boxes of the same half-axes**, ODE's cheapest stand-in, take "
      << text("%.2f", forms.value({{"form", "dBox"}}, "step_s") / forms.value({{"form", "Supernormal"}}, "step_s"))
      << " times our time per step: what they spare in geometry they spend on the solver, which has more contacts.\n\n";
}

}  // namespace

void write_report(const std::string& folder) {
  const auto table = [&](const char* name) { return CsvTable(folder + "/" + name + ".csv"); };
  const CsvTable query = table("query");
  const CsvTable meshes = table("meshes");
  const CsvTable literature = table("literature");
  const CsvTable boxes = table("boxes");
  const CsvTable colliders = table("colliders");
  const CsvTable forms = table("scene_forms");
  const CsvTable growth = table("scene_growth");
  const CsvTable outcomes = table("scene_outcomes");
  std::ofstream out(folder + "/report.md");
  out << "# What accuracy costs\n\nWritten by `accuracy_cost --atlas`. Only ratios carry to another machine; all methods of a "
         "table took turns in one run.\n\n";
  for (const std::string& line : (!query.rows().empty()   ? query
                                  : !forms.rows().empty() ? forms
                                  : !boxes.rows().empty() ? boxes
                                                          : literature)
                                     .comments())
    out << "* " << line << '\n';
  out << '\n';
  if (!query.rows().empty() && !outcomes.rows().empty()) write_reading(query, forms, outcomes, out);
  if (!query.rows().empty()) {
    write_digits(query, out);
    write_ratios(query, out);
    write_floor(query, out);
  }
  if (!forms.rows().empty()) write_forms(forms, out);
  if (!growth.rows().empty()) write_growth(growth, out);
  if (!outcomes.rows().empty()) write_outcomes(outcomes, out);
  if (!colliders.rows().empty()) write_colliders(colliders, out);
  if (!meshes.rows().empty()) write_meshes(meshes, out);
  if (!literature.rows().empty()) write_literature(literature, out);
  if (!boxes.rows().empty()) write_boxes(boxes, out);
  if (!query.rows().empty()) write_queries(query, out);
  out.close();
  if (!out) throw std::runtime_error(folder + "/report.md: cannot be written");
}

}  // namespace accuracy_cost
