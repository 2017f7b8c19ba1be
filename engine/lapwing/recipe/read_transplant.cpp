#include "lapwing/recipe/read_transplant.h"

#include "lapwing/recipe/read_coat.h"
#include "lapwing/recipe/read_region.h"
#include "lapwing/recipe/read_step.h"

namespace lapwing {
namespace {

LoopFit read_fit(const JsonNode& node) {
  node.require_keys({"rotate_degrees", "scale", "keep_size"});
  LoopFit fit;
  if (const auto degrees = node.find("rotate_degrees")) fit.rotate_degrees = degrees->number();
  if (const auto scale = node.find("scale")) fit.scale = scale->positive_number();
  if (const auto keep = node.find("keep_size")) fit.keep_size = keep->boolean();
  return fit;
}

PartPlace read_place(const JsonNode& node) {
  if (!node.is_object() || !node.has("auto")) return read_move(node);
  node.require_keys({"auto"});
  return read_fit(node.at("auto"));
}

// "wing.obj", or {"mesh": ..., "region": ...}.
void read_part(const JsonNode& node, TransplantStep& step) {
  if (node.is_string()) {
    step.part = node.file_name();
    return;
  }
  node.require_keys({"mesh", "region"});
  if (const auto mesh = node.find("mesh")) {
    step.part = mesh->file_name();
  } else if (!node.has("region")) {
    node.fail("expected \"mesh\", \"region\" (of the mesh itself) or both");
  }
  if (const auto region = node.find("region")) step.part_region = read_region(*region);
}

TransplantParameters read_transplant_parameters(const JsonNode& node) {
  TransplantParameters parameters;
  if (const auto transition = node.find("transition")) {
    parameters.transition = read_transition(*transition);
  }
  if (const auto belt = node.find("belt")) {
    belt->require_keys({"padding", "width"});
    if (const auto padding = belt->find("padding"))
      parameters.padding = padding->number_from_zero();
    if (const auto width = belt->find("width")) parameters.belt = width->positive_number();
  }
  if (const auto weights = node.find("weights")) parameters.weights = read_weights(*weights);
  if (const auto sampling = node.find("sampling")) parameters.sampling = read_sampling(*sampling);
  if (const auto remesh = node.find("remesh")) parameters.remesh = read_remeshing(*remesh);
  return parameters;
}

}  // namespace

TransplantStep read_transplant(const JsonNode& node) {
  node.require_keys({"op", "part", "loop", "place", "snap", "target_region", "transition", "belt",
                     "weights", "sampling", "remesh"});
  TransplantStep step;
  step.where = node.where();
  read_part(node.at("part"), step);
  if (const auto loop = node.find("loop")) step.loop = loop->vertex();
  if (const auto place = node.find("place")) step.place = read_place(*place);
  if (const auto snap = node.find("snap")) {
    step.snap = snap->boolean();
    if (step.snap && std::holds_alternative<LoopFit>(step.place)) {
      snap->fail(
          "a part that is fitted by itself is on the surface already; give its \"place\" as "
          "a move, or leave \"snap\" out");
    }
  }
  step.target_region = read_region(node.at("target_region"));
  step.parameters = read_transplant_parameters(node);
  return step;
}

}  // namespace lapwing
