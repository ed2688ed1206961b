// The records of replaced.cpp about the demo's geoms, and the numbers for the demo's run.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

/// The number in an environment variable; 0 without it.
double number_from(const char* name);

/// A sphere or box of the demo, of ODE's class or of ours.
struct Replaceable {
  dGeomID geom;
  bool has_started = false;
  std::array<double, 3> start{};  // m; its centre when the loop first ran
  double lowest = 0;              // m; height of the centre
};

/// The living spheres and boxes of the demo.
std::vector<Replaceable>& replaceables();

struct CollisionCounts {
  unsigned long long calls = 0;     // calls of dCollide
  unsigned long long contacts = 0;  // contacts that these returned
};

const CollisionCounts& collision_counts();

/// The class of ODE that the demo sees.
extern "C" int demo_geom_get_class(dGeomID geom);
