#include "bonds.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "driven_body.hpp"
#include "grain.hpp"
#include "world.hpp"

namespace falling_particles {
namespace {

using Eigen::Quaterniond;

Quaterniond rotation_of(dBodyID body) {
  const dReal* q = dBodyGetQuaternion(body);
  return {q[0], q[1], q[2], q[3]};
}

/// rad, along the axis of the rotation; the smaller of the two that lead there.
Vector3 rotation_vector(Quaterniond rotation) {
  if (rotation.w() < 0) rotation.coeffs() *= -1;
  const double sine = rotation.vec().norm();
  constexpr double kSmall = 1e-9;  // below it, asin x = x in double precision
  return sine < kSmall ? Vector3(2 * rotation.vec()) : Vector3(2 * std::atan2(sine, rotation.w()) / sine * rotation.vec());
}

/// The response of one body to a force or torque of 1 N or 1 N m.
class Response {
 public:
  explicit Response(dBodyID body) {
    if (dBodyIsKinematic(body) != 0) return;
    dMass mass;
    dBodyGetMass(body, &mass);
    inverse_mass_ = 1 / mass.mass;
    Eigen::Matrix3d inertia;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) inertia(i, j) = mass.I[4 * i + j];
    }
    inverse_inertia_ = inertia.inverse();
  }
  /// 1/kg, of a force at `arm` (m) from the centre along `axis`.
  double to_force(const Vector3& arm, const Vector3& axis) const { return inverse_mass_ + to_torque(arm.cross(axis)); }
  /// 1/(kg m^2), for a torque about a unit axis.
  double to_torque(const Vector3& axis) const { return axis.dot(inverse_inertia_ * axis); }

 private:
  double inverse_mass_ = 0;
  Eigen::Matrix3d inverse_inertia_ = Eigen::Matrix3d::Zero();
};

void apply(dBodyID body, const Vector3& force, const Vector3& moment, const Vector3& place) {
  if (dBodyIsKinematic(body) != 0) return;
  dBodyAddForceAtPos(body, force.x(), force.y(), force.z(), place.x(), place.y(), place.z());
  dBodyAddTorque(body, moment.x(), moment.y(), moment.z());
}

/// The least length of a bond, relative to the smallest half-axis. A shorter one has no direction: it is the rounding of centres
/// that are at one place. Twice, half, none: 1e-12 m of a bead of 1 mm are refused, refused, and too stiff for any step.
constexpr double kLeastLength = 1e-6;

/// The stiffnesses of a beam about its middle (N/m, N m), or of a ball.
std::array<double, 6> stiffness_of(const BondRule& rule, double radius, double length) {
  const double area = std::numbers::pi * radius * radius;
  const double along = rule.modulus * area / length;
  if (rule.kind == BondKind::Ball) return {along, along, along, 0, 0, 0};
  const double second_moment = area * radius * radius / 4;
  const double shear_modulus = rule.modulus / (2 * (1 + rule.poisson_ratio));
  // Cowper, J. Applied Mechanics 33 (1966), of a circular section.
  const double shear_coefficient = 6 * (1 + rule.poisson_ratio) / (7 + 6 * rule.poisson_ratio);
  const double bending = rule.modulus * second_moment / length;
  const double across = 1 / (length * length / (12 * bending) + length / (shear_coefficient * shear_modulus * area));
  const double twisting = 2 * shear_modulus * second_moment / length;
  return {along, across, across, twisting, bending, bending};
}

struct Closest {
  double gap = INFINITY;                // m
  Vector3 on_second = Vector3::Zero();  // m, on the second body
};

