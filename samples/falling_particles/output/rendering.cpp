#include "rendering.hpp"

#include <cstdio>
#include <map>
#include <sstream>

#include "base/child_process.hpp"
#include "base/interrupt.hpp"
#include "base/write_file.hpp"

namespace falling_particles {
namespace {

void append(std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; }

/// The decisive line of a program's messages: the last line about an error, otherwise the last line.
std::string complaint_of(const std::string& messages) {
  std::istringstream stream(messages);
  std::string last, last_error;
  for (std::string line; std::getline(stream, line);) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    last = line;
    if (line.find("rror") != std::string::npos) last_error = line;
  }
  return last_error.empty() ? last : last_error;
}

/// Removes the chunks of a PNG with date and program, so that equal pictures have equal bytes. Other or truncated files are
/// returned unchanged.
std::string without_date(const std::string& file) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  constexpr std::size_t kFrame = 12;  // bytes of a chunk besides its content: length, name, checksum
  if (!file.starts_with(kSignature)) return file;
  std::string kept(kSignature);
  for (std::size_t at = kSignature.size(); at < file.size();) {
    if (file.size() - at < kFrame) return file;
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | static_cast<unsigned char>(file[at + i]);
    if (file.size() - at - kFrame < length) return file;
    const std::string_view name = std::string_view(file).substr(at + 4, 4);
    if (name != "tIME" && name != "tEXt") kept.append(file, at, kFrame + length);
    at += kFrame + length;
  }
  return kept;
}

void tell_failure(const Rendering& rendering, const ProgramEnd& end) {
  const std::string complaint = end.has_succeeded ? "it wrote nothing" : complaint_of(end.messages);
  std::fprintf(stderr, "Not drawn: %s; %s failed: %s\n", rendering.file.c_str(), rendering.command.front().c_str(),
               complaint.c_str());
}

}  // namespace

void render(const std::vector<Rendering>& renderings, const std::filesystem::path& folder, bool quiet) {
  std::string all, left;
  for (const Rendering& rendering : renderings) append(all, rendering.file);
  if (!quiet && !all.empty()) std::fprintf(stderr, "Drawing %s (Ctrl-C leaves out the rest)\n", all.c_str());
  std::map<std::string, std::string> missing;  // pictures by program
  std::map<std::string, std::string_view> packages;
  for (const Rendering& rendering : renderings) {
    const std::string& program = rendering.command.front();
    const ProgramEnd end = interrupted() ? ProgramEnd{} : run_program(rendering.command, folder, rendering.input);
    if (interrupted()) {
      append(left, rendering.file);
    } else if (!end.is_installed) {
      append(missing[program], rendering.file);
      packages[program] = rendering.package;
    } else if (!end.has_succeeded || end.output.empty()) {
      tell_failure(rendering, end);
    } else {
      write_file(folder / rendering.file, without_date(end.output));
    }
  }
  for (const auto& [program, files] : missing) {
    std::fprintf(stderr, "Not drawn: %s; %s is not installed (sudo apt install %s)\n", files.c_str(), program.c_str(),
                 std::string(packages[program]).c_str());
  }
  if (!left.empty()) std::fprintf(stderr, "Not drawn: %s; stopped by Ctrl-C\n", left.c_str());
}

}  // namespace falling_particles
