// The files of a run with checkpoints, which are in its folder until it has ended.
#pragma once

#include <array>
#include <string_view>

namespace falling_particles {

inline constexpr std::string_view kCheckpointFile = "checkpoint";
inline constexpr std::string_view kNewCheckpointFile = "checkpoint.new";  ///< one that is being written
inline constexpr std::string_view kFrameLogFile = "checkpoint.frames";
inline constexpr std::array kCheckpointFiles = {kCheckpointFile, kNewCheckpointFile, kFrameLogFile};

/// What a user can do where a run cannot go on from what is there.
inline constexpr const char* kStartAnew =
    "; without --resume the run starts anew, and removes this unless other files are beside it";

}  // namespace falling_particles
