// Tests that answers depend on the pair alone: asked at once on several threads, on a small stack, and over any former content of
// the stack.
#include <doctest/doctest.h>
#include <pthread.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "support/draw.hpp"
#include "support/painted_stack.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_pairs.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// Pairs of every kind, of which body 1 is the same for all.
class PairsOfOneBody {
 public:
  PairsOfOneBody() {
    for (const RandomKind& kind : random_kinds()) {
      RandomBodies& bodies = *bodies_.emplace_back(std::make_unique<RandomBodies>(kind, 5));
      for (const double gap : {0.3, 1e-3, -1e-3, -0.3}) {
        RandomPair pair = bodies.draw_apart();
        if (!pairs_.empty()) pair.shape1 = pairs_.front().shape1;
        bodies.place(pair, gap * pair.unit);
        pairs_.push_back(std::move(pair));
      }
    }
  }

  const std::vector<RandomPair>& pairs() const { return pairs_; }

 private:
  std::vector<std::unique_ptr<RandomBodies>> bodies_;  // they hold vertices that the pairs refer to
  std::vector<RandomPair> pairs_;
};

Numbers ask(const RandomPair& pair) { return numbers_of(find_proximity(*pair.shape1, {}, *pair.shape2, pair.pose2)); }

/// Runs a task on a thread with a stack of so many bytes. A query that needs more ends the program.
template <typename Task>
void run_on_stack(std::size_t bytes, Task task) {
  pthread_attr_t attributes;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstacksize(&attributes, bytes) == 0);
  pthread_t thread{};
  const auto begin = [](void* its_task) -> void* {
    (*static_cast<Task*>(its_task))();
    return nullptr;
  };
  REQUIRE(pthread_create(&thread, &attributes, begin, &task) == 0);
  REQUIRE(pthread_join(thread, nullptr) == 0);
  pthread_attr_destroy(&attributes);
}

/// A box that says that it has faces and edges, and not where.
class Reticent : public Shape {
 public:
  explicit Reticent(const Vector3& half_lengths) : box_(half_lengths) {}

  void evaluate(const Vector3& n, Order order, Jet& jet) const override { box_.evaluate(n, order, jet); }
  ShapeTraits traits() const override { return {.has_hessian = true, .has_nonsmooth_points = true}; }
  Vector3 half_extents() const override { return box_.half_extents(); }

 private:
  Box box_;
};

}  // namespace

TEST_CASE("many pairs of one body at once give the digits that they give one after the other") {
  const PairsOfOneBody bodies;
  const std::vector<RandomPair>& pairs = bodies.pairs();
  std::vector<Numbers> alone;
  alone.reserve(pairs.size());
  for (const RandomPair& pair : pairs) alone.push_back(ask(pair));
  // Each thread begins with another pair, so that at any time different pairs are asked about.
  std::atomic<int> different = 0;
  std::array<std::thread, 4> threads;
  for (std::size_t t = 0; t < threads.size(); ++t) {
    threads[t] = std::thread([&, t] {
      for (std::size_t k = 0; k < 3 * pairs.size(); ++k) {
        const std::size_t i = (k + t * pairs.size() / threads.size()) % pairs.size();
        if (!are_identical(ask(pairs[i]), alone[i])) ++different;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(different == 0);
}

#ifndef __SANITIZE_ADDRESS__  // its frames are several times as large

TEST_CASE("queries run on a stack of 64 KiB") {
  const PairsOfOneBody bodies;
  int different = 0;
  for (const RandomPair& pair : bodies.pairs()) {
    const Numbers expected = ask(pair);
    run_on_stack(64 * 1024, [&] {
      if (!are_identical(ask(pair), expected)) ++different;
    });
  }
  CHECK(different == 0);
}
#endif

TEST_CASE("reference pairs: every solver gives the same digits over any stack, and computes with nothing that it has not set") {
  for (const ReferencePair& pair : some_of(reference_pairs())) {
    for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
      const Settings settings{.solver = solver};
      const auto ask = [&] { return find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, settings); };
      if (!is_same_on_every_stack(ask)) FAIL_CHECK(pair.name);
      const Traps traps(pair.name.c_str());
      if (solver == Solver::Hybrid) ask_on_painted_stack(kSignallingNan, ask);
    }
  }
}

TEST_CASE("a body with faces that names no vertex is known by its boundary points") {
  const Reticent box(Vector3(0.5, 0.4, 0.3));
  const Ellipsoid body(Vector3(1, 0.8, 0.6));
  for (const double height : {0.5, 0.85, 0.95}) {
    const Pose pose2{{0.1, 0.2, height}, Matrix3::Identity()};
    const auto ask = [&] { return find_proximity(body, {}, box, pose2, {}); };
    CHECK(is_same_on_every_stack(ask));
    const Proximity known = find_proximity(body, {}, Box(Vector3(0.5, 0.4, 0.3)), pose2, {});
    CHECK(ask().gap == doctest::Approx(known.gap).epsilon(1e-6));
  }
}
