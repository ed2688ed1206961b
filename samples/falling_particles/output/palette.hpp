// The colours of kinds of grains.
#pragma once

#include <array>
#include <cstddef>

namespace falling_particles {

/// Red, green and blue in [0, 1] for a screen (sRGB).
using Colour = std::array<double, 3>;

/// The colour of a kind: from Okabe and Ito's palette, which people with any colour vision can distinguish; then the same colours
/// darker, then lighter, repeatedly.
inline Colour colour_of_kind(std::size_t kind) {
  constexpr std::array<Colour, 7> kPalette = {{{0.90, 0.62, 0.00},
                                               {0.34, 0.71, 0.91},
                                               {0.00, 0.62, 0.45},
                                               {0.94, 0.89, 0.26},
                                               {0.00, 0.45, 0.70},
                                               {0.84, 0.37, 0.00},
                                               {0.80, 0.47, 0.65}}};
  constexpr std::array kWhite = {0.0, 0.0, 0.55}, kStrength = {1.0, 0.5, 0.45};
  const std::size_t round = kind / kPalette.size() % kStrength.size();
  Colour colour = kPalette[kind % kPalette.size()];
  for (double& part : colour) part = kWhite[round] + kStrength[round] * part;
  return colour;
}

}  // namespace falling_particles
