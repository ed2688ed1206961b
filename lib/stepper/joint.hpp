// Joints of ODE as rows. What a joint holds is solved at once; a motor and stops act on an axis that it leaves free.
#pragma once

#include <ode/ode.h>

#include <Eigen/Cholesky>
#include <array>
#include <span>
#include <unordered_map>

#include "stepper/body.hpp"

namespace supernormal::stepper {

struct System;
struct SweepSettings;

/// An axis that a joint leaves free.
struct FreeAxis {
  double position = 0;              ///< rad or m
  double low = -kAny, high = kAny;  ///< rad or m; the stops
  double speed = 0;                 ///< rad/s or m/s; what the motor aims at
  double strongest = 0;             ///< N m or N; of the motor
};

/// It lives from step to step and remembers its forces. Body 1 is the one that ODE calculates with, which is never the world.
class Joint : public Link {
 public:
  /// Reads the joint from ODE. False: quickstep must move its bodies, because it is of another type, is soft or bounces.
  bool read(dJointID id);

  /// After its bodies have been read: sets up the rows. The forces of the last step act in sub-steps of `time` (s).
  void begin(System& system, double time);

  /// Solves what the joint holds, then motors and stops, each with the rest of the joint as it follows.
  void solve(System& system, const SweepSettings& settings);

  /// Before the bodies move for `time` (s), and after it (MovingContacts::end_turn).
  void begin_turn(const System& system, double time);
  void end_turn(const System& system);

  /// At the end of a sub-step: counts what it did.
  void count_forces();

  /// Remembers the forces of the present sub-step of `time` (s): those that were recalled, and `part` of what they changed by.
  /// Gives the program the mean over the `step` (s).
  void keep(double time, double part, double step);

  bool is_linear(int row) const { return row < linear_ || (slides_ && row >= held_); }
  std::span<Row> rows() { return {rows_.data(), static_cast<std::size_t>(count_)}; }
  std::span<const Row> rows() const { return {rows_.data(), static_cast<std::size_t>(count_)}; }
  int held() const { return held_; }
  dJointID id() const { return id_; }
  dBodyID body(int side) const { return sides_[static_cast<std::size_t>(side)].body; }

 private:
  static constexpr int kMostRows = 6;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1>;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;

  /// What one body has of the joint.
  struct Side {
    dBodyID body = nullptr;  // null: the world
    Vector3 place, axis;     // m and unit; in the frame of the body
  };
  void set_rows(const System& system);
  Rows velocities(const System& system) const;
  void push(System& system, int row, double impulse);
  double impulse_of(const FreeAxis& axis, int row, double velocity, const SweepSettings& settings) const;

  dJointID id_ = nullptr;
  dJointType type_ = dJointTypeNone;
  int linear_ = 0, held_ = 0, count_ = 0;  // rows that hold places; that hold anything; and those of free axes
  bool slides_ = false;                    // whether the free axis is one of displacement
  std::array<Side, 2> sides_;
  Matrix3 turned_;  // the orientation of body 1 in the frame of body 2, that the joint keeps
  std::array<FreeAxis, 2> axes_;
  std::array<Row, kMostRows> rows_;
  Eigen::LLT<Square> factor_;           // of the mobility of the held rows
  std::array<Rows, 2> compensation_;    // impulses of held rows, for a unit impulse at a free axis
  Rows error_, aim_, before_, forces_;  // of rows: m or rad; m/s or rad/s; the same; N or N m
  Vector3 force_, torque1_, torque2_;   // N s and N m s; of the step so far, about the centres of mass
};

/// All joints that hold bodies of a stepper.
class Joints {
 public:
  /// Lists in `system` the joints that it solves. Sets is_held of bodies that another joint holds, too.
  void read(System& system, const std::unordered_map<dBodyID, int>& indices);

  /// Forgets the joints of a body, and so how its bodies were when they were set.
  void forget(dBodyID body) {
    std::erase_if(known_,
                  [=](const auto& entry) { return entry.second.joint.body(0) == body || entry.second.joint.body(1) == body; });
  }

  /// Enables or disables those of its joints that a predicate selects.
  template <typename Predicate>
  void enable(const Predicate& selects, bool is_enabled) const {
    for (const auto& [id, known] : known_) {
      if (known.is_ours && selects(known.joint)) is_enabled ? dJointEnable(id) : dJointDisable(id);
    }
  }

 private:
  struct Known {
    Joint joint;
    bool is_present = false;
    bool is_ours = false;
  };
  std::unordered_map<dJointID, Known> known_;
};

}  // namespace supernormal::stepper
