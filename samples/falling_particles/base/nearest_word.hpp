// Suggestions for misspelt words.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace falling_particles {

/// The candidate nearest to `word` by typing slips, if at most a third of its letters are wrong (one in short words); otherwise "".
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

/// `; did you mean "…"?`, or "" when nothing is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c"
std::string join(std::span<const std::string> words);

}  // namespace falling_particles
