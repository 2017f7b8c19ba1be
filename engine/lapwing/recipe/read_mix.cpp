#include "lapwing/recipe/read_mix.h"

#include "lapwing/recipe/read_coat.h"
#include "lapwing/recipe/read_region.h"
#include "lapwing/recipe/read_step.h"

namespace lapwing {
namespace {

FileSource read_source(const JsonNode& node, Domain domain) {
  node.require_keys({"mesh", "patch", "detail_size", "boundary_pairs", "inner_pairs", "sampling",
                     "scale", "amplitude"});
  FileSource source = read_source_keys(node, domain);
  if (const auto mesh = node.find("mesh")) source.mesh = mesh->file_name();
  source.patch = read_region(node.at("patch"));
  return source;
}

std::array<FileSource, 2> read_sources(const JsonNode& node, Domain domain) {
  const std::vector<JsonNode> sources = node.elements();
  if (sources.size() != 2) {
    node.fail("expected two sources, got " + std::to_string(sources.size()) +
              (sources.size() == 1 ? "; {\"op\": \"coat\"} takes one" : ""));
  }
  return {read_source(sources[0], domain), read_source(sources[1], domain)};
}

DomainRamp read_domain_ramp(const JsonNode& node, Domain domain) {
  const std::vector<double> ends = node.numbers();
  if (ends.size() != 2) {
    node.fail("expected two numbers, where the mixing begins and where it ends, got " +
              std::to_string(ends.size()));
  }
  if (ends[0] == ends[1]) node.fail("the ramp has no extent; give two different numbers");
  if (domain != Domain::square) {
    node.fail("only the square domain has a v; add \"domain\": \"square\", or weigh by distance");
  }
  return {ends[0], ends[1]};
}

PaintedWeight read_field(const JsonNode& node) {
  PaintedWeight painted;
  for (const JsonNode& element : node.elements()) {
    const double w = element.number();
    if (!(w >= 0.0 && w <= 1.0)) element.fail("expected 0 to 1, the second source's share");
    painted.field.push_back(w);
  }
  return painted;
}

MixWeight read_weight(const JsonNode& node, Domain domain) {
  node.require_keys({"domain_v", "distance_to", "width", "field"});
  const std::string_view form = node.only_key_of({"domain_v", "distance_to", "field"}, "a weight");
  if (form == "distance_to") {
    return {DistanceRamp{read_region(node.at(form)), node.at("width").number_from_zero()}};
  }
  if (const auto width = node.find("width")) {
    width->fail("a width belongs to \"distance_to\"; remove it");
  }
  if (form == "domain_v") return {read_domain_ramp(node.at(form), domain)};
  return {read_field(node.at(form))};
}

}  // namespace

MixStep read_mix(const JsonNode& node) {
  node.require_keys({"op", "target_patch", "sources", "take", "weight", "profile", "handles",
                     "smooth_target", "weights", "domain", "transition", "remesh"});
  MixStep step;
  step.where = node.where();
  step.target_patch = read_region(node.at("target_patch"));
  step.parameters = read_coat_parameters(node);
  step.sources = read_sources(node.at("sources"), step.parameters.domain);
  if (const auto take = node.find("take")) {
    step.taken = take->one_of("take", {"coating", "shape"}) == 0 ? Taken::coating : Taken::shape;
  }
  step.weight = read_weight(node.at("weight"), step.parameters.domain);
  if (const auto profile = node.find("profile")) {
    if (std::holds_alternative<PaintedWeight>(step.weight.form)) {
      profile->fail("a painted field is taken as it is; remove \"profile\"");
    }
    step.weight.profile = read_profile(*profile);
  }
  if (const auto handles = node.find("handles")) {
    for (const JsonNode& handle : handles->elements()) step.handles.push_back(read_handle(handle));
  }
  return step;
}

}  // namespace lapwing
