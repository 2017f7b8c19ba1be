#include "work/doctor_text.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace lapwing::viewer {
namespace {

std::string with_commas(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
  return digits;
}

// The doctor's words are plural: "faces that repeat a vertex".
std::string counted(std::size_t count, std::string_view plural) {
  std::string words(plural);
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSingular{
      {{"vertices", "vertex"},
       {"faces", "face"},
       {"edges", "edge"},
       {" that repeat ", " that repeats "},
       {" that cut ", " that cuts "}}};
  if (count == 1) {
    // The first noun is what is counted: "edges with more than two faces".
    std::size_t first = std::string::npos;
    std::pair<std::string_view, std::string_view> noun;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = words.find(kSingular[k].first);
      if (at >= first) continue;
      first = at;
      noun = kSingular[k];
    }
    if (first != std::string::npos) words.replace(first, noun.first.size(), noun.second);
    for (std::size_t k = 3; k < kSingular.size(); ++k) {
      const auto at = words.find(kSingular[k].first);
      if (at != std::string::npos)
        words.replace(at, kSingular[k].first.size(), kSingular[k].second);
    }
  }
  return with_commas(count) + " " + words;
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
    return "An edit cannot include non-finite vertices or their neighbours.";
  }
  return "It can be edited as it is; shading and weights may be wrong at these places.";
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
    return name +
           " holds no vertices and no faces. Export it again from where it was made, or open "
           "another file.";
  }
  if (statistics.faces == 0) {
    return name + " holds " + vertices +
           " and no faces: a point cloud has no surface to edit. Reconstruct its surface first, or "
           "open a mesh and carry the points along (File > Carry a file along).";
  }
  return name + " holds " + vertices + " and " + counted(statistics.faces, "faces") +
         ", none of which has three different corners at finite places. Export it again from where "
         "it was made, or open another file.";
}

}  // namespace lapwing::viewer
