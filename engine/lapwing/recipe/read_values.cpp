#include "lapwing/recipe/read_values.h"

#include <algorithm>
#include <array>

namespace lapwing {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

// Deeper nesting of unions and differences indicates a bug in the program that wrote the file.
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

AxisRotation read_rotation(const JsonNode& node) {
  node.require_keys({"axis", "degrees"});
  const AxisRotation rotation{node.at("axis").vector3(), node.at("degrees").number()};
  if (!(rotation.axis.norm() > 0.0)) node.at("axis").fail("the axis is zero; give a direction");
  return rotation;
}

MatrixMove read_matrix(const JsonNode& node) {
  const std::vector<double> values = node.numbers();
  if (values.size() != 12 && values.size() != 16) {
    node.fail("expected 12 or 16 numbers, row by row, got " + std::to_string(values.size()));
  }
  RowMajor4 matrix = RowMajor4::Identity();
  std::copy(values.begin(), values.end(), matrix.data());
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    node.fail("expected the last row 0 0 0 1: a handle's motion is affine");
  }
  return {matrix.topRows<3>()};
}

DomainRamp read_domain_ramp(const JsonNode& node) {
  const std::vector<double> ends = node.numbers();
  if (ends.size() != 2) {
    node.fail("expected two numbers, the start and the end of the ramp, got " +
              std::to_string(ends.size()));
  }
  if (ends[0] == ends[1]) node.fail("the ramp has no extent; give two different numbers");
  return {ends[0], ends[1]};
}

// Reads numbers from 0 to 1. `what` names them in error messages.
std::vector<double> read_field(const JsonNode& node, const std::string& what) {
  std::vector<double> field;
  for (const JsonNode& element : node.elements()) {
    const double w = element.number();
    if (!(w >= 0.0 && w <= 1.0)) element.fail("expected a number from 0 to 1, " + what);
    field.push_back(w);
  }
  return field;
}

Transition read_transition(const JsonNode& node) {
  node.require_keys({"width", "profile"});
  Transition falloff{node.at("width").positive_number()};
  if (const auto profile = node.find("profile")) {
    constexpr std::array kProfiles{Transition::Profile::smooth, Transition::Profile::linear};
    falloff.profile = kProfiles[profile->one_of("profile", {"smooth", "linear"})];
  }
  return falloff;
}

Falloff read_falloff(const JsonNode& handle) {
  Falloff falloff;
  if (const auto transition = handle.find("falloff")) {
    falloff.transition = read_transition(*transition);
  }
  if (const auto weight = handle.find("weight")) {
    if (!weight->is_object()) {
      const std::optional<double> number = weight->if_number();
      if (!number || !is_weight(*number)) weight->fail_expecting(std::string(kWeightWords));
      falloff.weight = *number;
      return falloff;
    }
    if (falloff.transition) {
      weight->fail("a painted weight and \"falloff\" exclude each other; remove one of the two");
    }
    weight->require_keys({"field"});
    falloff.field = read_field(weight->at("field"), "the handle weight of the vertex");
  }
  return falloff;
}

double read_factor(const JsonNode& node) {
  if (node.is_string()) {
    node.one_of("factor", {"rigid"});
    return kRigidStiffness;
  }
  const std::optional<double> factor = node.if_number();
  if (!factor || !is_stiffness(*factor)) node.fail_expecting(std::string(kStiffnessWords));
  return *factor;
}

LoopFit read_fit(const JsonNode& node) {
  node.require_keys({"rotate_degrees", "scale", "keep_size"});
  LoopFit fit;
  if (const auto degrees = node.find("rotate_degrees")) fit.rotate_degrees = degrees->number();
  if (const auto scale = node.find("scale")) fit.scale = scale->positive_number();
  if (const auto keep = node.find("keep_size")) fit.keep_size = keep->boolean();
  return fit;
}

