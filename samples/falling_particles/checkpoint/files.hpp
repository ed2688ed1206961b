// The files of a run with checkpoints, which are in its folder until it has ended.
#pragma once

#include <array>
#include <string_view>

namespace falling_particles {

inline constexpr std::string_view kCheckpointFile = "checkpoint";
inline constexpr std::string_view kNewCheckpointFile = "checkpoint.new";  ///< one that is being written
inline constexpr std::string_view kFrameLogFile = "checkpoint.frames";
inline constexpr std::array kCheckpointFiles = {kCheckpointFile, kNewCheckpointFile, kFrameLogFile};

}  // namespace falling_particles
