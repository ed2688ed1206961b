// Base 64: bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace falling_particles {

/// Encodes bytes as base 64 (RFC 4648, section 4).
std::string to_base64(std::string_view bytes);

}  // namespace falling_particles