// Reads one number for all axes or one number per axis.
Eigen::Vector3d read_scale(const JsonNode& node) {
  if (node.if_number()) return Eigen::Vector3d::Constant(node.positive_number());
  const Eigen::Vector3d scale = node.vector3();
  for (std::size_t axis = 0; axis < 3; ++axis) node.elements()[axis].positive_number();
  return scale;
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

Move read_move(const JsonNode& node) {
  node.require_keys({"translate", "rotate", "scale", "pivot", "matrix"});
  if (const auto matrix = node.find("matrix")) {
    for (const std::string_view other : {"translate", "rotate", "scale", "pivot"}) {
      if (!node.has(other)) continue;
      node.at(other).fail("\"matrix\" and \"" + std::string(other) +
                          "\" exclude each other; remove one of the two");
    }
    return read_matrix(*matrix);
  }
  SimilarityMove move;
  if (const auto translate = node.find("translate")) move.translate = translate->vector3();
  if (const auto rotate = node.find("rotate")) move.rotate = read_rotation(*rotate);
  if (const auto scale = node.find("scale")) move.scale = read_scale(*scale);
  if (const auto pivot = node.find("pivot")) move.pivot = pivot->vector3();
  return move;
}

MovedHandle read_handle(const JsonNode& node, HandleForm form) {
  MovedHandle handle;
  if (form == HandleForm::graded) {
    node.require_keys({"region", "move", "falloff", "weight", "orientation", "path"});
    handle.falloff = read_falloff(node);
    if (const auto orientation = node.find("orientation")) {
      constexpr std::array kOrientations{HandleOrientation::kept, HandleOrientation::free};
      handle.orientation = kOrientations[orientation->one_of("orientation", {"kept", "free"})];
    }
    if (const auto path = node.find("path")) {
      for (const JsonNode& move : path->elements()) handle.path.push_back(read_move(move));
    }
  } else {
    node.require_keys({"region", "move"});
  }
  handle.region = read_region(node.at("region"));
  handle.move = read_move(node.at("move"));
  return handle;
}

TargetSpec read_targets(const JsonNode& node) {
  TargetSpec targets;
  targets.where = node.where();
  const auto add_rows = [&](const JsonNode& rows) {
    for (const JsonNode& row : rows.elements()) {
      targets.rows.push_back(target_row(row.numbers(), row.where()));
    }
  };
  if (!node.is_object()) {
    add_rows(node);
    return targets;
  }
  node.require_keys({"rows", "file", "hard"});
  const std::string_view form = node.only_key_of({"rows", "file"}, "targets");
  if (form == "rows") {
    add_rows(node.at("rows"));
  } else {
    targets.file = node.at("file").file_name();
  }
  if (const auto hard = node.find("hard")) targets.hard = hard->boolean();
  return targets;
}

LandmarkSpec read_landmarks(const JsonNode& node) {
  LandmarkSpec landmarks{.where = node.where()};
  if (node.is_string()) {
    landmarks.file = node.file_name();
  } else if (node.is_object()) {
    node.require_keys({"template", "scan"});
    landmarks.file = node.at("template").file_name();
    landmarks.scan_file = node.at("scan").file_name();
  } else {
    for (const JsonNode& row : node.elements()) landmarks.rows.push_back(read_landmark(row));
  }
  return landmarks;
}

StiffnessSpec read_stiffness(const JsonNode& node) {
  node.require_keys({"region", "factor"});
  StiffnessSpec spec{read_region(node.at("region"))};
  const JsonNode factor = node.at("factor");
  if (!factor.is_object()) {
    spec.factor = read_factor(factor);
    return spec;
  }
  factor.require_keys({"field"});
  for (const JsonNode& element : factor.at("field").elements()) {
    spec.field.push_back(read_factor(element));
  }
  return spec;
}

MirrorSpec read_mirror(const JsonNode& node) {
  MirrorSpec mirror{AutomaticMirror{}, node.where()};
  if (node.is_string()) {
    node.one_of("mirror", {"auto"});
    return mirror;
  }
  node.require_keys({"plane", "point", "normal"});
  MirrorPlane plane;
  if (const auto axis = node.find("plane")) {
    if (node.has("point") || node.has("normal")) {
      axis->fail("\"plane\" names a coordinate plane; remove \"point\" and \"normal\"");
    }
    plane.normal =
        Eigen::Vector3d::Unit(static_cast<Eigen::Index>(axis->one_of("plane", {"x", "y", "z"})));
  } else {
    plane = {node.at("point").vector3(), node.at("normal").vector3()};
    if (!(plane.normal.norm() > 0.0)) {
      node.at("normal").fail("the normal is zero; give a direction");
    }
  }
  mirror.plane = plane;
  return mirror;
}

CarrySpec read_carry(const JsonNode& node) {
  if (node.is_string()) return {node.file_name()};
  node.require_keys({"file", "save"});
  CarrySpec carry{node.at("file").file_name()};
  if (const auto save = node.find("save")) carry.save = save->file_name();
  return carry;
}

std::vector<VertexPair> read_pairs(const JsonNode& node) {
  std::vector<VertexPair> pairs;
  for (const JsonNode& element : node.elements()) {
    const std::vector<Index> vertices = element.vertices();
    if (vertices.size() != 2) {
      element.fail("expected two vertices, one of the source and one of the target, got " +
                   std::to_string(vertices.size()));
    }
    pairs.push_back({vertices[0], vertices[1]});
  }
  return pairs;
}

MixWeight read_weight(const JsonNode& node) {
  node.require_keys({"domain_v", "distance_to", "width", "field"});
  const std::string_view form = node.only_key_of({"domain_v", "distance_to", "field"}, "a weight");
  if (form == "distance_to") {
    return {DistanceRamp{read_region(node.at(form)), node.at("width").number_from_zero()}};
  }
  if (const auto width = node.find("width")) {
    width->fail("\"width\" goes with \"distance_to\" only; remove it");
  }
  if (form == "domain_v") return {read_domain_ramp(node.at(form))};
  return {PaintedWeight{read_field(node.at(form), "the second source's share")}};
}

PartPlace read_place(const JsonNode& node) {
  if (!node.is_object() || !node.has("auto")) return read_move(node);
  node.require_keys({"auto"});
  return read_fit(node.at("auto"));
}

}  // namespace lapwing
