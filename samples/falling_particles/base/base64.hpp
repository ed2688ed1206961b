// Bytes as text.
#pragma once

#include <string>
#include <string_view>

namespace falling_particles {

/// RFC 4648, section 4.
std::string to_base64(std::string_view bytes);

}  // namespace falling_particles
