#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "common/interval.hpp"
#include "read_data.hpp"
#include "triangles.hpp"

namespace fit {
namespace {

enum class Format { Text, LittleEndian, BigEndian };

struct Type {
  std::array<const char*, 2> names;
  std::size_t bytes;
  char kind;  // 'i'nteger, 'u'nsigned or 'f'loating point
};

constexpr std::array kTypes = {Type{{"char", "int8"}, 1, 'i'},     Type{{"uchar", "uint8"}, 1, 'u'},
                               Type{{"short", "int16"}, 2, 'i'},   Type{{"ushort", "uint16"}, 2, 'u'},
                               Type{{"int", "int32"}, 4, 'i'},     Type{{"uint", "uint32"}, 4, 'u'},
                               Type{{"float", "float32"}, 4, 'f'}, Type{{"double", "float64"}, 8, 'f'}};

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* count_type = nullptr;  // for a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::Text;
  std::vector<Element> elements;
  std::size_t lines = 0, bytes = 0;
};

const Type* type_named(const std::string& where, const std::string& name) {
  const auto found =
      std::ranges::find_if(kTypes, [&](const Type& type) { return std::ranges::find(type.names, name) != type.names.end(); });
  if (found == kTypes.end()) throw InputError(where + "\"" + name + "\" is no type of a number");
  return &*found;
}

Format format_of(const std::string& where, std::istream& words) {
  std::string name, version;
  words >> name >> version;
  constexpr std::array kNames = {"ascii", "binary_little_endian", "binary_big_endian"};
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end() || version != "1.0") {
    throw InputError(where + "unknown format \"" + name + " " + version +
                     "\"; allowed: ascii, binary_little_endian or binary_big_endian, 1.0");
  }
  return static_cast<Format>(found - kNames.begin());
}

