// The reason why a call was refused, and the fence that keeps exceptions out of C.
#pragma once

#include <exception>
#include <utility>

namespace supernormal::ode {

/// Remembers "function: message" for this thread. Allocates nothing, so that it also reports that memory has run out.
void set_last_error(const char* function, const char* message) noexcept;

/// The text of this thread's last set_last_error(); "" if there was none.
const char* last_error() noexcept;

/// Wraps the work of every function that C or ODE calls: returns what `work` returns, or, when it throws, `refusal` with the
/// exception's text as the last error. ODE is compiled without exceptions; one that crossed it would leave its spaces locked.
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

}  // namespace supernormal::ode
