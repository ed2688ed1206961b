#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <numeric>

#include "../costs.hpp"
#include "colliders.hpp"
#include "common/measured_tables.hpp"
#include "measurement.hpp"
#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using Clock = std::chrono::steady_clock;
using common::OdeGeom;
using common::text;

constexpr double kDepth = 0.02 * kSmallestHalfAxis;  // m; depth of the overlap, and gap when apart
constexpr double kRayShare = 0.5;                    // of the distance at which a ray grazes

enum class Lie { Overlap, Apart };
constexpr std::array kLies = {Lie::Overlap, Lie::Apart};

const char* name_of(Lie lie) { return lie == Lie::Overlap ? "overlap" : "apart"; }

double distance_of(Lie lie, ColliderClass collider, double touching) {
  if (lie == Lie::Apart) return touching + kDepth;
  return collider == ColliderClass::Ray ? kRayShare * touching : touching - kDepth;
}

/// A pair at two consecutive poses.
struct OdeQuery {
  OdePair pair;
  bool is_warm;
  std::array<supernormal::Pose, 2> poses;
  int repeats = 2;
  // The shortest times of all rounds, s: to move the body, and to move it and call dCollide.
  double moving = std::numeric_limits<double>::infinity();
  double asking = std::numeric_limits<double>::infinity();
  double contacts = 0;  // mean

  double time() const { return asking - moving; }  // s; of dCollide
};

constexpr int kMaxRepeats = 4096;  // even, for equal counts of both poses

/// A sink, so that the compiler keeps the queries.
volatile int sink;

/// The time per query, alternating between the two poses, s.
double time_of(const OdeQuery& query, const auto& ask) {
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
  for (const supernormal::Pose& pose : query.poses) {
    query.pair.move_body(pose);
    count += query.pair.collide(contacts);
  }
  return count / 2;
}

/// Measures all queries in turns, so that a disturbance of the machine affects all of them.
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

/// The measurements of one body in one row of the table.
struct Cell {
  std::vector<double> times, contacts;
};

struct Row {
  ColliderClass collider = ColliderClass::Plane;
  Lie lie = Lie::Overlap;
  std::vector<Cell> cells;  // one for each entry of ode_bodies()
};

/// The bodies and the colliders for two rows of the table.
class Meeting {
 public:
  explicit Meeting(ColliderClass collider) : collider_(collider), bodies_(ode_bodies()) {
    for (const OdeBody& body : bodies_) geoms_.push_back(body.make());
    // All bodies collide with the same collider, so that a mesh is in the caches for all or for none.
    const std::size_t count = collider == ColliderClass::Itself ? bodies_.size() : 1;
    for (std::size_t k = 0; k < count; ++k) colliders_.push_back(make_collider(collider, bodies_[k]));
  }

  std::array<Row, kLies.size()> measure(std::size_t poses, common::Random& random, const Effort& effort) const {
    std::array<Row, kLies.size()> rows;
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r] = {collider_, kLies[r], std::vector<Cell>(bodies_.size())};
    for (std::size_t k = 0; k < poses; ++k) {
      const Approach approach = Approach::draw(collider_, random);
      for (const OdeGeom& geom : colliders_) approach.move_collider(collider_, geom.id());
      for (Row& row : rows) measure_pose(approach, effort, row);
    }
    return rows;
  }

 private:
  OdePair pair(std::size_t b) const { return {geoms_[b].id(), colliders_[std::min(b, colliders_.size() - 1)].id()}; }

  void measure_pose(const Approach& approach, const Effort& effort, Row& row) const {
    std::vector<OdeQuery> queries;
    std::vector<Cell*> cells;
    snSetWarmStart(0);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const std::optional<double> touching = touching_distance(pair(b), approach);
      if (!touching) continue;
      queries.push_back({pair(b), bodies_[b].is_warm, approach.poses_at(distance_of(row.lie, collider_, *touching))});
      cells.push_back(&row.cells[b]);
    }
    measure_queries(queries, effort);
    for (std::size_t q = 0; q < queries.size(); ++q) {
      cells[q]->times.push_back(queries[q].time());
      cells[q]->contacts.push_back(queries[q].contacts);
    }
  }

  ColliderClass collider_;
  std::vector<OdeBody> bodies_;
  std::vector<OdeGeom> geoms_, colliders_;
};

double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void write_times(const std::vector<Row>& rows, std::ostream& out) {
  const std::vector<OdeBody> bodies = ode_bodies();
  out << "| collider | pose |";
  for (const OdeBody& body : bodies) out << ' ' << body.name << " |";
  out << "\n|---|---|";
  for (std::size_t b = 0; b < bodies.size(); ++b) out << "---:|";
  for (const Row& row : rows) {
    out << "\n| " << name_of(row.collider) << " | " << name_of(row.lie) << " |";
    for (const Cell& cell : row.cells) {
      out << ' ' << text("%.3f", median(cell.times) * 1e6);
      if (row.lie == Lie::Overlap && !cell.times.empty()) out << " (" << text("%.1f", mean(cell.contacts)) << ")";
      out << " |";
    }
  }
  out << '\n';
}

void write_ratios(const std::vector<Row>& rows, std::ostream& out) {
  const std::vector<OdeBody> bodies = ode_bodies();
  out << "| collider | pose |";
  for (const char* start : {"cold", "warm"}) {
    for (const std::size_t other : kOthers) out << ' ' << start << " / " << bodies[other].name << " |";
  }
  out << "\n|---|---|---:|---:|---:|---:|---:|---:|";
  for (const Row& row : rows) {
    out << "\n| " << name_of(row.collider) << " | " << name_of(row.lie) << " |";
    for (const std::size_t ours : {kOursCold, kOursWarm}) {
      for (const std::size_t other : kOthers) {
        out << ' ' << text("%.2f", median(row.cells[ours].times) / median(row.cells[other].times)) << " |";
      }
    }
  }
  out << '\n';
}

}  // namespace

void write_collider_costs(std::size_t poses, std::uint64_t seed, const Effort& effort, std::ostream& out) {
  common::Random random(seed);
  std::vector<Row> rows;
  for (const ColliderClass collider : kColliderClasses) {
    for (Row& row : Meeting(collider).measure(poses, random, effort)) rows.push_back(std::move(row));
  }
  out << "* poses of each body at each collider: " << poses
      << "\n\nMedian time of a dCollide, µs, and in brackets the mean number of contacts (at most " << kMaxContacts
      << "). Bodies have half-axes 0.5, 0.4, 0.3 m; overlap and apart: by 2 % of the smallest;\nrays hit half-way to the middle. "
         "Each query follows one of a pose 1e-3 (m and rad) away; \"–\": no such pair, or one that found no\n"
         "contact (ODE's dRay takes the distance from a face of a dConvex for that along the ray: slanted rays miss).\n"
         "Moving the body and its bounding box are not counted; what is left is good to about 0.01 µs.\n\n";
  write_times(rows, out);
  out << "\nRatios of the medians: our superellipsoid over ODE's body, below 1 where ours is faster.\n\n";
  write_ratios(rows, out);
}

}  // namespace accuracy_cost