Element read_element(const std::string& where, std::istream& words) {
  Element element;
  std::string count;
  words >> element.name >> count;
  const bool is_number =
      !count.empty() && count.size() < 19 && std::ranges::all_of(count, [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!is_number) throw InputError(where + "element " + element.name + " has the count \"" + count + "\"; allowed: 0 to 1e18 - 1");
  element.count = std::stoull(count);
  return element;
}

Property read_property(const std::string& where, std::istream& words) {
  Property property;
  std::string type;
  words >> type;
  if (type == "list") {
    std::string count_type;
    words >> count_type >> type;
    property.count_type = type_named(where, count_type);
  }
  property.type = type_named(where, type);
  if (!(words >> property.name)) throw InputError(where + "a property without a name");
  return property;
}

Header read_header(const std::string& path, const std::string& bytes) {
  Header header;
  bool has_format = false;
  while (true) {
    const std::size_t end = bytes.find('\n', header.bytes);
    const std::string where = path + ":" + std::to_string(++header.lines) + ": ";
    if (end == std::string::npos) throw InputError(where + "the file ends within its header, which must end with end_header");
    std::istringstream words(bytes.substr(header.bytes, end - header.bytes));
    header.bytes = end + 1;
    std::string key;
    words >> key;
    if (header.lines == 1) {
      if (key != "ply") throw InputError(where + "the first line of a .ply is \"ply\"");
    } else if (key == "format") {
      header.format = format_of(where, words);
      has_format = true;
    } else if (key == "element") {
      header.elements.push_back(read_element(where, words));
    } else if (key == "property") {
      if (header.elements.empty()) throw InputError(where + "a property stands before the first element");
      header.elements.back().properties.push_back(read_property(where, words));
    } else if (key == "end_header") {
      if (!has_format) throw InputError(where + "the header has no format");
      return header;
    } else if (key != "comment" && key != "obj_info" && !key.empty()) {
      throw InputError(where + "unknown key \"" + key.substr(0, 40) + "\" in the header");
    }
  }
}

/// Reads the numbers after the header one by one.
class Numbers {
 public:
  Numbers(const std::string& path, const std::string& bytes, const Header& header)
      : path_(path), bytes_(bytes), format_(header.format), at_(header.bytes), line_(header.lines + 1) {}

  /// The element to read next, for messages.
  void expect(const Element& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
  }

  double next(const Type& type) { return format_ == Format::Text ? next_of_text() : next_of_bytes(type); }

  std::size_t next_count(const Type& type) {
    const double count = next(type);
    if (!(count >= 0) || count != std::floor(count)) fail("a list has " + common::shortest(count) + " entries");
    // Every entry takes at least one byte: refuse a count beyond the end of the file early.
    if (count > static_cast<double>(bytes_.size() - at_))
      fail("a list has " + common::shortest(count) + " entries, but the file ends before");
    return static_cast<std::size_t>(count);
  }

  /// Refuses a count of elements for which the file is too short.
  void require_room(const Element& element) const {
    std::size_t least = 0;
    for (const Property& property : element.properties) {
      // In a text file every number but the last takes a digit and a space.
      least += format_ == Format::Text ? 2 : (property.count_type != nullptr ? property.count_type : property.type)->bytes;
    }
    const std::size_t room = least == 0 ? 0 : (bytes_.size() - at_ + 1) / least;
    if (element.count <= room || element.properties.empty()) return;
    throw InputError(path_ + ": the header says " + std::to_string(element.count) + " of element " + element.name +
                     ", but the file has room for " + std::to_string(room) + " at most: is it truncated?");
  }

  /// Refuses text after the last element. Returns the number of bytes after it in a binary file.
  std::size_t finish() {
    if (format_ != Format::Text) return bytes_.size() - at_;
    skip_space();
    if (at_ < bytes_.size())
      throw InputError(path_ + ":" + std::to_string(line_) + ": the file goes on after all that its header says");
    return 0;
  }

  [[noreturn]] void fail(const std::string& what) const {
    std::string where = path_ + ":";
    if (format_ == Format::Text) where += std::to_string(line_) + ":";
    throw InputError(where + " " + element_->name + " " + std::to_string(index_ + 1) + " of " + std::to_string(element_->count) +
                     ": " + what);
  }

 private:
  void skip_space() {
    for (; at_ < bytes_.size() && std::isspace(static_cast<unsigned char>(bytes_[at_])) != 0; ++at_) {
      if (bytes_[at_] == '\n') ++line_;
    }
  }

  double next_of_text() {
    skip_space();
    if (at_ == bytes_.size()) fail("the file ends here");
    const char* const first = bytes_.c_str() + at_;
    char* end = nullptr;
    const double value = std::strtod(first, &end);
    if (end == first || (*end != '\0' && std::isspace(static_cast<unsigned char>(*end)) == 0)) {
      const std::size_t length = bytes_.find_first_of(" \t\r\n", at_) - at_;
      fail("\"" + bytes_.substr(at_, std::min<std::size_t>(length, 40)) + "\" is no number");
    }
    at_ += static_cast<std::size_t>(end - first);
    return value;
  }

  double next_of_bytes(const Type& type) {
    if (bytes_.size() - at_ < type.bytes) fail("the file ends here");
    std::array<char, 8> raw{};
    std::copy_n(bytes_.data() + at_, type.bytes, raw.data());
    at_ += type.bytes;
    if ((format_ == Format::BigEndian) == (std::endian::native == std::endian::little))
      std::reverse(raw.data(), raw.data() + type.bytes);
    const auto as = [&]<typename Number>(Number number) {
      std::memcpy(&number, raw.data(), sizeof number);
      return static_cast<double>(number);
    };
    if (type.kind == 'f') return type.bytes == 4 ? as(float{}) : as(double{});
    const bool is_signed = type.kind == 'i';
    if (type.bytes == 1) return is_signed ? as(std::int8_t{}) : as(std::uint8_t{});
    if (type.bytes == 2) return is_signed ? as(std::int16_t{}) : as(std::uint16_t{});
    return is_signed ? as(std::int32_t{}) : as(std::uint32_t{});
  }

  const std::string& path_;
  const std::string& bytes_;
  Format format_;
  std::size_t at_, line_;
  const Element* element_ = nullptr;
  std::uint64_t index_ = 0;
};

std::optional<std::size_t> find_property(const Element& element, const char* name) {
  const auto found = std::ranges::find(element.properties, name, &Property::name);
  if (found == element.properties.end() || found->count_type != nullptr) return std::nullopt;
  return static_cast<std::size_t>(found - element.properties.begin());
}

/// The values of the next element, one list for each property.
void read_values(Numbers& numbers, const Element& element, std::vector<std::vector<double>>& values) {
  values.resize(element.properties.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Property& property = element.properties[k];
    values[k].resize(property.count_type == nullptr ? 1 : numbers.next_count(*property.count_type));
    for (double& value : values[k]) value = numbers.next(*property.type);
  }
}

void read_vertices(const std::string& path, Numbers& numbers, const Element& element, Data& data) {
  std::array<std::size_t, 3> place{}, normal{};
  bool has_normals = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = find_property(element, std::array{"x", "y", "z"}[i]);
    if (!found) throw InputError(path + ": vertices have no property \"" + "xyz"[i] + "\"");
    place[i] = *found;
    const auto of_normal = find_property(element, std::array{"nx", "ny", "nz"}[i]);
    has_normals = has_normals && of_normal.has_value();
    normal[i] = of_normal.value_or(0);
    const Type& type = *element.properties[*found].type;
    data.is_single = data.is_single || (type.kind == 'f' && type.bytes == 4);
  }
  std::vector<std::vector<double>> values;
  const auto vector_at = [&](const std::array<std::size_t, 3>& where) {
    return Eigen::Vector3d(values[where[0]][0], values[where[1]][0], values[where[2]][0]);
  };
  for (std::uint64_t i = 0; i < element.count; ++i) {
    numbers.expect(element, i);
    read_values(numbers, element, values);
    data.vertices.points.push_back(vector_at(place));
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = data.vertices.points.back()[static_cast<Eigen::Index>(k)];
      if (!std::isfinite(x)) numbers.fail(std::string(1, "xyz"[k]) + " is " + common::shortest(x) + ", but must be finite");
    }
    if (has_normals) data.vertices.normals.push_back(vector_at(normal));
  }
}

