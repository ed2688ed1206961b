#include "toml_override.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/input_error.hpp"
#include "common/nearest_word.hpp"
#include "toml_input.hpp"

namespace falling_particles {
namespace {

/// A step of a path: the key of a table, or the selector of an array's entry.
struct Step {
  std::string word;
  bool chooses_entry;
};

constexpr std::size_t kLongestEcho = 60;  // characters of an option that a message about its length quotes

/// One KEY=VALUE, and the node that its path has reached.
class Assignment {
 public:
  explicit Assignment(const std::string& text) : option_("--set " + text) {
    std::ranges::replace(option_, '\n', ' ');  // a message is one line
    std::string_view rest = text;
    while (true) {
      const std::size_t end = std::min(rest.find_first_not_of(kNameCharacters), rest.size());
      if (end == 0) fail_form();
      path_.push_back({std::string(rest.substr(0, end)), false});
      rest.remove_prefix(end);
      while (rest.starts_with('[')) {
        const std::size_t closing = rest.find(']');
        if (closing == std::string_view::npos || closing == 1) fail_form();
        path_.push_back({std::string(rest.substr(1, closing - 1)), true});
        rest.remove_prefix(closing + 1);
      }
      if (!rest.starts_with('.')) break;
      rest.remove_prefix(1);
    }
    if (!rest.starts_with('=')) fail_form();
    value_ = rest.substr(1);
    if (path_.size() > kMostTomlLevels || find_deep_toml(value_)) {
      option_ = option_.substr(0, kLongestEcho) + "…";
      fail("keys, arrays or tables are nested in more than " + std::to_string(kMostTomlLevels) + " levels; allowed: up to " +
           std::to_string(kMostTomlLevels));
    }
  }

  void apply_to(toml::table& root) {
    toml::node* node = &root;
    std::size_t i = 0;
    for (; i + 1 < path_.size(); ++i) {
      const Step& step = path_[i];
      toml::node* next = step.chooses_entry ? &entry(*node, step.word) : table(*node).get(step.word);
      if (next == nullptr && !path_[i + 1].chooses_entry) break;  // the file does not have this table
      if (next == nullptr) fail_missing(table(*node), step.word);
      node = next;
      walked_ += step.chooses_entry ? '[' + step.word + ']' : (walked_.empty() ? "" : ".") + step.word;
    }
    if (path_[i].chooses_entry) {
      toml::array& entries = array(*node);
      toml::table parsed = parse("entry");
      entries.replace(entries.cbegin() + static_cast<std::ptrdiff_t>(index_in(entries, path_[i].word)),
                      std::move(*parsed.get("entry")));
      return;
    }
    std::string keys = path_[i].word;
    for (std::size_t k = i + 1; k < path_.size(); ++k) {
      if (path_[k].chooses_entry) fail_missing(table(*node), path_[i].word);
      keys += '.' + path_[k].word;
    }
    for (auto&& [key, value] : parse(keys)) assign(table(*node), key, std::move(value));
  }

 private:
  /// An empty array removes sections [[key]].
  static void assign(toml::table& table, const toml::key& key, toml::node&& value) {
    const toml::node* old = table.get(key);
    if (value.is_array() && value.as_array()->empty() && old != nullptr && old->is_array_of_tables()) {
      table.erase(key);
    } else {
      table.insert_or_assign(key, std::move(value));
    }
  }

  [[noreturn]] void fail(const std::string& text) const { throw InputError(option_ + ": " + text); }

  [[noreturn]] void fail_form() const {
    fail("allowed: KEY=VALUE, such as time.step=1e-3, container.width[0]=0.1 or grain[pea].count=20");
  }

  [[noreturn]] void fail_missing(const toml::table& table, const std::string& word) const {
    std::vector<std::string> keys;
    for (const auto& [key, value] : table) keys.emplace_back(key.str());
    fail("the file has no array \"" + word + "\"" + (walked_.empty() ? "" : " in " + walked_) + did_you_mean(word, keys) +
         "; allowed to choose entries of: " + join(keys));
  }

  /// The parsed value, under keys whose source is the option.
  toml::table parse(const std::string& keys) const {
    try {
      // A second line could set another key.
      if (value_.find('\n') == std::string::npos) return toml::parse(keys + " = " + value_, option_);
    } catch (const toml::parse_error&) {
    }
    fail('"' + value_.substr(0, value_.find('\n')) +
         R"(" is no value of TOML; allowed: a number, "a text" in its quotes, true, false, [an array] or {a = "table"})");
  }

