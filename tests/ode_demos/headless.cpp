// Replaces the drawing functions and dCreateBox of ODE's demos, without a window: runs the demo's loop for DEMO_FRAMES frames,
// and creates each box as a dBox, or with DEMO_EXPONENT as a superellipsoid of that exponent. Prints for every box where its
// centre was at first, where it is in the end, and its lowest position, in m.

#include <drawstuff/drawstuff.h>
#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

// Simulated time of a frame, for demos that ask; s.
constexpr double kFrame = 0.02;

struct Box {
  dGeomID geom;
  std::array<double, 3> start{};
  double lowest = 0;
};

std::vector<Box>& boxes() {
  static std::vector<Box> all;
  return all;
}

double number_from(const char* name) {
  const char* const text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): there is one thread
  return text == nullptr ? 0 : std::strtod(text, nullptr);
}

void remember_start(Box& box) {
  const dReal* const place = dGeomGetPosition(box.geom);
  box.start = {double{place[0]}, double{place[1]}, double{place[2]}};
  box.lowest = box.start[2];
}

void print(const Box& box) {
  const dReal* const place = dGeomGetPosition(box.geom);
  std::printf("box %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n", box.start[0], box.start[1], box.start[2], double{place[0]},
              double{place[1]}, double{place[2]}, box.lowest);
}

}  // namespace

extern "C" {

// The name that the demos are compiled with in place of dCreateBox.
dGeomID demo_create_box(dSpaceID space, dReal lx, dReal ly, dReal lz) {
  const auto exponent = static_cast<dReal>(number_from("DEMO_EXPONENT"));
  const dGeomID geom =
      exponent > 0 ? snCreateSuperellipsoid(space, lx / 2, ly / 2, lz / 2, exponent, exponent) : dCreateBox(space, lx, ly, lz);
  if (geom == nullptr) {
    std::fprintf(stderr, "%s\n", snLastError());
    std::abort();
  }
  boxes().push_back({geom});
  return geom;
}

void dsSimulationLoop(int, char**, int, int, dsFunctions* demo) {
  dRandSetSeed(static_cast<unsigned long>(number_from("DEMO_SEED")));  // quickstep shuffles its rows
  if (demo->start != nullptr) demo->start();
  for (Box& box : boxes()) remember_start(box);
  for (int frame = 0; frame < number_from("DEMO_FRAMES"); ++frame) {
    demo->step(0);
    for (Box& box : boxes()) box.lowest = std::min(box.lowest, double{dGeomGetPosition(box.geom)[2]});
  }
  if (demo->stop != nullptr) demo->stop();
  for (const Box& box : boxes()) print(box);
}

double dsElapsedTime() { return kFrame; }
void dsSetViewpoint(float*, float*) {}
void dsSetColor(float, float, float) {}
void dsDrawBoxD(const double*, const double*, const double*) {}
void dsDrawCylinderD(const double*, const double*, float, float) {}

}  // extern "C"
