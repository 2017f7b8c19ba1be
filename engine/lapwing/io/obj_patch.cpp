#include "lapwing/io/source_patch.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

// Returns the part of a corner such as "7/2/-3" behind its second slash; empty without one.
std::string_view normal_part(std::string_view corner) {
  const std::size_t first = corner.find('/');
  if (first == std::string_view::npos) return {};
  const std::size_t second = corner.find('/', first + 1);
  return second == std::string_view::npos ? std::string_view{} : corner.substr(second + 1);
}

std::string normal_lines(const StoredNormals& updated, std::size_t first, std::string_view ending) {
  std::string lines;
  for (std::size_t n = first; n < updated.normals.size(); ++n) {
    lines += "vn";
    append_numbers(lines, updated.normals[n]);
    lines += ending;
  }
  return lines;
}

}  // namespace

void add_obj_normals(const Mesh& mesh, const StoredNormals& updated, const SourceFile& source,
                     SourcePatch& patch) {
  const std::string_view bytes = source.bytes();
  const std::string_view ending = bytes.find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
  const std::size_t own = source.normals.count;
  TextScanner behind(source, '#', source.normals.offset(own - 1, 2));
  behind.next_line();
  const std::uint64_t insertion = behind.offset();
  std::string lines = normal_lines(updated, own, ending);
  if (bytes[insertion - 1] != '\n' && bytes[insertion - 1] != '\r') {
    lines.insert(0, ending);
  }
  patch.set_text(insertion, 0, std::move(lines));

  std::size_t corner = 0;
  for (TextScanner scan = scan_text(source, '#'); !scan.at_end(); scan.next_line()) {
    const std::string_view keyword = scan.word();
    if (keyword == "g" || keyword == "usemtl" || keyword == "mtllib") continue;
    if (keyword != "f" && keyword != "fo") {
      while (!scan.at_line_end()) scan.word();  // includes continued lines
      continue;
    }
    for (; !scan.at_line_end(); ++corner) {
      const std::string_view number = normal_part(scan.word());
      if (number.empty()) continue;
      const Index now = updated.corner_normals[corner];
      const auto offset = static_cast<std::uint64_t>(number.data() - bytes.data());
      // A relative index behind the inserted lines would count them as well.
      const bool shifted = number.front() == '-' && offset > insertion;
      if (now == mesh.attributes().corner_normals[corner] && !shifted) continue;
      patch.set_text(offset, number.size(), std::to_string(std::size_t{now} + 1));
    }
  }
}

}  // namespace lapwing
