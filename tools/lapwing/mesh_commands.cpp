#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide_mesh.h"
#include "lapwing/remesh/remesh.h"
#include "messages.h"
#include "output_files.h"
#include "progress_display.h"
#include "region_text.h"

// Adds the commands that write a whole mesh: shape, convert, subdivide and remesh.
namespace lapwing::cli {
namespace {

std::map<std::string, Mesh (*)()> shapes_by_name() {
  std::map<std::string, Mesh (*)()> shapes;
  for (const NamedShape& shape : named_shapes()) shapes.emplace(shape.name, shape.make);
  return shapes;
}

struct ConvertArguments {
  std::string from;
  std::string to;
  bool ascii = false;
  bool binary = false;
  double feature_angle_degrees = kFeatureAngleDegrees;
};

void convert(const ConvertArguments& a) {
  OutputFiles files;
  files.reads("FROM", a.from, true);
  files.writes_mesh("TO", a.to);
  WriteOptions options{.feature_angle_degrees = a.feature_angle_degrees};
  if (a.ascii) options.encoding = Encoding::ascii;
  if (a.binary) options.encoding = Encoding::little_endian;
  const Mesh mesh = read_with_notes(a.from);
  if (mesh.face_count() == 0) warn_without_surface(mesh, a.from);
  print_notes(write_mesh(mesh, a.to, options));
}

struct SubdivideArguments {
  std::string mesh;
  std::string output;
  SubdivideRequest request;
};

void subdivide_mesh(const SubdivideArguments& a) {
  OutputFiles files;
  files.reads("MESH", a.mesh, true);
  files.writes_mesh("--output", a.output);
  const Mesh mesh = read_with_notes(a.mesh);
  warn_without_surface(mesh, a.mesh);
  print_notes(write_mesh(subdivide(mesh, a.request), a.output));
}

struct RemeshArguments {
  std::string mesh;
  std::string output;
  std::string region = "all";
  RemeshRequest request;
  bool quiet = false;
};

void print_result(const RegionQuality& before, const RegionQuality& after) {
  std::printf("vertices %zu, were %zu\nfaces %zu, were %zu\n", after.vertices, before.vertices,
              after.faces, before.faces);
  std::printf("mean edge %.4g, was %.4g\nsmallest angle %.1f degrees, was %.1f\n", after.mean_edge,
              before.mean_edge, after.smallest_angle_degrees, before.smallest_angle_degrees);
}

void remesh_mesh(const RemeshArguments& a) {
  OutputFiles files;
  files.reads("MESH", a.mesh, true);
  files.writes_mesh("--output", a.output);
  const Mesh mesh = read_with_notes(a.mesh);
  RemeshRequest request = a.request;
  request.region = region_spec("--region", a.region);
  request.where = "--scale";
  Remeshed result;
  {
    ProgressDisplay display(a.quiet);
    result = remesh(mesh, request, display.callback());
  }
  print_notes(write_mesh(result.mesh, a.output, {.anew = true, .original_file = mesh.source}));
  for (const std::string& warning : result.warnings) warn(warning);
  if (!a.quiet) print_result(result.before, result.after);
}

}  // namespace

void add_shape(CLI::App& app) {
  auto* command = app.add_subcommand("shape", "write a generated mesh, to try things on");
  auto shape = std::make_shared<std::string>();
  auto path = std::make_shared<std::string>();
  command->add_option("SHAPE", *shape, "name of the shape")
      ->required()
      ->check(CLI::IsMember(shapes_by_name()));
  command->add_option("-o,--output", *path, kMeshHelp)->required();
  command->callback([shape, path] { write_mesh(shapes_by_name().at(*shape)(), *path); });
}

void add_convert(CLI::App& app) {
  auto* command = app.add_subcommand(
      "convert", "convert a mesh to another format; reports what that cannot store");
  auto a = std::make_shared<ConvertArguments>();
  command->add_option("FROM", a->from, kMeshHelp)->required();
  command->add_option("TO", a->to, "its extension names the format")->required();
  auto* ascii = command->add_flag("--ascii", a->ascii, "PLY and STL as text");
  command->add_flag("--binary", a->binary, "PLY and STL as binary, the default")->excludes(ascii);
  command
      ->add_option("--feature-angle", a->feature_angle_degrees,
                   "edges whose faces meet at more than this angle look hard, in degrees; for glTF "
                   "from a file without normals")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str();
  command->callback([a] { convert(*a); });
}

void add_subdivide(CLI::App& app) {
  auto* command = app.add_subcommand("subdivide", "a finer mesh: every triangle becomes four");
  auto a = std::make_shared<SubdivideArguments>();
  command->add_option("MESH", a->mesh, kMeshHelp)->required();
  command
      ->add_option("-o,--output", a->output, "its extension names the format; normals are dropped")
      ->required();
  command->add_option("--times", a->request.times, "number of subdivisions")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command->add_flag("--smooth", a->request.smooth,
                    "smooth the shape by Loop's scheme; by default the shape stays the same");
  command->callback([a] { subdivide_mesh(*a); });
}

void add_remesh(CLI::App& app) {
  auto* command =
      app.add_subcommand("remesh", "nearly equilateral triangles of one size, on the same surface");
  auto a = std::make_shared<RemeshArguments>();
  command->add_option("MESH", a->mesh, kMeshHelp)->required();
  command->add_option("-o,--output", a->output, "its extension names the format")->required();
  command->add_option("--region", a->region, kRegionHelp)->capture_default_str();
  auto* length = command->add_option("--length", a->request.length, "target edge length")
                     ->check(CLI::PositiveNumber);
  command
      ->add_option("--scale", a->request.scale, "target edge length, in mean edges of the region")
      ->check(CLI::PositiveNumber)
      ->excludes(length)
      ->capture_default_str();
  command->add_option("--iterations", a->request.options.iterations, "number of remeshing rounds")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--feature-angle", a->request.options.feature_angle_degrees,
                   "keep edges whose faces meet at this angle or more, in degrees")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str();
  command->add_flag("--quiet", a->quiet, "print errors and notes only");
  command->callback([a] { remesh_mesh(*a); });
}

}  // namespace lapwing::cli
