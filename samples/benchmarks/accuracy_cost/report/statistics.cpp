#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace accuracy_cost {
namespace {

// A thousand times the default tolerance. A larger error belongs to another maximum, or to another kind of method.
constexpr double kInexact = 1e-6;

constexpr double kLarge = 0.99;  // quantile for "large"

void count_failure(const Answer& answer, const Pair& pair, Statistics& result) {
  const bool is_apart = pair.gap > 0;
  const bool is_touching = std::abs(pair.gap) <= kInexact * pair.size;
  const bool says_apart = answer.kind == Answer::Kind::Apart || answer.gap > 0;
  const bool is_near = std::abs(answer.gap - pair.gap) <= 0.1 * std::abs(pair.gap) + 0.001 * pair.size;
  if (answer.kind == Answer::Kind::None) {
    ++result.no_answer;
  } else if (says_apart != is_apart && !is_touching) {
    ++result.wrong_verdict;
  } else if (answer.kind == Answer::Kind::Gap && !is_near) {
    ++result.wrong_gap;
  }
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto place = values.begin() + std::min(rank, std::ssize(values) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Statistics statistics(const std::vector<Sample>& samples, const std::vector<Pair>& pairs,
                      const std::function<bool(const Pair&)>& is_chosen) {
  Statistics result;
  std::vector<double> times, evaluations, errors, normal_errors, contact_errors;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (!is_chosen(pairs[p])) continue;
    const Sample& sample = samples[p];
    times.push_back(sample.time);
    evaluations.push_back(sample.answer.evaluations);
    if (sample.answer.kind == Answer::Kind::Gap) {
      errors.push_back(std::abs(sample.answer.gap - pairs[p].gap) / pairs[p].size);
      normal_errors.push_back(2 * std::asin(std::min(1.0, 0.5 * (sample.answer.normal - pairs[p].normal).norm())));
    }
    if (sample.answer.contact) contact_errors.push_back((*sample.answer.contact - pairs[p].contact).norm() / pairs[p].size);
    count_failure(sample.answer, pairs[p], result);
  }
  result.inexact = static_cast<std::size_t>(std::count_if(errors.begin(), errors.end(), [](double e) { return !(e <= kInexact); }));
  result.queries = times.size();
  result.worst_error = errors.empty() ? median(errors) : *std::max_element(errors.begin(), errors.end());
  result.slow_time = quantile(times, kLarge);
  result.large_error = quantile(errors, kLarge);
  result.normal_error = median(std::move(normal_errors));
  result.contact_error = median(std::move(contact_errors));
  result.time = median(std::move(times));
  result.evaluations = median(std::move(evaluations));
  result.median_error = median(std::move(errors));
  return result;
}

}  // namespace accuracy_cost