/// The gap between a grain and another grain or a wall.
Closest find_closest(std::span<const dGeomID> grain, std::span<const dGeomID> other) {
  Closest closest;
  for (const dGeomID g1 : grain) {
    for (const dGeomID g2 : other) {
      snProximity proximity;
      if (snGeomProximity(g1, g2, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
      if (proximity.gap < closest.gap) closest = {proximity.gap, to_vector(proximity.point2)};
    }
  }
  return closest;
}

/// The unstrained pose of a bond that is unstrained now.
BondRest rest_of(const WallPose& first, const Vector3& start, const Grain& second) {
  const Quaterniond back = first.rotation.conjugate();
  return {back * (start - first.position), back * (to_vector(dBodyGetPosition(second.body)) - first.position),
          back * rotation_of(second.body)};
}

}  // namespace

std::string cause_of(const BondBreak& failure, const BondRule& rule) {
  if (failure.is_removed) return "removed";
  const auto& [tension, bending, shear, torsion] = failure.stress;
  if ((tension + bending) / rule.tensile_strength >= (shear + torsion) / rule.shear_strength) {
    return tension >= bending ? "tension" : "bending";
  }
  return shear >= torsion ? "shear" : "torsion";
}

Bonds::Bonds(const World& world) : world_(world), step_(world.scene().time.step) {
  if (world.grains().empty()) return;  // as in the worlds that check walls
  const std::vector<BondRule>& rules = world.scene().bonds;
  for (std::size_t rule = 0; rule < rules.size(); ++rule) {
    for (const BondedPair& pair : rules[rule].pairs) add(rule, pair);
  }
  for (std::size_t rule = 0; rule < rules.size(); ++rule) {
    if (rules[rule].touching) find_touching(rule);
  }
  measure_energy();
}

Bonds::Bonds(const World& world, const BondsState& state) : world_(world), step_(world.scene().time.step), state_(state) {
  for (std::size_t i = 0; i < state_.bonds.size(); ++i) {
    joints_.emplace_back();
    const Bond& bond = state_.bonds[i];
    if (!bond.is_broken) add_joints(i);
    if (bond.is_broken && bond.overlap > 0) parting_[key_of(bond)] = i;
  }
  measure_energy();
}

Bonds::~Bonds() {
  for (std::size_t i = 0; i < joints_.size(); ++i) remove_joints(i);
}

/// Bonds the pairs whose gap is small enough, by a sweep along x over the bounding spheres.
void Bonds::find_touching(std::size_t rule) {
  const BondRule& material = world_.scene().bonds[rule];
  const std::vector<Grain>& grains = world_.grains();
  if (material.wall) {
    const std::array wall = {world_.walls().geoms()[*material.wall]};
    for (std::size_t i = 0; i < grains.size(); ++i) {
      const double gap = find_closest(grains[i].geoms(), wall).gap;
      if (gap <= *material.touching * grains[i].smallest_half_axis()) add(rule, {0, i});
    }
    return;
  }
  const auto reach = [&](const Grain& grain) { return grain.bounding_radius() + *material.touching * grain.smallest_half_axis(); };
  std::vector<std::pair<double, std::size_t>> by_start;  // m, along x
  for (std::size_t i = 0; i < grains.size(); ++i) by_start.emplace_back(grains[i].position()[0] - reach(grains[i]), i);
  std::ranges::sort(by_start);
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t a = 0; a < by_start.size(); ++a) {
    const Grain& grain = grains[by_start[a].second];
    const Vector3 centre = to_vector(dBodyGetPosition(grain.body));
    for (std::size_t b = a + 1; b < by_start.size() && by_start[b].first <= centre.x() + reach(grain); ++b) {
      const Grain& other = grains[by_start[b].second];
      if ((to_vector(dBodyGetPosition(other.body)) - centre).norm() > reach(grain) + reach(other)) continue;
      const double allowed = *material.touching * std::min(grain.smallest_half_axis(), other.smallest_half_axis());
      if (find_closest(grain.geoms(), other.geoms()).gap > allowed) continue;
      found.emplace_back(std::minmax(by_start[a].second, by_start[b].second));
    }
  }
  std::ranges::sort(found);
  for (const auto& [first, second] : found) add(rule, {first, second});
}

/// Pairs that are bonded already keep their bond.
void Bonds::add(std::size_t rule, const BondedPair& pair) {
  const BondRule& material = world_.scene().bonds[rule];
  const Grain& second = world_.grains()[pair.second];
  Bond bond;
  bond.rule = rule;
  bond.first = material.wall ? Bond::kPart : pair.first;
  bond.second = pair.second;
  if (bonded_.contains(key_of(bond))) return;
  double smallest = second.smallest_half_axis();
  if (material.wall) {
    const WallPose pose = world_.walls().state(*material.wall).pose;
    const std::array wall = {world_.walls().geoms()[*material.wall]};
    bond.rest = pair.rest ? *pair.rest : rest_of(pose, find_closest(second.geoms(), wall).on_second, second);
  } else {
    const Grain& first = world_.grains()[pair.first];
    const WallPose pose = {to_vector(dBodyGetPosition(first.body)), rotation_of(first.body)};
    bond.rest = pair.rest ? *pair.rest : rest_of(pose, pose.position, second);
    smallest = std::min(smallest, first.smallest_half_axis());
  }
  refuse_zero_length(bond, kLeastLength * smallest);
  bond.radius = pair.radius.value_or(material.radius.value_or(material.relative_radius * smallest));
  state_.bonds.push_back(bond);
  joints_.emplace_back();
  add_joints(state_.bonds.size() - 1);
}

