// TOML files as input, with every value checked.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/input_error.hpp"
#include "common/interval.hpp"

namespace falling_particles {

using namespace common;

/// The characters that a name may have without quotes.
constexpr const char* kNameCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

/// A table of a TOML file whose keys are known in advance. Every reading function checks its value. It throws InputError with the
/// allowed values, and with the file and line or the option that set the value. A table is valid as long as its TomlFile.
class TomlTable {
 public:
  std::optional<std::string> find_text(std::string_view key) const;
  std::string text(std::string_view key) const;
  double number(std::string_view key, const Interval& allowed) const;
  std::vector<double> numbers(std::string_view key, std::size_t count, const Interval& allowed) const;
  /// The number of elements of the array under `key`.
  std::size_t array_size(std::string_view key) const;
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  /// An array of different words of `allowed`; it may be empty.
  std::vector<std::string> choices(std::string_view key, const std::vector<std::string>& allowed) const;
  std::int64_t integer(std::string_view key, std::int64_t lowest, std::int64_t highest) const;
  bool boolean(std::string_view key) const;

  bool has(std::string_view key) const;

  /// The table under `key`, which may have `keys` and no others.
  TomlTable table(std::string_view key, std::vector<std::string> keys) const;
  /// The table under `key`, if its valid keys depend on its content. Call refuse_unknown_keys() afterwards.
  TomlTable table(std::string_view key) const;
  std::optional<TomlTable> find_table(std::string_view key, std::vector<std::string> keys) const;

  /// The array of tables ([[key]]), not empty.
  std::vector<TomlTable> tables(std::string_view key, const std::vector<std::string>& keys) const;
  /// The same, if the valid keys of each table depend on its content. Call refuse_unknown_keys() for each.
  std::vector<TomlTable> tables(std::string_view key) const;

  void refuse_unknown_keys(const std::vector<std::string>& keys) const;

  /// All keys in the order of the file, for tables whose keys are names that the user chooses.
  std::vector<std::string> names() const;

  /// Throws InputError at the line of `key` (at the line of the table when it has no such key).
  [[noreturn]] void fail(std::string_view key, const std::string& text) const;
  /// The same, with the name of the key in front of the text.
  [[noreturn]] void refuse(std::string_view key, const std::string& text) const { fail(key, full_name(key) + text); }

  /// The name of the key in messages: "box.width".
  std::string full_name(std::string_view key) const;

 private:
  friend class TomlFile;
  struct Node;
  explicit TomlTable(std::shared_ptr<const Node> node);
  TomlTable part(std::string_view key, const std::string& allowed) const;
  std::vector<TomlTable> parts(std::string_view key, const std::string& allowed) const;

  std::shared_ptr<const Node> node_;
};

/// A TOML file, parsed.
class TomlFile {
 public:
  /// Replaces values of the file first (set_values()). Throws InputError when `path` is not a readable file or not valid TOML.
  /// `what` names its purpose in the message: "scene file".
  TomlFile(const std::string& path, const std::string& what, const std::vector<std::string>& assignments = {});
  /// A text, which messages call `name`.
  struct Text {
    std::string content;
    std::string name{InputError::kText};
  };
  explicit TomlFile(const Text& text, const std::vector<std::string>& assignments = {});

  /// The top level of the file, which may have the given keys and no others.
  TomlTable root(const std::vector<std::string>& keys) const;
  /// The top level of the file, with keys of the user's choice.
  TomlTable root() const;

 private:
  std::shared_ptr<const TomlTable::Node> node_;
};

}  // namespace falling_particles
