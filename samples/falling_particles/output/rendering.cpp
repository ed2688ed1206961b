#include "rendering.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>

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

constexpr int kPollInterval = 100;  // ms, between two checks for Ctrl-C

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {
    if (number < 0) throw std::system_error(errno, std::generic_category(), "cannot run another program");
  }
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// Reads the available bytes, up to a buffer. Returns false at the end.
bool read_some(const Descriptor& from, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t count = read(from.number(), buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0;
}

/// An anonymous file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : file_(memfd_create(name, MFD_CLOEXEC)) {}

  int number() const { return file_.number(); }
  void fill(const std::string& text) {
    if (!write_all(number(), text)) throw std::system_error(errno, std::generic_category(), "cannot run another program");
    lseek(number(), 0, SEEK_SET);
  }
  std::string text() {
    std::string text;
    lseek(number(), 0, SEEK_SET);
    while (read_some(file_, text)) {
    }
    return text;
  }

 private:
  Descriptor file_;
};

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void give(int file, int as) { posix_spawn_file_actions_adddup2(&actions_, file, as); }
  void enter(const std::filesystem::path& folder) { posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Reads the program's output until it ends.
std::string read_output(const Descriptor& output, pid_t program) {
  std::string text;
  pollfd wait{output.number(), POLLIN, 0};
  bool is_told = false;
  while (true) {
    if (interrupted() && !is_told) is_told = kill(program, SIGTERM) == 0;
    if (poll(&wait, 1, kPollInterval) > 0 && !read_some(output, text)) return text;
  }
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

ProgramEnd run_program(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::string& input) {
  MemoryFile standard_input("stdin"), messages("stderr");
  standard_input.fill(input);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "cannot run another program");
  const Descriptor output(ends[0]);
  Descriptor output_of_program(ends[1]);
  FileActions actions;
  actions.enter(folder);
  actions.give(standard_input.number(), STDIN_FILENO);
  actions.give(output_of_program.number(), STDOUT_FILENO);
  actions.give(messages.number(), STDERR_FILENO);
  std::vector<std::string> words = command;  // a copy: posix_spawn takes char* const[] although it changes nothing
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t program = 0;
  const int error = posix_spawnp(&program, arguments[0], actions.get(), nullptr, arguments.data(), environ);
  if (error == ENOENT || error == EACCES || error == ENOTDIR) return {false, false, "", ""};
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot run " + command.front());
  output_of_program.close();

  ProgramEnd end{true, false, read_output(output, program), ""};
  int status = 0;
  while (waitpid(program, &status, 0) < 0 && errno == EINTR) {
  }
  end.messages = messages.text();
  end.has_succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (WIFSIGNALED(status)) end.messages += "\nended by signal " + std::to_string(WTERMSIG(status));
  if (WIFEXITED(status) && !end.has_succeeded && end.messages.empty()) {
    end.messages = "exit code " + std::to_string(WEXITSTATUS(status));
  }
  return end;
}

}  // namespace falling_particles
