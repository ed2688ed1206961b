// fix wall/supernormal: walls at rest, with prescribed motion, or driven by forces.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "fix.h"
#include "kernel/walls/driven_wall.hpp"
#include "kernel/walls/wall_contacts.hpp"
#include "styles/pair_supernormal.hpp"
#include "styles/wall_command.hpp"

namespace granular {

/// Its scalar is the energy of the springs, J. Its vector contains the force on the wall (N), the torque on it about its moving
/// anchor (N m), and the number of contacts. For a driven wall follow position (m or rad) and speed (m/s or rad/s) along or about
/// the axis of its drive, the push of the drive (N or N m), and the stress on a servo (Pa).
class FixWallSupernormal : public LAMMPS_NS::Fix {
 public:
  FixWallSupernormal(LAMMPS_NS::LAMMPS* lammps, int count, char** words);
  ~FixWallSupernormal() override;

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void post_force(int vflag) override;
  void final_integrate() override;
  double compute_scalar() override { return total(0); }
  double compute_vector(int index) override;

  void grow_arrays(int count) override { histories_.resize(static_cast<std::size_t>(count)); }
  void copy_arrays(int from, int to, int deleted) override;
  void set_arrays(int i) override { history(i).count = 0; }
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int set) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  static constexpr int kSums = 8;         // energy, force, torque, contacts
  static constexpr int kDriveValues = 4;  // position, speed, push, stress

  enum class DriveKind : std::int64_t { None, Slides, Turns };  // as wide as a number: Stored has no padding
  DriveKind kind() const;
  /// What a restart file has for the whole wall.
  struct Stored {
    DriveKind kind;
    Clock::State clock;
    DrivenWall::State driven;
  };

  WallHistory& history(int i) { return histories_[static_cast<std::size_t>(i)]; }
  const ContactMaterial& material(int type) const;
  /// The wall with its prescribed motions alone.
  common::WallPose carrier_at(double time) const;
  common::WallPose pose() const;
  Vector3 normal() const { return pose().rotation * *command_.normal; }  ///< of a plane
  void find_facing_walls();
  double area_between() const;
  Body wall_body(double step) const;
  void kick(double now);
  double total(int index);

  WallCommand command_;
  std::optional<DrivenWall> driven_;
  std::array<const FixWallSupernormal*, 4> facing_{};  // of a servo: planes that face each other two by two
  bool is_drive_restored_ = false;                     // whether the load of driven_ comes from a restart file
  const double* gravity_ = nullptr;                    // m/s^2, in memory of LAMMPS
  std::vector<int> is_extensive_;                      // per number of the vector
  PairSupernormal* pair_ = nullptr;
  Clock clock_;                      // time of the motions since the fix was created
  LAMMPS_NS::bigint first_counter_;  // step counter of LAMMPS when the fix was created
  std::vector<WallHistory> histories_;
  std::vector<WallContact> scratch_;
  std::array<double, kSums> sums_{}, totals_{};  // of this rank; of all ranks
  LAMMPS_NS::bigint totals_step_ = -1;
};

}  // namespace granular
