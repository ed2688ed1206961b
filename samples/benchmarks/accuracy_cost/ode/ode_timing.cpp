#include "ode_timing.hpp"

#include <algorithm>
#include <chrono>

#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using Clock = std::chrono::steady_clock;
using supernormal::Pose;

constexpr int kMaxRepeats = 4096;  // even, for equal counts of both poses

/// A sink, so that the compiler keeps the queries.
volatile int sink;

/// The time per query, alternating between the two poses, s.
template <typename Ask>
double time_of(const OdeQuery& query, const Ask& ask) {
  const auto start = Clock::now();
  for (int k = 0; k < query.repeats; ++k) {
    query.pair.move_body(query.poses[static_cast<std::size_t>(k % 2)]);
    sink = ask();
  }
  return std::chrono::duration<double>(Clock::now() - start).count() / query.repeats;
}

void time_once(OdeQuery& query) {
  snSetWarmStart(query.is_warm ? 1 : 0);
  std::array<dContactGeom, kMaxContacts> contacts;
  query.pair.move_body(query.poses[1]);
  query.pair.collide(contacts);
  query.asking = std::min(query.asking, time_of(query, [&] { return query.pair.collide(contacts); }));
  query.moving = std::min(query.moving, time_of(query, [] { return 0; }));
}

double count_contacts(const OdeQuery& query) {
  std::array<dContactGeom, kMaxContacts> contacts;
  double count = 0;
  for (const Pose& pose : query.poses) {
    query.pair.move_body(pose);
    count += query.pair.collide(contacts);
  }
  return count / 2;
}

}  // namespace

void measure_queries(std::vector<OdeQuery>& queries, const Effort& effort) {
  for (OdeQuery& query : queries) {
    query.contacts = count_contacts(query);
    time_once(query);
    query.repeats = 2 * std::clamp(static_cast<int>(0.5 * effort.batch / query.asking), 1, kMaxRepeats / 2);
  }
  for (int round = 0; round < effort.rounds; ++round) {
    for (std::size_t turn = 0; turn < queries.size(); ++turn) {
      // The predecessor of a query varies.
      time_once(queries[(turn + static_cast<std::size_t>(round)) % queries.size()]);
    }
  }
}

}  // namespace accuracy_cost
