// The catalogue as a program runs it that has trapped floating-point exceptions: one that is raised ends it.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cfenv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <string>

#include "catalogue.hpp"
#include "supernormal/solvers/solve.hpp"

using namespace supernormal;
using namespace supernormal::samples;

namespace {

constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

const char* name_of_current_case = "";

/// Only what a signal handler may call.
void say_which_case(int /*signal*/) {
  for (const char* part : {"floating-point exception in the hard case \"", name_of_current_case, "\"\n"}) {
    if (write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
  }
  _exit(1);
}

/// Traps while it lives.
class Traps {
 public:
  Traps() : old_handler_(std::signal(SIGFPE, say_which_case)) {
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(kTrapped);
  }
  ~Traps() {
    fedisableexcept(kTrapped);
    std::signal(SIGFPE, old_handler_);
  }
  Traps(const Traps&) = delete;
  Traps& operator=(const Traps&) = delete;

 private:
  void (*old_handler_)(int);
};

bool is_finite(const Proximity& answer) {
  double sum = answer.gap + answer.normal.sum();
  sum += answer.point1.sum() + answer.point2.sum() + answer.contact.sum();
  return std::isfinite(sum);
}

}  // namespace

TEST_CASE("hard cases: no query raises a floating-point exception") {
  const std::vector<HardCase> cases = hard_cases();
  for (const HardCase& one : cases) {
    name_of_current_case = one.name.c_str();
    for (const bool certify : {false, true}) {
      Settings settings;
      settings.certify_depth = certify;
      bool finite = false;
      {
        const Traps traps;
        const Vector3* start = one.first_normal ? &*one.first_normal : nullptr;
        finite = is_finite(find_proximity(*one.shape1, one.pose1, *one.shape2, one.pose2, settings, start));
      }
      if (!finite) FAIL_CHECK(one.name);
    }
  }
}

TEST_CASE("hard cases: making their shapes, and refusing others, raises no floating-point exception") {
  name_of_current_case = "shapes of the catalogue";
  {
    const Traps traps;
    CHECK(!hard_cases().empty());
  }
  for (const Refusal& refusal : refusals()) {
    name_of_current_case = refusal.name.c_str();
    const Traps traps;
    CHECK_THROWS_AS(refusal.attempt(), std::invalid_argument);
  }
}
