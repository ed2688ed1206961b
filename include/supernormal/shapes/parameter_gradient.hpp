// Derivatives of a length with respect to the parameters of a shape.
#pragma once

#include <array>
#include <cstddef>

namespace supernormal {

/// One number for each parameter of a shape, with the parameter's name. The order is the constructor's order. A Rounded has its
/// radius after the parameters of its core, a MinkowskiSum the parameters of its first shape and then of its second.
class ParameterGradient {
 public:
  static constexpr std::size_t kCapacity = 16;  ///< the capacity of the list

  /// A parameter and the derivative with respect to it.
  struct Entry {
    const char* name = "";  ///< of the parameter, such as "a" or "delta"; a string literal
    double value = 0;       ///< m/m for a length, m for an exponent or a taper
  };

  /// Adds an entry. A full list drops it, and is_partial() becomes true.
  void add(const char* name, double value) {
    if (count_ < kCapacity) {
      entries_[count_++] = {name, value};
    } else {
      is_partial_ = true;
    }
  }

  std::size_t size() const { return count_; }                           ///< the number of entries
  const Entry& operator[](std::size_t k) const { return entries_[k]; }  ///< entry k, from 0 to size() - 1
  const Entry* begin() const { return entries_.data(); }                ///< the first entry
  const Entry* end() const { return entries_.data() + count_; }         ///< behind the last entry
  bool is_partial() const { return is_partial_; }                       ///< whether the shape has more parameters

  /// Multiplies the entries from `first` on by `factor`.
  void scale(double factor, std::size_t first = 0) {
    for (std::size_t k = first; k < count_; ++k) entries_[k].value *= factor;
  }

 private:
  std::array<Entry, kCapacity> entries_;
  std::size_t count_ = 0;
  bool is_partial_ = false;
};

}  // namespace supernormal
