#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../costs.hpp"
#include "colliders.hpp"
#include "common/measured_tables.hpp"
#include "common/ode_geom.hpp"
#include "measurement.hpp"
#include "pairs.hpp"
#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using common::make_trimesh;
using common::OdeGeom;
using common::Random;
using common::terrain;
using common::text;
using supernormal::Pose;
using supernormal::Vector3;

const Vector3 kBrick(0.5, 0.25, 0.15);  // m; half-axes
constexpr std::array kExponents = {2.3, 3.0, 4.0, 8.0, 12.0, 20.0, 60.0, 200.0};
constexpr std::array kRooms = {1, 8};
constexpr double kLeastOverlap = 1e-5, kGreatestOverlap = 1e-3;  // relative to the half-height
constexpr double kLean = 0.2;  // of the angle at which one end of the brick has the full overlap and the other touches
constexpr std::size_t kOverlaps = 8, kSteps = 32;
constexpr double kFloorSize = 20;  // m
constexpr int kBisections = 50;
constexpr int kBatches = 15;  // per round

/// A body with the size of the brick: a superellipsoid with this exponent in both sections, or a dBox.
struct Brick {
  std::string name;
  double exponent = 0;  // 0: dBox

  OdeGeom make() const {
    if (exponent == 0) return OdeGeom(dCreateBox(nullptr, 2 * kBrick.x(), 2 * kBrick.y(), 2 * kBrick.z()));
    return OdeGeom(snCreateSuperellipsoid(nullptr, kBrick.x(), kBrick.y(), kBrick.z(), exponent, exponent));
  }
};

std::vector<Brick> bricks() {
  std::vector<Brick> all;
  all.reserve(kExponents.size() + 1);
  for (const double exponent : kExponents) all.push_back({text("%g", exponent), exponent});
  all.push_back({"`dBox`", 0});
  return all;
}

/// The displacement of the brick since the last query, whose normal may be cached, in overlaps. A body at rest moves by less than
/// 0.01 overlaps in a step.
struct Start {
  const char* name;
  bool is_warm;
  double move;
};
constexpr std::array kStarts = {Start{"cold", false, 0.01}, Start{"warm", true, 0.01}, Start{"warm, jolted", true, 1}};

/// Poses of a resting brick. It touches at height 0.
std::vector<Pose> resting_poses(double move, unsigned seed) {
  Random random(seed);
  const auto any = [&] { return Vector3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)); };
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < kOverlaps; ++k) {
    const double share = static_cast<double>(k) / (kOverlaps - 1);
    const double overlap = kBrick.z() * kLeastOverlap * std::pow(kGreatestOverlap / kLeastOverlap, share);
    const Vector3 axis = random_normal(random);
    for (std::size_t step = 0; step < kSteps; ++step) {
      const Vector3 turn = kLean * overlap / kBrick.x() * (axis + move * any());
      const Vector3 moved = 0.5 * move * overlap * any();
      poses.push_back({moved - overlap * Vector3::UnitZ(), Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()});
    }
  }
  return poses;
}

OdeGeom brick_at(const Brick& brick, double x) {
  OdeGeom geom = brick.make();
  dGeomSetPosition(geom.id(), x, 0, -kBrick.z());
  return geom;
}

OdeGeom box_floor() {
  OdeGeom geom(dCreateBox(nullptr, kFloorSize, kFloorSize, 1));
  dGeomSetPosition(geom.id(), 0, 0, -0.5);
  return geom;
}

/// What is under the brick: one geom, or two in a bond.
struct Floor {
  const char* name;
  void (*add)(const Brick& brick, std::vector<OdeGeom>& geoms);
};
constexpr std::array<Floor, 5> kFloors = {
    {{"`dPlane`", [](const Brick&, auto& geoms) { geoms.emplace_back(dCreatePlane(nullptr, 0, 0, 1, 0)); }},
     {"`dBox`", [](const Brick&, auto& geoms) { geoms.push_back(box_floor()); }},
     {"face on face", [](const Brick& brick, auto& geoms) { geoms.push_back(brick_at(brick, 0)); }},
     {"brick bond",
      [](const Brick& brick, auto& geoms) {
        for (const double x : {-kBrick.x(), kBrick.x()}) geoms.push_back(brick_at(brick, x));
      }},
     {"`dTriMesh`", [](const Brick&, auto& geoms) { geoms.push_back(make_trimesh(terrain(1, kFloorSize, 0))); }}}};

/// The height at which a brick stops colliding with a floor whose top is at z = 0. Round bodies sink into a bond.
double touching_height(const OdePair& pair) {
  std::array<dContactGeom, kMaxContacts> contacts;
  double low = 0, high = 2 * kBrick.z();
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    pair.move_body({{0, 0, middle}, supernormal::Matrix3::Identity()});
    (pair.collide(contacts) > 0 ? low : high) = middle;
  }
  return low;
}

