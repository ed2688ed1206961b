#include <Eigen/Core>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "formats.hpp"
#include "triangles.hpp"

namespace fit {
namespace {

/// Reads the words of the lines of a file that are neither empty nor a comment.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), file_(path) {
    if (!file_) throw InputError(path + ": cannot be opened");
  }

  /// Goes to the next line. Returns false at the end of the file.
  bool next() {
    while (std::getline(file_, line_)) {
      if (++number_ == 1 && line_.starts_with("\xef\xbb\xbf")) line_.erase(0, 3);  // the byte order mark of UTF-8
      line_.erase(std::min(line_.find('#'), line_.size()));
      at_ = 0;
      if (!is_at_end()) return true;
    }
    return false;
  }

  bool is_at_end() {
    while (at_ < line_.size() && is_space(line_[at_])) ++at_;
    return at_ == line_.size();
  }

  /// The next word of the line; "" at its end.
  std::string word() {
    if (is_at_end()) return "";
    const std::size_t first = at_;
    while (at_ < line_.size() && !is_space(line_[at_])) ++at_;
    return line_.substr(first, at_ - first);
  }

  double number(const std::string& what) {
    const std::string text = word();
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty()) fail("the line ends before " + what);
    if (end != text.c_str() + text.size()) fail(what + " is \"" + text.substr(0, kLongest) + "\", which is no number");
    return value;
  }

  std::uint64_t count(const std::string& what) {
    const std::string text = word();
    const bool is_count =
        !text.empty() && text.size() < 19 && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!is_count) fail("the number of " + what + " is \"" + text.substr(0, kLongest) + "\"; allowed: 0 to 1e18 - 1");
    return std::stoull(text);
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(path_ + ":" + std::to_string(number_) + ": " + what); }

 private:
  static constexpr std::size_t kLongest = 40;  // characters of a word in a message
  static bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

  const std::string& path_;
  std::ifstream file_;
  std::string line_;
  std::size_t at_ = 0, number_ = 0;
};

struct Header {
  std::uint64_t vertices = 0, faces = 0;
  bool has_normals = false;
};

Header read_header(const std::string& path, Lines& lines) {
  if (!lines.next()) throw InputError(path + ": no points");
  // Before OFF: ST (texture coordinates), C (colours) and N (normals).
  const std::string key = lines.word();
  const std::vector<std::string> allowed = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  if (std::ranges::find(allowed, key) == allowed.end()) {
    lines.fail("the file begins with \"" + key.substr(0, 40) + "\"; allowed: OFF, with ST, C or N before it, in three dimensions");
  }
  if (lines.is_at_end() && !lines.next()) lines.fail("the file ends before the numbers of vertices and faces");
  Header header{lines.count("vertices"), lines.count("faces"), key.find('N') != std::string::npos};
  return header;
}

Eigen::Vector3d read_vector(Lines& lines, const std::string& prefix) {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = lines.number(prefix + "xyz"[i]);
  return v;
}

void read_face(Lines& lines, Data& data) {
  const std::uint64_t count = lines.count("vertices of a face");
  std::vector<double> corners;
  for (std::uint64_t i = 0; i < count; ++i) {
    corners.push_back(lines.number("vertex " + std::to_string(i + 1) + " of " + std::to_string(count) + " of the face"));
  }
  const std::string complaint = append_polygon(corners, data);
  if (!complaint.empty()) lines.fail(complaint);
}

}  // namespace

Data read_off(const std::string& path) {
  Lines lines(path);
  const Header header = read_header(path, lines);
  Data data;
  std::uint64_t faces = 0;
  const std::string promised =
      "the header says " + std::to_string(header.vertices) + " vertices and " + std::to_string(header.faces) + " faces, but ";
  const auto expect_line = [&] {
    if (lines.next()) return;
    throw InputError(path + ": " + promised + "the file has " + std::to_string(data.vertices.points.size()) + " vertices and " +
                     std::to_string(faces) + " faces: is it truncated?");
  };
  while (data.vertices.points.size() < header.vertices) {
    expect_line();
    data.vertices.points.push_back(read_vector(lines, ""));
    if (!data.vertices.points.back().allFinite()) lines.fail("a coordinate is not finite");
    if (header.has_normals && header.faces == 0) data.vertices.normals.push_back(read_vector(lines, "n"));
  }
  for (; faces < header.faces; ++faces) {
    expect_line();
    read_face(lines, data);
  }
  if (lines.next()) lines.fail(promised + "the file goes on");
  return data;
}

}  // namespace fit
