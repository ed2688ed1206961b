// Face to face. The boundary point changes steeply with the normal, and the witness points jump by the size of the face.
#include "support/hard_cases/builders.hpp"

namespace supernormal::samples {
namespace {

const Vector3 kLower(1, 0.8, 0.5), kUpper(0.7, 0.6, 0.25);  // m; half-axes
constexpr double kFacesMeet = 0.75;                         // m; height of the upper body's centre

void add_tilted(std::vector<HardCase>& cases, const std::string& what, double exponent, double gap) {
  for (const double tilt : {0., 1e-300, 1e-16, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2}) {
    const Matrix3 rotation = turned(Vector3(2, 1, 0), tilt);
    const std::optional<double> known = tilt == 0 ? std::optional(gap) : std::nullopt;
    cases.push_back(pair("face to face: " + what + ", tilted by " + text(tilt),
                         tilt == 0
                             ? "every point of two faces has the common normal"
                             : "the faces meet at a corner, but only just: a tiny turn moves the witness points across the face",
                         superellipsoid(kLower, exponent, exponent), superellipsoid(kUpper, exponent, exponent),
                         at({0.1, -0.05, kFacesMeet + gap}, rotation), known));
  }
}

}  // namespace

std::vector<HardCase> face_cases() {
  std::vector<HardCase> cases;
  add_tilted(cases, "boxy (20) apart", 20, 0.0625);
  add_tilted(cases, "boxy (20) overlapping", 20, -0.015625);
  add_tilted(cases, "nearly boxes (1000) apart", 1000, 0.0625);
  add_tilted(cases, "nearly boxes (1000) overlapping", 1000, -0.015625);
  const std::string reason = "the faces overlap by little: the centre line points past both";
  for (const double exponent : {8., 100., 1000.}) {
    cases.push_back(pair("face to face: boxy " + text(exponent) + ", the upper one shifted to the lower one's rim", reason,
                         superellipsoid(kLower, exponent, exponent), superellipsoid(kUpper, exponent, exponent),
                         at({1.65, 0, kFacesMeet - 0.015625})));
  }
  cases.push_back(pair("face to face: cylinder-like on cylinder-like", "flat caps on round bodies: delta 2, epsilon 200",
                       superellipsoid(Vector3(1, 1, 0.5), 2, 200), superellipsoid(Vector3(0.5, 0.5, 0.25), 2, 200),
                       at({0.25, 0.25, 0.6875}), -0.0625));
  cases.push_back(pair("face to face: turned by 45 degrees, corner over edge",
                       "a corner of the face hangs over the lower one's edge", superellipsoid(kLower, 50, 50),
                       superellipsoid(kLower, 50, 50), at({0.9, 0.7, 0.98}, turned(Vector3::UnitZ(), kEighthTurn))));
  return cases;
}

}  // namespace supernormal::samples
