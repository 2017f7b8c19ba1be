#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "domain_picture.h"
#include "lapwing/base/counted.h"
#include "lapwing/parameterize/parameterize.h"
#include "messages.h"
#include "output_files.h"
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

ParameterizeRequest request_of(const ParameterizeArguments& arguments) {
  ParameterizeRequest request;
  request.region = region_spec("--region", arguments.region);
  request.domain = arguments.domain == "disk" ? Domain::disk : Domain::square;
  request.pins = arguments.pins;
  request.where = "--pin";
  return request;
}

void print(const Parameterized& result) {
  const Patch& patch = result.patch;
  std::string pins;
  for (const Index pin : result.pins) pins += " " + std::to_string(patch.vertices[pin]);
  std::printf("patch    %s, %s, %zu on the boundary\n", counted(patch.size(), "vertices").c_str(),
              counted(patch.triangles.size(), "triangles").c_str(), patch.loop.size());
  if (!patch.midpoint_of.empty()) {
    std::printf("halved   %s between two boundary vertices\n",
                counted(patch.midpoint_of.size(), "inner edges").c_str());
  }
  std::printf("pins    %s\n", pins.c_str());
  std::printf("flipped  %s\n", counted(result.flipped.size(), "triangles").c_str());
  const MapDistortion& distortion = result.distortion;
  std::printf("stretch  %.4g overall, %.4g at most (1 keeps lengths)\n", distortion.stretch,
              distortion.largest_stretch);
  std::printf("shear    %.4g on average, %.4g at most (1 keeps angles)\n", distortion.shear,
              distortion.largest_shear);
  for (const std::string& warning : result.warnings) warn(warning);
}

void parameterize_mesh(const ParameterizeArguments& arguments) {
  OutputFiles files;
  files.reads("MESH", arguments.mesh, true);
  files.writes_mesh("--output", arguments.output);
  files.writes_picture("--picture", arguments.picture);
  const Mesh mesh = read_with_notes(arguments.mesh);
  const Parameterized result = parameterize(mesh, request_of(arguments));
  print(result);
  FileReplacements written;
  if (!arguments.output.empty()) print_notes(write_mesh(result.mesh, arguments.output, written));
  if (!arguments.picture.empty()) {
    written.add(arguments.picture, encode_png(draw_domain(result, arguments.size)));
  }
  written.commit();
}

}  // namespace

void add_parameterize(CLI::App& app) {
  auto* command = app.add_subcommand(
      "parameterize", "map a region that is a disk to the plane by mean value coordinates");
  auto arguments = std::make_shared<ParameterizeArguments>();
  command->add_option("MESH", arguments->mesh, kMeshHelp)->required();
  command->add_option("--region", arguments->region, kRegionHelp)->capture_default_str();
  command->add_option("--domain", arguments->domain, "the shape that its boundary is mapped to")
      ->check(CLI::IsMember({"disk", "square"}))
      ->capture_default_str();
  command
      ->add_option("--pin", arguments->pins,
                   "boundary vertex for the disk's rightmost point; four for the square's "
                   "corners, counterclockwise from the lower left")
      ->delimiter(',');
  command->add_option("-o,--output", arguments->output,
                      "the mesh with the map as texture coordinates");
  command->add_option("--picture", arguments->picture, "PNG of the triangles in the plane");
  command->add_option("--size", arguments->size, "size of the picture, in pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command->callback([arguments] { parameterize_mesh(*arguments); });
}

}  // namespace lapwing::cli
