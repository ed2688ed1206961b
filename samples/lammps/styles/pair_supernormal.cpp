#include "styles/pair_supernormal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_neigh_history.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neigh_request.h"
#include "neighbor.h"
#include "styles/fix_nve_supernormal.hpp"
#include "styles/words.hpp"
#include "update.h"

namespace granular {

using namespace LAMMPS_NS;

namespace {

constexpr double kProofMargin = 1e-9;  // of the bounding radii; covers the rounding of a gap

// LAMMPS renamed both in 2022, after the version of Debian 12.
#ifdef SUPERNORMAL_LAMMPS_2022
void request_history(Neighbor& neighbor, Pair& pair, int /*instance*/) { neighbor.add_request(&pair, NeighConst::REQ_HISTORY); }
void forward(Comm& comm, Pair& pair) { comm.forward_comm(&pair); }
#else
void request_history(Neighbor& neighbor, Pair& pair, int instance) {
  const int request = neighbor.request(&pair, instance);  // moves `requests`
  neighbor.requests[request]->history = 1;
}
void forward(Comm& comm, Pair& pair) { comm.forward_comm_pair(&pair); }
#endif

}  // namespace

PairSupernormal::PairSupernormal(LAMMPS* lammps) : Pair(lammps) {
  query_settings_.stop_when_apart = true;
  single_enable = 1;
  restartinfo = 1;
  no_virial_fdotr_compute = 1;
  // The history is stored for every pair with a known normal, also if the bodies are apart.
  beyond_contact = 1;
  nondefault_history_transfer = 1;
  nextra = SumCount;
  pvector = sums_.data();
  single_extra = kSingles;
  svector = singles_.data();
  // The fix that stores the history can only be created when the run starts. Until then a placeholder keeps its position in the
  // list of fixes.
  modify->add_fix("SUPERNORMAL_PLACE_" + std::to_string(instance_me) + " all DUMMY");
}

PairSupernormal::~PairSupernormal() {
  const std::string number = std::to_string(instance_me);
  modify->delete_fix((history_ == nullptr ? "SUPERNORMAL_PLACE_" : "SUPERNORMAL_HISTORY_") + number);
  if (allocated != 0) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

PairSupernormal& PairSupernormal::require(LAMMPS* lammps, const char* who) {
  auto* pair = dynamic_cast<PairSupernormal*>(lammps->force->pair_match("supernormal", 1));
  if (pair == nullptr || pair->bodies_ == nullptr) {
    lammps->error->all(FLERR, std::string(who) + " takes a pair_style supernormal with its coefficients");
  }
  return *pair;
}

std::size_t PairSupernormal::index(int i, int j) const {
  return static_cast<std::size_t>(i) * (static_cast<std::size_t>(atom->ntypes) + 1) + static_cast<std::size_t>(j);
}

void PairSupernormal::allocate() {
  allocated = 1;
  const int size = atom->ntypes + 1;
  memory->create(setflag, size, size, "pair:setflag");
  memory->create(cutsq, size, size, "pair:cutsq");
  for (int i = 0; i < size; ++i) std::fill_n(setflag[i], size, 0);
  materials_.resize(index(size, 0));
  bodies_ = std::make_unique<BodyTable>(lmp, atom->ntypes);
}

void PairSupernormal::settings(int count, char** words) {
  Words rest({words, words + count}, lmp);
  try {
    while (!rest.is_empty()) {
      const std::string keyword = rest.next("pair_style supernormal");
      if (keyword == "tolerance") {
        query_settings_.tolerance = rest.number(keyword);
      } else if (keyword == "exponents" && rest.accept("atom")) {
        has_particle_exponents_ = true;
      } else {
        throw std::invalid_argument(keyword + " is none of: tolerance VALUE, exponents atom");
      }
    }
  } catch (const std::invalid_argument& refusal) {
    error->all(FLERR, std::string("pair_style supernormal: ") + refusal.what());
  }
  if (!(query_settings_.tolerance >= 1e-15 && query_settings_.tolerance <= 1)) {
    error->all(FLERR, fmt::format("pair_style supernormal: tolerance = {} is outside [1e-15, 1]", query_settings_.tolerance));
  }
}

void PairSupernormal::coeff(int count, char** words) {
  if (allocated == 0) allocate();
  if (count < 3) error->all(FLERR, "pair_coeff takes two types and what is set for them");
  int low = 0, high = 0, low2 = 0, high2 = 0;
  utils::bounds(FLERR, words[0], 1, atom->ntypes, low, high, error);
  utils::bounds(FLERR, words[1], 1, atom->ntypes, low2, high2, error);
  try {
    const Coefficients found = read_coefficients(Words({words + 2, words + count}, lmp));
    if (found.has_exponents) {
      if (has_particle_exponents_)
        error->all(FLERR, "pair_coeff: exponents belong to the particles: pair_style has exponents atom");
      if (low != low2 || high != high2) error->all(FLERR, "pair_coeff: exponents belong to a type: name the same one twice");
      for (int type = low; type <= high; ++type) bodies_->exponents(type) = {found.delta, found.epsilon};
    }
    if (found.has_material) set_material(low, high, low2, high2, found.material);
  } catch (const std::invalid_argument& refusal) {
    error->all(FLERR, std::string("pair_coeff: ") + refusal.what());
  }
}

void PairSupernormal::set_material(int low, int high, int low2, int high2, const ContactMaterial& material) {
  for (int i = low; i <= high; ++i) {
    for (int j = low2; j <= high2; ++j) {
      materials_[index(i, j)] = materials_[index(j, i)] = material;
      setflag[std::min(i, j)][std::max(i, j)] = 1;
    }
  }
}

void PairSupernormal::report_volumes() const {
  // `set density` of LAMMPS computes masses from the volumes of ellipsoids.
  if (has_particle_exponents_) return;
  for (int type = 1; type <= atom->ntypes && comm->me == 0; ++type) {
    const BodyTable::Exponents& exponents = bodies_->exponents(type);
    const double share = ParticleShape(Vector3::Ones(), exponents.delta, exponents.epsilon).volume / (4.0 / 3 * std::numbers::pi);
    utils::logmesg(lmp, fmt::format("supernormal: type {}: exponents {} and {}, volume {:.10g} of the ellipsoid's\n", type,
                                    exponents.delta, exponents.epsilon, share));
  }
}

void PairSupernormal::init_style() {
  if (comm->ghost_velocity == 0) error->all(FLERR, "pair_style supernormal takes: comm_modify vel yes");
  if (force->ftm2v != 1)
    error->all(FLERR, "pair_style supernormal takes units in which force is mass times acceleration: si, cgs, lj");
  constexpr int kTiled = 1;
  if (comm->style == kTiled && force->newton_pair != 0)
    error->all(FLERR, "pair_style supernormal takes comm_style tiled with newton off only: histories of pairs go back from ghosts");
  if (atom->tag_enable == 0) error->all(FLERR, "pair_style supernormal takes atoms with tags");
  if (domain->dimension != 3)
    error->all(FLERR, fmt::format("pair_style supernormal: dimension = {} is outside [3, 3]", domain->dimension));
  if (!(update->dt > 0 && std::isfinite(update->dt))) {
    error->all(FLERR, fmt::format("pair_style supernormal: timestep = {} is outside (0, inf)", update->dt));
  }
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "pair_style supernormal takes run_style verlet, and not respa");
  request_history(*neighbor, *this, instance_me);
  if (history_ == nullptr) {
    const std::string number = std::to_string(instance_me);
    const std::string made = "SUPERNORMAL_HISTORY_" + number + " all SUPERNORMAL_HISTORY " + std::to_string(ContactHistory::kSize);
    history_ = dynamic_cast<FixNeighHistory*>(modify->replace_fix("SUPERNORMAL_PLACE_" + number, made, 1));
    history_->pair = this;
    report_volumes();
  }
  constexpr int kMinimization = 2;
  if (update->whichflag == kMinimization && comm->me == 0)
    error->warning(FLERR, "supernormal: a minimization rotates no particles");
  if (has_particle_exponents_) bodies_->use_particle_exponents();
  find_fixes_of_clusters();
  has_warned_ = false;
  comm_forward = (has_particle_exponents_ ? 2 : 0) + (fixes_of_clusters_.empty() ? 0 : Cluster::kSize);
  largest_radii_ = bodies_->find_largest_radii();
}

void PairSupernormal::find_fixes_of_clusters() {
  fixes_of_clusters_.clear();
  bodies_->clusters().clear();
  for (int k = 0; k < modify->nfix; ++k) {
    const Fix& fix = *modify->fix[k];
    const bool is_rigid = fix.rigid_flag != 0, moves = is_rigid || fix.time_integrate != 0;
    const auto* const clusters = dynamic_cast<const RigidClusters*>(&fix);
    if (clusters != nullptr) {
      fixes_of_clusters_.push_back(clusters);
    } else if (moves && dynamic_cast<const FixNveSupernormal*>(&fix) == nullptr && comm->me == 0) {
      error->warning(FLERR, fmt::format("fix {} takes particles as ellipsoids, or does not rotate them: use fix {}/supernormal",
                                        fix.style, is_rigid ? "rigid/nve" : "nve"));
    }
  }
}

void PairSupernormal::read_clusters() {
  if (fixes_of_clusters_.empty()) return;
  std::vector<Cluster>& clusters = bodies_->clusters();
  clusters.assign(static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost), {});
  for (int i = 0; i < atom->nlocal; ++i) {
    for (const RigidClusters* const one : fixes_of_clusters_) {
      Cluster& cluster = clusters[static_cast<std::size_t>(i)];
      if (cluster.is_none()) cluster = one->cluster(i);
    }
  }
}

