#include "numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace robot_model {

namespace {

struct Quantity {
  std::string_view name;  ///< the end of a path
  std::size_t count;      ///< of numbers
  double least;
  double greatest;
  const char* unit;
};

// ODE ends the program at a mass or a length that overflows or vanishes in its products. These ranges are far from that.
constexpr double kFar = 1e6;       // m and rad; there the last bit of a coordinate is 1e-10 m
constexpr double kSmall = 1e-6;    // m
constexpr double kMasses = 1e18;   // kg; a ball of kSmall and 1000 kg/m^3 has 4e-15 kg
constexpr double kMoments = 1e30;  // kg m^2: kMasses at a distance of kFar
constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kLeastStep = 1e-6;  // s

constexpr std::array kQuantities = std::to_array<Quantity>({
    {"pose", 6, -kFar, kFar, "m and rad"},
    {"pose of a quaternion", 7, -kFar, kFar, "m"},
    {"origin/xyz", 3, -kFar, kFar, "m"},
    {"origin/rpy", 3, -kFar, kFar, "rad"},
    {"axis/xyz", 3, -kFar, kFar, ""},
    {"limit/lower", 1, -kAny, kAny, "m or rad"},
    {"limit/upper", 1, -kAny, kAny, "m or rad"},
    {"radius", 1, kSmall, kFar, "m"},
    {"length", 1, kSmall, kFar, "m"},
    {"size", 3, kSmall, kFar, "m"},
    {"radii", 3, kSmall, kFar, "m"},
    {"exponents", 2, 1.01, 1000, ""},
    {"normal", 3, -kFar, kFar, ""},
    {"mass", 1, 1 / kMasses, kMasses, "kg"},
    {"mass/value", 1, 1 / kMasses, kMasses, "kg"},
    {"ixx", 1, 1 / kMoments, kMoments, "kg m^2"},
    {"iyy", 1, 1 / kMoments, kMoments, "kg m^2"},
    {"izz", 1, 1 / kMoments, kMoments, "kg m^2"},
    {"ixy", 1, -kMoments, kMoments, "kg m^2"},
    {"ixz", 1, -kMoments, kMoments, "kg m^2"},
    {"iyz", 1, -kMoments, kMoments, "kg m^2"},
    {"mu", 1, 0, kNoLimit, ""},
    {"velocity_decay/linear", 1, 0, 1, ""},
    {"velocity_decay/angular", 1, 0, 1, ""},
    {"world/gravity", 3, -kFar, kFar, "m/s^2"},
    {"max_step_size", 1, kLeastStep, 1, "s"},
    {"seconds", 1, 0, 1e6, "s"},
    {"density", 1, 1e-6, 1e12, "kg/m^3"},
});

const Quantity* find(std::string_view path) {
  const std::string whole = "/" + std::string(path);
  const auto* const found = std::find_if(kQuantities.begin(), kQuantities.end(),
                                         [&](const Quantity& q) { return whole.ends_with("/" + std::string(q.name)); });
  return found == kQuantities.end() ? nullptr : found;
}

/// All numbers of a text; none if there is anything else in it. The decimal sign is a point in every locale.
std::vector<double> numbers_in(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    const char* const end = word.data() + word.size();
    double number = 0;
    const auto [last, error] = std::from_chars(word.data() + (word.starts_with("+") ? 1 : 0), end, number);
    if (error != std::errc() || last != end) return {};
    numbers.push_back(number);
  }
  return numbers;
}

bool are_valid(const Quantity& q, const std::vector<double>& numbers) {
  return numbers.size() == q.count &&
         std::all_of(numbers.begin(), numbers.end(), [&q](double x) { return x >= q.least && x <= q.greatest; });
}

[[noreturn]] void refuse(const Quantity& q, const std::string& found, const std::string& where) {
  std::ostringstream message;
  message << where << ": " << q.name << " is " << found << ", must be " << q.count << (q.count == 1 ? " number" : " numbers")
          << " in [" << q.least << ", " << q.greatest << "]";
  if (*q.unit != 0) message << " " << q.unit;
  throw std::runtime_error(message.str());
}

}  // namespace

bool takes_numbers(std::string_view path) { return find(path) != nullptr; }

std::vector<double> read_numbers(std::string_view path, const std::optional<std::string>& text, const std::string& where) {
  const Quantity& q = *find(path);
  std::vector<double> numbers = numbers_in(text.value_or(""));
  if (!are_valid(q, numbers)) refuse(q, text ? "\"" + *text + "\"" : "missing", where);
  return numbers;
}

void check_number(std::string_view name, double value, const std::string& where) {
  const Quantity& q = *find(name);
  if (are_valid(q, {value})) return;
  std::ostringstream text;
  text << value;
  refuse(q, text.str(), where);
}

}  // namespace robot_model
