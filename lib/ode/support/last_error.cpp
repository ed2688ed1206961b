#include "ode/support/last_error.hpp"

#include <array>
#include <cstdio>

namespace supernormal::ode {
namespace {

thread_local std::array<char, 512> text{};  // longer texts are truncated

}  // namespace

void set_last_error(const char* function, const char* message) noexcept {
  std::snprintf(text.data(), text.size(), "%s: %s", function, message);
}

const char* last_error() noexcept { return text.data(); }

}  // namespace supernormal::ode