double PairSupernormal::init_one(int i, int j) {
  // LAMMPS has made sure that each type has a law with itself.
  if (setflag[std::min(i, j)][std::max(i, j)] == 0) {
    try {
      materials_[index(i, j)] = materials_[index(j, i)] = mixed(material(i, i), material(j, j));
    } catch (const std::invalid_argument& refusal) {
      error->all(FLERR, fmt::format("pair_coeff: no contact law for types {} and {}: {}", i, j, refusal.what()));
    }
  }
  return largest_radii_[static_cast<std::size_t>(i)] + largest_radii_[static_cast<std::size_t>(j)];
}

void PairSupernormal::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  sums_.fill(0);
  if (neighbor->ago == 0) {
    refuse_two_images();
    read_clusters();
    if (comm_forward > 0) forward(*comm, *this);
    bodies_->assign_shapes();
    forget_proofs();
  }
  bodies_->read_motion();
  warn_of_leaps();
  // In the setup of a run, the springs are already up to date.
  const double step = update->setupflag != 0 ? 0 : update->dt;
  for (int k = 0; k < list->inum; ++k) list_neighbors(k, step);
  solve_pending(step);
}

// LAMMPS finds the history of a neighbour by its tag, so a neighbour must not have two images within the cutoff.
void PairSupernormal::refuse_two_images() const {
  const std::array<Vector3, 3> periods{
      {{domain->xprd, 0, 0}, {domain->xy, domain->yprd, 0}, {domain->xz, domain->yz, domain->zprd}}};
  std::vector<Vector3> shifts;
  for (std::size_t k = 0; k < periods.size(); ++k) {
    if (domain->periodicity[k] == 0 || periods[k][static_cast<int>(k)] >= 2 * neighbor->cutneighmax) continue;
    shifts.insert(shifts.end(), {periods[k], -periods[k]});
  }
  if (shifts.empty()) return;
  for (int k = 0; k < list->inum; ++k) {
    const int i = list->ilist[k];
    for (int n = 0; n < list->numneigh[i]; ++n) {
      const int j = list->firstneigh[i][n] & NEIGHMASK;
      const Vector3 apart = Vector3::Map(atom->x[i]) - Vector3::Map(atom->x[j]);
      const double square = neighbor->cutneighsq[atom->type[i]][atom->type[j]];
      if (std::ranges::none_of(shifts, [&](const Vector3& shift) { return (apart + shift).squaredNorm() < square; })) continue;
      error->one(FLERR, fmt::format("supernormal: atoms {} and {} are neighbors twice, across a periodic boundary; the box must be "
                                    "longer than two cutoffs, {:.3g}",
                                    atom->tag[i], atom->tag[j], 2 * std::sqrt(square)));
    }
  }
}

