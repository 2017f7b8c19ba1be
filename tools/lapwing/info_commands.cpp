#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/doctor/format.h"
#include "lapwing/fill/fill_holes.h"
#include "lapwing/gpu/devices.h"
#include "lapwing/io/source_file.h"
#include "lapwing/recipe/step.h"
#include "messages.h"
#include "output_files.h"

// Adds the commands that print information: info, check and keys.
namespace lapwing::cli {
namespace {

void print_devices() {
  std::printf("devices (for --device)\n");
  std::printf("  %-5s %s, %u threads, float64\n", "cpu", "the CPU, without Vulkan", thread_count());
  try {
    for (const gpu::DeviceDescription& d : gpu::list_devices()) {
      std::printf("  %-5zu %s, %s, Vulkan %s, %s%s\n", d.index, printable(d.name).c_str(),
                  d.type.c_str(), d.api_version.c_str(), printable(d.driver).c_str(),
                  d.float64 ? ", float64" : ", float32");
      if (!d.rejected.empty()) std::printf("        not usable: %s\n", d.rejected.c_str());
    }
  } catch (const GpuError& error) {
    std::printf("  no Vulkan device: %s\n", error.what());
  }
}

struct CheckArguments {
  std::string mesh;
  std::string fix;
  bool self_intersections = false;
  std::optional<FillShape> fill;
  FillRequest holes;
};

bool has_errors(const CheckReport& report) {
  return std::ranges::any_of(report.defects, [](const Defect& defect) {
    return describe(defect.kind).severity == Severity::error;
  });
}

CheckReport examine_and_print(const Mesh& mesh, bool with_self_intersections) {
  CheckReport report = check(mesh);
  if (with_self_intersections) add_self_intersections(mesh, report);
  std::fputs(format(report.statistics).c_str(), stdout);
  std::fputs(format(report).c_str(), stdout);
  return report;
}

// Fills the holes that the flags select. Returns a line for the list of repairs.
std::string filled(Mesh& mesh, const CheckArguments& a) {
  FillRequest request = a.holes;
  request.shape = *a.fill;
  FilledHoles result = fill_holes(mesh, request);
  for (const std::string& warning : result.warnings) warn(warning);
  for (const std::string& text : result.notes) note(text);
  if (result.holes == 0) return "no hole to fill\n";
  mesh = std::move(result.mesh);
  std::string lines = counted(result.holes, "holes") + " filled with " +
                      counted(result.faces, "triangles") + " and " +
                      counted(result.vertices, "new vertices") + "\n";
  // A part that is closed now can be inside out.
  const FixReport repairs = fix(mesh);
  return repairs.changed() ? lines + format(repairs) : lines;
}

// Repairs the mesh and writes it. If the format stays the same, so does the encoding (text or
// binary).
void write_repaired(DamagedMesh& damaged, const CheckArguments& a) {
  const std::string& path = a.fix;
  WriteOptions options{.original_file = damaged.file};
  const bool keeps_format = format_of(path) == damaged.file->format();
  if (keeps_format && !is_gltf(format_of(path))) options.encoding = damaged.file->encoding;
  const FixReport repairs = fix(damaged.mesh);
  std::string lines = format_repairs(damaged.defects);
  if (repairs.changed() || (lines.empty() && !a.fill)) lines += format(repairs);
  if (a.fill) lines += filled(damaged.mesh, a);
  std::printf("\nRepairs\n%s", lines.c_str());
  print_notes(write_mesh(damaged.mesh, path, options));
  std::printf("\nAfter the repairs: %s\n", shown(path).c_str());
}

void check_mesh(const CheckArguments& a) {
  OutputFiles files;
  files.reads("MESH", a.mesh, true);
  files.writes_mesh("--fix", a.fix);
  DamagedMesh damaged = read_damaged_mesh(a.mesh);
  for (const std::string& line : damaged.file->notes) note(line);
  if (!damaged.defects.empty()) {
    std::printf("%s\nWhat can be read\n", format(damaged.defects).c_str());
  }
  CheckReport report = examine_and_print(damaged.mesh, a.self_intersections);
  if (!a.fix.empty()) {
    write_repaired(damaged, a);
    report = examine_and_print(damaged.mesh, a.self_intersections);
  }
  const bool is_refused = a.fix.empty() && !damaged.defects.empty();
  if (is_refused || has_errors(report)) throw ExitWith{kInput};
}

}  // namespace

void add_info(CLI::App& app) {
  auto* command = app.add_subcommand("info", "the devices that can run an edit, and a mesh's size");
  auto mesh = std::make_shared<std::string>();
  command->add_option("MESH", *mesh, kMeshHelp);
  command->callback([mesh] {
    std::printf("lapwing %s\n", LAPWING_VERSION);
    print_devices();
    if (mesh->empty()) return;
    const Mesh loaded = read_with_notes(*mesh);
    std::printf("%s\n%s", shown(*mesh).c_str(), format(check(loaded).statistics).c_str());
  });
}

void add_check(CLI::App& app) {
  auto* command = app.add_subcommand(
      "check", "the mesh doctor: the defects of a mesh, and what they mean for editing it");
  auto a = std::make_shared<CheckArguments>();
  command->add_option("MESH", a->mesh, kMeshHelp)->required();
  auto* fix =
      command->add_option("--fix", a->fix, "repair what can be repaired, and write the mesh here");
  const std::map<std::string, FillShape> shapes{{"flat", FillShape::flat},
                                                {"smooth", FillShape::smooth}};
  auto* fill = command
                   ->add_option("--fill-holes", a->fill,
                                "with --fix: fill holes with flat triangles (flat), or continue "
                                "the surrounding surface (smooth)")
                   ->transform(CLI::CheckedTransformer(shapes).description("flat|smooth"))
                   ->needs(fix);
  command
      ->add_option("--largest", a->holes.largest,
                   "fill only holes with at most this number of rim vertices")
      ->check(CLI::PositiveNumber)
      ->needs(fill);
  command
      ->add_flag(
          "--fill-borders", a->holes.borders,
          "also fill the border of an open sheet: the longest loop of a part that is flatter "
          "than a hemisphere")
      ->needs(fill);
  command->add_flag("--self-intersections", a->self_intersections,
                    "also find faces that intersect others");
  command->footer("Exits with 3 if the mesh has defects that prevent editing there.");
  command->callback([a] { check_mesh(*a); });
}

void add_keys(CLI::App& app) {
  auto* command = app.add_subcommand("keys", "the keys of a recipe's step, with their defaults");
  auto wanted = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const Operation& operation : operations()) names.emplace_back(operation.name);
  command->add_option("OPERATION", *wanted, "the step; by default all of them")
      ->check(CLI::IsMember(names));
  command->callback([wanted] {
    bool first = true;
    for (const Operation& operation : operations()) {
      if (!wanted->empty() && *wanted != operation.name) continue;
      if (!first) std::printf("\n");
      first = false;
      const std::string title = std::string(operation.name) + ": " + std::string(operation.help);
      std::printf("%s\n\n%s", title.c_str(), key_table(operation).c_str());
    }
  });
}

}  // namespace lapwing::cli
