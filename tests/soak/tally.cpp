#include "tally.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

namespace supernormal::soak {
namespace {

constexpr const char* kHead = "supernormal-soak-1";
constexpr std::size_t kMostListed = 20;

std::vector<std::pair<const char*, Ranking Tally::*>> rankings() {
  return {{"error", &Tally::by_error}, {"error_of_bound", &Tally::by_error_of_bound}, {"evaluations", &Tally::by_evaluations}};
}

std::vector<std::pair<const char*, std::uint64_t Tally::*>> counters() {
  return {{"samples", &Tally::samples},
          {"queries", &Tally::queries},
          {"evaluations", &Tally::evaluations},
          {"not_global", &Tally::not_global},
          {"not_converged", &Tally::not_converged},
          {"violations", &Tally::violations}};
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error("cannot resume from " + path + ": " + why);
}

}  // namespace

void Ranking::add(const Entry& entry) {
  // Ties go to the smaller number, so the ranking does not depend on the order of the threads.
  const auto comes_before = [](const Entry& a, const Entry& b) {
    return a.value != b.value ? a.value > b.value : a.sample < b.sample;
  };
  if (entries_.size() == kLength && !comes_before(entry, entries_.back())) return;
  entries_.insert(std::ranges::upper_bound(entries_, entry, comes_before), entry);
  if (entries_.size() > kLength) entries_.pop_back();
}

void Tally::add(std::uint64_t sample, const Finding& finding) {
  ++samples;
  queries += finding.queries;
  evaluations += finding.evaluations;
  not_global += finding.is_global ? 0 : 1;
  not_converged += finding.is_converged ? 0 : 1;
  by_error.add({finding.error, sample});
  by_error_of_bound.add({finding.error_of_bound, sample});
  by_evaluations.add({static_cast<double>(finding.most_evaluations), sample});
  if (finding.violations.empty()) return;
  ++violations;
  if (violated.size() < kMostListed) violated.push_back(sample);
}

void Tally::add(const Tally& other) {
  for (const auto& [name, counter] : counters()) this->*counter += other.*counter;
  for (const auto& [name, ranking] : rankings()) (this->*ranking).add(other.*ranking);
  violated.insert(violated.end(), other.violated.begin(), other.violated.end());
  std::ranges::sort(violated);
  violated.resize(std::min(violated.size(), kMostListed));
}

void save(const Tally& tally, std::uint64_t seed, const std::string& path) {
  const std::string unfinished = path + ".unfinished";
  std::ofstream out(unfinished);
  out.precision(std::numeric_limits<double>::max_digits10);
  out << kHead << "\nseed " << seed << "\nseconds " << tally.seconds << '\n';
  for (const auto& [name, counter] : counters()) out << name << ' ' << tally.*counter << '\n';
  out << "violated " << tally.violated.size();
  for (const std::uint64_t sample : tally.violated) out << ' ' << sample;
  for (const auto& [name, ranking] : rankings()) {
    out << '\n' << name << ' ' << (tally.*ranking).entries().size();
    for (const auto& [value, sample] : (tally.*ranking).entries()) out << ' ' << value << ' ' << sample;
  }
  out << '\n';
  out.close();
  if (!out) throw std::runtime_error("cannot write " + unfinished);
  std::filesystem::rename(unfinished, path);
}

Tally load(std::uint64_t seed, const std::string& path) {
  Tally tally;
  if (!std::filesystem::exists(path)) return tally;
  std::ifstream in(path);
  const auto expect_word = [&](const std::string& expected) {
    std::string word;
    if (!(in >> word) || word != expected) refuse(path, "\"" + expected + "\" expected instead of \"" + word + "\"");
  };
  expect_word(kHead);
  expect_word("seed");
  std::uint64_t saved_seed = 0;
  in >> saved_seed;
  if (saved_seed != seed) refuse(path, "it is of seed " + std::to_string(saved_seed) + ", not " + std::to_string(seed));
  expect_word("seconds");
  in >> tally.seconds;
  for (const auto& [name, counter] : counters()) {
    expect_word(name);
    in >> tally.*counter;
  }
  expect_word("violated");
  std::size_t count = 0;
  in >> count;
  tally.violated.resize(std::min(count, kMostListed));
  for (std::uint64_t& sample : tally.violated) in >> sample;
  for (const auto& [name, ranking] : rankings()) {
    expect_word(name);
    in >> count;
    for (Ranking::Entry entry; count > 0 && in >> entry.value >> entry.sample; --count) (tally.*ranking).add(entry);
  }
  if (!in) refuse(path, "it is cut short, or a number is missing");
  return tally;
}

}  // namespace supernormal::soak
