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

std::vector<VertexPair> read_boundary_pairs(const JsonNode& node, Domain domain) {
  std::vector<VertexPair> pairs = read_pairs(node);
  const std::size_t count = pairs.size();
  const std::size_t wanted = pin_count(domain);
  if (count != 0 && count != wanted) {
    node.fail(wanted == 1
                  ? "the disk takes one pair of boundary vertices, got " + std::to_string(count)
                  : "the square takes four pairs of boundary vertices, in order around, got " +
                        std::to_string(count));
  }
  return pairs;
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
    transition.profile = read_profile(*profile);
  }
  return transition;
}

Transition::Profile read_profile(const JsonNode& node) {
  return node.one_of("profile", {"smooth", "linear"}) == 0 ? Transition::Profile::smooth
                                                           : Transition::Profile::linear;
}

FileSource read_source_keys(const JsonNode& node, Domain domain) {
  FileSource source;
  source.where = node.where();
  source.detail_size = node.at("detail_size").positive_number();
  if (const auto pairs = node.find("boundary_pairs")) {
    source.boundary_pairs = read_boundary_pairs(*pairs, domain);
  }
  if (const auto pairs = node.find("inner_pairs")) source.inner_pairs = read_pairs(*pairs);
  source.sampling = read_coat_options(node);
  if (const auto amplitude = node.find("amplitude")) source.amplitude = amplitude->number();
  return source;
}

CoatParameters read_coat_parameters(const JsonNode& node) {
  CoatParameters parameters;
  if (const auto size = node.find("smooth_target")) {
    parameters.smooth_target = size->number_from_zero();
  }
  if (const auto weights = node.find("weights")) parameters.weights = read_weights(*weights);
  if (const auto domain = node.find("domain")) {
    parameters.domain =
        domain->one_of("domain", {"disk", "square"}) == 0 ? Domain::disk : Domain::square;
  }
  if (const auto transition = node.find("transition")) {
    parameters.transition = read_transition(*transition);
  }
  if (const auto remesh = node.find("remesh")) parameters.remesh = read_remeshing(*remesh);
  return parameters;
}

CoatStep read_coat(const JsonNode& node) {
  node.require_keys({"op", "source", "source_patch", "target_patch", "detail_size", "smooth_target",
                     "weights", "domain", "boundary_pairs", "inner_pairs", "sampling", "scale",
                     "amplitude", "transition", "remesh"});
  CoatStep step;
  step.where = node.where();
  step.parameters = read_coat_parameters(node);
  step.source = read_source_keys(node, step.parameters.domain);
  if (const auto source = node.find("source")) step.source.mesh = source->file_name();
  step.source.patch = read_region(node.at("source_patch"));
  step.target_patch = read_region(node.at("target_patch"));
  return step;
}

}  // namespace lapwing
