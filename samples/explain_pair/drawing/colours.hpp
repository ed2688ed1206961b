// The colours of the pictures.
#pragma once

#include <string>

namespace explain_pair {

/// Of Okabe and Ito's palette, which people with any colour vision can tell apart.
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kVermilion = "#D55E00";
inline constexpr const char* kPurple = "#AA4488";  // darker than theirs, to stand out on the pale map
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kOrange = "#B87300";  // darker than theirs, likewise
inline constexpr const char* kBrown = "#7A4A2A";   // ours
inline constexpr const char* kBlack = "#000";
inline constexpr const char* kInk = "#222";
inline constexpr const char* kGrey = "#666";

/// A colour in OKLab's polar form (Ottosson, A perceptual color space for image processing, 2020): equal distances look equal.
struct Oklch {
  double lightness;  ///< 0 black to 1 white
  double chroma;
  double hue;  ///< degrees
};

/// "#rrggbb", in sRGB; channels out of range are cut off.
std::string hex(const Oklch& colour);

/// The colour of a share from 0 to 1 of the range of s: from dark to light in equal steps, so that equal differences of s look
/// equal, with any colour vision and in print.
Oklch map_colour(double share);

}  // namespace explain_pair
