#include <array>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/counted.h"
#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/region/disk_report.h"
#include "lapwing/render/part_picture.h"
#include "lapwing/transplant/cut.h"
#include "lapwing/transplant/loop_curve.h"
#include "lapwing/transplant/part_library.h"
#include "messages.h"
#include "output_files.h"
#include "region_text.h"

// Adds the commands for the parts of transplants. `cut` writes a part, and `parts` manages a folder
// of parts.
namespace lapwing::cli {
namespace {

// Returns a description such as "63 vertices from vertex 12, 1.234 long".
std::string loop_text(const BoundaryLoop& loop, std::span<const Eigen::Vector3d> positions) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), " from vertex %zu, %.4g long", std::size_t{loop.front()},
                loop_length(loop, positions));
  return counted(loop.size(), "vertices") + text.data();
}

void print_loops(std::span<const BoundaryLoop> loops, const Positions& positions) {
  for (std::size_t k = 0; k < loops.size(); ++k) {
    std::printf("  loop %zu: %s\n", k, loop_text(loops[k], positions).c_str());
  }
}

struct CutArguments {
  std::string mesh;
  std::string region;
  std::string part;
  std::string rest;
  bool quiet = false;
};

VertexSet all_vertices(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

// Prints a note for each property of a piece that may prevent `lapwing transplant` from joining it.
void note_obstacles(const Mesh& mesh, const std::string& path) {
  const DiskReport report = report_disk(region_triangles(all_vertices(mesh), mesh.topology()));
  const auto note = [&](const std::string& text) { cli::note(path + " " + text); };
  if (report.pieces.size() > 1) {
    note("is in " + std::to_string(report.pieces.size()) + " pieces");
  }
  if (report.loops.empty()) note("has no boundary loop, so it cannot be joined to a mesh");
  if (report.loops.size() > 1) note("has several boundary loops; a part is joined at one of them");
  if (!report.pinched.empty()) note("touches itself at " + name_vertices(report.pinched));
  if (!report.non_manifold_edges.empty()) note("has edges with more than two triangles");
  if (!report.turned_edges.empty()) note("has edges whose triangles face opposite ways");
}

void describe_piece(const CutPiece& piece, const std::string& path, bool quiet) {
  note_obstacles(piece.mesh, path);
  if (quiet) return;
  std::printf("%s: %s, %s\n", shown(path).c_str(),
              counted(piece.mesh.vertex_count(), "vertices").c_str(),
              counted(piece.mesh.face_count(), "faces").c_str());
  try {
    print_loops(boundary_loops(piece.mesh.topology().triangles, path), piece.mesh.positions);
  } catch (const InputError&) {
    // `note_obstacles` has already reported the reason of this error.
  }
}

void cut(const CutArguments& a) {
  OutputFiles files;
  files.reads("MESH", a.mesh, true);
  files.writes_mesh("--output", a.part);
  files.writes_mesh("--rest", a.rest);
  const Mesh mesh = read_with_notes(a.mesh);
  const VertexSet region = resolve(region_spec("--region", a.region), mesh);
  const CutPiece part = cut_out(mesh, region, "--region");
  // Write either both files or none.
  CutPiece rest;
  if (!a.rest.empty()) rest = cut_away(mesh, region, "--region");
  FileReplacements written;
  print_notes(write_mesh(part.mesh, a.part, written));
  if (!a.rest.empty()) print_notes(write_mesh(rest.mesh, a.rest, written));
  written.commit();
  describe_piece(part, a.part, a.quiet);
  if (!a.rest.empty()) describe_piece(rest, a.rest, a.quiet);
}

struct PartsArguments {
  std::string folder;
  std::string mesh;
  std::string name;
  std::optional<std::size_t> loop;
  std::string picture;
  std::uint32_t side = 512;
  std::string device = "auto";
  bool no_pictures = false;
};

// Draws the images of parts. Opens the device when the first image is needed.
class Thumbnails {
 public:
  explicit Thumbnails(const PartsArguments& arguments)
      : device_(arguments.device), off_(arguments.no_pictures) {}

  void renew(const Part& part) {
    if (off_ || picture_is_current(part.mesh_path)) return;
    try {
      if (!picture_may_be_written(part.mesh_path)) {
        note(picture_path(part.mesh_path).string() +
             " was not made by Lapwing and is kept; the part has no picture");
        return;
      }
      if (!context_) context_ = std::make_shared<gpu::Context>(gpu::ContextOptions{device_});
      const Image image = part_picture(context_, part.mesh, part.loops[part.loop], kThumbnailSide);
      write_part_picture(part.mesh_path, image);
    } catch (const GpuError& error) {
      off_ = true;
      note(std::string("parts stay without pictures: ") + error.what());
    } catch (const IoError& error) {
      off_ = true;
      note(std::string("parts stay without pictures: ") + error.what());
    }
  }

 private:
  std::string device_;
  bool off_;
  std::shared_ptr<gpu::Context> context_;
};

void print(const Part& part) {
  std::printf("%s: %s, %s, loop %zu of %zu: %s\n", shown(part.name).c_str(),
              counted(part.mesh.vertex_count(), "vertices").c_str(),
              counted(part.mesh.face_count(), "faces").c_str(), part.loop, part.loops.size(),
              loop_text(part.loops[part.loop], part.mesh.positions).c_str());
}

void list(const PartsArguments& a) {
  Thumbnails thumbnails(a);
  for (const auto& file : part_files(a.folder)) {
    try {
      const Part part = read_part(file);
      print(part);
      thumbnails.renew(part);
    } catch (const InputError& error) {
      note("skipped " + file.string() + ": " + error.what());
    } catch (const IoError& error) {
      note("skipped " + file.string() + ": " + error.what());
    }
  }
}

void add(const PartsArguments& a) {
  const AddedPart added = add_part(a.folder, a.mesh, a.name, a.loop);
  print_notes(added.report);
  print(added.part);
  if (added.part.loops.size() > 1 && !a.loop) {
    note("the part has " + std::to_string(added.part.loops.size()) +
         " boundary loops and is joined at the longest; choose another with --loop");
  }
  Thumbnails(a).renew(added.part);
}

void show(const PartsArguments& a) {
  OutputFiles files;
  files.writes_picture("--output", a.picture);
  const Part part = find_part(a.folder, a.name);
  std::printf("%s\n", shown(part.mesh_path).c_str());
  print(part);
  print_loops(part.loops, part.mesh.positions);
  if (a.picture.empty()) return;
  const auto context = std::make_shared<gpu::Context>(gpu::ContextOptions{a.device});
  write_png(a.picture, part_picture(context, part.mesh, part.loops[part.loop], a.side));
}

CLI::App* subcommand(CLI::App& parts, PartsArguments& a, const std::string& name,
                     const std::string& help) {
  auto* command = parts.add_subcommand(name, help);
  command->add_option("DIR", a.folder, "the folder of parts")->required();
  command->add_option("--device", a.device, "auto, an index or a part of a name")
      ->capture_default_str();
  return command;
}

}  // namespace

