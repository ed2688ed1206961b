#include "common/nearest_word.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace common {
namespace {

/// The optimal string alignment distance: the number of letters to insert, delete, replace or swap with their neighbour. Swaps are
/// the most common typing error.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last;
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_word(std::string_view word, std::span<const std::string> candidates) {
  // A word without what follows its first underscore, such as the unit of a column.
  for (const std::string& candidate : candidates) {
    if (!word.empty() && candidate.size() > word.size() && candidate.starts_with(word) && candidate[word.size()] == '_')
      return candidate;
  }
  std::string best;
  std::size_t fewest_edits = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t edits = edit_distance(word, candidate);
    if (edits < fewest_edits) {
      fewest_edits = edits;
      best = candidate;
    }
  }
  if (!best.empty()) return best;
  std::size_t longest = std::max<std::size_t>(2, word.size() / 2);
  for (const std::string& candidate : candidates) {
    const auto shared = static_cast<std::size_t>(std::ranges::mismatch(word, candidate).in1 - word.begin());
    if (shared > longest) {
      longest = shared;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::string nearest = nearest_word(word, candidates);
  return nearest.empty() ? std::string() : "; did you mean \"" + nearest + "\"?";
}

std::string join(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace common
