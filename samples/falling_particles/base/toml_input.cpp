#include "toml_input.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "common/input_error.hpp"
#include "common/nearest_word.hpp"
#include "common/read_file.hpp"
#include "toml_override.hpp"

namespace falling_particles {
namespace {

/// `place`: a line of the file, or the option that set the value.
[[noreturn]] void refuse_at(const std::string& file, const toml::source_region& place, const std::string& text) {
  if (place.path && *place.path != file) throw InputError(*place.path + ": " + text);
  throw InputError(file, std::max(place.begin.line, 1U), text);
}

std::string in_quotes(std::string_view text) { return '"' + std::string(text) + '"'; }

std::string describe(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return shortest(*number);
  if (const auto number = node.value_exact<std::int64_t>()) return std::to_string(*number);
  if (const auto text = node.value_exact<std::string>()) return "the string " + in_quotes(*text);
  if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
  if (node.is_table()) return "a table";
  if (const auto* array = node.as_array()) return "an array of " + std::to_string(array->size());
  return "a date or time";
}

std::optional<double> as_number(const toml::node& node) {
  return node.is_number() ? node.value<double>() : std::nullopt;  // value() alone also converts other types
}

std::string content_of(const std::string& path, const std::string& what) {
  if (const std::string other = what_is_no_file(path); !other.empty()) {
    throw InputError("cannot read " + what + " " + in_quotes(path) + ": it is " + other + "; allowed: a file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError("cannot read " + what + " " + in_quotes(path) + ": " + std::strerror(errno));
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

}  // namespace

struct TomlTable::Node {
  std::shared_ptr<const toml::table> root;  // keeps `table`, which is part of it, alive
  const toml::table* table;
  std::string file;
  std::string name;  // "" at the top

  Node child(const toml::table& part, std::string part_name) const { return {root, &part, file, std::move(part_name)}; }
  std::string full_name(std::string_view key) const { return name.empty() ? std::string(key) : name + "." + std::string(key); }
  /// The value of `key`, which must be there. `allowed`: in the message.
  const toml::node& at(std::string_view key, const std::string& allowed) const {
    if (const toml::node* const value = table->get(key)) return *value;
    refuse_at(file, table->source(), full_name(key) + " is missing; allowed: " + allowed);
  }
  const toml::array& array_at(std::string_view key, const std::string& allowed) const {
    const toml::array* const array = at(key, allowed).as_array();
    if (array == nullptr) fail_value(key, allowed);
    return *array;
  }
  [[noreturn]] void fail_value(std::string_view key, const std::string& allowed) const {
    refuse_at(file, table->get(key)->source(), full_name(key) + " is " + describe(*table->get(key)) + "; allowed: " + allowed);
  }
};

TomlTable::TomlTable(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

std::string TomlTable::full_name(std::string_view key) const { return node_->full_name(key); }

bool TomlTable::has(std::string_view key) const { return node_->table->contains(key); }

void TomlTable::fail(std::string_view key, const std::string& text) const {
  const toml::node* value = node_->table->get(key);
  refuse_at(node_->file, value != nullptr ? value->source() : node_->table->source(), text);
}

void TomlTable::refuse_unknown_keys(const std::vector<std::string>& keys) const {
  for (const auto& [key, value] : *node_->table) {
    if (std::ranges::find(keys, key.str()) != keys.end()) continue;
    const std::string where = node_->name.empty() ? "at the top of the file" : "in [" + node_->name + "]";
    refuse_at(node_->file, key.source(),
              "unknown key " + in_quotes(key.str()) + " " + where + did_you_mean(key.str(), keys) + "; allowed: " + join(keys));
  }
}

std::optional<std::string> TomlTable::find_text(std::string_view key) const {
  return has(key) ? std::optional(text(key)) : std::nullopt;
}

std::string TomlTable::text(std::string_view key) const {
  const std::string allowed = "a string, not empty";
  const auto text = node_->at(key, allowed).value_exact<std::string>();
  if (!text || text->empty()) node_->fail_value(key, allowed);
  return *text;
}

std::string TomlTable::choice(std::string_view key, const std::vector<std::string>& allowed) const {
  node_->at(key, join(allowed));
  const std::string word = text(key);
  if (std::ranges::find(allowed, word) != allowed.end()) return word;
  fail(key, full_name(key) + " is " + in_quotes(word) + did_you_mean(word, allowed) + "; allowed: " + join(allowed));
}

std::vector<std::string> TomlTable::choices(std::string_view key, const std::vector<std::string>& allowed) const {
  const std::string all = "an array of different words of: " + join(allowed);
  std::vector<std::string> result;
  for (const toml::node& element : node_->array_at(key, all)) {
    const auto word = element.value_exact<std::string>();
    const bool is_allowed = word && std::ranges::find(allowed, *word) != allowed.end();
    const bool is_repeated = is_allowed && std::ranges::find(result, *word) != result.end();
    if (!is_allowed || is_repeated) {
      const std::string hint = is_repeated ? " for the second time" : word ? did_you_mean(*word, allowed) : "";
      std::ostringstream text;
      text << full_name(key) << '[' << result.size() << "] is " << describe(element) << hint << "; allowed: " << all;
      refuse_at(node_->file, element.source(), text.str());
    }
    result.push_back(*word);
  }
  return result;
}

double TomlTable::number(std::string_view key, const Interval& allowed) const {
  const auto number = as_number(node_->at(key, allowed.describe()));
  if (!number || !allowed.contains(*number)) node_->fail_value(key, allowed.describe());
  return *number;
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count, const Interval& allowed) const {
  const std::string all = "an array of " + std::to_string(count) + ", each " + allowed.describe();
  const toml::array& array = node_->array_at(key, all);
  if (array.size() != count) node_->fail_value(key, all);
  std::vector<double> result;
  for (const toml::node& element : array) {
    const auto number = as_number(element);
    if (!number || !allowed.contains(*number)) {
      refuse_at(node_->file, element.source(),
                full_name(key) + "[" + std::to_string(result.size()) + "] is " + describe(element) + "; allowed: " + all);
    }
    result.push_back(*number);
  }
  return result;
}

std::size_t TomlTable::array_size(std::string_view key) const { return node_->array_at(key, "an array").size(); }

std::int64_t TomlTable::integer(std::string_view key, std::int64_t lowest, std::int64_t highest) const {
  const std::string allowed = "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
  const toml::node& value = node_->at(key, allowed);
  const auto number = value.value_exact<std::int64_t>();
  if (value.is_floating_point()) node_->fail_value(key, allowed + ", without a point and an exponent");
  if (!number || *number < lowest || *number > highest) node_->fail_value(key, allowed);
  return *number;
}

bool TomlTable::boolean(std::string_view key) const {
  const std::string allowed = "true or false";
  const auto truth = node_->at(key, allowed).value_exact<bool>();
  if (!truth) node_->fail_value(key, allowed);
  return *truth;
}

TomlTable TomlTable::table(std::string_view key, std::vector<std::string> keys) const {
  TomlTable result = part(key, "a table with " + join(keys));
  result.refuse_unknown_keys(keys);
  return result;
}

TomlTable TomlTable::table(std::string_view key) const { return part(key, "a table"); }

TomlTable TomlTable::part(std::string_view key, const std::string& allowed) const {
  const toml::table* table = node_->at(key, allowed).as_table();
  if (table == nullptr) node_->fail_value(key, allowed);
  return TomlTable(std::make_shared<const Node>(node_->child(*table, full_name(key))));
}

std::optional<TomlTable> TomlTable::find_table(std::string_view key, std::vector<std::string> keys) const {
  return has(key) ? std::optional(table(key, std::move(keys))) : std::nullopt;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key, const std::vector<std::string>& keys) const {
  std::vector<TomlTable> result = parts(key, "one or more [[" + full_name(key) + "]] with " + join(keys));
  for (const TomlTable& table : result) table.refuse_unknown_keys(keys);
  return result;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  return parts(key, "one or more [[" + full_name(key) + "]]");
}

std::vector<TomlTable> TomlTable::parts(std::string_view key, const std::string& allowed) const {
  const toml::array& array = node_->array_at(key, allowed);
  if (array.empty()) node_->fail_value(key, allowed);
  std::vector<TomlTable> result;
  for (const toml::node& element : array) {
    const toml::table* part = element.as_table();
    if (part == nullptr)
      refuse_at(node_->file, element.source(), full_name(key) + " holds " + describe(element) + "; allowed: " + allowed);
    result.push_back(TomlTable(std::make_shared<const Node>(node_->child(*part, full_name(key)))));
  }
  return result;
}

std::vector<std::string> TomlTable::names() const {
  std::vector<std::pair<unsigned, std::string>> by_line;
  for (const auto& [key, value] : *node_->table) by_line.emplace_back(key.source().begin.line, key.str());
  std::ranges::sort(by_line);
  std::vector<std::string> result(by_line.size());
  std::ranges::transform(by_line, result.begin(), [](auto& entry) { return std::move(entry.second); });
  return result;
}

TomlFile::TomlFile(const std::string& path, const std::string& what, const std::vector<std::string>& assignments)
    : TomlFile(Text{content_of(path, what), path}, assignments) {}

TomlFile::TomlFile(const Text& text, const std::vector<std::string>& assignments) {
  const auto& [content, name] = text;
  if (const std::optional<unsigned> line = find_deep_toml(content)) {
    throw InputError(name, *line,
                     "keys, arrays or tables are nested in more than " + std::to_string(kMostTomlLevels) +
                         " levels; allowed: up to " + std::to_string(kMostTomlLevels));
  }
  try {
    auto root = std::make_shared<toml::table>(toml::parse(content, name));
    set_values(*root, assignments);
    const toml::table* top = root.get();
    node_ = std::make_shared<const TomlTable::Node>(TomlTable::Node{std::move(root), top, name, ""});
  } catch (const toml::parse_error& error) {
    throw InputError(name, error.source().begin.line, std::string(error.description()) + " (allowed: valid TOML 1.0)");
  }
}

TomlTable TomlFile::root(const std::vector<std::string>& keys) const {
  TomlTable result = root();
  result.refuse_unknown_keys(keys);
  return result;
}

TomlTable TomlFile::root() const { return TomlTable(node_); }

}  // namespace falling_particles
