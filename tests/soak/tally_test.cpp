#include "tally.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

using namespace supernormal::soak;

namespace {

Finding finding(double error, int evaluations, bool is_violated) {
  Finding out;
  out.queries = 4;
  out.evaluations = 3 * static_cast<std::uint64_t>(evaluations);
  out.most_evaluations = evaluations;
  out.error = error;
  out.error_of_bound = 1000 * error;
  out.is_global = error < 0.5;
  if (is_violated) out.violations.emplace_back("as an example");
  return out;
}

std::vector<std::uint64_t> samples_of(const Ranking& ranking) {
  std::vector<std::uint64_t> samples;
  for (const Ranking::Entry& entry : ranking.entries()) samples.push_back(entry.sample);
  return samples;
}

/// The tally of samples first ... end - 1 with errors that go up and down.
Tally tally_of(std::uint64_t first, std::uint64_t end) {
  Tally tally;
  for (std::uint64_t k = first; k < end; ++k)
    tally.add(k, finding(static_cast<double>(k * 37 % 100) / 100, static_cast<int>(k), k % 7 == 3));
  return tally;
}

void check_same(const Tally& a, const Tally& b) {
  CHECK(a.samples == b.samples);
  CHECK(a.queries == b.queries);
  CHECK(a.evaluations == b.evaluations);
  CHECK(a.not_global == b.not_global);
  CHECK(a.violations == b.violations);
  CHECK(a.violated == b.violated);
  CHECK(samples_of(a.by_error) == samples_of(b.by_error));
  CHECK(samples_of(a.by_error_of_bound) == samples_of(b.by_error_of_bound));
  CHECK(samples_of(a.by_evaluations) == samples_of(b.by_evaluations));
}

std::string complaint_about(const std::string& path, std::uint64_t seed) {
  try {
    load(seed, path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("the largest values are kept, largest first, ties by number") {
  Ranking ranking;
  for (const Ranking::Entry& entry : {Ranking::Entry{1, 10}, {3, 11}, {2, 12}, {3, 9}, {0, 13}, {2, 14}, {5, 15}})
    ranking.add(entry);
  CHECK(samples_of(ranking) == std::vector<std::uint64_t>{15, 9, 11, 12, 14});
}

TEST_CASE("tallies of parts in any order add up to the tally of the whole") {
  Tally parts = tally_of(60, 200);
  parts.add(tally_of(0, 60));
  check_same(parts, tally_of(0, 200));
  CHECK(parts.violated.front() == 3);
}

TEST_CASE("a saved tally is read back, and a missing file gives a new one") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "state").string();
  check_same(load(5, path), Tally());
  Tally tally = tally_of(0, 200);
  tally.seconds = 1.25;
  save(tally, 5, path);
  const Tally again = load(5, path);
  check_same(again, tally);
  CHECK(again.seconds == 1.25);
  for (std::size_t k = 0; k < 5; ++k) CHECK(again.by_error.entries()[k].value == tally.by_error.entries()[k].value);
}

TEST_CASE("a tally of another seed, or a file that is not a tally, is refused") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "state").string();
  save(tally_of(0, 10), 5, path);
  CHECK(complaint_about(path, 6).find("it is of seed 5, not 6") != std::string::npos);
  std::ifstream in(path);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const std::size_t length : {text.size() / 4, text.size() / 2, text.size() - 8}) {
    CHECK(complaint_about(folder.write("cut", text.substr(0, length)), 5).find("cannot resume from ") == 0);
  }
  CHECK(complaint_about(folder.write("other", "a poem"), 5).find("\"supernormal-soak-1\" expected instead of \"a\"") !=
        std::string::npos);
}
