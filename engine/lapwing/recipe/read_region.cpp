#include "lapwing/recipe/read_region.h"

#include <array>

namespace lapwing {
namespace {

// A deeper nesting of unions and differences is a bug of the program that wrote the file.
constexpr int kDeepestNesting = 64;

RegionSpec read_nested(const JsonNode& node, int depth);

GeodesicDisk read_disk(const JsonNode& node) {
  node.require_keys({"center", "near", "radius"});
  GeodesicDisk disk;
  if (node.only_key_of({"center", "near"}, "a disk") == "center") {
    disk.center = node.at("center").vertex();
  } else {
    disk.center = node.at("near").vector3();
  }
  disk.radius = node.at("radius").positive_number();
  return disk;
}

Box read_box(const JsonNode& node) {
  node.require_keys({"min", "max"});
  const Box box{node.at("min").vector3(), node.at("max").vector3()};
  constexpr std::array kAxes{"x", "y", "z"};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (box.min[axis] > box.max[axis]) {
      node.fail("min is greater than max in " + std::string(kAxes[static_cast<std::size_t>(axis)]) +
                "; swap them");
    }
  }
  return box;
}

LoopRegion read_loop(const JsonNode& node) {
  LoopRegion region{node.at("loop").vertices(), node.at("inside").vertex()};
  if (region.loop.size() < 3) {
    node.at("loop").fail("expected at least 3 vertices, got " + std::to_string(region.loop.size()));
  }
  return region;
}

std::vector<RegionSpec> read_parts(const JsonNode& node, std::size_t least, int depth) {
  std::vector<RegionSpec> parts;
  for (const JsonNode& element : node.elements()) parts.push_back(read_nested(element, depth + 1));
  if (parts.size() < least) {
    node.fail("expected at least " + std::to_string(least) +
              (least == 1 ? " region, got " : " regions, got ") + std::to_string(parts.size()));
  }
  return parts;
}

AllVertices read_all(const JsonNode& node) {
  if (!node.boolean()) node.fail("expected true; use \"vertices\" to choose some vertices");
  return {};
}

RegionSpec read_nested(const JsonNode& node, int depth) {
  if (depth > kDeepestNesting) {
    node.fail("regions are nested more than " + std::to_string(kDeepestNesting) + " levels deep");
  }
  node.require_keys(
      {"all", "vertices", "disk", "box", "loop", "inside", "union", "minus", "disk_in"});
  const std::string_view form = node.only_key_of(
      {"all", "vertices", "disk", "box", "loop", "union", "minus", "disk_in"}, "a region");
  if (form != "loop" && node.has("inside")) {
    node.at("inside").fail("\"inside\" goes with \"loop\" only; remove it");
  }
  const JsonNode value = node.at(form);
  RegionSpec spec{AllVertices{}, node.where()};
  if (form == "all") spec.form = read_all(value);
  if (form == "vertices") spec.form = ListedVertices{value.vertices()};
  if (form == "disk") spec.form = read_disk(value);
  if (form == "box") spec.form = read_box(value);
  if (form == "loop") spec.form = read_loop(node);
  if (form == "union") spec.form = UnionRegion{read_parts(value, 1, depth)};
  if (form == "minus") spec.form = DifferenceRegion{read_parts(value, 2, depth)};
  if (form == "disk_in") spec.form = DiskInRegion{{read_nested(value, depth + 1)}};
  return spec;
}

}  // namespace

RegionSpec read_region(const JsonNode& node) {
  return read_nested(node, 1);
}

BeltSpec read_belt(const JsonNode& node) {
  if (!node.has("fraction")) return read_region(node);
  node.require_keys({"fraction"});
  const BoundaryAnchors belt{node.at("fraction").number(), node.where()};
  if (!(belt.fraction >= 0.0 && belt.fraction <= 1.0)) {
    node.at("fraction").fail_expecting("a number from 0 to 1");
  }
  return belt;
}

}  // namespace lapwing