void PairSupernormal::warn(const std::string& what) {
  if (!has_warned_) error->warning(FLERR, "supernormal: " + what + ", at step " + std::to_string(update->ntimestep));
  has_warned_ = true;
}

void PairSupernormal::warn_of_leaps() {
  for (int i = 0; i < atom->nlocal && !has_warned_; ++i) {
    const Body& body = bodies_->body(i);
    const double least = bodies_->shape(i).least_half_axis;
    const double way = update->dt * (body.velocity.norm() + bodies_->shape(i).bounding_radius * body.angular_velocity.norm());
    if (way > least) {
      warn(fmt::format(
          "atom {} moves by {:.3g} in a step, more than its smallest half-axis of {:.3g}, so it may pass through others; a smaller "
          "timestep helps",
          atom->tag[i], way, least));
    }
  }
}

void PairSupernormal::warn_of_depth(double depth, int i, const std::string& other, double least) {
  if (depth <= least || has_warned_) return;
  warn(fmt::format(
      "atom {} overlaps with {} by {:.3g}, more than a half-axis of {:.3g}, so they may pass through each other; stiffer "
      "springs, a smaller timestep or another start help",
      atom->tag[i], other, depth, least));
}

void PairSupernormal::forget_proofs() {
  first_proof_.clear();
  std::size_t count = 0;
  for (int k = 0; k < list->inum; ++k) {
    first_proof_.push_back(count);
    count += static_cast<std::size_t>(list->numneigh[list->ilist[k]]);
  }
  proofs_.assign(count, std::numeric_limits<double>::infinity());
}

