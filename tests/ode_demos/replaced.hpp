// What replaced.cpp keeps of the demo's geoms, and the numbers that the demo is run with.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

/// The number that an environment variable holds; 0 without it.
double number_from(const char* name);

/// A sphere or box of the demo, of ODE's class or of ours.
struct Replaceable {
  dGeomID geom;
  bool has_started = false;
  std::array<double, 3> start{};  // where its centre was when the loop first came by, m
  double lowest = 0;              // height of the centre, m
};

/// The spheres and boxes of the demo that live.
std::vector<Replaceable>& replaceables();

struct CollisionCounts {
  unsigned long long calls = 0;     // of dCollide
  unsigned long long contacts = 0;  // that these returned
};

const CollisionCounts& collision_counts();

/// The class of ODE that the demo takes the geom for.
extern "C" int demo_geom_get_class(dGeomID geom);
