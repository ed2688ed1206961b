// Many bodies of one kind that fall onto a plane and onto one another, and how they come to rest.
#pragma once

#include <ode/ode.h>

namespace resting {

/// 60 needles side by side in layers; 60 needles across one another; a heavy cube on three light ones.
enum class Heap { Bundle, Crossed, OnThree };

/// Everything that a program may choose, and the bodies. For everything else ODE's defaults hold.
struct HeapRow {
  Heap heap = Heap::Bundle;
  double exponent = 0;  ///< exponent of both sections; 0: dBoxes
  double size = 0.005;  ///< m; the half-thickness of needles, which are 40 times as long, or the half-height of the light cubes
  double step = 0.01;   ///< s
  int room = 8;         ///< contacts a pair
  int iterations = 20;  ///< iterations of quickstep
  int in_layer = 60;    ///< needles side by side in a bundle
  bool looks_ahead = false;  ///< contacts before overlap; dBoxes have none
};

/// How a heap ended.
struct HeapRest {
  int awake = 0;       ///< number of bodies awake after ten seconds
  double time = 0;     ///< s; until all slept
  double speed = 0;    ///< m/s; root mean square over the bodies in the last second in which any was awake
  double overlap = 0;  ///< depth of the deepest contact in that second, in units of the size
};

/// Lets them fall; number 0, 1, ... starts in different attitudes.
HeapRest settle(const HeapRow& row, int number);

}  // namespace resting
