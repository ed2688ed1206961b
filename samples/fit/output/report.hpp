// The result of a fit as text, and text by patterns of printf.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "model/fit_body.hpp"
#include "model/fit_error.hpp"

namespace fit {

/// At most 511 characters.
[[gnu::format(printf, 1, 2)]] inline std::string format(const char* pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  std::vector<char> text(512);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

/// The parameters of a body, each with one standard error, or the reason why it has none.
std::string describe(const FittedBody& fitted);

/// The points that the fits ignored: how many, and the farthest ones with index (from 1), position and distance from the bodies. ""
/// if there are none.
std::string describe_outliers(std::span<const FittedBody> fitted, const Cloud& cloud);

/// Why a fit is bad: one sentence each, without an end; none if it is good. Limits: the root mean square of the distances is 5 % of
/// the radius of the data, the reach beyond the data 5 %, the difference of the volume from a closed mesh 10 %, outliers 20 % of
/// the points; and the data bound every half-axis.
std::vector<std::string> doubts_about(std::span<const FittedBody> fitted, const FitError& error);

/// Distances, volume and inertia of the bodies, next to the values of the data.
std::string describe(const FitError& error);

}  // namespace fit
