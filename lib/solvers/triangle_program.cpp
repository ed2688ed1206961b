#include "solvers/triangle_program.hpp"

#include <algorithm>
#include <utility>

namespace supernormal {
namespace {

/// A convex polygon of barycentric coordinates: at first the triangle, with every half-plane that clips it at most one corner more.
class Polygon {
 public:
  Polygon() {
    for (std::size_t v = 0; v < 3; ++v) corners_[v] = Vector3::Unit(static_cast<int>(v));
  }

  /// Leaves the part where difference.w >= 0.
  void clip(const Vector3& difference) {
    std::array<double, kCapacity> side;
    bool is_whole = true;
    for (std::size_t v = 0; v < count_; ++v) {
      side[v] = difference.dot(corners_[v]);
      is_whole = is_whole && side[v] >= 0;
    }
    if (is_whole) return;
    const std::array<Vector3, kCapacity> whole = corners_;
    const std::size_t whole_count = std::exchange(count_, 0);
    for (std::size_t v = 0; v < whole_count && count_ + 2 <= kCapacity; ++v) {
      const std::size_t next = v + 1 == whole_count ? 0 : v + 1;
      if (side[v] >= 0) corners_[count_++] = whole[v];
      if ((side[v] > 0 && side[next] < 0) || (side[v] < 0 && side[next] > 0)) {
        corners_[count_++] = whole[v] + side[v] / (side[v] - side[next]) * (whole[next] - whole[v]);
      }
    }
  }

  /// The corner where the function is largest; null if nothing is left.
  const Vector3* highest(const Vector3& function) const {
    const auto end = corners_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto top = std::max_element(corners_.begin(), end,
                                      [&](const Vector3& a, const Vector3& b) { return function.dot(a) < function.dot(b); });
    return top == end ? nullptr : &*top;
  }

 private:
  static constexpr std::size_t kCapacity = 3 + TriangleProgram::kMaxCuts + 2;
  std::array<Vector3, kCapacity> corners_;
  std::size_t count_ = 3;
};

}  // namespace

std::size_t TriangleProgram::add(const Vector3& cut) {
  if (count_ == 0 || cut.dot(weights_) < value_) {
    Polygon lowest;
    for (std::size_t k = 0; k < count_; ++k) lowest.clip(cuts_[k] - cut);
    // Rounding may leave nothing: the maximum so far is a bound still.
    if (const Vector3* top = lowest.highest(cut); top != nullptr) {
      weights_ = *top;
      value_ = std::min(value_, cut.dot(weights_));
    }
  }
  std::size_t place = count_;
  if (count_ < kMaxCuts) {
    ++count_;
  } else {
    const auto is_lower = [&](const Vector3& a, const Vector3& b) { return a.dot(weights_) < b.dot(weights_); };
    place = static_cast<std::size_t>(std::max_element(cuts_.begin(), cuts_.end(), is_lower) - cuts_.begin());
  }
  cuts_[place] = cut;
  return place;
}

}  // namespace supernormal
