// Heightfields for tests, with known samples and triangles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "support/ode_fixture.hpp"

namespace supernormal::test {

enum class Source { Callback, Byte, Short, Single, Double };

/// Samples over a rectangle, and ODE's data made from them. The heights are as ODE computes them from the samples.
class Terrain {
 public:
  using Height = std::function<double(int i, int j)>;

  struct Layout {
    int columns = 9, rows = 9;
    double width = 8, depth = 8;
    bool repeats = false;
    Source source = Source::Double;
    double scale = 1, offset = 0;
  };

  Terrain(const Layout& layout, const Height& height) : data_(dGeomHeightfieldDataCreate()) { build(layout, height); }
  ~Terrain() { dGeomHeightfieldDataDestroy(data_); }
  Terrain(const Terrain&) = delete;
  Terrain(Terrain&&) = delete;
  Terrain& operator=(const Terrain&) = delete;
  Terrain& operator=(Terrain&&) = delete;

  /// Builds the data anew, for the same dHeightfieldDataID.
  void build(const Layout& layout, const Height& height) {
    layout_ = layout;
    const auto count = static_cast<std::size_t>(layout.columns) * static_cast<std::size_t>(layout.rows);
    doubles_.resize(count);
    for (int j = 0; j < layout.rows; ++j) {
      for (int i = 0; i < layout.columns; ++i) doubles_[index(i, j)] = height(i, j);
    }
    const auto width = dReal(layout.width);
    const auto depth = dReal(layout.depth);
    const auto scale = dReal(layout.scale);
    const auto offset = dReal(layout.offset);
    const int wrap = layout.repeats ? 1 : 0;
    const int nx = layout.columns;
    const int nz = layout.rows;
    switch (layout.source) {
      case Source::Callback:
        dGeomHeightfieldDataBuildCallback(data_, this, call_back, width, depth, nx, nz, scale, offset, 1, wrap);
        break;
      case Source::Byte:
        bytes_.assign(doubles_.begin(), doubles_.end());
        dGeomHeightfieldDataBuildByte(data_, bytes_.data(), 0, width, depth, nx, nz, scale, offset, 1, wrap);
        break;
      case Source::Short:
        shorts_.assign(doubles_.begin(), doubles_.end());
        dGeomHeightfieldDataBuildShort(data_, shorts_.data(), 0, width, depth, nx, nz, scale, offset, 1, wrap);
        break;
      case Source::Single:
        floats_.assign(doubles_.begin(), doubles_.end());
        dGeomHeightfieldDataBuildSingle(data_, floats_.data(), 0, width, depth, nx, nz, scale, offset, 1, wrap);
        break;
      case Source::Double:
        dGeomHeightfieldDataBuildDouble(data_, doubles_.data(), 0, width, depth, nx, nz, scale, offset, 1, wrap);
        break;
    }
  }

  /// Changes a sample in place; for Source::Double and Source::Callback.
  void set(int i, int j, double height) { doubles_[index(i, j)] = height; }

  dGeomID create(bool placeable = false, dSpaceID space = nullptr) const {
    return dCreateHeightfield(space, data_, placeable ? 1 : 0);
  }

  const Layout& layout() const { return layout_; }
  dHeightfieldDataID data() const { return data_; }
  double spacing_x() const { return layout_.width / (layout_.columns - 1); }
  double spacing_z() const { return layout_.depth / (layout_.rows - 1); }

  /// The vertex of a sample in the heightfield's frame. If the heightfield repeats, i and j are any numbers.
  Vec vertex(std::int64_t i, std::int64_t j) const {
    return {static_cast<double>(i) * spacing_x() - layout_.width / 2, height(i, j),
            static_cast<double>(j) * spacing_z() - layout_.depth / 2};
  }

  /// The surface as ODE defines it, y at x and z in the heightfield's frame.
  double surface(double x, double z) const {
    const double u = (x + layout_.width / 2) / spacing_x();
    const double v = (z + layout_.depth / 2) / spacing_z();
    const auto i = static_cast<std::int64_t>(std::floor(u));
    const auto j = static_cast<std::int64_t>(std::floor(v));
    const double du = u - static_cast<double>(i);
    const double dv = v - static_cast<double>(j);
    if (du + dv <= 1) return height(i, j) + (height(i + 1, j) - height(i, j)) * du + (height(i, j + 1) - height(i, j)) * dv;
    const double d = height(i + 1, j + 1);
    return d + (height(i + 1, j) - d) * (1 - dv) + (height(i, j + 1) - d) * (1 - du);
  }

 private:
  static dReal call_back(void* self, int i, int j) {
    const auto& terrain = *static_cast<const Terrain*>(self);
    return dReal(terrain.doubles_[terrain.index(i, j)]);
  }

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(layout_.columns) + static_cast<std::size_t>(i);
  }

  static int wrapped(std::int64_t k, int count, bool repeats) {
    if (!repeats) return static_cast<int>(k);
    const std::int64_t period = count - 1;
    return static_cast<int>((k % period + period) % period);
  }

  double height(std::int64_t i, std::int64_t j) const {
    const std::size_t k = index(wrapped(i, layout_.columns, layout_.repeats), wrapped(j, layout_.rows, layout_.repeats));
    double sample = doubles_[k];
    if (layout_.source == Source::Byte) sample = bytes_[k];
    if (layout_.source == Source::Short) sample = shorts_[k];
    if (layout_.source == Source::Single) sample = double{floats_[k]};
    return sample * layout_.scale + layout_.offset;
  }

  dHeightfieldDataID data_;
  Layout layout_;
  std::vector<double> doubles_;
  std::vector<float> floats_;
  std::vector<short> shorts_;
  std::vector<unsigned char> bytes_;
};

/// A rough landscape: every sample is independent, in 0 ... height. The same seed gives the same samples.
inline Terrain::Height rough(unsigned seed, double height) {
  return [seed, height](int i, int j) {
    std::mt19937_64 engine(seed * 7919U + static_cast<unsigned>(i) * 104729U + static_cast<unsigned>(j));
    engine.discard(3);
    return height * (static_cast<double>(engine() >> 11U) * 0x1p-53);
  };
}

/// A landscape of smooth hills.
inline Terrain::Height hills(double height, double wave) {
  return [height, wave](int i, int j) { return height * (std::sin(wave * i) + std::cos(0.8 * wave * j + 1)); };
}

}  // namespace supernormal::test
