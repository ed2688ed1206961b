// A kind of grain as text: report, lines to paste, JSON.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "grain_kind.hpp"
#include "model/fit_error.hpp"
#include "output/results.hpp"

namespace fit {

/// The fit of one scan of a kind.
struct KindScan {
  std::string file;
  FittedBody fitted;
  FitError error;
  std::vector<std::string> doubts;
};

/// A row for each scan, the mean shape with its spread, and the sizes.
std::string describe(const GrainKind& kind, std::span<const KindScan> scans);

/// Lines for a scene: so many grains of the kind, with the sizes of the scans. Sizes are relative to the kind in the catalogue, its
/// median. Without `size` if the scans have one size, or differ by more than a scene takes.
std::string scene_lines(const GrainKind& kind, const std::string& name);

/// Why a kind is doubtful: one sentence each; none if it is good.
std::vector<std::string> doubts_about(const GrainKind& kind, std::span<const KindScan> scans);

/// JSON with its units: the kind, and a body for each scan.
std::string json_text(const GrainKind& kind, std::span<const KindScan> scans, const std::vector<std::string>& warnings,
                      const Provenance& provenance);

}  // namespace fit
