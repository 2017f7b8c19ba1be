#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "exit_code.h"
#include "lapwing/doctor/format.h"
#include "lapwing/io/mesh_file.h"
#include "messages.h"
#include "output_files.h"

namespace lapwing::cli {
namespace {

struct CheckArguments {
  std::string mesh;
  std::string fix;
  bool self_intersections = false;
};

bool has_errors(const CheckReport& report) {
  for (const Defect& defect : report.defects) {
    if (describe(defect.kind).severity == Severity::error) return true;
  }
  return false;
}

CheckReport examine_and_print(const Mesh& mesh, bool with_self_intersections) {
  CheckReport report = check(mesh);
  if (with_self_intersections) add_self_intersections(mesh, report);
  std::fputs(format(report.statistics).c_str(), stdout);
  std::fputs(format(report).c_str(), stdout);
  return report;
}

void check_mesh(const CheckArguments& arguments) {
  OutputFiles files;
  files.reads("MESH", arguments.mesh, true);
  files.writes_mesh("--fix", arguments.fix);
  Mesh mesh = read_mesh(arguments.mesh);
  CheckReport report = examine_and_print(mesh, arguments.self_intersections);
  if (!arguments.fix.empty()) {
    const FixReport repairs = fix(mesh);
    std::printf("\nRepairs\n%s", format(repairs).c_str());
    print_notes(write_mesh(mesh, arguments.fix));
    std::printf("\nAfter the repairs: %s\n", shown(arguments.fix).c_str());
    report = examine_and_print(mesh, arguments.self_intersections);
  }
  if (has_errors(report)) throw ExitWith{kInput};
}

}  // namespace

void add_check(CLI::App& app) {
  auto* command = app.add_subcommand(
      "check", "the mesh doctor: the defects of a mesh, and what they mean for editing it");
  auto arguments = std::make_shared<CheckArguments>();
  command->add_option("MESH", arguments->mesh, "OBJ, OFF, PLY, STL or glTF")->required();
  command->add_option("--fix", arguments->fix,
                      "repair what can be repaired, and write the mesh here");
  command->add_flag("--self-intersections", arguments->self_intersections,
                    "also find faces that intersect others");
  command->footer("Exits with 3 if the mesh has defects that prevent editing there.");
  command->callback([arguments] { check_mesh(*arguments); });
}

}  // namespace lapwing::cli
