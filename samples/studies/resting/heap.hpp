// Many bodies of one kind that fall onto a plane and each other, and come to rest.
#pragma once

#include <ode/ode.h>

namespace resting {

/// 60 needles side by side in layers; 60 crossed needles; a heavy cube on three light ones.
enum class Heap { Bundle, Crossed, OnThree };

/// All choices of a program, and the bodies. Everything else has ODE's defaults.
struct HeapRow {
  Heap heap = Heap::Bundle;
  double exponent = 0;  ///< exponent of both sections; 0: dBoxes
  double size = 0.005;  ///< m; the half-thickness of needles, which are 40 times as long, or the half-height of the light cubes
  double step = 0.01;   ///< s
  int room = 8;         ///< max_contacts
  int iterations = 20;  ///< iterations of quickstep
  int in_layer = 60;    ///< needles side by side in a bundle
  bool looks_ahead = false;  ///< contacts before overlap; dBoxes have none
};

/// The outcome of a heap.
struct HeapRest {
  int awake = 0;       ///< number of bodies awake after ten seconds
  double time = 0;     ///< s; until all were asleep
  double speed = 0;    ///< m/s; root mean square over the bodies in the last second in which any was awake
  double overlap = 0;  ///< depth of the deepest contact in that second, in units of the size
};

/// Drops the bodies. Number 0, 1, ... starts in different orientations.
HeapRest settle(const HeapRow& row, int number);

}  // namespace resting
