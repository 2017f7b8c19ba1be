#include "messages.h"

#include <algorithm>
#include <array>
#include <regex>
#include <utility>

namespace lapwing::python {
namespace {

void replace_all(std::string& text, const std::string& old, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size()) {
    text.replace(at, old.size(), by);
  }
}

// Phrases for shells and their replacements. A phrase precedes shorter phrases that it contains, so
// that it is replaced first.
constexpr std::array<std::pair<const char*, const char*>, 12> kPhrases{{
    {"`lapwing check MESH --fix OUT --fill-holes smooth`", "`lapwing.fill_holes`"},
    {"`lapwing check MESH --fix OUT`", "`lapwing.fix`"},
    {"`lapwing check --fix`", "`lapwing.fix`"},
    {" (`lapwing info` lists them)", ""},
    {" `lapwing info` says why.", ""},
    {"cut it open with `lapwing cut`, or give a \"region\" of it", "give a part_region of it"},
    {"`lapwing check MESH`", "`lapwing.check`"},
    {"repair the mesh with --fix", "repair the mesh with `lapwing.fix`"},
    {"run with --device cpu", "use device=\"cpu\""},
    {"--device cpu", "device=\"cpu\""},
    {"transplant: part.region", "transplant: part_region"},
    {"transplant: part.mesh", "transplant: part"},
}};

// Replaces the JSON pointer after the name of a function by a Python expression. For example,
// "/a/0/b" becomes "a[0].b".
std::string without_pointer(const std::string& message) {
  static const std::regex place(
      "^((?:deform|Deformer|coat|mix|transplant|peel|remesh|parameterize|wrap): (?:\\w+: )?)"
      "(/[\\w/]+)(?=: )");
  std::smatch found;
  if (!std::regex_search(message, found, place)) return message;
  std::string prefix = found[1];
  std::string path = std::regex_replace(found[2].str(), std::regex("/(\\d+)(?=/|$)"), "[$1]");
  replace_all(path, "/", ".");
  const bool is_inside = std::count(prefix.begin(), prefix.end(), ':') == 2;
  if (is_inside) {
    prefix.resize(prefix.size() - 2);  // "peel: region: /disk" becomes "peel: region.disk"
  } else {
    path.erase(0, 1);
  }
  return prefix + path + found.suffix().str();
}

}  // namespace

std::string in_python_words(std::string message) {
  static const std::regex flag(" \\(or --[^)]*\\)");
  message = std::regex_replace(without_pointer(message), flag, "");
  for (const auto& [old, by] : kPhrases) replace_all(message, old, by);
  message = std::regex_replace(message, std::regex("`--device ([^`]+)`"), "device=\"$1\"");
  static const std::regex command("`lapwing (\\w+)`");
  return std::regex_replace(message, command, "`lapwing.$1`");
}

std::vector<std::string> in_python_words(std::vector<std::string> messages) {
  for (std::string& message : messages) message = in_python_words(std::move(message));
  return messages;
}

}  // namespace lapwing::python
