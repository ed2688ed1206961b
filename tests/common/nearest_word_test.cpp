#include "common/nearest_word.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace common;

TEST_CASE("a column without its unit is the column with it") {
  const std::vector<std::string> columns = {"qx", "x_m", "vx_m_per_s"};
  CHECK(nearest_word("x", columns) == "x_m");
  CHECK(nearest_word("vx", columns) == "vx_m_per_s");
  CHECK(nearest_word("", std::vector<std::string>{"_m"}).empty());
}

TEST_CASE("a word that begins as a candidate does is that candidate") {
  const std::vector<std::string> grains = {"mm", "soybean", "lentil"};
  CHECK(nearest_word("soya", grains) == "soybean");
  CHECK(nearest_word("lens", grains) == "lentil");
  CHECK(nearest_word("so", grains).empty());
  CHECK(nearest_word("sorghum", grains).empty());
}

TEST_CASE("the nearest word is found by edits, and nothing is better than a far one") {
  const std::vector<std::string> words = {"width", "height", "depth"};
  CHECK(nearest_word("widht", words) == "width");
  CHECK(nearest_word("heigth", words) == "height");
  CHECK(nearest_word("dept", words) == "depth");
  CHECK(nearest_word("density", words).empty());
  CHECK(nearest_word("", words).empty());
  CHECK(nearest_word("wdth", words) == "width");
  CHECK(did_you_mean("radius", words).empty());
  CHECK(did_you_mean("width", words) == "; did you mean \"width\"?");
}
