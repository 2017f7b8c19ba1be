#include "lapwing/recipe/read_step.h"

#include <array>
#include <cmath>

#include "lapwing/deform/turn_tracker.h"
#include "lapwing/recipe/read_coat.h"
#include "lapwing/recipe/read_mix.h"
#include "lapwing/recipe/read_region.h"
#include "lapwing/recipe/read_transplant.h"
#include "lapwing/recipe/suggest.h"

namespace lapwing {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

AxisRotation read_rotation(const JsonNode& node) {
  node.require_keys({"axis", "degrees"});
  const AxisRotation rotation{node.at("axis").vector3(), node.at("degrees").number()};
  if (!(rotation.axis.norm() > 0.0))
    node.at("axis").fail("the axis has no length; name a direction");
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

// true, false, or an object of options.
std::optional<SettleOptions> read_settle(const JsonNode& node) {
  SettleOptions options;
  if (!node.is_object()) return node.boolean() ? std::optional(options) : std::nullopt;
  node.require_keys({"tolerance", "max_iterations"});
  if (const auto tolerance = node.find("tolerance"))
    options.tolerance = tolerance->positive_number();
  if (const auto iterations = node.find("max_iterations")) {
    constexpr int kMost = 1'000'000;
    const double count = iterations->positive_number();
    if (count != std::floor(count) || count > kMost) {
      iterations->fail("expected a whole number from 1 to " + std::to_string(kMost));
    }
    options.max_iterations = static_cast<int>(count);
  }
  return options;
}

double read_commit_every(const JsonNode& node) {
  const double degrees = node.positive_number();
  if (degrees > kLargestSettledTurnDegrees) {
    node.fail("expected at most 180 degrees: past half a turn the other way round is shorter");
  }
  return degrees;
}

// Between a handle and its mirror image there is no motion that a part could be.
void refuse_mirror(const JsonNode& node) {
  if (!mirrors(read_move(node))) return;
  node.at("matrix").fail(
      "a matrix that mirrors cannot be carried out in parts; leave out \"commit_every\"");
}

DeformParameters read_deform_parameters(const JsonNode& step) {
  DeformParameters parameters;
  if (const auto weights = step.find("weights")) parameters.weights = read_weights(*weights);
  if (const auto weight = step.find("constraint_weight")) {
    parameters.constraint_weight = weight->positive_number();
  }
  if (const auto hard = step.find("hard")) parameters.hard = hard->boolean();
  if (const auto length = step.find("detail_length")) {
    parameters.detail_length = length->positive_number();
  }
  if (const auto response = step.find("response")) {
    parameters.response = response->one_of("response", {"tangent", "rsi"}) == 0
                              ? LinearResponse::tangent
                              : LinearResponse::rsi;
  }
  if (const auto settle = step.find("settle")) parameters.settle = read_settle(*settle);
  if (const auto degrees = step.find("commit_every")) {
    parameters.commit_every = read_commit_every(*degrees);
  }
  return parameters;
}

Step read_deform(const JsonNode& node) {
  node.require_keys({"op", "roi", "belt", "handles", "weights", "detail_length", "response",
                     "constraint_weight", "hard", "settle", "commit_every"});
  DeformRequest step;
  step.roi = read_region(node.at("roi"));
  step.belt = BorderBelt{.where = node.where() + "/belt"};
  if (const auto belt = node.find("belt")) step.belt = read_belt(*belt);
  const JsonNode handles = node.at("handles");
  for (const JsonNode& handle : handles.elements()) step.handles.push_back(read_handle(handle));
  if (step.handles.empty()) handles.fail("expected at least one handle");
  step.parameters = read_deform_parameters(node);
  if (step.parameters.commit_every) {
    for (const JsonNode& handle : handles.elements()) refuse_mirror(handle.at("move"));
  }
  return step;
}

}  // namespace

LaplacianWeights read_weights(const JsonNode& node) {
  return node.one_of("weights", {"uniform", "cotangent"}) == 0 ? LaplacianWeights::uniform
                                                               : LaplacianWeights::cotangent;
}

Move read_move(const JsonNode& node) {
  node.require_keys({"translate", "rotate", "scale", "pivot", "matrix"});
  if (const auto matrix = node.find("matrix")) {
    for (const std::string_view other : {"translate", "rotate", "scale", "pivot"}) {
      if (!node.has(other)) continue;
      node.at(other).fail("\"matrix\" stands in place of \"" + std::string(other) +
                          "\"; remove one of the two");
    }
    return read_matrix(*matrix);
  }
  SimilarityMove move;
  if (const auto translate = node.find("translate")) move.translate = translate->vector3();
  if (const auto rotate = node.find("rotate")) move.rotate = read_rotation(*rotate);
  if (const auto scale = node.find("scale")) move.scale = scale->positive_number();
  if (const auto pivot = node.find("pivot")) move.pivot = pivot->vector3();
  return move;
}

MovedHandle read_handle(const JsonNode& node) {
  node.require_keys({"region", "move"});
  return {read_region(node.at("region")), read_move(node.at("move"))};
}

Step read_step(const JsonNode& node) {
  switch (node.at("op").one_of("op", {"deform", "coat", "mix", "transplant"})) {
    case 0:
      return read_deform(node);
    case 1:
      return read_coat(node);
    case 2:
      return read_mix(node);
    default:
      return read_transplant(node);
  }
}

}  // namespace lapwing
