#include "common/measured_tables.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

namespace common {
namespace {

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

}  // namespace

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

}  // namespace common
