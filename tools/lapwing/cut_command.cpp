#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/errors.h"
#include "lapwing/region/boundary_loops.h"
#include "lapwing/region/disk_report.h"
#include "lapwing/transplant/cut.h"
#include "loop_text.h"
#include "messages.h"
#include "output_files.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

struct CutArguments {
  std::string mesh;
  std::string region;
  std::string part;
  std::string rest;
  bool quiet = false;
};

VertexSet all_vertices(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<Index>(v);
  return all;
}

// Notes everything that prevents `lapwing transplant` from joining a piece without further options.
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
  const Topology& topology = piece.mesh.topology();
  note_obstacles(piece.mesh, path);
  if (quiet) return;
  std::printf("%s: %zu vertices, %zu faces\n", shown(path).c_str(), piece.mesh.vertex_count(),
              piece.mesh.face_count());
  std::vector<BoundaryLoop> loops;
  try {
    loops = boundary_loops(topology.triangles, path);
  } catch (const InputError&) {
    return;  // reported above
  }
  for (std::size_t k = 0; k < loops.size(); ++k) {
    std::printf("  loop %zu: %s\n", k, loop_text(loops[k], piece.mesh.positions).c_str());
  }
}

void cut(const CutArguments& a) {
  OutputFiles files;
  files.reads("MESH", a.mesh, true);
  files.writes_mesh("--output", a.part);
  files.writes_mesh("--rest", a.rest);
  const Mesh mesh = read_mesh(a.mesh);
  const VertexSet region = resolve(region_spec("--region", a.region), mesh);
  const CutPiece part = cut_out(mesh, region, "--region");
  // Both files are written, or neither.
  CutPiece rest;
  if (!a.rest.empty()) rest = cut_away(mesh, region, "--region");
  FileReplacements written;
  print_notes(write_mesh(part.mesh, a.part, written));
  if (!a.rest.empty()) print_notes(write_mesh(rest.mesh, a.rest, written));
  written.commit();
  describe_piece(part, a.part, a.quiet);
  if (!a.rest.empty()) describe_piece(rest, a.rest, a.quiet);
}

}  // namespace

void add_cut(CLI::App& app) {
  auto* command = app.add_subcommand(
      "cut", "cut a part out of a mesh, for transplanting: the polygons inside a region");
  auto a = std::make_shared<CutArguments>();
  command->add_option("MESH", a->mesh, "OBJ, OFF, PLY, STL or glTF")->required();
  command->add_option("--region", a->region, kRegionHelp)->required();
  command->add_option("-o,--output", a->part, "the part; its extension names the format")
      ->required();
  command->add_option("--rest", a->rest, "the rest of the mesh, around the hole");
  command->add_flag("--quiet", a->quiet, "print errors and notes only");
  command->callback([a] { cut(*a); });
}

}  // namespace lapwing::cli
