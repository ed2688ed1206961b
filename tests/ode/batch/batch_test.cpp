// Tests that a batch gives the contacts of sequential calls of dCollide, bit for bit, whichever thread solves a pair.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"
#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

// 150 crowded bodies, three of each of ODE's geoms, a plane and a mesh. One body has callbacks, which throw on demand.
struct Crowd {
  dSpaceID space = dHashSpaceCreate(nullptr);
  std::vector<ColliderGeom> colliders;
  std::vector<dGeomID> geoms;
  std::vector<std::size_t> numbers;  // numbers of the geoms, stored as their data
  MeshGeom mesh;
  bool throws = false;

  Crowd() : mesh(box_mesh({2, 1.5, 1.1}), space) {
    Random random(3);
    for (int i = 0; i < 150; ++i) geoms.push_back(random_body(random, space));
    for (const ColliderKind kind : kSolidKinds) {
      for (int i = 0; i < 3; ++i) geoms.push_back(colliders.emplace_back(kind, random, space));
    }
    geoms.push_back(create_ball());
    for (const dGeomID geom : geoms) place(geom, {random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)});
    geoms.push_back(dCreatePlane(space, 0, 0, 1, -3));
    geoms.push_back(mesh);
    numbers.resize(geoms.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    for (std::size_t i = 0; i < geoms.size(); ++i) dGeomSetData(geoms[i], &numbers[i]);
  }
  ~Crowd() {
    colliders.clear();
    dSpaceRemove(space, mesh);
    dSpaceDestroy(space);
  }
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  void step() const {
    Random random(7);
    for (const dGeomID geom : geoms) {
      if (dGeomGetClass(geom) != dPlaneClass) move(geom, 0.05 * random.direction());
    }
  }

 private:
  dGeomID create_ball() {
    snShape ball{};
    ball.user = this;
    ball.support = [](const void*, const dReal* /*n*/) -> dReal { return 1; };
    ball.point = [](const void* user, const dReal* n, dReal* point) {
      if (static_cast<const Crowd*>(user)->throws) throw std::runtime_error("no ball today");
      std::copy(n, n + 3, point);
    };
    return snCreateConvex(space, &ball);
  }
};

struct Line {
  std::size_t number1, number2;  // numbers of the geoms
  dContactGeom contact;
};

std::size_t number_of(dGeomID geom) { return *static_cast<const std::size_t*>(dGeomGetData(geom)); }

void append(void* lines, dGeomID g1, dGeomID g2, const dContactGeom* contacts, int count) {
  for (int k = 0; k < count; ++k) {
    CHECK(contacts[k].g1 == g1);
    CHECK(contacts[k].g2 == g2);
    static_cast<std::vector<Line>*>(lines)->push_back({number_of(g1), number_of(g2), contacts[k]});
  }
}

using Bits = std::array<unsigned char, sizeof(dReal)>;  // -0 is not 0

bool are_same(dReal a, dReal b) { return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b); }

bool are_same(const dReal* a, const dReal* b) {
  return std::equal(a, a + 3, b, [](dReal x, dReal y) { return are_same(x, y); });
}

bool are_same(const Line& a, const Line& b) {
  return a.number1 == b.number1 && a.number2 == b.number2 && are_same(a.contact.pos, b.contact.pos) &&
         are_same(a.contact.normal, b.contact.normal) && are_same(a.contact.depth, b.contact.depth) &&
         a.contact.side1 == b.contact.side1 && a.contact.side2 == b.contact.side2;
}

bool are_same(const std::vector<Line>& a, const std::vector<Line>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Line& x, const Line& y) { return are_same(x, y); });
}

constexpr int kRoom = 6;

// Pairs of ODE's own geoms are ignored.
int is_one_ours(void* /*lines*/, dGeomID g1, dGeomID g2) {
  return dGeomGetClass(g1) == snGeomClass() || dGeomGetClass(g2) == snGeomClass() ? 1 : 0;
}

void near_callback(void* lines, dGeomID g1, dGeomID g2) {
  if (is_one_ours(lines, g1, g2) == 0) return;
  dContactGeom contacts[kRoom];
  const int count = dCollide(g1, g2, kRoom, contacts, sizeof contacts[0]);
  append(lines, g1, g2, contacts, count);
}

struct Account {
  std::vector<Line> lines;
  snStatistics statistics{};
  std::string error;
};

using Collide = std::function<void(dSpaceID, std::vector<Line>&)>;

// Makes three steps of a new crowd in a new thread, which has an empty cache.
Account account_of(const Collide& collide_space) {
  Account account;
  std::thread([&] {
    Crowd crowd;
    for (int step = 0; step < 3; ++step) {
      crowd.throws = step == 1;
      collide_space(crowd.space, account.lines);
      crowd.step();
    }
    snGetStatistics(&account.statistics);
    account.error = snLastError();
  }).join();
  return account;
}

