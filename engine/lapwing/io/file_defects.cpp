#include "lapwing/io/file_defects.h"

#include <array>

#include "lapwing/base/counted.h"
#include "lapwing/base/printable_text.h"

namespace lapwing {
namespace {

// The entries must be in the order of FileDefectKind.
constexpr std::array<FileDefectInfo, kFileDefectKindCount> kFileDefects{{
    {"faces with fewer than three corners", "faces with fewer than three corners left out"},
    {"faces that name a missing vertex", "faces that named a missing vertex left out"},
    {"headers whose count of faces is wrong", "headers with a wrong count of faces corrected"},
    {"solids without an end", "solids closed after the last complete facet"},
}};

}  // namespace

const FileDefectInfo& describe(FileDefectKind kind) {
  return kFileDefects[static_cast<std::size_t>(kind)];
}

std::string format(std::span<const FileDefect> defects) {
  const std::string indent(9, ' ');
  std::string text;
  for (const FileDefect& defect : defects) {
    text += "error    " + counted(defect.count, describe(defect.kind).name) + '\n';
    for (const std::string& place : defect.first) text += indent + printable(place) + '\n';
    if (defect.first.size() < defect.count) text += indent + "...\n";
  }
  if (!text.empty()) {
    text += indent +
            "-> repair the file with `lapwing check MESH --fix OUT`; no other command "
            "reads it\n";
  }
  return text;
}

std::string format_repairs(std::span<const FileDefect> defects) {
  std::string text;
  for (const FileDefect& defect : defects) {
    text += counted(defect.count, describe(defect.kind).repair) + '\n';
  }
  return text;
}

}  // namespace lapwing
