#include "base64.hpp"

#include <cstddef>
#include <cstdint>

namespace falling_particles {

std::string to_base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t start = 0; start < bytes.size(); start += 3) {
    // Three bytes are four digits of six bits. Missing bytes at the end count as zero and are written as '='.
    std::uint32_t bits = 0;
    for (std::size_t i = start; i < start + 3; ++i)
      bits = bits << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit) {
      const bool is_missing = start + digit > bytes.size();
      text += is_missing ? '=' : kDigits[bits >> (18 - 6 * digit) & 63U];
    }
  }
  return text;
}

}  // namespace falling_particles
