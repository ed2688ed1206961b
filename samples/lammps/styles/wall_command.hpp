// Parses the command of a wall, and the drive in it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/drive.hpp"
#include "common/motion.hpp"
#include "kernel/contact_material.hpp"
#include "kernel/walls/wall.hpp"
#include "styles/words.hpp"

namespace granular {

/// The parsed drive.
struct DriveCommand {
  common::Drive drive;
  std::string gravity;               ///< the fix gravity that gives the wall weight; empty for none
  std::vector<std::string> between;  ///< four fixes of planes that face each other two by two, for the area; empty if it is given
};

/// The parsed command.
struct WallCommand {
  std::unique_ptr<Wall> wall;
  Vector3 anchor = Vector3::Zero();  ///< m; initial origin of the wall's frame
  std::optional<Vector3> normal;     ///< of a plane, unit; out of the wall
  ContactMaterial material;          ///< unless `type` is set
  std::optional<int> type;           ///< the wall has the material of this atom type
  std::vector<common::WallMotion> motions;
  std::optional<DriveCommand> drive;
};

/// Parses
///     plane POINT NORMAL | box LOW HIGH | cylinder POINT AXIS RADIUS | mesh FILE UNIT
/// Each takes three numbers, except RADIUS and UNIT (m). Then follow the contact law of pair_coeff, or `type` and an atom type, and
/// any number of
///     move linear VELOCITY | rotate AXIS POINT RPM | vibrate AMPLITUDE FREQUENCY PHASE | conveyor VELOCITY
/// each with optional `from SECONDS` and `until SECONDS`, and at the end optionally `drive` with its words.
/// Throws std::invalid_argument or std::runtime_error with the error.
WallCommand read_wall_command(Words words);

}  // namespace granular
