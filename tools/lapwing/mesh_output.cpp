#include "mesh_output.h"

#include <cstdio>

namespace lapwing::cli {

void print_notes(const WriteReport& report) {
  for (const std::string& line : report.not_carried) {
    std::fprintf(stderr, "lapwing: not carried over: %s\n", line.c_str());
  }
  for (const std::string& line : report.notes) {
    std::fprintf(stderr, "lapwing: note: %s\n", line.c_str());
  }
}

}  // namespace lapwing::cli