/// A brick on its floor, and the cost of a pair query there.
class Rest {
 public:
  Rest(const Floor& floor, const Brick& brick) : brick_(brick.make()) {
    floor.add(brick, floor_);
    height_ = touching_height({brick_.id(), floor_.front().id()});
  }

  /// Asks at each pose once. A processor would learn the branches of poses that come again.
  void measure(const std::vector<Pose>& poses, int max_contacts, bool is_warm) {
    snSetWarmStart(is_warm ? 1 : 0);
    const double moving = time_of([&] { pass(poses, 0); });
    snResetStatistics();
    double contacts = 0;
    const double asking = time_of([&] { contacts = pass(poses, max_contacts); });
    snStatistics counted;
    snGetStatistics(&counted);
    const auto queries = static_cast<double>(poses.size() * floor_.size());
    times_.push_back((asking - moving) / queries);
    contacts_ += contacts / queries;
    evaluations_ += static_cast<double>(counted.evaluations_cold + counted.evaluations_warm) / queries;
  }

  double time() const { return median(times_); }  // s
  double contacts() const { return contacts_ / static_cast<double>(times_.size()); }
  double evaluations() const { return evaluations_ / static_cast<double>(times_.size()); }

 private:
  static double time_of(const auto& function) {
    const auto start = std::chrono::steady_clock::now();
    function();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  // With max_contacts = 0 it only moves the brick.
  double pass(const std::vector<Pose>& poses, int max_contacts) const {
    std::array<dContactGeom, kMaxContacts> contacts;
    double count = 0;
    for (const Pose& pose : poses) {
      OdePair{brick_.id(), nullptr}.move_body({pose.position + height_ * Vector3::UnitZ(), pose.rotation});
      if (max_contacts == 0) continue;
      for (const OdeGeom& geom : floor_)
        count += dCollide(brick_.id(), geom.id(), max_contacts, contacts.data(), sizeof(dContactGeom));
    }
    return count;
  }

  OdeGeom brick_;
  std::vector<OdeGeom> floor_;
  std::vector<double> times_;              // s; of the batches
  double contacts_ = 0, evaluations_ = 0;  // sums of the batches
  double height_ = 0;                      // m
};

struct Row {
  std::string name;
  std::vector<Rest> rests;  // one for each entry of bricks()
};

std::vector<Row> measure_rows(const Effort& effort) {
  std::vector<Row> rows;
  for (const Floor& floor : kFloors) {
    for (const int max_contacts : kRooms) {
      for (const Start& start : kStarts) {
        Row row{std::string(floor.name) + " | " + std::to_string(max_contacts) + " | " + start.name, {}};
        for (const Brick& brick : bricks()) row.rests.emplace_back(floor, brick);
        for (int batch = 0; batch < kBatches * effort.rounds; ++batch) {
          const std::vector<Pose> poses = resting_poses(start.move, static_cast<unsigned>(batch + 1));
          for (Rest& rest : row.rests) rest.measure(poses, max_contacts, start.is_warm);
        }
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

void write_rows(const std::vector<Row>& rows, const std::function<std::string(const Rest&, const Rest& of_box)>& cell,
                std::ostream& out) {
  out << "\n| on | room | start |";
  for (const Brick& brick : bricks()) out << ' ' << brick.name << " |";
  out << "\n|---|---:|---|";
  for (std::size_t b = 0; b < bricks().size(); ++b) out << "---:|";
  for (const Row& row : rows) {
    out << "\n| " << row.name << " |";
    for (const Rest& rest : row.rests) out << ' ' << cell(rest, row.rests.back()) << " |";
  }
  out << '\n';
}

}  // namespace

void write_face_costs(const Effort& effort, std::ostream& out) {
  const std::vector<Row> rows = measure_rows(effort);
  out << "\nMedian time of a dCollide of superellipsoids by their exponent, half-axes 0.5, 0.25, 0.15 m, in times that of a dBox "
         "in the\n"
         "same run, which is in µs. They rest: overlapped by 1e-5 … 1e-3 of the half-height, and moved since the last query by 1 % "
         "of\n"
         "that; jolted, by all of it. No pose comes twice, and moving the body is not counted. In a brick bond the brick lies on "
         "two\n"
         "others, half on each; the time is that of one pair.\n";
  write_rows(
      rows,
      [](const Rest& rest, const Rest& of_box) {
        return &rest == &of_box ? text("%.3f µs", rest.time() * 1e6) : text("%.1f", rest.time() / of_box.time());
      },
      out);
  out << "\nMean number of contacts, and of evaluations of the gap function in the query; those for the corners come on top.\n";
  write_rows(
      rows,
      [](const Rest& rest, const Rest& /*of_box*/) {
        return text("%.1f", rest.contacts()) + ", " + text("%.1f", rest.evaluations());
      },
      out);
}

}  // namespace accuracy_cost