Collide by_batch(snBatchID batch) {
  return [batch](dSpaceID space, std::vector<Line>& lines) {
    const std::size_t before = lines.size();
    const int count = snBatchCollide(batch, space, kRoom, &lines, is_one_ours, append);
    CHECK(before + static_cast<std::size_t>(count) == lines.size());
  };
}

void backwards(void* pool, int count, void (*task)(void* context, int i), void* context) {
  ++*static_cast<int*>(pool);
  for (int i = count - 1; i >= 0; --i) task(context, i);
}

void ignore(void* /*data*/, dGeomID, dGeomID, const dContactGeom*, int) {}

/// Twenty bodies on one another.
struct Heap {
  const OdeSession session;
  const dSpaceID space = dHashSpaceCreate(nullptr);

  Heap() {
    Random random(3);
    for (int i = 0; i < 20; ++i) place(random_body(random, space), 0.3 * random.direction());
  }
  ~Heap() { dSpaceDestroy(space); }
  Heap(const Heap&) = delete;
  Heap& operator=(const Heap&) = delete;
};

void check_same(const Account& account, const Account& expected) {
  CHECK(are_same(account.lines, expected.lines));
  CHECK(std::memcmp(&account.statistics, &expected.statistics, sizeof(snStatistics)) == 0);
  CHECK(account.error == expected.error);
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "a batch on any number of threads gives the contacts, statistics and errors of sequential calls") {
  for (const int warm_start : {1, 0}) {
    snSetWarmStart(warm_start);
    const Account expected =
        account_of([](dSpaceID space, std::vector<Line>& lines) { dSpaceCollide(space, &lines, near_callback); });
    CHECK(expected.lines.size() > 500);
    CHECK(expected.error == "dCollide: no ball today");
    CHECK((expected.statistics.queries_warm > 500) == (warm_start == 1));
    for (const int threads : {1, 2, 5}) {
      CAPTURE(threads);
      const snBatchID batch = snBatchCreate(threads);
      check_same(account_of(by_batch(batch)), expected);
      snBatchDestroy(batch);
    }
    int runs = 0;
    const snBatchID batch = snBatchCreateOn(backwards, &runs);
    check_same(account_of(by_batch(batch)), expected);
    CHECK(runs == 3);
    snBatchDestroy(batch);
  }
}

TEST_CASE_FIXTURE(OdeSession, "a batch skips pairs that the filter rejects, and pairs of one body") {
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  const World world;
  const dBodyID body = dBodyCreate(world.id());
  std::vector<dGeomID> geoms;
  std::array<std::size_t, 4> numbers = {0, 1, 2, 3};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    geoms.push_back(snCreateEllipsoid(space, 1, 1, 1));
    dGeomSetData(geoms.back(), &numbers[i]);
    place(geoms.back(), {0.1 * static_cast<double>(i), 0, 0});
  }
  const snBatchID batch = snBatchCreate(0);
  std::vector<Line> lines;
  CHECK(snBatchCollide(batch, space, 1, &lines, nullptr, append) == 6);
  dGeomSetBody(geoms[0], body);
  dGeomSetBody(geoms[1], body);
  lines.clear();
  CHECK(snBatchCollide(batch, space, 1, &lines, nullptr, append) == 5);
  const auto without_the_last = [](void* /*data*/, dGeomID g1, dGeomID g2) {
    return number_of(g1) != 3 && number_of(g2) != 3 ? 1 : 0;
  };
  lines.clear();
  CHECK(snBatchCollide(batch, space, 1, &lines, without_the_last, append) == 2);
  snBatchDestroy(batch);
  dSpaceDestroy(space);
}

TEST_CASE_FIXTURE(OdeSession, "a batch enters nested spaces") {
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  const dSpaceID inner = dSimpleSpaceCreate(space);
  std::size_t number = 0;
  for (const dSpaceID home : {space, inner, inner}) dGeomSetData(snCreateEllipsoid(home, 1, 2, 3), &number);
  const snBatchID batch = snBatchCreate(2);
  std::vector<Line> lines;
  CHECK(snBatchCollide(batch, space, 1, &lines, nullptr, append) == 2);  // the outer one with both
  CHECK(snBatchCollide(batch, inner, 1, &lines, nullptr, append) == 1);
  snBatchDestroy(batch);
  dSpaceDestroy(space);
}

