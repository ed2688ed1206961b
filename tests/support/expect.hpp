// Reports a failure by ending the process. libFuzzer then reports it with the input.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace supernormal::fuzz {

inline void expect(bool holds, const char* what, const char* details = "") {
  if (holds) return;
  std::fprintf(stderr, "violated: %s %s\n", what, details);
  std::abort();
}

}  // namespace supernormal::fuzz