// The gap along a normal changes with the distance of the centres along it and, by rotation, at most as far as points of the bodies
// move: |h(n') - h(n)| <= R |n' - n|.
double PairSupernormal::separation(int i, int j, const Vector3& normal) const {
  const Body &first = bodies_->body(i), &second = bodies_->body(j);
  return normal.dot(second.pose.position - first.pose.position) - (bodies_->rotated(i) + bodies_->rotated(j));
}

// The pairs are solved many at once, in the order of the list: their forces are added in this order, too.
void PairSupernormal::list_neighbors(int number, double step) {
  const int i = list->ilist[number];
  const int* neighbors = list->firstneigh[i];
  int* known = history_->firstflag[i];
  double* values = history_->firstvalue[i];
  for (int k = 0; k < list->numneigh[i]; ++k) {
    const int j = neighbors[k] & NEIGHMASK;
    double* pair_values = values + k * ContactHistory::kSize;
    const Vector3 apart = Vector3::Map(atom->x[i]) - Vector3::Map(atom->x[j]);
    double& proof = proofs_[first_proof_[static_cast<std::size_t>(number)] + static_cast<std::size_t>(k)];
    const double reach = bodies_->shape(i).bounding_radius + bodies_->shape(j).bounding_radius;
    if (bodies_->are_in_one_cluster(i, j)) continue;
    if (apart.squaredNorm() >= reach * reach) {
      if (step > 0 && known[k] != 0) {
        known[k] = 0;
        ContactHistory().store(pair_values);
        proof = std::numeric_limits<double>::infinity();
      }
      continue;
    }
    const auto [first, second] = by_tag(i, j);
    if (step > 0 && separation(first, second, Vector3::Map(pair_values)) > proof) {
      sums_[Queries] += share(j);
      continue;
    }
    Pending& pending = pending_[pending_count_++];
    pending.i = i;
    pending.j = j;
    pending.known = known + k;
    pending.values = pair_values;
    pending.proof = &proof;
    pending.history = ContactHistory::load(pair_values);
    pending.query.set(bodies_->body(first), bodies_->body(second), pending.history);
    if (pending_count_ == pending_.size()) solve_pending(step);
  }
}

void PairSupernormal::solve_pending(double step) {
  std::array<supernormal::ProximityQuery, std::tuple_size_v<decltype(pending_)>> queries{};
  std::array<supernormal::Proximity, std::tuple_size_v<decltype(pending_)>> found;
  for (std::size_t k = 0; k < pending_count_; ++k) queries[k] = pending_[k].query.query;
  std::array<supernormal::ContactCurvature, std::tuple_size_v<decltype(pending_)>> curvatures;
  supernormal::find_proximities({queries.data(), pending_count_}, query_settings_, {found.data(), pending_count_},
                                {curvatures.data(), pending_count_});
  for (std::size_t k = 0; k < pending_count_; ++k) {
    Pending& pending = pending_[k];
    const auto [first, second] = by_tag(pending.i, pending.j);
    const PairContact pair =
        require_finite(contact_of(found[k], curvatures[k], bodies_->body(first), bodies_->body(second),
                                  material(atom->type[pending.i], atom->type[pending.j]), step, pending.history),
                       first, second);
    if (step > 0) {
      *pending.known = 1;
      pending.history.store(pending.values);
      // Twice the margin of separation(). Faces may meet before the bodies do.
      const double rounding = kProofMargin * (bodies_->shape(first).bounding_radius + bodies_->shape(second).bounding_radius);
      const double bulge = bodies_->shape(first).bulge + bodies_->shape(second).bulge;
      *pending.proof = pair.state == PairState::Apart
                           ? separation(first, second, pending.history.normal) - found[k].gap + bulge + rounding
                           : std::numeric_limits<double>::infinity();
    }
    count_and_apply(pending.i, pending.j, pair);
  }
  pending_count_ = 0;
}

