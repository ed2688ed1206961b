#include "picture.hpp"

#include <algorithm>
#include <array>

#include "observe/measuring.hpp"
#include "summary.hpp"

// The texts of the scripts (plot_scripts.S).
extern "C" const char kEnergiesScript[], kStateScript[], kDischargeScript[], kCompressionScript[], kMeasurementScript[];

namespace falling_particles {
namespace {

/// The script of a kind of measurement. Kinds without one have a plot of MeasurementKind::plotted.
struct PlotScript {
  std::string_view kind;
  const char* text;
};

constexpr std::array kPlotScripts = {PlotScript{"energies", kEnergiesScript}, PlotScript{"state", kStateScript},
                                     PlotScript{"discharge", kDischargeScript}, PlotScript{"compression", kCompressionScript}};

/// The plot of a table, NAME.svg beside NAME.csv; none if its kind has none. `table`: its path without the extension.
std::optional<Rendering> plot_of(const MeasurementKind& kind, const std::string& table) {
  const auto own = std::ranges::find(kPlotScripts, kind.name, &PlotScript::kind);
  if (own == kPlotScripts.end() && kind.plotted.empty()) return std::nullopt;
  Rendering plot{table + ".svg",
                 {"gnuplot", "-c", "/dev/stdin", table + ".csv"},
                 own == kPlotScripts.end() ? kMeasurementScript : own->text,
                 "gnuplot-nox"};
  if (own != kPlotScripts.end()) return plot;
  plot.command.push_back(kind.plot_label);
  plot.command.insert(plot.command.end(), kind.plotted.begin(), kind.plotted.end());
  return plot;
}

/// Makes a plot beside every table of numbers over time. gnuplot draws it by the scripts of plots/, which the program contains.
class Plots final : public Picture {
 public:
  explicit Plots(const Contents& contents) : scene_(*contents.scene) {}
  void add(const Frame& /*frame*/) override {}
  void finish(const std::string& /*summary*/) override {}
  std::vector<Rendering> renderings() const override {
    std::vector<Rendering> plots;
    const auto add_plot = [&plots](const MeasurementKind& kind, const std::string& table) {
      if (std::optional<Rendering> plot = plot_of(kind, table)) plots.push_back(std::move(*plot));
    };
    for (const MeasurementKind& kind : measurement_kinds()) {
      if (kind.is_on(scene_)) add_plot(kind, kind.name);
    }
    for (const MeasurementRequest& request : scene_.measurements) {
      add_plot(*find_measurement_kind(request.kind), std::string(kMeasurementFolder) + '/' + request.name);
    }
    return plots;
  }

 private:
  const Scene& scene_;
};

/// The plots of the tables that are on by default.
std::vector<std::string> files_of_plots() {
  std::vector<std::string> files;
  for (const MeasurementKind& kind : measurement_kinds()) {
    const std::optional<Rendering> plot = kind.on_by_default ? plot_of(kind, kind.name) : std::nullopt;
    if (plot) files.push_back(plot->file);
  }
  return files;
}

std::unique_ptr<Picture> make_plots(const OutputFolder&, const PictureFormat&, const Contents& contents) {
  return std::make_unique<Plots>(contents);
}

}  // namespace

const std::vector<PictureFormat>& picture_formats() {
  static const std::vector<PictureFormat> formats = {page_format(), glb_format(),    lammps_format(),
                                                     vtk_format(),  povray_format(), {"plots", {}, make_plots, files_of_plots()}};
  return formats;
}

const PictureFormat* find_picture_format(std::string_view name) {
  const auto found = std::ranges::find(picture_formats(), name, &PictureFormat::name);
  return found == picture_formats().end() ? nullptr : &*found;
}

ResultNames result_names() {
  ResultNames names{{std::string(kSummaryFile)}, {{std::string(kMeasurementFolder), ".csv"}, {std::string(kVtkFolder), ".vtp"}}};
  for (const MeasurementKind& kind : measurement_kinds()) {
    if (kind.on_by_default) names.files.push_back(default_file(kind));
  }
  for (const PictureFormat& format : picture_formats()) {
    names.files.insert(names.files.end(), format.files.begin(), format.files.end());
    names.files.insert(names.files.end(), format.rendered.begin(), format.rendered.end());
  }
  return names;
}

}  // namespace falling_particles
