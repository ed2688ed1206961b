#include "toml_depth.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace falling_particles {
namespace {

/// The length of a comment or a quoted text at the start of `rest`; 0 if there is neither. Its characters are no keys, brackets or
/// commas.
std::size_t length_of_text(std::string_view rest) {
  if (rest.front() == '#') return std::min(rest.find('\n'), rest.size());
  const char quote = rest.front();
  if (quote != '"' && quote != '\'') return 0;
  const std::string_view end = rest.starts_with(std::string(3, quote)) ? rest.substr(0, 3) : rest.substr(0, 1);
  for (std::size_t at = end.size(); at < rest.size(); ++at) {
    if (rest[at] == '\\' && quote == '"') {
      ++at;
    } else if (rest.substr(at).starts_with(end)) {
      return at + end.size();
    } else if (rest[at] == '\n' && end.size() == 1) {
      return at;
    }
  }
  return rest.size();
}

}  // namespace

std::optional<unsigned> find_deep_toml(std::string_view text) {
  std::vector<std::size_t> enclosing = {0};  // levels at each open bracket
  std::size_t level = 0;
  unsigned line = 1;
  while (!text.empty()) {
    const std::size_t skipped = length_of_text(text);
    const char c = text.front();
    if (skipped == 0 && (c == '[' || c == '{')) enclosing.push_back(++level);
    if (skipped == 0 && c == '.') ++level;
    if (skipped == 0 && (c == ']' || c == '}') && enclosing.size() > 1) {
      enclosing.pop_back();
      level = enclosing.back();
    }
    if (c == ',' || (c == '\n' && enclosing.size() == 1)) level = enclosing.back();
    if (level > kMostTomlLevels) return line;
    const std::string_view taken = text.substr(0, std::max<std::size_t>(skipped, 1));
    line += static_cast<unsigned>(std::ranges::count(taken, '\n'));
    text.remove_prefix(taken.size());
  }
  return std::nullopt;
}

}  // namespace falling_particles
