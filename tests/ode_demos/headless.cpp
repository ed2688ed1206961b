// Replaces the drawing functions of ODE's demos, without a window. It runs the demo's loop for DEMO_FRAMES frames and presses the
// keys DEMO_KEYS, one every DEMO_KEY_FRAMES frames. For every sphere and box on a body it prints its first, its last and its lowest
// position, in m. It also prints the processor time, counts of collisions and the messages of ODE.
//
// ODE's functions for spheres and boxes as the demos call them (replaced.h). With DEMO_SPHERES=1 a sphere is an ellipsoid of ours.
// With DEMO_EXPONENT a box is a superellipsoid of that exponent. Otherwise they are ODE's own. Classes and sizes are reported as
// the demo requested them, since the demo chooses friction and drawing by them.
#include <drawstuff/drawstuff.h>
#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

/// The number in an environment variable; 0 without it.
double number_from(const char* name) {
  const char* const text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): there is one thread
  return text == nullptr ? 0 : std::strtod(text, nullptr);
}

// The exponents of an ellipsoid; boxes have larger ones.
constexpr dReal kRound = 2;

/// A sphere or box of the demo, of ODE's class or of ours.
struct Replaceable {
  dGeomID geom;
  bool has_started = false;
  std::array<double, 3> start{};  // m; its centre when the loop first ran
  double lowest = 0;              // m; height of the centre
};

/// The living spheres and boxes of the demo.
std::vector<Replaceable>& replaceables() {
  static std::vector<Replaceable> all;
  return all;
}

struct CollisionCounts {
  unsigned long long calls = 0;     // calls of dCollide
  unsigned long long contacts = 0;  // contacts that these returned
};

struct Size {
  std::array<dReal, 3> half_axes{};
  dReal exponent = 0;
};

CollisionCounts& counts() {
  static CollisionCounts all;
  return all;
}

bool is_ours(dGeomID geom) { return dGeomGetClass(geom) == snGeomClass(); }

Size size_of(dGeomID geom) {
  Size size;
  dReal epsilon = 0;
  auto& [a, b, c] = size.half_axes;
  if (snGeomSuperellipsoidGetParams(geom, &a, &b, &c, &size.exponent, &epsilon) == 0) std::abort();
  return size;
}

dGeomID remembered(dGeomID geom) {
  if (geom == nullptr) {
    std::fprintf(stderr, "%s\n", snLastError());
    std::abort();
  }
  replaceables().push_back({geom});
  return geom;
}

}  // namespace

extern "C" {

dGeomID demo_create_sphere(dSpaceID space, dReal radius) {
  static const bool ours = number_from("DEMO_SPHERES") > 0;
  return remembered(ours ? snCreateEllipsoid(space, radius, radius, radius) : dCreateSphere(space, radius));
}

dGeomID demo_create_box(dSpaceID space, dReal lx, dReal ly, dReal lz) {
  static const auto exponent = static_cast<dReal>(number_from("DEMO_EXPONENT"));
  return remembered(exponent > 0 ? snCreateSuperellipsoid(space, lx / 2, ly / 2, lz / 2, exponent, exponent)
                                 : dCreateBox(space, lx, ly, lz));
}

void demo_geom_destroy(dGeomID geom) {
  std::erase_if(replaceables(), [geom](const Replaceable& known) { return known.geom == geom; });
  dGeomDestroy(geom);
}

int demo_geom_get_class(dGeomID geom) {
  if (!is_ours(geom)) return dGeomGetClass(geom);
  return size_of(geom).exponent == kRound ? dSphereClass : dBoxClass;
}

void demo_sphere_set_radius(dGeomID geom, dReal radius) {
  if (!is_ours(geom)) return dGeomSphereSetRadius(geom, radius);
  if (snGeomSuperellipsoidSetParams(geom, radius, radius, radius, kRound, kRound) == 0) std::abort();
}

dReal demo_sphere_get_radius(dGeomID geom) { return is_ours(geom) ? size_of(geom).half_axes[0] : dGeomSphereGetRadius(geom); }

dReal demo_sphere_point_depth(dGeomID geom, dReal x, dReal y, dReal z) {
  return is_ours(geom) ? snGeomPointDepth(geom, x, y, z) : dGeomSpherePointDepth(geom, x, y, z);
}

void demo_box_get_lengths(dGeomID geom, dReal* lengths) {
  if (!is_ours(geom)) return dGeomBoxGetLengths(geom, lengths);
  const Size size = size_of(geom);
  std::ranges::transform(size.half_axes, lengths, [](dReal half) { return 2 * half; });
}

int demo_collide(dGeomID g1, dGeomID g2, int flags, dContactGeom* contacts, int skip) {
  const int found = dCollide(g1, g2, flags, contacts, skip);
  counts().calls += 1;
  counts().contacts += static_cast<unsigned>(found);
  return found;
}

// Without the demo's threads a run has the same digits every time, and its processor time is the time of its work.
void demo_set_threading(dWorldID world, const dThreadingFunctionsInfo* functions, dThreadingImplementationID threading) {
  if (number_from("DEMO_THREADS") > 0) dWorldSetStepThreadingImplementation(world, functions, threading);
}

}  // extern "C"

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
  std::printf("seconds %.4f\ncalls %llu\ncontacts %llu\nour_calls %llu\n", seconds, counts().calls, counts().contacts,
              ours.queries_cold + ours.queries_warm + ours.closed_forms);
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