void read_faces(Numbers& numbers, const Element& element, Data& data) {
  const auto corners = std::ranges::find_if(element.properties, [](const Property& property) {
    return property.count_type != nullptr && (property.name == "vertex_indices" || property.name == "vertex_index");
  });
  const auto list = static_cast<std::size_t>(corners - element.properties.begin());
  std::vector<std::vector<double>> values;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    numbers.expect(element, i);
    if (list == element.properties.size()) numbers.fail("faces have no list \"vertex_indices\"");
    read_values(numbers, element, values);
    const std::string complaint = append_polygon(values[list], data);
    if (!complaint.empty()) numbers.fail(complaint);
  }
}

/// All elements, from where the header ends.
Data read_elements(const std::string& path, const std::string& bytes, const Header& header) {
  Numbers numbers(path, bytes, header);
  Data data;
  for (const Element& element : header.elements) {
    numbers.require_room(element);
    if (element.name == "tristrips") throw InputError(path + ": strips of triangles (tristrips) are not read; give faces");
    if (element.name == "vertex") {
      read_vertices(path, numbers, element, data);
    } else if (element.name == "face") {
      read_faces(numbers, element, data);
    } else {
      std::vector<std::vector<double>> values;
      for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        numbers.expect(element, i);
        read_values(numbers, element, values);
      }
    }
  }
  if (const std::size_t rest = numbers.finish(); rest > 0) {
    data.note = "what follows all that the header says, " + std::to_string(rest) + " bytes, is left out";
  }
  // A text file holds the digits that it shows, whatever type its header names.
  if (header.format == Format::Text) data.is_single = false;
  if (!data.triangles.empty()) data.vertices.normals.clear();  // the normals of the triangles are used
  return data;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": cannot be opened");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The text of an .off file as that of a .ply, with its header beside it: line by line the numbers that count, without comments and
/// colours.
std::string as_ply(const std::string& path, const std::string& text, Header& header) {
  std::istringstream lines(text);
  std::string key, out;
  std::uint64_t vertices = 0;
  std::size_t number = 0, of_vertex = 3;
  for (std::string line; std::getline(lines, line); out += '\n') {
    if (++number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // the byte order mark of UTF-8
    const std::string where = path + ":" + std::to_string(number) + ": ";
    std::istringstream stream(line.substr(0, line.find('#')));
    std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    if (key.empty() && !words.empty()) {
      // Before OFF: ST (texture coordinates), C (colours) and N (normals).
      constexpr std::array kKeys = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
      key = words.front();
      if (std::ranges::find(kKeys, key) == kKeys.end()) {
        throw InputError(where + "the file begins with \"" + key.substr(0, 40) +
                         "\"; allowed: OFF, with ST, C or N before it, in three dimensions");
      }
      words.erase(words.begin());
    }
    if (words.empty()) continue;
    if (header.elements.empty()) {
      words.resize(2);
      for (const char* const element : {"vertex ", "face "}) {
        std::istringstream count(element + words[header.elements.size()]);
        header.elements.push_back(read_element(where, count));
      }
      vertices = header.elements[0].count;
      const bool has_normals = key.find('N') != key.npos && header.elements[1].count == 0;
      of_vertex = has_normals ? 6 : 3;
      for (const char* const name : {"x", "y", "z", "nx", "ny", "nz"}) {
        if (header.elements[0].properties.size() < of_vertex) header.elements[0].properties.push_back({name, &kTypes.back()});
      }
      header.elements[1].properties = {{"vertex_indices", &kTypes.back(), &kTypes.back()}};
      continue;
    }
    const std::size_t kept = vertices > 0 ? of_vertex : 1 + std::strtoul(words.front().c_str(), nullptr, 10);
    if (vertices > 0) --vertices;
    for (std::size_t k = 0; k < std::min(kept, words.size()); ++k) out += words[k] + ' ';
  }
  if (header.elements.empty()) throw InputError(path + ": the file ends before the numbers of vertices and faces");
  return out;
}

}  // namespace

Data read_ply(const std::string& path) {
  const std::string bytes = bytes_of(path);
  return read_elements(path, bytes, read_header(path, bytes));
}

Data read_off(const std::string& path) {
  Header header;
  const std::string text = as_ply(path, bytes_of(path), header);
  return read_elements(path, text, header);
}

}  // namespace fit