/// Bonds by `touching` may join grains whose centres are at one place, or on the surface of a part.
void Bonds::refuse_zero_length(const Bond& bond, double least) const {
  if (bond.rest.length() >= least) return;
  const Scene& scene = world_.scene();
  const BondRule& rule = scene.bonds[bond.rule];
  const std::string first = rule.wall ? "part " + scene.walls[*rule.wall].name : "grain " + std::to_string(bond.first);
  throw InputError(scene.called + ": bond \"" + rule.name + "\": the length from " + first + " to grain " +
                   std::to_string(bond.second) + " (" + world_.grains()[bond.second].kind->name + ") is " +
                   rounded(bond.rest.length()) + " m; allowed: from " + rounded_up(least) +
                   " m on, between two centres, or the centre of a grain and the surface of a part");
}

void Bonds::add_joints(std::size_t index) {
  const Bond& bond = state_.bonds[index];
  const BondRule& rule = world_.scene().bonds[bond.rule];
  Joints& joints = joints_[index];
  joints.has_anchor = bond.first == Bond::kPart;
  joints.first = joints.has_anchor ? dBodyCreate(world_.id()) : world_.grains()[bond.first].body;
  joints.second = world_.grains()[bond.second].body;
  if (joints.has_anchor) {
    dBodySetKinematic(joints.first);
    dBodySetAutoDisableFlag(joints.first, 0);
    place_anchor(bond, joints);
  }
  joints.axes = rotation_between(Vector3::UnitX(), bond.rest.centre - bond.rest.start);
  joints.stiffness = stiffness_of(rule, bond.radius, bond.rest.length());
  const auto [of_first, of_second] = inverse_masses(bond, joints);
  // The row of a spring k and a damper d: velocity + force / (step k + d) = 0. The force of the pose acts besides.
  const auto compliance = [&, first = of_first, second = of_second](std::size_t row) {
    const double stiffness = joints.stiffness[row];
    return 1 / (step_ * stiffness + rule.damping * 2 * std::sqrt(stiffness / (first[row] + second[row])));
  };
  // The rows of a ball joint have the exact lever arms of a bent bond. All have the stiffness of stretching, the largest one.
  const Vector3 middle = strain_of(bond, joints).middle;
  joints.linear = dJointCreateBall(world_.id(), nullptr);
  dJointAttach(joints.linear, joints.first, joints.second);
  dJointSetBallAnchor(joints.linear, middle.x(), middle.y(), middle.z());
  dJointSetBallParam(joints.linear, dParamERP, 0);
  dJointSetBallParam(joints.linear, dParamCFM, compliance(0));
  if (rule.kind == BondKind::Beam) {
    joints.angular = dJointCreateAMotor(world_.id(), nullptr);
    dJointAttach(joints.angular, joints.first, joints.second);
    dJointSetAMotorMode(joints.angular, dAMotorUser);
    dJointSetAMotorNumAxes(joints.angular, 3);
    for (int k = 0; k < 3; ++k) {
      const int group = k * dParamGroup;
      const Vector3 axis =
          rotation_of(joints.first) * (joints.axes * Vector3::Unit(k));  // in the world's frame; turns with the body
      dJointSetAMotorAxis(joints.angular, k, 1, axis.x(), axis.y(), axis.z());
      dJointSetAMotorParam(joints.angular, dParamVel + group, 0);
      dJointSetAMotorParam(joints.angular, dParamFMax + group, dInfinity);
      dJointSetAMotorParam(joints.angular, dParamCFM + group, compliance(static_cast<std::size_t>(k) + 3));
    }
  }
  bonded_[key_of(bond)] = index;
  if (!rule.contacts) hidden_[key_of(bond)] = index;
}