  toml::table& table(toml::node& node) const {
    if (toml::table* table = node.as_table()) return *table;
    if (const toml::array* entries = node.as_array()) fail(walked_ + " is an array; " + allowed_entries(*entries));
    fail(walked_ + " is no table and has no keys");
  }

  toml::array& array(toml::node& node) const {
    if (toml::array* array = node.as_array()) return *array;
    fail(walked_ + " is no array and has no entries in brackets");
  }

  static std::optional<std::string> name_of(const toml::node& entry) {
    const toml::table* table = entry.as_table();
    if (table == nullptr) return std::nullopt;
    const toml::node* name = table->contains("name") ? table->get("name") : table->get("kind");
    return name == nullptr ? std::nullopt : name->value_exact<std::string>();
  }

  std::string allowed_entries(const toml::array& entries) const {
    if (entries.empty()) return walked_ + " has no entries";
    std::string text = "allowed: " + walked_ + "[0]";
    if (entries.size() > 1) text += " to " + walked_ + '[' + std::to_string(entries.size() - 1) + ']';
    std::vector<std::string> names;
    for (const toml::node& entry : entries) {
      if (const auto name = name_of(entry)) names.push_back(*name);
    }
    return names.empty() ? text : text + ", or instead of the number a name: " + join(names);
  }

  std::size_t index_in(const toml::array& entries, const std::string& choice) const {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
    if (error == std::errc() && end == choice.data() + choice.size()) {
      if (index < entries.size()) return index;
      fail("there is no " + walked_ + '[' + choice + "]; " + allowed_entries(entries));
    }
    std::vector<std::string> names;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const auto name = name_of(entries[i]);
      if (!name) continue;
      names.push_back(*name);
      if (*name == choice) found.push_back(i);
    }
    if (found.size() == 1) return found.front();
    if (found.empty())
      fail("there is no " + walked_ + " \"" + choice + '"' + did_you_mean(choice, names) + "; " + allowed_entries(entries));
    fail(std::to_string(found.size()) + ' ' + walked_ + " are \"" + choice + "\"; allowed: their numbers, " + walked_ + '[' +
         std::to_string(found.front()) + "] the first");
  }

  toml::node& entry(toml::node& node, const std::string& choice) const {
    toml::array& entries = array(node);
    return entries[index_in(entries, choice)];
  }

  std::string option_;
  std::string value_;
  std::vector<Step> path_;
  std::string walked_;  // the path so far, for messages
};

/// The length of a comment or a quoted text at the start of `rest`; 0 if there is neither. Its characters are no keys, brackets or
/// commas.
std::size_t length_of_text(std::string_view rest) {
  if (rest.front() == '#') return std::min(rest.find('\n'), rest.size());
  const char quote = rest.front();
  if (quote != '"' && quote != '\'') return 0;
  const std::string_view end = rest.starts_with(std::string(3, quote)) ? rest.substr(0, 3) : rest.substr(0, 1);
  for (std::size_t at = end.size(); at < rest.size(); ++at) {
    if (rest[at] == '\\' && quote == '"') {
      ++at;
    } else if (rest.substr(at).starts_with(end)) {
      return at + end.size();
    } else if (rest[at] == '\n' && end.size() == 1) {
      return at;
    }
  }
  return rest.size();
}

}  // namespace

void set_values(toml::table& root, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) Assignment(assignment).apply_to(root);
}

std::optional<unsigned> find_deep_toml(std::string_view text) {
  std::vector<std::size_t> enclosing = {0};  // levels at each open bracket
  std::size_t level = 0;
  unsigned line = 1;
  while (!text.empty()) {
    const std::size_t skipped = length_of_text(text);
    const char c = text.front();
    if (skipped == 0 && (c == '[' || c == '{')) enclosing.push_back(++level);
    if (skipped == 0 && c == '.') ++level;
    if (skipped == 0 && (c == ']' || c == '}') && enclosing.size() > 1) {
      enclosing.pop_back();
      level = enclosing.back();
    }
    if (c == ',' || (c == '\n' && enclosing.size() == 1)) level = enclosing.back();
    if (level > kMostTomlLevels) return line;
    const std::string_view taken = text.substr(0, std::max<std::size_t>(skipped, 1));
    line += static_cast<unsigned>(std::ranges::count(taken, '\n'));
    text.remove_prefix(taken.size());
  }
  return std::nullopt;
}

}  // namespace falling_particles
