#include "messages.h"

#include <cstdio>

#include "lapwing/base/printable_text.h"

namespace lapwing::cli {

void say(const std::string& line) {
  std::fprintf(stderr, "lapwing: %s\n", printable(line).c_str());
}

void note(const std::string& text) {
  say("note: " + text);
}

void print_notes(const WriteReport& report) {
  for (const std::string& line : report.not_carried) say("not carried over: " + line);
  for (const std::string& line : report.notes) note(line);
}

std::string shown(const std::filesystem::path& name) {
  return printable(name.string());
}

}  // namespace lapwing::cli
