// Lengths as text.
#pragma once

#include <string>

namespace explain_pair {

/// "12.5 mm", with so many digits, in m, mm or µm, whichever leaves the fewest zeros; beyond these in m with an exponent.
std::string length_text(double metres, int digits = 4);

}  // namespace explain_pair
