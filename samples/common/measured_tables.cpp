#include "common/measured_tables.hpp"

#include <unistd.h>

#include <Eigen/Core>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

namespace common {

namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return __VERSION__;  // it names the compiler, too
#else
  return std::string("GCC ") + __VERSION__;
#endif
}

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

std::string commit() {
  std::FILE* const pipe = popen("git -C '" COMMON_SOURCE "' describe --always --dirty 2>/dev/null", "r");
  if (pipe == nullptr) return "unknown";
  std::array<char, 128> text{};
  const bool found = std::fgets(text.data(), text.size(), pipe) != nullptr;
  pclose(pipe);
  std::string name = found ? text.data() : "unknown";
  if (name.ends_with('\n')) name.pop_back();
  return name;
}

namespace fs = std::filesystem;

constexpr const char* kDone = "# done: ";

/// The file of a table. It contains only the lines of finished tasks.
class TableFile {
 public:
  TableFile(const MeasuredTable& table, const Environment& environment, const std::string& folder)
      : path_(fs::path(folder) / (table.name + ".csv")) {
    if (fs::exists(path_)) {
      read();
    } else {
      for (const auto& [name, value] : environment) text_.append("# ").append(name).append(": ").append(value).append("\n");
      text_.append(table.header).append("\n");
    }
  }

  bool has(const std::string& task) const { return done_.contains(task); }

  void add(const std::string& task, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text_.append(line).append("\n");
    text_.append(kDone).append(task).append("\n");
    done_.insert(task);
    const fs::path unfinished = path_.string() + ".part";
    std::ofstream file(unfinished);
    file << text_;
    file.close();
    if (!file) throw std::runtime_error(unfinished.string() + ": cannot be written");
    fs::rename(unfinished, path_);
  }

 private:
  void read() {
    std::ifstream file(path_);
    for (std::string line; std::getline(file, line);) {
      text_.append(line).append("\n");
      if (line.rfind(kDone, 0) == 0) done_.insert(line.substr(std::string(kDone).size()));
    }
  }

  fs::path path_;
  std::string text_;
  std::set<std::string> done_;
};

class Bar {
 public:
  explicit Bar(std::size_t tasks) : tasks_(tasks) {}

  void show(std::size_t done, const std::string& doing) const {
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = tasks_ == 0 ? kWidth : kWidth * done / tasks_;
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start_).count();
    std::fprintf(stderr, "\r[%s%s] %zu/%zu %4llds  %-48.48s", std::string(filled, '#').c_str(),
                 std::string(kWidth - filled, '.').c_str(), done, tasks_, static_cast<long long>(seconds), doing.c_str());
  }

 private:
  std::size_t tasks_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string print(const char* format, double value) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

}  // namespace

Environment environment() {
  return {{"processor", processor()},
          {"compiler", compiler()},
          {"build", COMMON_FLAGS},
          {"commit", commit()},
          {"Eigen", eigen_version()}};
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line.append(&cell == cells.data() ? "" : ",").append(cell);
  return line;
}

void measure_tables(const std::vector<MeasuredTable>& tables, const Environment& environment, const std::string& folder) {
  fs::create_directories(folder);
  std::size_t count = 0;
  for (const MeasuredTable& table : tables) count += table.tasks.size();
  const Bar bar(count);
  std::size_t done = 0;
  for (const MeasuredTable& table : tables) {
    TableFile file(table, environment, folder);
    for (const MeasuringTask& task : table.tasks) {
      bar.show(done, table.name + ": " + task.name);
      if (!file.has(task.name)) file.add(task.name, task.run());
      ++done;
    }
  }
  bar.show(done, "done");
  std::fputc('\n', stderr);
}

std::string text(const char* format, double value) { return std::isnan(value) ? "–" : print(format, value); }

std::string number(double value) { return print("%.6g", value); }

void become_python(const std::string& script, const std::string& argument) {
  constexpr const char* kPython = "/usr/bin/python3";  // of Debian, which packs matplotlib for it
  execl(kPython, kPython, script.c_str(), argument.c_str(), nullptr);
  throw std::runtime_error("no report: cannot run " + std::string(kPython) + ": " + std::generic_category().message(errno));
}

}  // namespace common
