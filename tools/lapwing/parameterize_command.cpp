#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "domain_picture.h"
#include "lapwing/base/errors.h"
#include "lapwing/parameterize/stretch.h"
#include "lapwing/parameterize/uv_mesh.h"
#include "mesh_output.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

struct ParameterizeArguments {
  std::string mesh;
  std::string region = "all";
  std::string domain = "disk";
  std::vector<Index> pins;
  std::string output;
  std::string picture;
  std::uint32_t size = 1024;
};

// A patch and where it lies.
struct LaidOut {
  Patch patch;
  std::vector<Eigen::Vector3d> positions;
  BoundaryPins pins;
  DomainMap map;
  std::vector<Index> flipped;
};

BoundaryPins own_pins(const std::vector<Index>& vertices, const Patch& patch) {
  BoundaryPins pins;
  for (const Index v : vertices) {
    pins.push_back(patch.own_number(v));
    if (pins.back() == kNoIndex) {
      throw InputError("--pin: vertex " + std::to_string(v) +
                       " is not in the patch; name one on its boundary, such as vertex " +
                       std::to_string(patch.vertices[patch.loop.front()]));
    }
  }
  return pins;
}

LaidOut lay_out(const ParameterizeArguments& arguments, const Mesh& mesh,
                const Topology& topology) {
  const RegionSpec region = region_spec("--region", arguments.region);
  const Domain domain = arguments.domain == "disk" ? Domain::disk : Domain::square;
  LaidOut result;
  result.patch =
      disk_patch(resolve(region, mesh, topology), topology, mesh.positions, region.where);
  const Patch& patch = result.patch;
  result.positions = on_patch(patch, std::span<const Eigen::Vector3d>(mesh.positions));
  result.pins = arguments.pins.empty() ? default_pins(patch, result.positions, domain)
                                       : own_pins(arguments.pins, patch);
  result.map = mean_value_map(patch, result.positions, domain, result.pins);
  result.flipped = flipped_triangles(patch.triangles, result.map.points);
  return result;
}

// Texture coordinates fill the unit square.
std::vector<Eigen::Vector2d> uvs_of(const DomainMap& map) {
  std::vector<Eigen::Vector2d> uvs = map.points;
  if (map.domain == Domain::square) return uvs;
  for (Eigen::Vector2d& uv : uvs) uv = 0.5 * (uv + Eigen::Vector2d(1, 1));
  return uvs;
}

void print(const LaidOut& result) {
  const Patch& patch = result.patch;
  std::string pins;
  for (const Index pin : result.pins) pins += " " + std::to_string(patch.vertices[pin]);
  std::printf("patch    %zu vertices, %zu triangles, %zu on the boundary\n", patch.size(),
              patch.triangles.size(), patch.loop.size());
  if (!patch.midpoint_of.empty()) {
    std::printf("halved   %zu edges that join boundary vertices through the inside\n",
                patch.midpoint_of.size());
  }
  std::printf("pins    %s\n", pins.c_str());
  std::printf("flipped  %zu triangles\n", result.flipped.size());
  const MapDistortion distortion =
      measure_distortion(patch.triangles, result.positions, result.map.points);
  std::printf("stretch  %.4g overall, %.4g at most (1 keeps lengths)\n", distortion.stretch,
              distortion.largest_stretch);
  std::printf("shear    %.4g on average, %.4g at most (1 keeps angles)\n", distortion.shear,
              distortion.largest_shear);
}

void warn(const LaidOut& result) {
  if (result.flipped.empty()) return;
  const Index triangle = result.patch.triangle_sources[result.flipped.front()];
  std::fprintf(stderr,
               "note: triangles are flipped where the map shrinks them below rounding, the first "
               "one in triangle %u; choose a region with a longer boundary, or another domain\n",
               triangle);
}

void parameterize(const ParameterizeArguments& arguments) {
  const Mesh mesh = read_mesh(arguments.mesh);
  const Topology topology = build_topology(mesh);
  const LaidOut result = lay_out(arguments, mesh, topology);
  print(result);
  warn(result);
  if (!arguments.output.empty()) {
    print_notes(
        write_mesh(with_uvs(mesh, topology, result.patch, uvs_of(result.map)), arguments.output));
  }
  if (!arguments.picture.empty()) {
    DomainLayer layer;
    layer.triangles = result.patch.triangles;
    layer.points = result.map.points;
    layer.loop = result.patch.loop;
    layer.pins = result.pins;
    layer.flipped = result.flipped;
    write_png(arguments.picture,
              draw_domain(result.map.domain, std::span(&layer, 1), arguments.size));
  }
}

}  // namespace

void add_parameterize(CLI::App& app) {
  auto* command = app.add_subcommand(
      "parameterize", "lays a region that is a disk into the plane, by mean value coordinates");
  auto arguments = std::make_shared<ParameterizeArguments>();
  command->add_option("MESH", arguments->mesh, "OBJ, OFF, PLY or STL")->required();
  command->add_option("--region", arguments->region, kRegionHelp)->capture_default_str();
  command->add_option("--domain", arguments->domain, "what its boundary is laid along")
      ->check(CLI::IsMember({"disk", "square"}))
      ->capture_default_str();
  command
      ->add_option("--pin", arguments->pins,
                   "boundary vertex for the disk's rightmost point; four for the square's "
                   "corners, counterclockwise from the lower left")
      ->delimiter(',');
  command->add_option("-o,--output", arguments->output,
                      "the mesh with the patch's places as texture coordinates");
  command->add_option("--picture", arguments->picture, "PNG of the triangles in the plane");
  command->add_option("--size", arguments->size, "of the picture, in pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command->callback([arguments] { parameterize(*arguments); });
}

}  // namespace lapwing::cli