void Bonds::remove_joints(std::size_t index) {
  Joints& joints = joints_[index];
  if (joints.linear == nullptr) return;
  dJointDestroy(joints.linear);
  if (joints.angular != nullptr) dJointDestroy(joints.angular);
  if (joints.has_anchor) dBodyDestroy(joints.first);
  joints.linear = joints.angular = nullptr;
  bonded_.erase(key_of(state_.bonds[index]));
  hidden_.erase(key_of(state_.bonds[index]));
}

/// Moves the body of a part's end of a bond with the part. While the part stands, the body sleeps, so that grains on it may sleep.
void Bonds::place_anchor(const Bond& bond, const Joints& joints) const {
  const auto [pose, velocity] = world_.walls().state(*world_.scene().bonds[bond.rule].wall);
  const Vector3 place = pose(bond.rest.start);
  const Vector3 linear = velocity.linear + velocity.angular.cross(place - pose.position);
  set_pose(joints.first, {place, pose.rotation});
  set_velocity(joints.first, {linear, velocity.angular});
  velocity.is_zero() ? dBodyDisable(joints.first) : dBodyEnable(joints.first);
}

/// 1/kg or 1/(kg m^2), of both bodies for each row.
std::array<Bonds::Rows, 2> Bonds::inverse_masses(const Bond& bond, const Joints& joints) const {
  const Vector3 arm = (bond.rest.centre - bond.rest.start) / 2;
  const Quaterniond to_second = bond.rest.rotation.conjugate();
  const Response first(joints.first), second(joints.second);
  std::array<Rows, 2> inverse{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 axis = joints.axes * Vector3::Unit(static_cast<Eigen::Index>(k));
    const Vector3 axis_of_second = to_second * axis;
    inverse[0][k] = first.to_force(arm, axis);
    inverse[1][k] = second.to_force(to_second * arm, axis_of_second);
    inverse[0][k + 3] = first.to_torque(axis);
    inverse[1][k + 3] = second.to_torque(axis_of_second);
  }
  return inverse;
}

Bonds::Strain Bonds::strain_of(const Bond& bond, const Joints& joints) const {
  const Quaterniond first = rotation_of(joints.first), second = rotation_of(joints.second);
  const Quaterniond back = bond.rest.rotation.conjugate();
  const Vector3 turn = rotation_vector(first.conjugate() * second * back);  // rad, in the frame of the first body
  const Vector3 arm = (bond.rest.centre - bond.rest.start) / 2;
  const Vector3 end_of_first = to_vector(dBodyGetPosition(joints.first)) + first * arm;
  const Vector3 end_of_second = to_vector(dBodyGetPosition(joints.second)) - second * (back * arm);
  Strain strain;
  strain.middle = (end_of_first + end_of_second) / 2;
  strain.frame = first * rotation_by(turn / 2) * joints.axes;
  const Vector3 displacement = strain.frame.conjugate() * (end_of_second - end_of_first);
  const Vector3 rotation = joints.axes.conjugate() * turn;
  const Eigen::Map<const Vector3> linear(joints.stiffness.data()), angular(joints.stiffness.data() + 3);
  strain.force = -linear.cwiseProduct(displacement);
  strain.moment = -angular.cwiseProduct(rotation);
  strain.energy = -(strain.force.dot(displacement) + strain.moment.dot(rotation)) / 2;
  return strain;
}

BondStress Bonds::stress_of(const Bond& bond, const Strain& strain) const {
  const double area = std::numbers::pi * bond.radius * bond.radius;
  const double section = area * bond.radius / 4;  // m^3, second moment of area / radius
  BondStress stress{.tension = -strain.force.x() / area, .shear = strain.force.tail<2>().norm() / area};
  if (world_.scene().bonds[bond.rule].kind == BondKind::Ball) return stress;
  const Vector3 of_shear = bond.rest.length() / 2 * Vector3::UnitX().cross(strain.force);
  const double bending = std::max((strain.moment + of_shear).tail<2>().norm(), (strain.moment - of_shear).tail<2>().norm());
  stress.bending = bending / section;
  stress.torsion = std::abs(strain.moment.x()) / (2 * section);
  return stress;
}

