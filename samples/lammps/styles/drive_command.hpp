// Parses the drive of a wall.
#pragma once

#include <string>
#include <vector>

#include "common/drive.hpp"
#include "styles/words.hpp"

namespace granular {

/// The parsed drive.
struct DriveCommand {
  common::Drive drive;
  std::string gravity;               ///< the fix gravity that gives the wall weight; empty for none
  std::vector<std::string> between;  ///< four fixes of planes that face each other two by two, for the area; empty if it is given
};

/// Parses, in any order,
///     axis X Y Z, one of
///     force F | pressure P area A | power P largest_force F, each with mass M
///     torque T | power P largest_torque T, each with point X Y Z, moment J and optional mass M
///     stress S gain G largest_speed V, with area A or between FIX FIX FIX FIX
/// and the optional words damping C (not with stress), from T, until T, travel LOW HIGH (m or degrees), gravity FIX. Units are as
/// in [part.drive] of falling_particles. Throws std::invalid_argument with the error.
DriveCommand read_drive(Words& words);

}  // namespace granular
