#include "child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

#include "interrupt.hpp"
#include "write_file.hpp"

namespace falling_particles {
namespace {

constexpr std::chrono::milliseconds kPollInterval(10);  // between two looks whether the program has ended and for Ctrl-C

/// An anonymous file in memory, which a program may have as its input or output.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name, const std::string& text = "") : number_(memfd_create(name, MFD_CLOEXEC)) {
    if (number_ < 0 || !write_all(number_, text) || lseek(number_, 0, SEEK_SET) < 0) fail();
  }
  ~MemoryFile() { close(number_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int number() const { return number_; }
  std::string text() const {
    std::string text(static_cast<std::size_t>(lseek(number_, 0, SEEK_END)), '\0');
    if (pread(number_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) fail();
    return text;
  }

 private:
  [[noreturn]] static void fail() { throw std::system_error(errno, std::generic_category(), "cannot run another program"); }
  int number_;
};

/// Waits for the end of the program, which Ctrl-C tells to end. Returns its status.
int wait_for(pid_t program) {
  int status = 0;
  for (bool is_told = false; waitpid(program, &status, WNOHANG) == 0; std::this_thread::sleep_for(kPollInterval)) {
    if (interrupted() && !is_told) is_told = kill(program, SIGTERM) == 0;
  }
  return status;
}

}  // namespace

ProgramEnd run_program(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::string& input) {
  const MemoryFile standard_input("stdin", input), output("stdout"), messages("stderr");
  std::vector<std::string> words = command;  // a copy: posix_spawn takes char* const[] although it changes nothing
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_adddup2(&actions, standard_input.number(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output.number(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.number(), STDERR_FILENO);
  pid_t program = 0;
  const int error = posix_spawnp(&program, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT || error == EACCES || error == ENOTDIR) return {false, false, "", ""};
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot run " + command.front());

  const int status = wait_for(program);
  ProgramEnd end{true, WIFEXITED(status) && WEXITSTATUS(status) == 0, output.text(), messages.text()};
  if (WIFSIGNALED(status)) end.messages += "\nended by signal " + std::to_string(WTERMSIG(status));
  if (WIFEXITED(status) && !end.has_succeeded && end.messages.empty()) {
    end.messages = "exit code " + std::to_string(WEXITSTATUS(status));
  }
  return end;
}

}  // namespace falling_particles
