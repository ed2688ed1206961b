// Tests that one body can be asked about any number of pairs at once, on any number of threads.
#include <doctest/doctest.h>
#include <pthread.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "support/painted_stack.hpp"
#include "support/random_bodies.hpp"

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
namespace {

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

}  // namespace

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
