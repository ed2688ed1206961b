// The check that all numbers pass: of a file, of the command line, and of the bodies that follow from them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace robot_model {

/// SDF's own number for no limit, of a stop (m or rad) and of a coefficient of friction.
inline constexpr double kNoLimit = 1e16;

/// Whether the reader takes numbers from `path`: the names of an element and of its child or attribute, as in "mass/value".
bool takes_numbers(std::string_view path);

/// The numbers of a text. Throws std::runtime_error, which begins with `where` and has the name, the text, the valid range and the
/// unit, if the text is missing, has another count of numbers or anything else, or if a number is out of range.
std::vector<double> read_numbers(std::string_view path, const std::optional<std::string>& text, const std::string& where);

/// The same for one number.
void check_number(std::string_view name, double value, const std::string& where);

}  // namespace robot_model
