// pair_style supernormal: superellipsoids in contact.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <vector>

#include "comm.h"
#include "fix_neigh_history.h"
#include "kernel/pair_contact.hpp"
#include "pair.h"
#include "styles/body_table.hpp"
#include "update.h"

namespace granular {

/// The pair style; commands.md has its commands. Body 1 is always the particle with the smaller tag. So every rank that solves a
/// pair computes the same force, and both agree on the meaning of its history.
class PairSupernormal : public LAMMPS_NS::Pair {
 public:
  explicit PairSupernormal(LAMMPS_NS::LAMMPS* lammps);
  ~PairSupernormal() override;

  void settings(int count, char** words) override;
  void coeff(int count, char** words) override;
  void init_style() override;
  double init_one(int i, int j) override;
  void compute(int eflag, int vflag) override;
  double single(int i, int j, int itype, int jtype, double square, double coul, double lj, double& force_over_distance) override;
#ifdef SUPERNORMAL_LAMMPS_HISTORY_OF_TYPES
  void transfer_history(double* from, double* to, int /*type*/, int /*other*/) override { copy_history(from, to); }
#else
  void transfer_history(double* from, double* to) override { copy_history(from, to); }
#endif
  /// Copies the exponents and the clusters of particles to their ghosts.
  int pack_forward_comm(int count, int* indices, double* buffer, int pbc_flag, int* pbc) override;
  void unpack_forward_comm(int count, int first, double* buffer) override;

  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;

  /// The style of a simulation. Raises a LAMMPS error that names `who` if there is none.
  static PairSupernormal& require(LAMMPS_NS::LAMMPS* lammps, const char* who);

  BodyTable& bodies() { return *bodies_; }
  const ContactMaterial& material(int i, int j) const { return materials_[index(i, j)]; }

  /// Warns, once in a run on each rank, if particle i is deeper (m) in another body than `least` (m), the smallest half-axis of
  /// both.
  void warn_of_depth(double depth, int i, const std::string& other, double least);

 private:
  enum Sum { Contacts, Slipping, Queries, Evaluations, Faces, SumCount };  // compute pair
  static constexpr int kSingles = 18;                                      // compute pair/local

  static void copy_history(const double* from, double* to) { std::copy_n(from, ContactHistory::kSize, to); }
  void allocate();
  void report_volumes() const;
  std::size_t index(int i, int j) const;
  /// A pair whose bounding spheres overlap, between its query and its forces.
  struct Pending {
    int i, j;
    int* known;
    double* values;
    double* proof;
    ContactHistory history;
    PairQuery query;
  };

  PairContact solve(int i, int j, double step, ContactHistory& history) const;
  PairContact require_finite(const PairContact& pair, int first, int second) const;
  std::pair<int, int> by_tag(int i, int j) const;
  void apply(int i, int j, const PairContact& pair);
  void find_fixes_of_clusters();
  void read_clusters();
  void refuse_two_images() const;
  void warn(const std::string& what);
  void warn_of_leaps();
  void forget_proofs();
  double separation(int i, int j, const Vector3& normal) const;
  void list_neighbors(int k, double step);
  void solve_pending(double step);
  double share(int j) const;
  void count_and_apply(int i, int j, const PairContact& pair);
  void set_material(int low, int high, int low2, int high2, const ContactMaterial& material);
  void exchange_coefficients(FILE* file, bool write);
  const double* find_history(int i, int j) const;

  bool has_particle_exponents_ = false;
  bool has_warned_ = false;  // in this run
  std::vector<const RigidClusters*> fixes_of_clusters_;
  std::unique_ptr<BodyTable> bodies_;
  std::vector<double> largest_radii_;       // m; per type
  std::vector<ContactMaterial> materials_;  // per pair of types
  supernormal::Settings query_settings_;
  LAMMPS_NS::FixNeighHistory* history_ = nullptr;
  std::array<Pending, 64> pending_;  // as many as fill vector lanes, and stay in the cache
  std::size_t pending_count_ = 0;
  // Per neighbour: separation() less the gap when it was proved, or infinity. The last normal proves that the bodies are still
  // apart while separation() exceeds this.
  std::vector<double> proofs_;
  std::vector<std::size_t> first_proof_;  // per particle of the list
  std::array<double, SumCount> sums_{};
  std::array<double, kSingles> singles_{};
};

/// fix SUPERNORMAL_HISTORY, which the pair style creates: LAMMPS' history of neighbours, which write_restart between two runs does
/// not spoil. LAMMPS stores the histories with the particles at the end of a run, and again for the file. By then its ghosts are
/// new, but the list of neighbours is not, so pairs across a periodic side would get other particles' springs.
class FixContactHistory : public LAMMPS_NS::FixNeighHistory {
 public:
  using FixNeighHistory::FixNeighHistory;

  void post_run() override {
    FixNeighHistory::post_run();
    stored_ = update->ntimestep;
  }
  void post_neighbor() override {
    FixNeighHistory::post_neighbor();
    stored_ = kNever;
  }
  void write_restart(FILE* file) override {
    if (update->ntimestep != stored_) return FixNeighHistory::write_restart(file);
    const int size = 0;  // of what is stored besides the particles
    if (comm->me == 0) fwrite(&size, sizeof size, 1, file);
  }

 private:
  static constexpr LAMMPS_NS::bigint kNever = -1;
  LAMMPS_NS::bigint stored_ = kNever;  // the step whose histories a run has stored at its end, until the next list of neighbours
};

}  // namespace granular
