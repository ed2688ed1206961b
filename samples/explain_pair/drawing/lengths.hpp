// Formats lengths.
#pragma once

#include <string>

namespace explain_pair {

/// "12.5 mm", with `digits` digits, in the unit m, mm or µm with the fewest zeros. Lengths out of this range are in m with an
/// exponent.
std::string length_text(double metres, int digits = 4);

}  // namespace explain_pair
