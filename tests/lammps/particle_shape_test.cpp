// Shapes of particles and their rotation.
#include "kernel/particle_shape.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/relative.hpp"

using namespace granular;
using supernormal::test::relative;

TEST_CASE("lammps: the bounding radius is the distance of the farthest point") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const auto& [delta, epsilon] : {std::pair(1.3, 1.6), {2.0, 2.0}, {2.5, 8.0}, {8.0, 1.5}, {1.5, 50.0}, {100.0, 100.0}}) {
    const Vector3 axes(0.02, 0.015, 0.008);
    const ParticleShape shape(axes, delta, epsilon);
    // r(n) is parallel to n at the farthest point. Ascend there from many starts.
    double farthest = 0;
    for (int start = 0; start < 50; ++start) {
      Vector3 n = Vector3(normal(random), normal(random), normal(random)).normalized();
      for (int i = 0; i < 3000; ++i) n = (n + shape.body.point(n).normalized()).normalized();
      farthest = std::max(farthest, shape.body.point(n).norm());
    }
    CAPTURE(shape.body.delta());
    CHECK(shape.bounding_radius == relative(farthest).epsilon(1e-4));
    CHECK(shape.bounding_radius >= farthest * (1 - 1e-12));
  }
}

TEST_CASE("lammps: an ellipsoid has its volume and inertia") {
  const ParticleShape shape({0.3, 0.2, 0.1}, 2, 2);
  CHECK(shape.volume == relative(4.0 / 3 * std::acos(-1.0) * 0.006).epsilon(1e-12));
  CHECK(shape.unit_inertia.x() == relative((0.04 + 0.01) / 5).epsilon(1e-12));
  CHECK(shape.unit_inertia.z() == relative((0.09 + 0.04) / 5).epsilon(1e-12));
}

TEST_CASE("lammps: the ellipsoid of a shape has its inertia") {
  const Vector3 axes(0.3, 0.2, 0.1);
  CHECK((ParticleShape(axes, 2, 2).equal_ellipsoid() - axes).norm() < 1e-12);
  const ParticleShape brick(axes, 12, 20);
  CHECK((ParticleShape(brick.equal_ellipsoid(), 2, 2).unit_inertia - brick.unit_inertia).norm() < 1e-12);
}

TEST_CASE("lammps: a symmetric top precesses with Euler's period") {
  // With the moments I1 = I2, the axis rotates about the angular momentum L at L/I1.
  const Vector3 inertia(2, 2, 0.5), momentum(0.3, 0, 1);
  const double period = 2 * std::acos(-1.0) / (momentum.norm() / inertia.x());
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  const int steps = 2000;
  for (int i = 0; i < steps; ++i) attitude = rotate_freely(attitude, momentum, inertia, period / steps);
  CHECK((attitude * Vector3::UnitZ() - Vector3::UnitZ()).norm() < 1e-5);
}

TEST_CASE("lammps: the energy of an asymmetric top does not drift") {
  const Vector3 inertia(1, 2, 3), momentum(0.1, 2, 0.1);
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  const auto energy = [&] {
    const Vector3 body = attitude.conjugate() * momentum;
    return 0.5 * body.cwiseProduct(body).cwiseQuotient(inertia).sum();
  };
  const double start = energy();
  double largest = 0, late = 0;
  for (int i = 0; i < 200000; ++i) {
    attitude = rotate_freely(attitude, momentum, inertia, 0.02);
    const double error = std::abs(energy() - start) / start;
    (i < 20000 ? largest : late) = std::max(i < 20000 ? largest : late, error);
  }
  CHECK(largest < 1e-4);
  CHECK(late < 1.1 * largest);
}
