// Floating-point traps: a raised exception ends the program.
#pragma once

#include <cfenv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#ifdef __GLIBC__
#include <unistd.h>
#endif

namespace supernormal::test {

/// Traps exceptions while it lives. An exception ends the program with the name of the query. Where the C library cannot trap, its
/// end asks the flags.
class Traps {
 public:
  static constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

  /// Keeps a reference to the name.
  explicit Traps(const char* name) {
    asked = name;
    std::feclearexcept(FE_ALL_EXCEPT);
#ifdef __GLIBC__
    old_handler_ = std::signal(SIGFPE, say_what_was_asked);
    feenableexcept(kTrapped);
#endif
  }
  ~Traps() {
#ifdef __GLIBC__
    fedisableexcept(kTrapped);
    std::signal(SIGFPE, old_handler_);
#else
    if (std::fetestexcept(kTrapped) != 0) {
      std::fprintf(stderr, "floating-point exception in \"%s\"\n", asked);
      std::_Exit(1);
    }
#endif
  }
  Traps(const Traps&) = delete;
  Traps(Traps&&) = delete;
  Traps& operator=(const Traps&) = delete;
  Traps& operator=(Traps&&) = delete;

 private:
  inline static const char* asked = "";

#ifdef __GLIBC__
  /// The handler calls only functions that are allowed in a signal handler.
  static void say_what_was_asked(int /*signal*/) {
    for (const char* part : {"floating-point exception in \"", asked, "\"\n"}) {
      if (write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
    }
    _exit(1);
  }

  void (*old_handler_)(int) = SIG_DFL;
#endif
};

/// The answer of a query under traps.
auto trapped(const char* name, const auto& query) {
  const Traps traps(name);
  return query();
}

}  // namespace supernormal::test