void add_cut(CLI::App& app) {
  auto* command = app.add_subcommand(
      "cut", "cut a part out of a mesh, for transplanting: the polygons inside a region");
  auto a = std::make_shared<CutArguments>();
  command->add_option("MESH", a->mesh, kMeshHelp)->required();
  command->add_option("--region", a->region, kRegionHelp)->required();
  command->add_option("-o,--output", a->part, "the part; its extension names the format")
      ->required();
  command->add_option("--rest", a->rest, "the rest of the mesh, around the hole");
  command->add_flag("--quiet", a->quiet, "print errors and notes only");
  command->callback([a] { cut(*a); });
}

void add_parts(CLI::App& app) {
  auto* parts = app.add_subcommand("parts", "a folder of parts for transplanting, with pictures");
  parts->require_subcommand(1);
  auto a = std::make_shared<PartsArguments>();

  auto* list_command = subcommand(
      *parts, *a, "list", "the parts in a folder: meshes with a boundary loop; updates NAME.png");
  list_command->add_flag("--no-pictures", a->no_pictures, "do not draw pictures");
  list_command->callback([a] { list(*a); });

  auto* add_command = subcommand(*parts, *a, "add", "copy a mesh into the folder as a part");
  add_command->add_option("MESH", a->mesh, "OBJ, OFF, PLY, STL or glTF with a boundary loop")
      ->required();
  add_command->add_option("--name", a->name, "name of the part; by default that of the mesh file");
  add_command->add_option("--loop", a->loop,
                          "number of the boundary loop to join; by default the longest");
  add_command->add_flag("--no-pictures", a->no_pictures, "do not draw a picture");
  add_command->callback([a] { add(*a); });

  auto* show_command = subcommand(*parts, *a, "show", "one part, and a picture of it");
  show_command->add_option("NAME", a->name, "name of the part")->required();
  show_command->add_option("-o,--output", a->picture, "PNG");
  show_command->add_option("--size", a->side, "size of the picture, in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  show_command->callback([a] { show(*a); });
}

}  // namespace lapwing::cli
