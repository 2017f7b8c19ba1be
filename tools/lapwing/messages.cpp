#include "messages.h"

#include <cstdio>
#include <cstdlib>
#include <unistd.h>

#include "lapwing/base/printable_text.h"
#include "lapwing/mesh/topology.h"

namespace lapwing::cli {
namespace {

constexpr const char* kCyan = "36";
constexpr const char* kYellow = "33";

bool is_coloured() {
  static const bool coloured = isatty(STDERR_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
  return coloured;
}

void say_with_word(const char* word, const char* color, const std::string& text) {
  if (!is_coloured()) return say(std::string(word) + ": " + text);
  std::fprintf(stderr, "lapwing: \033[1;%sm%s:\033[0m %s\n", color, word, printable(text).c_str());
}

}  // namespace

void say(const std::string& line) {
  std::fprintf(stderr, "lapwing: %s\n", printable(line).c_str());
}

void note(const std::string& text) {
  say_with_word("note", kCyan, text);
}

void warn(const std::string& text) {
  say_with_word("warning", kYellow, text);
}

Mesh read_with_notes(const std::filesystem::path& path) {
  Mesh mesh = read_mesh(path);
  for (const std::string& line : reading_notes(mesh)) note(line);
  return mesh;
}

void warn_without_surface(const Mesh& mesh, const std::string& path) {
  const std::string why = why_no_surface(mesh);
  if (!why.empty()) warn(path + " has no surface: " + why);
}

void print_notes(const WriteReport& report) {
  for (const std::string& line : report.not_carried) warn("not carried over: " + line);
  for (const std::string& line : report.notes) note(line);
}

std::string shown(const std::filesystem::path& name) {
  return printable(name.string());
}

}  // namespace lapwing::cli
