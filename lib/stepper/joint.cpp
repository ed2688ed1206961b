#include "stepper/joint.hpp"

#include <algorithm>

#include "ode/geom/convert.hpp"
#include "stepper/contact.hpp"
#include "stepper/sweep.hpp"

namespace supernormal::stepper {

void Joint::begin(System& system, double time) {
  force_ = torque1_ = torque2_ = Vector3::Zero();
  part_before = std::min(system.body1(*this).part_before(), system.body2(*this).part_before());
  set_rows(system);
  for (int i = 0; i < count_; ++i) {
    rows_[std::size_t(i)].impulse = time * forces_[i];
    rows_[std::size_t(i)].total = 0;
  }
}

void Joint::set_rows(const System& system) {
  const Body& one = system.body1(*this);
  const Body& two = system.body2(*this);
  const Vector3 away1 = one.rotation * sides_[0].place;
  const Vector3 away2 = two.rotation * sides_[1].place;
  const Vector3 apart = one.centre() + away1 - two.centre() - away2;
  const Vector3 axis1 = one.rotation * sides_[0].axis;
  const Vector3 axis2 = two.rotation * sides_[1].axis;
  arm1 = slides_ ? Vector3(away1 - apart) : away1;  // what slides is held where body 2 is
  arm2 = away2;
  const Vector3 across = two.rotation * sides_[1].axis.unitOrthogonal();
  const Matrix3 turn = one.rotation * turned_.transpose() * two.rotation.transpose();
  const Vector3 turned = 0.5 * Vector3(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  const std::array<Vector3, 3> world = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};

  error_.resize(held_);
  int count = 0;
  std::array<Vector3, kMostRows> lever1, lever2;
  const auto add = [&](const Vector3& direction, double error = 0) {
    const auto k = std::size_t(count);
    lever1[k] = is_linear(count) ? arm1.cross(direction) : direction;
    lever2[k] = is_linear(count) ? arm2.cross(direction) : direction;
    rows_[k].set(direction, one, lever1[k], two, lever2[k]);
    if (count < held_) error_[count] = error;
    ++count;
  };
  const auto add_both = [&](const Vector3& errors) {
    for (const Vector3& direction : {across, Vector3(axis2.cross(across))}) add(direction, errors.dot(direction));
  };
  const auto add_all = [&](const Vector3& errors) {
    for (int k = 0; k < 3; ++k) add(world[std::size_t(k)], errors[k]);
  };
  slides_ ? add_both(apart) : add_all(apart);
  if (type_ == dJointTypeHinge) add_both(axis2.cross(axis1));
  if (type_ == dJointTypeUniversal) add(axis1.cross(axis2).normalized(), axis1.dot(axis2));
  if (type_ == dJointTypeSlider || type_ == dJointTypeFixed) add_all(turned);
  if (count < count_) add(axis1);
  if (count < count_) add(axis2);

  Square mobility(count_, count_);
  for (int i = 0; i < count_; ++i) {
    const auto a = std::size_t(i);
    for (int j = 0; j < count_; ++j) {
      const auto b = std::size_t(j);
      mobility(i, j) = lever1[a].dot(rows_[b].response1) + lever2[a].dot(rows_[b].response2);
      if (!is_linear(i) || !is_linear(j)) continue;
      mobility(i, j) += (one.inverse_mass + two.inverse_mass) * rows_[a].direction.dot(rows_[b].direction);
    }
    rows_[a].mobility = mobility(i, i);
  }
  factor_.compute(mobility.topLeftCorner(held_, held_));
  for (int i = held_; i < count_; ++i) {
    Rows& follows = compensation_[std::size_t(i - held_)];
    follows = -factor_.solve(mobility.block(0, i, held_, 1));
    rows_[std::size_t(i)].mobility += follows.dot(mobility.block(0, i, held_, 1).col(0));
  }
}

Joint::Rows Joint::velocities(const System& system) const {
  const Vector3 velocity = system.velocity(*this);
  const Vector3 spin = system.spin(*this);
  Rows along(count_);
  for (int i = 0; i < count_; ++i) along[i] = rows_[std::size_t(i)].direction.dot(is_linear(i) ? velocity : spin);
  return along;
}

void Joint::push(System& system, int row, double impulse) {
  Row& at = rows_[std::size_t(row)];
  at.impulse += impulse;
  is_linear(row) ? system.push(*this, at, impulse) : system.turn(*this, at, impulse);
}

void Joint::solve(System& system, const SweepSettings& settings) {
  const bool is_biased = settings.is_biased;
  const Softness softness = is_biased ? settings.softness : Softness();
  Rows missing = -velocities(system).head(held_);
  if (is_biased) missing += aim_ - softness.rate * error_;
  const Rows impulses = factor_.solve(softness.mass * missing);
  for (int i = 0; i < held_; ++i) {
    const Row& row = rows_[std::size_t(i)];
    push(system, i, impulses[i] - softness.keep * (row.impulse + (is_biased ? row.later : 0)));
  }
  for (int i = held_; i < count_; ++i) {
    const auto k = std::size_t(i - held_);
    const double change = impulse_of(axes_[k], i, velocities(system)[i], settings) - rows_[std::size_t(i)].impulse;
    if (change == 0) continue;
    push(system, i, change);
    for (int j = 0; j < held_; ++j) push(system, j, change * compensation_[k][j]);
  }
}

/// N s or N m s; the motor has what force it needs, up to its largest one, and the stops are stronger.
double Joint::impulse_of(const FreeAxis& axis, int row, double velocity, const SweepSettings& settings) const {
  const Row& at = rows_[std::size_t(row)];
  const double strongest = axis.strongest * settings.time * (settings.is_biased ? part_before : 1);
  const double free = velocity - at.mobility * at.impulse;
  const double motor = std::clamp((axis.speed - free) / at.mobility, -strongest, strongest);
  // What is apart from a stop may close the gap; an overlap is corrected.
  const auto reach = [&](double gap) {
    return gap >= 0 ? gap / settings.time : settings.is_biased ? settings.softness.rate * gap : 0;
  };
  const double lowest = axis.low > -kAny ? -reach(axis.position - axis.low) : -kAny;
  const double highest = axis.high < kAny ? reach(axis.high - axis.position) : kAny;
  return (std::clamp(free + at.mobility * motor, lowest, std::max(lowest, highest)) - free) / at.mobility;
}

void Joint::begin_turn(const System& system, double time) {
  before_ = velocities(system);
  for (int i = held_; i < count_; ++i) axes_[std::size_t(i - held_)].position += time * before_[i];
}

void Joint::end_turn(const System& system) {
  set_rows(system);
  aim_ = -0.5 * (velocities(system) - before_).head(held_);
}

void Joint::count_forces() {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
  for (int i = 0; i < count_; ++i) {
    Row& row = rows_[std::size_t(i)];
    row.total += row.impulse;
    (is_linear(i) ? force : torque) += row.impulse * row.direction;
  }
  force_ += force;
  torque1_ += arm1.cross(force) + torque;
  torque2_ -= arm2.cross(force) + torque;
}

void Joint::keep(double time, double part, double step) {
  for (int i = 0; i < count_; ++i) forces_[i] += part * (rows_[std::size_t(i)].impulse / time - forces_[i]);
  dJointFeedback* const feedback = dJointGetFeedback(id_);
  if (feedback == nullptr) return;
  ode::from_vector(force_ / step, feedback->f1);
  ode::from_vector(torque1_ / step, feedback->t1);
  ode::from_vector(-force_ / step, feedback->f2);
  ode::from_vector(torque2_ / step, feedback->t2);
}

}  // namespace supernormal::stepper
