#include "lapwing/doctor/format.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <locale>
#include <sstream>

#include "lapwing/base/counted.h"

namespace lapwing {
namespace {

constexpr std::size_t kMaxListedComponents = 5;
constexpr int kLabelWidth = 14;
constexpr int kSeverityWidth = 9;

// Returns a stream whose output does not depend on the locale.
std::ostringstream plain_stream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  return out;
}

int digits_of(std::size_t value) {
  return static_cast<int>(std::to_string(value).size());
}

std::string in_number(std::size_t count, std::string_view plural) {
  return count == 1 ? singular(plural) : std::string(plural);
}

void write_label(std::ostream& out, std::string_view label) {
  out << std::left << std::setw(kLabelWidth) << label;
}

void write_point(std::ostream& out, const Eigen::Vector3d& p) {
  out << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
}

void write_components(std::ostream& out, const std::vector<std::size_t>& sizes) {
  write_label(out, "components");
  out << sizes.size();
  const std::size_t listed = std::min(sizes.size(), kMaxListedComponents);
  if (sizes.size() > 1) {
    for (std::size_t i = 0; i < listed; ++i) out << (i == 0 ? " of " : ", ") << sizes[i];
    out << (listed < sizes.size() ? ", ... vertices" : " vertices");
  }
  out << '\n';
}

// These names must be in the order of the enumerators of Severity and Element.
constexpr std::array<std::string_view, 3> kSeverityNames{"info", "warning", "error"};
constexpr std::array<std::string_view, 6> kElementNames{"",      "vertices",    "faces",
                                                        "edges", "at vertices", "at vertices"};

// Writes "vertices 3, 7, 12, ..." or "edges 3-7, 12-15".
void write_places(std::ostream& out, const Defect& defect) {
  const Element element = describe(defect.kind).element;
  const std::size_t width = element == Element::edge ? 2 : 1;
  out << kElementNames[static_cast<std::size_t>(element)];
  for (std::size_t i = 0; i < defect.first.size(); i += width) {
    out << (i == 0 ? " " : ", ") << defect.first[i];
    if (width == 2) out << '-' << defect.first[i + 1];
  }
  if (defect.first.size() / width < defect.count) out << ", ...";
}

// Writes "with 24, 8 and 3 rim vertices". `holes` have the same order as `defect.first`.
void write_rims(std::ostream& out, const Defect& defect, const std::vector<Hole>& holes) {
  const std::size_t listed = defect.first.size();
  for (std::size_t i = 0; i < listed; ++i) {
    const bool is_last = i + 1 == listed && listed == defect.count;
    out << (i == 0 ? ", with " : is_last ? " and " : ", ") << holes[i].rim.size();
  }
  out << (listed < defect.count ? ", ... rim vertices" : " rim vertices");
}

void write_defect(std::ostream& out, const CheckReport& report, const Defect& defect,
                  int count_width, int name_width) {
  const DefectInfo& info = describe(defect.kind);
  const std::string indent(kSeverityWidth, ' ');
  out << std::left << std::setw(kSeverityWidth)
      << kSeverityNames[static_cast<std::size_t>(info.severity)];
  if (info.element == Element::none) {
    out << info.name;
  } else {
    out << std::right << std::setw(count_width) << defect.count << ' ' << std::left
        << std::setw(name_width) << in_number(defect.count, info.name);
    write_places(out, defect);
    if (defect.kind == DefectKind::hole) write_rims(out, defect, chosen(report.holes, {}));
  }
  out << '\n' << indent << info.meaning << '\n';
  if (!info.next_step.empty()) out << indent << "-> " << info.next_step << '\n';
}

}  // namespace

std::string format(const MeshStatistics& s) {
  std::ostringstream out = plain_stream();
  write_label(out, "vertices");
  out << s.vertices << '\n';
  write_label(out, "faces");
  out << s.faces << ", " << counted(s.triangles, "triangles") << '\n';
  write_label(out, "edges");
  out << s.edges << ", length " << s.min_edge_length << " to " << s.max_edge_length << ", mean "
      << s.mean_edge_length << '\n';
  write_label(out, "boundary");
  if (s.boundary_edges == 0) {
    out << "none\n";
  } else {
    out << counted(s.boundary_edges, "edges") << " in " << counted(s.boundary_loops, "loops")
        << '\n';
  }
  write_components(out, s.component_sizes);
  write_label(out, "Euler number");
  out << s.euler_characteristic;
  if (s.genus) out << ", genus " << *s.genus;
  out << '\n';
  write_label(out, "bounds");
  write_point(out, s.bounds.min);
  out << " to ";
  write_point(out, s.bounds.max);
  out << '\n';
  write_label(out, "area");
  out << s.area << '\n';
  return out.str();
}

std::string format(const CheckReport& report) {
  int count_width = 0;
  int name_width = 0;
  std::size_t problems = 0;
  std::size_t fixable = 0;
  for (const Defect& defect : report.defects) {
    const DefectInfo& info = describe(defect.kind);
    count_width = std::max(count_width, digits_of(defect.count));
    name_width = std::max(name_width, static_cast<int>(info.name.size()) + 2);
    if (info.severity != Severity::info) ++problems;
    if (info.fixable) ++fixable;
  }
  std::ostringstream out = plain_stream();
  for (const Defect& defect : report.defects) {
    write_defect(out, report, defect, count_width, name_width);
  }
  if (problems == 0) {
    out << "no defects\n";
  } else {
    out << counted(problems, "kinds") << " of defect, " << fixable << " repairable\n";
  }
  return out.str();
}

std::string format(const FixReport& report) {
  if (!report.changed()) return "nothing to repair\n";
  int width = 0;
  for (const Repair& repair : report.repairs) width = std::max(width, digits_of(repair.count));
  std::ostringstream out = plain_stream();
  for (const Repair& repair : report.repairs) {
    out << std::setw(width) << repair.count << ' '
        << in_number(repair.count, describe(repair.kind).text) << '\n';
  }
  return out.str();
}

}  // namespace lapwing
