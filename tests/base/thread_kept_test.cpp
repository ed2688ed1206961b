// Tests of what a thread keeps until its end: by the language, and by a key of POSIX threads.
#include "base/thread_kept.hpp"

#include <doctest/doctest.h>

#include <string>
#include <thread>
#include <vector>

#include "base/kept_by_key.hpp"

using namespace supernormal;

namespace {

using Log = std::vector<std::string>;

/// Its destructor reads its own memory. A filler of 4 KB makes the place of a freed object likely to be overwritten.
struct Noted {
  Log* log = nullptr;
  std::string name = "new";
  std::vector<int> filler = std::vector<int>(1024);

  Noted() = default;
  Noted(const Noted&) = delete;
  Noted(Noted&&) = delete;
  Noted& operator=(const Noted&) = delete;
  Noted& operator=(Noted&&) = delete;
  ~Noted() {
    if (log != nullptr) log->push_back(name);
  }
};

template <template <typename> class Kept>
Noted& first() {
  thread_local Kept<Noted> kept;
  return *kept;
}

template <template <typename> class Kept>
Noted& second() {
  thread_local Kept<Noted> kept;
  return *kept;
}

template <template <typename> class Kept>
Log run_thread() {
  Log log;
  std::thread([&] {
    first<Kept>().log = &log;
    first<Kept>().name = "first";
    second<Kept>().log = &log;
    second<Kept>().name = "second";
  }).join();
  return log;
}

/// An object that takes another at its end, for the first time in its thread.
template <template <typename> class Kept>
struct TakesAnother {
  Log* log = nullptr;

  TakesAnother() = default;
  TakesAnother(const TakesAnother&) = delete;
  TakesAnother(TakesAnother&&) = delete;
  TakesAnother& operator=(const TakesAnother&) = delete;
  TakesAnother& operator=(TakesAnother&&) = delete;
  ~TakesAnother() {
    if (log == nullptr) return;
    log->push_back("takes " + first<Kept>().name);
    first<Kept>().log = log;
    first<Kept>().name = "another";
  }
};

template <template <typename> class Kept>
TakesAnother<Kept>& taker() {
  thread_local Kept<TakesAnother<Kept>> kept;
  return *kept;
}

template <template <typename> class Kept>
void check() {
  SUBCASE("the end of a thread destroys its objects, the latest first, and their memory is still there") {
    for (int thread = 0; thread < 3; ++thread) CHECK(run_thread<Kept>() == Log{"second", "first"});
  }
  SUBCASE("each place of a program has one object in each thread") {
    CHECK(&first<Kept>() == &first<Kept>());
    CHECK(&first<Kept>() != &second<Kept>());
    const Noted* other = nullptr;
    std::string name;
    first<Kept>().name = "of this thread";
    std::thread([&] {
      other = &first<Kept>();
      name = first<Kept>().name;
    }).join();
    CHECK(other != &first<Kept>());
    CHECK(name == "new");
    CHECK(first<Kept>().name == "of this thread");
  }
  SUBCASE("an object that a destructor takes is destroyed, too") {
    Log log;
    std::thread([&] { taker<Kept>().log = &log; }).join();
    CHECK(log == Log{"takes new", "another"});
  }
}

}  // namespace

TEST_CASE("ThreadKept keeps an object for each thread") { check<ThreadKept>(); }

TEST_CASE("KeptByKey, which is ThreadKept on Windows, keeps an object for each thread") { check<KeptByKey>(); }