// With newton off, two ranks count each pair of an owned particle and a ghost.
double PairSupernormal::share(int j) const { return force->newton_pair != 0 || j < atom->nlocal ? 1 : 0.5; }

void PairSupernormal::count_and_apply(int i, int j, const PairContact& pair) {
  const double part = share(j);
  sums_[Queries] += part;
  sums_[Evaluations] += part * pair.evaluations;
  if (pair.state == PairState::Apart) return;
  if (!has_warned_) {
    warn_of_depth(pair.contact.depth, i, "atom " + std::to_string(atom->tag[j]),
                  std::min(bodies_->shape(i).least_half_axis, bodies_->shape(j).least_half_axis));
  }
  sums_[Contacts] += part;
  sums_[Slipping] += pair.force.slips ? part : 0;
  sums_[Faces] += pair.corners > 0 ? part : 0;
  apply(i, j, pair);
}

std::pair<int, int> PairSupernormal::by_tag(int i, int j) const {
  return atom->tag[i] < atom->tag[j] ? std::pair(i, j) : std::pair(j, i);
}

PairContact PairSupernormal::solve(int i, int j, double step, ContactHistory& history) const {
  const auto [first, second] = by_tag(i, j);
  return require_finite(find_pair_contact(bodies_->body(first), bodies_->body(second), material(atom->type[i], atom->type[j]),
                                          query_settings_, step, history),
                        first, second);
}

PairContact PairSupernormal::require_finite(const PairContact& pair, int first, int second) const {
  if (pair.state == PairState::Failed) {
    error->one(FLERR, "supernormal: the positions of atoms " + std::to_string(atom->tag[first]) + " and " +
                          std::to_string(atom->tag[second]) + " are not finite; a smaller timestep may help");
  }
  return pair;
}

void PairSupernormal::apply(int i, int j, const PairContact& pair) {
  const bool ordered = atom->tag[i] < atom->tag[j];
  const Vector3 force_i = ordered ? pair.force.force : Vector3(-pair.force.force);
  const Vector3 torque_i = ordered ? pair.torque1() : pair.torque2();
  const Vector3 torque_j = ordered ? pair.torque2() : pair.torque1();
  const bool newton = force->newton_pair != 0;
  Vector3::Map(atom->f[i]) += force_i;
  Vector3::Map(atom->torque[i]) += torque_i;
  if (newton || j < atom->nlocal) {
    Vector3::Map(atom->f[j]) -= force_i;
    Vector3::Map(atom->torque[j]) += torque_j;
  }
  if (evflag != 0) {
    const Vector3 apart = bodies_->body(i).pose.position - bodies_->body(j).pose.position;
    ev_tally_xyz(i, j, atom->nlocal, newton ? 1 : 0, pair.force.energy, 0, force_i.x(), force_i.y(), force_i.z(), apart.x(),
                 apart.y(), apart.z());
  }
}

const double* PairSupernormal::find_history(int i, int j) const {
  for (const auto& [owner, other] : {std::pair(i, j), std::pair(j, i)}) {
    if (owner >= atom->nlocal) continue;
    const int* begin = list->firstneigh[owner];
    const int* end = begin + list->numneigh[owner];
    const int* found = std::find_if(begin, end, [o = other](int entry) { return (entry & NEIGHMASK) == o; });
    if (found != end) return history_->firstvalue[owner] + (found - begin) * ContactHistory::kSize;
  }
  return nullptr;
}

