// The error of the last refused call, and the guard that keeps exceptions out of C.
#pragma once

#include <exception>
#include <utility>

namespace supernormal::ode {

/// Stores "function: message" for this thread. Does not allocate, so it can also report that memory ran out.
void set_last_error(const char* function, const char* message) noexcept;

/// The text of the last set_last_error() in this thread; "" if there was none.
const char* last_error() noexcept;

/// Wraps every function that C or ODE calls. Returns the result of `work`. If `work` throws, returns `refusal` and stores the
/// exception text as the last error. ODE is compiled without exceptions: one that passed through it would leave its spaces locked.
template <typename Result, typename Work>
Result guarded(const char* function, Result refusal, Work&& work) noexcept {
  try {
    return std::forward<Work>(work)();
  } catch (const std::exception& error) {
    set_last_error(function, error.what());
  } catch (...) {
    set_last_error(function, "an exception of unknown type was thrown, by a user-defined body perhaps");
  }
  return refusal;
}

/// guarded() of a function that returns 1, or 0 if `work` throws.
template <typename Work>
int succeeds(const char* function, Work&& work) noexcept {
  return guarded(function, 0, [&] {
    std::forward<Work>(work)();
    return 1;
  });
}

}  // namespace supernormal::ode
