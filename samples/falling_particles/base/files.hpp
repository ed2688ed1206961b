// The files of a run with checkpoints. They are in its folder until the run has ended.
#pragma once

#include <array>
#include <string_view>

namespace falling_particles {

inline constexpr std::string_view kCheckpointFile = "checkpoint";
inline constexpr std::string_view kNewCheckpointFile = "checkpoint.new";  ///< the checkpoint that is being written
inline constexpr std::string_view kFrameLogFile = "checkpoint.frames";
inline constexpr std::array kCheckpointFiles = {kCheckpointFile, kNewCheckpointFile, kFrameLogFile};

/// The advice to a user when a run cannot be resumed.
inline constexpr const char* kStartAnew =
    "; without --resume the run starts anew, and removes this unless other files are beside it";

}  // namespace falling_particles
