// The words of fix wall/supernormal.
#pragma once

#include <memory>
#include <vector>

#include "kernel/contact_material.hpp"
#include "kernel/walls/wall.hpp"
#include "model/motion.hpp"
#include "styles/words.hpp"

namespace granular {

/// What the command says.
struct WallCommand {
  std::unique_ptr<Wall> wall;
  Vector3 anchor = Vector3::Zero();  ///< m; where the origin of the wall's frame is at the start
  ContactMaterial material;
  std::vector<falling_particles::WallMotion> motions;
};

/// Reads
///     plane POINT NORMAL | box LOW HIGH | cylinder POINT AXIS RADIUS | mesh FILE UNIT
/// with three numbers for each but RADIUS and UNIT (m), then the contact law of pair_coeff, and any number of
///     move linear VELOCITY | rotate AXIS POINT RPM | vibrate AMPLITUDE FREQUENCY PHASE | conveyor VELOCITY
/// each with from SECONDS and until SECONDS where it is not on all the time.
/// std::invalid_argument or std::runtime_error says what is wrong.
WallCommand read_wall_command(Words words);

}  // namespace granular
