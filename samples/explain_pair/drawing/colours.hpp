// Colours of the pictures.
#pragma once

#include <string>

namespace explain_pair {

/// From the palette of Okabe and Ito, which is distinguishable with any colour vision.
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kVermilion = "#D55E00";
inline constexpr const char* kPurple = "#AA4488";  // darker than in the palette, to stand out on the pale map
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kOrange = "#B87300";  // darker than in the palette, for the same reason
inline constexpr const char* kBrown = "#7A4A2A";   // not in the palette
inline constexpr const char* kBlack = "#000";
inline constexpr const char* kInk = "#222";
inline constexpr const char* kGrey = "#666";

/// A colour in the polar form of OKLab (Ottosson, A perceptual color space for image processing, 2020): equal distances look equal.
struct Oklch {
  double lightness;  ///< 0 black to 1 white
  double chroma;
  double hue;  ///< degrees
};

/// "#rrggbb" in sRGB; channels are clamped.
std::string hex(const Oklch& colour);

/// The colour for a fraction from 0 to 1 of the range of s, from dark to light in equal steps. Equal differences of s look equal,
/// with any colour vision and in print.
Oklch map_colour(double share);

}  // namespace explain_pair
