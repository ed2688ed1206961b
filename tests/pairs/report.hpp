// What a kind of pairs prints: a table, and each fault that it finds.
#pragma once

#include <cstdio>
#include <initializer_list>
#include <string>

namespace supernormal::test {

class Report {
 public:
  void head(std::initializer_list<const char*> columns) const {
    for (const char* column : columns) std::printf("| %s ", column);
    std::printf("|\n");
    for (std::size_t k = 0; k < columns.size(); ++k) std::printf(k == 0 ? "|---" : "|--:");
    std::printf("|\n");
  }

  void row(const std::string& name, std::initializer_list<double> figures) const {
    std::printf("| %s |", name.c_str());
    for (const double figure : figures) std::printf(" %.7g |", figure);
    std::printf("\n");
    std::fflush(stdout);
  }

  void fault(const std::string& what) {
    ++faults_;
    std::printf("FAULT: %s\n", what.c_str());
  }

  long faults() const { return faults_; }

 private:
  long faults_ = 0;
};

}  // namespace supernormal::test
