// The CSV files of a run.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "base/write_file.hpp"
#include "observe/energy.hpp"
#include "world/compression.hpp"
#include "world/population.hpp"
#include "world/world.hpp"

namespace falling_particles {

inline constexpr std::string_view kTrajectoryFile = "trajectory.csv";
inline constexpr std::string_view kEnergiesFile = "energies.csv";
inline constexpr std::string_view kStateFile = "state.csv";
inline constexpr std::string_view kSummaryFile = "summary.toml";
inline constexpr std::string_view kDischargeFile = "discharge.csv";
inline constexpr std::string_view kCompressionFile = "compression.csv";
inline constexpr std::string_view kPartsFile = "parts.csv";
inline constexpr std::string_view kGrainsFile = "grains.csv";
inline constexpr std::string_view kFeedersFile = "feeders.csv";
inline constexpr std::string_view kSinksFile = "sinks.csv";
inline constexpr std::array kOutputFiles = {kTrajectoryFile, kEnergiesFile,  kStateFile,       kSummaryFile, kFeedersFile,
                                            kSinksFile,      kDischargeFile, kCompressionFile, kPartsFile,   kGrainsFile};

/// The format of a table of a run. Measurements have other tables.
struct TableFormat {
  std::string_view name;     ///< of its file
  std::string_view columns;  ///< its first line
  std::string_view lines;    ///< what each line is about
  std::string_view of;       ///< the scenes that have the table
  bool (*is_written)(const Scene& scene);
};

/// All formats, in the order of the list for users.
const std::vector<TableFormat>& table_formats();

/// A table that grows line by line.
class Table {
 public:
  void close() { file_.close(); }
  FileState state() const { return file_.state(); }
  void sync() { file_.sync(); }

 protected:
  /// Writes the columns of the table `name`, or continues after the bytes of `kept`, with which an existing table begins.
  Table(const std::filesystem::path& path, std::string_view name, const FileState& kept);
  ~Table() = default;
  void append(std::string_view lines) { file_.write(lines); }

 private:
  OutputFile file_;
};

/// trajectory.csv has a line per frame and present grain. An index is never reused. Numbers are the shortest text that reads back
/// exactly. Each frame goes to the operating system at once, so that a killed run leaves whole frames. A write error ends the run
/// (write_file.hpp).
class Trajectory : public Table {
 public:
  explicit Trajectory(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, const World& world);
};

/// energies.csv has a line per frame.
class Energies : public Table {
 public:
  explicit Energies(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, const Energy& energy, std::size_t contacts);
};

/// The end state of the summary, at any time of a run.
struct State {
  double deepest_contact;                ///< m, of the last step
  double deepest_contact_of_all_steps;   ///< m, of all steps so far
  std::optional<double> kinetic_height;  ///< m, to which the kinetic energy would lift all grains; empty without gravity
  double largest_kinetic_energy;         ///< J, of the grain with the largest kinetic energy
  double energy_lost;                    ///< J, from the start to the least energy so far
  double energy_gained;                  ///< J, the largest increase from the energy after an earlier step
  std::size_t leaked;                    ///< grains that have been outside
};

/// state.csv has a line per frame.
class StateFile : public Table {
 public:
  explicit StateFile(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, const State& state);
};

/// discharge.csv, of a hopper, has a line per frame.
class DischargeFile : public Table {
 public:
  explicit DischargeFile(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, double mass, std::size_t count);  ///< s; kg and number of the grains that have passed the outlet so far
};

/// compression.csv, of a compression, has a line per frame after the start, where no contact has been measured yet.
class CompressionFile : public Table {
 public:
  explicit CompressionFile(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, const Packing& packing);
};

/// feeders.csv has a line per frame, feeder and kind: the amount fed so far.
class FeedersFile : public Table {
 public:
  explicit FeedersFile(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, const Population& population);
};

/// sinks.csv has a line per frame, sink and kind of the scene: the amount removed so far.
class SinksFile : public Table {
 public:
  explicit SinksFile(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, const Population& population, const Scene& scene);
};

/// parts.csv, of a scene with moving walls, has a line per frame and moving wall: its pose, and its mean velocity in the last step,
/// without the motion of a conveyor's surface.
class WallsFile : public Table {
 public:
  explicit WallsFile(const std::filesystem::path& path, const FileState& kept = {});
  void write(double time, const WallBodies& walls);
};

/// grains.csv, of a scene with sizes, has a line per grain: the factor on the lengths of its kind, its sieve size and its mass.
class GrainsFile : public Table {
 public:
  /// `written`: the number of grains that the table has already.
  explicit GrainsFile(const std::filesystem::path& path, const FileState& kept = {}, std::size_t written = 0);
  /// Writes the grains that were inserted since the last call.
  void write(const World& world);
  std::size_t written() const { return written_; }

 private:
  std::size_t written_;
};

}  // namespace falling_particles
