// Replaces the drawing functions of ODE's demos, without a window. It runs the demo's loop for DEMO_FRAMES frames and presses the
// keys DEMO_KEYS, one every DEMO_KEY_FRAMES frames. For every sphere and box on a body it prints its first, its last and its lowest
// position, in m. It also prints the processor time, counts of collisions and the messages of ODE.
#include <drawstuff/drawstuff.h>
#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "replaced.hpp"

namespace {

// s; the simulated time of a frame, for demos that ask for it.
constexpr double kFrame = 0.02;

void print_message(int number, const char* format, va_list arguments) {
  std::printf("message %d ", number);
  std::vprintf(format, arguments);
  std::printf("\n");
}

// Before main(), since demos draw random objects and print messages there. Quickstep shuffles its rows by the same seed.
[[gnu::constructor]] void prepare() {
  dRandSetSeed(static_cast<unsigned long>(number_from("DEMO_SEED")));
  dSetMessageHandler(print_message);
}

void follow(Replaceable& known) {
  const dReal* const place = dGeomGetPosition(known.geom);
  if (!known.has_started) {
    known.has_started = true;
    known.start = {double{place[0]}, double{place[1]}, double{place[2]}};
    known.lowest = known.start[2];
  }
  known.lowest = std::min(known.lowest, double{place[2]});
}

void print(const Replaceable& known) {
  const dReal* const place = dGeomGetPosition(known.geom);
  const char* const kind = demo_geom_get_class(known.geom) == dBoxClass ? "box" : "sphere";
  std::printf("%s %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n", kind, known.start[0], known.start[1], known.start[2], double{place[0]},
              double{place[1]}, double{place[2]}, known.lowest);
}

/// Presses the keys for this frame.
void press_keys(const dsFunctions& demo, const std::string& keys, int frame) {
  const int every = std::max(1, static_cast<int>(number_from("DEMO_KEY_FRAMES")));
  const auto due = static_cast<std::size_t>(frame / every);
  if (frame % every == 0 && due < keys.size()) demo.command(keys[due]);
}

}  // namespace

extern "C" {

void dsSimulationLoop(int, char**, int, int, dsFunctions* demo) {
  const char* const keys = std::getenv("DEMO_KEYS");  // NOLINT(concurrency-mt-unsafe): there is one thread
  if (demo->start != nullptr) demo->start();
  for (Replaceable& known : replaceables()) follow(known);
  const std::clock_t begin = std::clock();
  for (int frame = 0; frame < number_from("DEMO_FRAMES"); ++frame) {
    press_keys(*demo, keys == nullptr ? "" : keys, frame);
    demo->step(0);
    for (Replaceable& known : replaceables()) follow(known);
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  for (const Replaceable& known : replaceables()) {
    if (dGeomGetBody(known.geom) != nullptr) print(known);
  }
  if (demo->stop != nullptr) demo->stop();
  snStatistics ours;
  snGetStatistics(&ours);
  std::printf("seconds %.4f\ncalls %llu\ncontacts %llu\nour_calls %llu\n", seconds, collision_counts().calls,
              collision_counts().contacts, ours.queries_cold + ours.queries_warm + ours.closed_forms);
  if (*snLastError() != '\0') std::printf("message %s\n", snLastError());
}

double dsElapsedTime() { return kFrame; }
void dsSetViewpoint(float*, float*) {}
void dsSetColor(float, float, float) {}
void dsSetColorAlpha(float, float, float, float) {}
void dsSetTexture(int) {}
void dsSetSphereQuality(int) {}
void dsSetCapsuleQuality(int) {}
void dsDrawBox(const float*, const float*, const float*) {}
void dsDrawSphere(const float*, const float*, float) {}
void dsDrawTriangle(const float*, const float*, const float*, const float*, const float*, int) {}
void dsDrawCylinder(const float*, const float*, float, float) {}
void dsDrawBoxD(const double*, const double*, const double*) {}
void dsDrawSphereD(const double*, const double*, float) {}
void dsDrawTriangleD(const double*, const double*, const double*, const double*, const double*, int) {}
void dsDrawCylinderD(const double*, const double*, float, float) {}
void dsDrawCapsuleD(const double*, const double*, float, float) {}
void dsDrawLineD(const double*, const double*) {}
void dsDrawConvexD(const double*, const double*, const double*, unsigned, const double*, unsigned, const unsigned*) {}

}  // extern "C"
