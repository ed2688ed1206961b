// The CSV files of a run.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "measure/energy.hpp"
#include "simulation/world.hpp"

namespace falling_particles {

inline constexpr std::string_view kTrajectoryFile = "trajectory.csv";
inline constexpr std::string_view kEnergiesFile = "energies.csv";
inline constexpr std::string_view kSummaryFile = "summary.toml";
inline constexpr std::string_view kDischargeFile = "discharge.csv";
inline constexpr std::array kOutputFiles = {kTrajectoryFile, kEnergiesFile, kSummaryFile, kDischargeFile};

/// trajectory.csv has a line per frame and body. Numbers are the shortest text that reads back exactly. All files are handed over
/// to the system frame by frame: a run that is killed leaves whole frames.
class Trajectory {
 public:
  explicit Trajectory(const std::filesystem::path& path);
  void write(double time, const World& world);
  void close();  ///< throws when anything could not be written

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// energies.csv has a line per frame.
class Energies {
 public:
  explicit Energies(const std::filesystem::path& path);
  void write(double time, const Energy& energy, std::size_t contacts);
  void close();  ///< throws when anything could not be written

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// discharge.csv, of a hopper, has a line per frame.
class DischargeFile {
 public:
  explicit DischargeFile(const std::filesystem::path& path);
  void write(double time, double mass, std::size_t count);  ///< s; kg and number of the grains that have passed the outlet so far
  void close();                                             ///< throws when anything could not be written

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace falling_particles
