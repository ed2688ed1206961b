// Suggestions for misspelt words.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace common {

/// The candidate nearest to `word` by typing errors, or the first one that has `word` before an underscore, such as x_m for x.
/// If in all of them more than a third of the letters are wrong (more than one in short words), the one that begins with more than
/// half of the word, three letters at least, or "".
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

/// `; did you mean "…"?`, or "" when no candidate is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c"
std::string join(std::span<const std::string> words);

}  // namespace common
