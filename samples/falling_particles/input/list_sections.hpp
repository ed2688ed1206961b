// The keys of a scene file, as texts for users (lists/). Effects and measurements list their own.
#pragma once

namespace falling_particles {

extern "C" {

/// The sections besides parts, feeders and sinks. Below each section, or each kind of it, every key has a line with its unit, range
/// and default. A test compares the keys with those that the loader accepts.
extern const char kSectionsList[];

/// The shapes, motions and drives of [[part]] with their parameters, units and ranges.
extern const char kWallsList[];

/// The parameters of [[feeder]] and [[sink]] with units and ranges.
extern const char kPopulationList[];
}

}  // namespace falling_particles
