#pragma once

#include <filesystem>

#include "scene.hpp"

namespace falling_particles {

enum class RunEnd { Completed, Interrupted };

/// Simulates the scene and writes `out`/<scene>/; prints the summary to stdout and, unless quiet, progress to stderr.
RunEnd run(const Scene& scene, const std::filesystem::path& out, bool quiet);

}  // namespace falling_particles