TEST_CASE_FIXTURE(OdeSession, "a batch refuses invalid arguments with a message") {
  const auto refusal = [](const auto& call) {
    CHECK(call());
    return std::string(snLastError());
  };
  CHECK(refusal([] { return snBatchCreate(-1) == nullptr; }) == "snBatchCreate: threads = -1 is outside [0, 256]");
  CHECK(refusal([] { return snBatchCreate(257) == nullptr; }) == "snBatchCreate: threads = 257 is outside [0, 256]");
  CHECK(refusal([] { return snBatchCreateOn(nullptr, nullptr) == nullptr; }) ==
        "snBatchCreateOn: run = NULL, but must be a function");
  const snBatchID batch = snBatchCreate(1);
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  const auto refused = [&](snBatchID b, dSpaceID s, int room, snContactsCallback* contacts) {
    return refusal([&] { return snBatchCollide(b, s, room, nullptr, nullptr, contacts) == -1; });
  };
  CHECK(refused(nullptr, space, 1, append) == "snBatchCollide: batch = NULL, but must point to something");
  CHECK(refused(batch, nullptr, 1, append) == "snBatchCollide: space = NULL, but must point to something");
  CHECK(refused(batch, space, 0, append) == "snBatchCollide: max_contacts = 0 is outside [1, 65535]");
  CHECK(refused(batch, space, 65536, append) == "snBatchCollide: max_contacts = 65536 is outside [1, 65535]");
  CHECK(refused(batch, space, 1, nullptr) == "snBatchCollide: contacts = NULL, but must be a function");
  dSpaceDestroy(space);
  snBatchDestroy(batch);
}

TEST_CASE_FIXTURE(Heap, "a batch that is in use refuses another call, from either callback, and is free again afterwards") {
  struct Calls {
    snBatchID batch;
    dSpaceID space;
    int allowed = 0, refused = 0, pairs = 0;

    void again() {
      const int result = snBatchCollide(batch, space, 4, nullptr, nullptr, append);
      (result == -1 && std::string(snLastError()).find("the batch is in use") != std::string::npos ? refused : allowed) += 1;
    }
  };
  Calls calls{snBatchCreate(2), space};
  const auto wanted = [](void* data, dGeomID, dGeomID) {
    static_cast<Calls*>(data)->again();
    return 1;
  };
  const auto contacts = [](void* data, dGeomID, dGeomID, const dContactGeom*, int) {
    static_cast<Calls*>(data)->again();
    ++static_cast<Calls*>(data)->pairs;
  };
  const int count = snBatchCollide(calls.batch, space, 4, &calls, wanted, contacts);
  CHECK(count > 0);
  CHECK(calls.pairs > 0);
  CHECK(calls.allowed == 0);
  CHECK(calls.refused > calls.pairs);
  calls.refused = 0;
  CHECK(snBatchCollide(calls.batch, space, 4, &calls, nullptr, contacts) == count);
  CHECK(calls.refused == calls.pairs / 2);
  snBatchDestroy(calls.batch);
}

TEST_CASE_FIXTURE(Heap, "an exception in a callback of a batch is its error, and the batch and the space are free afterwards") {
  const snBatchID batch = snBatchCreate(2);
  snPairFilter* const broken_filter = [](void*, dGeomID, dGeomID) -> int { throw std::runtime_error("the filter broke"); };
  snContactsCallback* const broken_contacts = [](void*, dGeomID, dGeomID, const dContactGeom*, int) { throw 7; };
  CHECK(snBatchCollide(batch, space, 4, nullptr, broken_filter, ignore) == -1);
  CHECK(std::string(snLastError()) == "snBatchCollide: the filter broke");
  snCreateEllipsoid(space, 1, 1, 1);  // ODE would end the program if the space were locked
  CHECK(snBatchCollide(batch, space, 4, nullptr, nullptr, broken_contacts) == -1);
  CHECK(std::string(snLastError()).find("snBatchCollide: an exception of unknown type") == 0);
  CHECK(snBatchCollide(batch, space, 4, nullptr, nullptr, ignore) > 0);
  snBatchDestroy(batch);
}

TEST_CASE_FIXTURE(Heap, "a pool that leaves out a task, or repeats one, is refused") {
  int change = 0;
  const snBatchID batch = snBatchCreateOn(
      [](void* pool, int count, void (*task)(void*, int), void* context) {
        for (int i = 0; i < count + *static_cast<int*>(pool); ++i) task(context, i % count);
      },
      &change);
  for (const int wrong : {-1, 1}) {
    change = wrong;
    CHECK(snBatchCollide(batch, space, 4, nullptr, nullptr, ignore) == -1);
    CHECK(std::string(snLastError()).find("but must call it once for each i in [0, ") != std::string::npos);
  }
  change = 0;
  CHECK(snBatchCollide(batch, space, 4, nullptr, nullptr, ignore) > 0);
  snBatchDestroy(batch);
}
