#include "styles/words.hpp"

#include <algorithm>
#include <stdexcept>

#include "pointers.h"
#include "utils.h"

namespace granular {

std::string Words::next(const std::string& keyword) {
  if (is_empty()) throw std::invalid_argument(keyword + " takes another word");
  const std::string word = words_.front();
  words_ = words_.subspan(1);
  return word;
}

bool Words::accept(const std::string& word) {
  if (is_empty() || words_.front() != word) return false;
  words_ = words_.subspan(1);
  return true;
}

double Words::number(const std::string& keyword) { return LAMMPS_NS::utils::numeric(FLERR, next(keyword).c_str(), false, lammps_); }

int Words::integer(const std::string& keyword) { return LAMMPS_NS::utils::inumeric(FLERR, next(keyword).c_str(), false, lammps_); }

Vector3 Words::vector(const std::string& keyword) {
  const double x = number(keyword), y = number(keyword), z = number(keyword);
  return {x, y, z};
}

Words Words::take_until(std::initializer_list<std::string_view> separators) {
  const auto found = std::find_first_of(words_.begin(), words_.end(), separators.begin(), separators.end(),
                                        [](const char* word, std::string_view separator) { return word == separator; });
  const auto count = static_cast<std::size_t>(found - words_.begin());
  const Words taken(words_.first(count), lammps_);
  words_ = words_.subspan(count);
  return taken;
}

}  // namespace granular