/// The strain whose elastic forces acted in the step: from the pose at its start by the new velocities. Poses have the curvature of
/// paths besides: a pair that a step turns by an angle is stretched by half its square. The joint resists the approach of both ends
/// along the chords of the turn, and the elastic forces outweigh it.
Bonds::Strain Bonds::in_step(const Joints& joints) const {
  Strain strain = *joints.before;
  const Vector3 first_turn = spin_of_move(joints.first), second_turn = spin_of_move(joints.second);
  const Vector3 velocity = velocity_of_move(joints.second) + second_turn.cross(joints.second_arm) - velocity_of_move(joints.first) -
                           first_turn.cross(joints.first_arm);
  const Quaterniond back = strain.frame.conjugate();
  const Eigen::Map<const Vector3> linear(joints.stiffness.data()), angular(joints.stiffness.data() + 3);
  const Vector3 turn = (first_turn + second_turn) / 2, branch = joints.first_arm - joints.second_arm;
  const Vector3 half = step_ / 2 * turn;
  const Quaterniond rotation = Quaterniond(1, half.x(), half.y(), half.z()).normalized();  // as ODE turns bodies
  const Vector3 approach = (rotation * branch - branch) / step_ - turn.cross(branch);
  const double resistance = 1 / dJointGetBallParam(joints.linear, dParamCFM);  // N s/m
  strain.force -= step_ * linear.cwiseProduct(back * (velocity - approach)) + resistance * (back * approach);
  strain.moment -= step_ * angular.cwiseProduct(back * (second_turn - first_turn));
  return strain;
}

void Bonds::before_step() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joints& joints = joints_[i];
    joints.before.reset();
    if (joints.linear == nullptr) continue;
    if (joints.has_anchor) place_anchor(state_.bonds[i], joints);
    // ODE would keep the forces on sleeping bodies until they wake.
    if (dBodyIsEnabled(joints.first) == 0 && dBodyIsEnabled(joints.second) == 0) continue;
    const Strain strain = strain_of(state_.bonds[i], joints);
    const Vector3 force = strain.frame * strain.force, moment = strain.frame * strain.moment;
    // Both bodies at one point: a pair that turns as a whole has no velocity there, and the joint keeps its angular momentum.
    dJointSetBallAnchor(joints.linear, strain.middle.x(), strain.middle.y(), strain.middle.z());
    apply(joints.first, -force, -moment, strain.middle);
    apply(joints.second, force, moment, strain.middle);
    state_.rows += joints.angular == nullptr ? 3 : kRows;
    joints.before = strain;
    joints.first_arm = strain.middle - to_vector(dBodyGetPosition(joints.first));
    joints.second_arm = strain.middle - to_vector(dBodyGetPosition(joints.second));
  }
}

void Bonds::after_step() {
  ++state_.steps;
  energy_ = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joints& joints = joints_[i];
    if (joints.linear == nullptr) continue;
    const Bond& bond = state_.bonds[i];
    const std::optional<Strain> acted = joints.before ? std::optional(in_step(joints)) : std::nullopt;
    if (joints.has_anchor) place_anchor(bond, joints);
    const Strain strain = strain_of(bond, joints);
    const BondRule& rule = world_.scene().bonds[bond.rule];
    const BondStress stress = stress_of(bond, acted.value_or(strain));
    if (stress.tension + stress.bending > rule.tensile_strength || stress.shear + stress.torsion > rule.shear_strength) {
      break_bond(i, strain, stress, false);
    } else {
      energy_ += strain.energy;
    }
  }
}

void Bonds::break_bond(std::size_t index, const Strain& strain, const BondStress& stress, bool is_removed) {
  Bond& bond = state_.bonds[index];
  state_.breaks.push_back({time(), index, to_point(strain.middle), stress, is_removed});
  for (const dBodyID body : {joints_[index].first, joints_[index].second}) dBodyEnable(body);
  const bool parts = hidden_.contains(key_of(bond)) && !is_removed;
  remove_joints(index);
  bond.is_broken = true;
  if (!parts) return;
  bond.overlap = std::numeric_limits<double>::max();  // until the next collision measures it
  parting_[key_of(bond)] = index;
}

void Bonds::release(std::size_t grain) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Bond& bond = state_.bonds[i];
    if (bond.first != grain && bond.second != grain) continue;
    if (joints_[i].linear != nullptr) {
      const Strain strain = strain_of(bond, joints_[i]);
      break_bond(i, strain, stress_of(bond, strain), true);
    }
    parting_.erase(key_of(bond));
    state_.bonds[i].overlap = 0;
  }
  measure_energy();
}

