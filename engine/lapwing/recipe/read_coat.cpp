#include "lapwing/recipe/read_coat.h"

#include "lapwing/recipe/read_region.h"
#include "lapwing/recipe/read_step.h"

namespace lapwing {
namespace {

std::vector<VertexPair> read_pairs(const JsonNode& node) {
  std::vector<VertexPair> pairs;
  for (const JsonNode& element : node.elements()) {
    const std::vector<Index> vertices = element.vertices();
    if (vertices.size() != 2) {
      element.fail("expected two vertices, of the source and of the target, got " +
                   std::to_string(vertices.size()));
    }
    pairs.push_back({vertices[0], vertices[1]});
  }
  return pairs;
}

CorrespondenceOptions read_correspondence(const JsonNode& node) {
  CorrespondenceOptions options;
  if (const auto domain = node.find("domain")) {
    options.domain =
        domain->one_of("domain", {"disk", "square"}) == 0 ? Domain::disk : Domain::square;
  }
  if (const auto pairs = node.find("boundary_pairs")) {
    options.boundary_pairs = read_pairs(*pairs);
    const std::size_t count = options.boundary_pairs.size();
    const std::size_t wanted = pin_count(options.domain);
    if (count != 0 && count != wanted) {
      pairs->fail(wanted == 1
                      ? "the disk takes one pair of boundary vertices, got " + std::to_string(count)
                      : "the square takes four pairs of boundary vertices, in order around, got " +
                            std::to_string(count));
    }
  }
  if (const auto pairs = node.find("inner_pairs")) options.inner_pairs = read_pairs(*pairs);
  return options;
}

CoatOptions read_coat_options(const JsonNode& node) {
  CoatOptions options;
  if (const auto sampling = node.find("sampling")) options.sampling = read_sampling(*sampling);
  if (const auto scale = node.find("scale")) {
    if (scale->is_string()) {
      scale->one_of("scale", {"auto"});
    } else {
      options.scale = scale->positive_number();
    }
  }
  return options;
}

CoatParameters read_parameters(const JsonNode& node) {
  CoatParameters parameters;
  parameters.detail_size = node.at("detail_size").positive_number();
  if (const auto size = node.find("smooth_target")) {
    parameters.smooth_target = size->number_from_zero();
  }
  if (const auto weights = node.find("weights")) parameters.weights = read_weights(*weights);
  parameters.correspondence = read_correspondence(node);
  parameters.sampling = read_coat_options(node);
  if (const auto amplitude = node.find("amplitude")) parameters.amplitude = amplitude->number();
  if (const auto transition = node.find("transition")) {
    parameters.transition = read_transition(*transition);
  }
  if (const auto remesh = node.find("remesh")) parameters.remesh = read_remeshing(*remesh);
  return parameters;
}

}  // namespace

MappedSampling read_sampling(const JsonNode& node) {
  return node.one_of("sampling", {"one_ring", "linear"}) == 0 ? MappedSampling::one_ring
                                                              : MappedSampling::linear;
}

Remeshing read_remeshing(const JsonNode& node) {
  return node.one_of("remesh", {"auto", "none"}) == 0 ? Remeshing::automatic : Remeshing::none;
}

Transition read_transition(const JsonNode& node) {
  node.require_keys({"width", "profile"});
  Transition transition;
  transition.width = node.at("width").number_from_zero();
  if (const auto profile = node.find("profile")) {
    transition.profile = profile->one_of("profile", {"smooth", "linear"}) == 0
                             ? Transition::Profile::smooth
                             : Transition::Profile::linear;
  }
  return transition;
}

CoatStep read_coat(const JsonNode& node) {
  node.require_keys({"op", "source", "source_patch", "target_patch", "detail_size", "smooth_target",
                     "weights", "domain", "boundary_pairs", "inner_pairs", "sampling", "scale",
                     "amplitude", "transition", "remesh"});
  CoatStep step;
  step.where = node.where();
  if (const auto source = node.find("source")) step.source = source->file_name();
  step.source_patch = read_region(node.at("source_patch"));
  step.target_patch = read_region(node.at("target_patch"));
  step.parameters = read_parameters(node);
  return step;
}

}  // namespace lapwing
