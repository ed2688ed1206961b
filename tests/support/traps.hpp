// Floating-point traps: a raised exception ends the program.
#pragma once

#include <unistd.h>

#include <cfenv>
#include <csignal>
#include <cstring>
#include <initializer_list>

namespace supernormal::test {

/// Traps exceptions while it lives. An exception ends the program with the name of the query.
class Traps {
 public:
  static constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

  /// Keeps a reference to the name.
  explicit Traps(const char* name) : old_handler_(std::signal(SIGFPE, say_what_was_asked)) {
    asked = name;
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(kTrapped);
  }
  ~Traps() {
    fedisableexcept(kTrapped);
    std::signal(SIGFPE, old_handler_);
  }
  Traps(const Traps&) = delete;
  Traps(Traps&&) = delete;
  Traps& operator=(const Traps&) = delete;
  Traps& operator=(Traps&&) = delete;

 private:
  /// The handler calls only functions that are allowed in a signal handler.
  static void say_what_was_asked(int /*signal*/) {
    for (const char* part : {"floating-point exception in \"", asked, "\"\n"}) {
      if (write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
    }
    _exit(1);
  }

  inline static const char* asked = "";

  void (*old_handler_)(int);
};

}  // namespace supernormal::test
