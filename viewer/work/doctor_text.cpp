#include "work/doctor_text.h"

#include <string_view>
#include <vector>

#include "lapwing/base/counted.h"
#include "lapwing/base/printable_text.h"

namespace lapwing::viewer {
namespace {

std::string counted(std::size_t count, std::string_view plural) {
  return grouped(count) + " " + (count == 1 ? singular(plural) : std::string(plural));
}

std::string joined(const std::vector<std::string>& parts, std::string_view before_last) {
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) text += k + 1 == parts.size() ? before_last : ", ";
    text += parts[k];
  }
  return text;
}

}  // namespace

std::string problems_in_words(const CheckReport& report) {
  std::vector<std::string> parts;
  for (const Defect& defect : report.defects) {
    const DefectInfo& info = describe(defect.kind);
    if (info.severity == Severity::info || info.element == Element::none) continue;
    parts.push_back(counted(defect.count, info.name));
  }
  return joined(parts, " and ");
}

std::string hindrance_in_words(const CheckReport& report) {
  if (report.find(DefectKind::no_faces) != nullptr) return "There is nothing to edit.";
  if (report.find(DefectKind::non_finite_vertex) != nullptr) {
    return "A region cannot include vertices without a valid position, or their neighbours.";
  }
  return "You can edit the mesh, but shading and weights may be wrong in these places.";
}

std::string repairs_in_words(const FixReport& report) {
  std::vector<std::string> parts;
  for (const Repair& repair : report.repairs) {
    parts.push_back(counted(repair.count, describe(repair.kind).text));
  }
  return joined(parts, ", ");
}

std::string emptiness_in_words(const std::string& name, const MeshStatistics& statistics) {
  const std::string vertices = counted(statistics.vertices, "vertices");
  if (statistics.vertices == 0) {
    return name + " has no vertices and no faces. Export it again, or open another file.";
  }
  if (statistics.faces == 0) {
    return name + " has " + vertices +
           " and no faces. A point cloud has no surface to edit. Reconstruct its surface first, or "
           "open a mesh and attach the points (File > Attach object).";
  }
  return name + " has " + vertices + " and " + counted(statistics.faces, "faces") +
         ", but none of the faces is valid. Export the mesh again, or open another file.";
}

}  // namespace lapwing::viewer