void Bonds::reduce(std::vector<dContactGeom>& contacts) {
  if (parting_.empty()) return;
  std::map<std::uint64_t, double> deepest;  // m, of the parting pairs that touch
  for (const dContactGeom& contact : contacts) {
    const std::uint64_t key = key_of(contact.g1, contact.g2);
    if (parting_.contains(key)) deepest[key] = std::max(deepest[key], double{contact.depth});
  }
  std::erase_if(parting_, [&](const auto& entry) {
    if (dBodyIsEnabled(world_.grains()[state_.bonds[entry.second].second].body) == 0) return false;  // may not have been tested
    const auto found = deepest.find(entry.first);
    double& overlap = state_.bonds[entry.second].overlap;
    overlap = found == deepest.end() ? 0 : std::min(overlap, found->second);
    return overlap <= 0;
  });
  std::erase_if(contacts, [this](dContactGeom& contact) {
    const auto found = parting_.find(key_of(contact.g1, contact.g2));
    if (found == parting_.end()) return false;
    contact.depth -= state_.bonds[found->second].overlap;
    return contact.depth < 0;
  });
}

/// 1/s^2, stiffness / mass of a bond for each of its grains.
std::array<double, 2> Bonds::rates_of(std::size_t index) const {
  const Bond& bond = state_.bonds[index];
  const Rows k = stiffness_of(world_.scene().bonds[bond.rule], bond.radius, bond.rest.length());
  const std::array<Rows, 2> inverse = inverse_masses(bond, joints_[index]);
  std::array<double, 2> rates{};
  std::ranges::transform(inverse, rates.begin(), [&k](const Rows& w) {
    // Shear along y and bending about z act on the same rotation.
    return std::max({k[0] * w[0], k[1] * w[1] + k[5] * w[5], k[2] * w[2] + k[4] * w[4], k[3] * w[3]});
  });
  return rates;
}

Bonds::Stiffness Bonds::stiffness() const {
  struct Load {
    double sum = 0, largest = 0;  // 1/s^2
    std::size_t bond = 0;
  };
  std::vector<Load> loads(world_.grains().size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].linear == nullptr) continue;
    const Bond& bond = state_.bonds[i];
    const auto [of_first, of_second] = rates_of(i);
    for (const auto& [rate, grain] : {std::pair(of_first, bond.first), std::pair(of_second, bond.second)}) {
      if (grain == Bond::kPart) continue;
      Load& load = loads[grain];
      load.sum += rate;
      if (rate > load.largest) std::tie(load.largest, load.bond) = std::pair(rate, i);
    }
  }
  const auto worst = std::ranges::max_element(loads, {}, &Load::sum);
  if (worst == loads.end()) return {};
  return {2 * step_ * step_ * worst->sum, static_cast<std::size_t>(worst - loads.begin()), worst->bond};
}

void Bonds::measure_energy() {
  energy_ = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].linear != nullptr) energy_ += strain_of(state_.bonds[i], joints_[i]).energy;
  }
}

double Bonds::time() const { return std::round(static_cast<double>(state_.steps) * step_ * 1e9) / 1e9; }

std::uint64_t Bonds::key_of(dGeomID g1, dGeomID g2) const {
  constexpr std::uint64_t kWall = 1ULL << 31;  // above all indices of grains
  const auto number = [this](dGeomID geom) -> std::uint64_t {
    if (const Grain* grain = grain_of(geom)) return world_.index_of(*grain);
    const Wall* wall = world_.walls().wall_of(geom);
    return wall == nullptr ? 2 * kWall - 1 : kWall + static_cast<std::uint64_t>(wall - world_.scene().walls.data());
  };
  const auto [least, most] = std::minmax({number(g1), number(g2)});
  return most << 32 | least;
}

std::uint64_t Bonds::key_of(const Bond& bond) const {
  constexpr std::uint64_t kWall = 1ULL << 31;
  const std::uint64_t first = bond.first == Bond::kPart ? kWall + *world_.scene().bonds[bond.rule].wall : bond.first;
  return std::max(first, bond.second) << 32 | std::min(first, bond.second);
}

}  // namespace falling_particles
