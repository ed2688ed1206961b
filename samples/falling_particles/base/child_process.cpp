#include "child_process.hpp"

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
#include <stdexcept>
#include <system_error>

#include "interrupt.hpp"
#include "write_file.hpp"

namespace falling_particles {
namespace {

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