double PairSupernormal::single(int i, int j, int /*itype*/, int /*jtype*/, double square, double /*coul*/, double /*lj*/,
                               double& force_over_distance) {
  force_over_distance = 0;
  singles_.fill(0);
  if (bodies_->are_in_one_cluster(i, j)) return 0;
  const double* values = find_history(i, j);
  ContactHistory history = values == nullptr ? ContactHistory() : ContactHistory::load(values);
  const PairContact pair = solve(i, j, 0, history);
  if (pair.state == PairState::Apart) return 0;
  const double sign = atom->tag[i] < atom->tag[j] ? 1 : -1;
  const Vector3 force_i = sign * pair.force.force;
  const Vector3 point = bodies_->body(atom->tag[i] < atom->tag[j] ? i : j).pose.position + pair.contact.arm1;
  Vector3::Map(&singles_[0]) = force_i;
  Vector3::Map(&singles_[3]) = point;
  Vector3::Map(&singles_[6]) = sign * pair.contact.normal;
  singles_[9] = pair.contact.depth;
  singles_[10] = pair.force.normal;
  singles_[11] = pair.force.slips ? 1 : 0;
  singles_[12] = pair.share_of_faces;
  singles_[13] = pair.corners;
  singles_[14] = pair.force.elastic;
  singles_[15] = pair.force.normal - pair.force.elastic;
  singles_[16] = pair.force.adhesion;
  singles_[17] = (history.sliding - history.sliding.dot(history.normal) * history.normal).norm();
  force_over_distance = force_i.dot(Vector3::Map(atom->x[i]) - Vector3::Map(atom->x[j])) / square;
  return pair.force.energy;
}

int PairSupernormal::pack_forward_comm(int count, int* indices, double* buffer, int /*pbc_flag*/, int* /*pbc*/) {
  double* end = buffer;
  for (int k = 0; k < count; ++k) {
    if (has_particle_exponents_) {
      *end++ = bodies_->delta(indices[k]);
      *end++ = bodies_->epsilon(indices[k]);
    }
    if (fixes_of_clusters_.empty()) continue;
    bodies_->clusters()[static_cast<std::size_t>(indices[k])].store(end);
    end += Cluster::kSize;
  }
  return static_cast<int>(end - buffer);
}

void PairSupernormal::unpack_forward_comm(int count, int first, double* buffer) {
  for (int i = first; i < first + count; ++i) {
    if (has_particle_exponents_) {
      bodies_->delta(i) = *buffer++;
      bodies_->epsilon(i) = *buffer++;
    }
    if (fixes_of_clusters_.empty()) continue;
    bodies_->clusters()[static_cast<std::size_t>(i)] = Cluster::load(buffer);
    buffer += Cluster::kSize;
  }
}

void PairSupernormal::write_restart(FILE* file) { exchange_coefficients(file, true); }

void PairSupernormal::read_restart(FILE* file) {
  allocate();
  exchange_coefficients(file, false);
}

void PairSupernormal::exchange_coefficients(FILE* file, bool write) {
  const auto exchange = [&](double& value) {
    if (write) {
      fwrite(&value, sizeof(double), 1, file);
    } else {
      if (comm->me == 0) utils::sfread(FLERR, &value, sizeof(double), 1, file, nullptr, error);
      MPI_Bcast(&value, 1, MPI_DOUBLE, 0, world);
    }
  };
  exchange(query_settings_.tolerance);
  double has_particle_exponents = has_particle_exponents_ ? 1 : 0;
  exchange(has_particle_exponents);
  has_particle_exponents_ = has_particle_exponents != 0;
  for (int i = 1; i <= atom->ntypes; ++i) {
    exchange(bodies_->exponents(i).delta);
    exchange(bodies_->exponents(i).epsilon);
    for (int j = i; j <= atom->ntypes; ++j) {
      double is_set = setflag[i][j];
      exchange(is_set);
      ContactMaterial material = materials_[index(i, j)];
      double law = material.law == NormalLaw::Hertz ? 1 : 0;
      for (double* value : {&law, &material.stiffness, &material.restitution, &material.friction, &material.tangential_ratio,
                            &material.rolling_length, &material.spinning_length, &material.adhesion, &material.damping_ratio}) {
        exchange(*value);
      }
      material.law = law != 0 ? NormalLaw::Hertz : NormalLaw::Hooke;
      setflag[i][j] = static_cast<int>(is_set);
      materials_[index(i, j)] = materials_[index(j, i)] = material;
    }
  }
}

}  // namespace granular
