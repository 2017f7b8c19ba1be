#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/recipe.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLineWidth = 96;

Json json_of(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Json json_of(const RegionSpec& spec);
Json json_of(const LoopFit& fit);
Json json_of(const Move& move);
Json json_of(const DeformRequest& step);
Json json_of(const CoatStep& step);
Json json_of(const MixStep& step);
Json json_of(const TransplantStep& step);

Json json_of(const std::vector<RegionSpec>& parts) {
  Json list = Json::array();
  for (const RegionSpec& part : parts) list.push_back(json_of(part));
  return list;
}

// One overload per form.
struct FormWriter {
  Json operator()(const AllVertices&) const { return {{"all", true}}; }
  Json operator()(const ListedVertices& list) const { return {{"vertices", list.vertices}}; }
  Json operator()(const GeodesicDisk& disk) const {
    Json keys;
    if (const auto* vertex = std::get_if<Index>(&disk.center)) {
      keys["center"] = *vertex;
    } else {
      keys["near"] = json_of(std::get<Vector3d>(disk.center));
    }
    keys["radius"] = disk.radius;
    return {{"disk", std::move(keys)}};
  }
  Json operator()(const Box& box) const {
    return {{"box", {{"min", json_of(box.min)}, {"max", json_of(box.max)}}}};
  }
  Json operator()(const LoopRegion& region) const {
    return {{"loop", region.loop}, {"inside", region.inside}};
  }
  Json operator()(const UnionRegion& region) const { return {{"union", json_of(region.parts)}}; }
  Json operator()(const DifferenceRegion& region) const {
    return {{"minus", json_of(region.parts)}};
  }
  Json operator()(const DiskInRegion& region) const {
    return {{"disk_in", json_of(region.parts.at(0))}};
  }
};

Json json_of(const RegionSpec& spec) {
  return std::visit(FormWriter{}, spec.form);
}
Json json_of(const BorderBelt& belt) {
  return {{"fraction", belt.fraction}};
}

Json json_of(const SimilarityMove& move) {
  Json keys{{"translate", json_of(move.translate)}};
  if (move.rotate != AxisRotation{}) {
    keys["rotate"] = {{"axis", json_of(move.rotate.axis)}, {"degrees", move.rotate.degrees}};
  }
  if (move.scale != 1.0) keys["scale"] = move.scale;
  if (move.pivot) keys["pivot"] = json_of(*move.pivot);
  return keys;
}

Json json_of(const MatrixMove& move) {
  Json list = Json::array();
  for (const auto row : move.matrix.rowwise()) {
    for (const double value : row) list.push_back(value);
  }
  return {{"matrix", std::move(list)}};
}

Json json_of(const DomainRamp& ramp) {
  return {{"domain_v", {ramp.from, ramp.to}}};
}
Json json_of(const DistanceRamp& ramp) {
  return {{"distance_to", json_of(ramp.region)}, {"width", ramp.width}};
}
Json json_of(const PaintedWeight& painted) {
  return {{"field", painted.field}};
}

// A belt, move, weight or step by the overload for what it holds.
template <class... Forms>
Json json_of_any(const std::variant<Forms...>& any) {
  return std::visit([](const auto& form) { return json_of(form); }, any);
}

const char* name_of(LaplacianWeights weights) {
  return weights == LaplacianWeights::uniform ? "uniform" : "cotangent";
}

const char* name_of(LinearResponse response) {
  return response == LinearResponse::tangent ? "tangent" : "rsi";
}

const char* name_of(MappedSampling sampling) {
  return sampling == MappedSampling::linear ? "linear" : "one_ring";
}
const char* name_of(Remeshing remeshing) {
  return remeshing == Remeshing::automatic ? "auto" : "none";
}

Json json_of_settle(const DeformRequest& step) {
  if (!step.parameters.settle || *step.parameters.settle == SettleOptions{})
    return step.parameters.settle.has_value();
  return {{"tolerance", step.parameters.settle->tolerance},
          {"max_iterations", step.parameters.settle->max_iterations}};
}

Json json_of(const std::vector<MovedHandle>& handles) {
  Json list = Json::array();
  for (const MovedHandle& handle : handles) {
    list.push_back({{"region", json_of(handle.region)}, {"move", json_of_any(handle.move)}});
  }
  return list;
}

Json json_of(const DeformRequest& step) {
  Json keys{{"op", "deform"},
            {"roi", json_of(step.roi)},
            {"belt", json_of_any(step.belt)},
            {"handles", json_of(step.handles)},
            {"weights", name_of(step.parameters.weights)},
            {"detail_length", step.parameters.detail_length},
            {"response", name_of(step.parameters.response)},
            {"constraint_weight", step.parameters.constraint_weight},
            {"hard", step.parameters.hard},
            {"settle", json_of_settle(step)}};
  if (step.parameters.commit_every) keys["commit_every"] = *step.parameters.commit_every;
  return keys;
}

const char* name_of(Transition::Profile profile) {
  return profile == Transition::Profile::linear ? "linear" : "smooth";
}

Json json_of(const Transition& transition) {
  return {{"width", transition.width}, {"profile", name_of(transition.profile)}};
}

const char* name_of(Domain domain) {
  return domain == Domain::disk ? "disk" : "square";
}

void write_pairs(const CoatSource& source, Json& keys) {
  if (!source.boundary_pairs.empty()) keys["boundary_pairs"] = source.boundary_pairs;
  if (!source.inner_pairs.empty()) keys["inner_pairs"] = source.inner_pairs;
}

void write_sampling(const CoatSource& source, Json& keys) {
  keys["sampling"] = name_of(source.sampling.sampling);
  keys["scale"] = source.sampling.scale ? Json(*source.sampling.scale) : Json("auto");
  keys["amplitude"] = source.amplitude;
}

void write_fading(const CoatParameters& parameters, Json& keys) {
  if (parameters.transition) keys["transition"] = json_of(*parameters.transition);
  keys["remesh"] = name_of(parameters.remesh);
}

Json json_of(const CoatStep& step) {
  const CoatParameters& parameters = step.parameters;
  Json keys{{"op", "coat"}};
  if (!step.source.mesh.empty()) keys["source"] = step.source.mesh.string();
  keys["source_patch"] = json_of(step.source.patch);
  keys["target_patch"] = json_of(step.target_patch);
  keys["detail_size"] = step.source.detail_size;
  keys["smooth_target"] = parameters.smooth_target;
  keys["weights"] = name_of(parameters.weights);
  keys["domain"] = name_of(parameters.domain);
  write_pairs(step.source, keys);
  write_sampling(step.source, keys);
  write_fading(parameters, keys);
  return keys;
}

Json json_of(const FileSource& source) {
  Json keys = Json::object();
  if (!source.mesh.empty()) keys["mesh"] = source.mesh.string();
  keys["patch"] = json_of(source.patch);
  keys["detail_size"] = source.detail_size;
  write_pairs(source, keys);
  write_sampling(source, keys);
  return keys;
}

Json json_of(const MixStep& step) {
  Json keys{{"op", "mix"}, {"target_patch", json_of(step.target_patch)}};
  keys["sources"] = Json::array({json_of(step.sources[0]), json_of(step.sources[1])});
  keys["take"] = step.taken == Taken::coating ? "coating" : "shape";
  keys["weight"] = json_of_any(step.weight.form);
  if (!std::holds_alternative<PaintedWeight>(step.weight.form)) {
    keys["profile"] = name_of(step.weight.profile);
  }
  if (!step.handles.empty()) keys["handles"] = json_of(step.handles);
  keys["smooth_target"] = step.parameters.smooth_target;
  keys["weights"] = name_of(step.parameters.weights);
  keys["domain"] = name_of(step.parameters.domain);
  write_fading(step.parameters, keys);
  return keys;
}

Json json_of(const LoopFit& fit) {
  Json keys{{"rotate_degrees", fit.rotate_degrees}};
  if (fit.scale != 1.0) keys["scale"] = fit.scale;
  if (fit.keep_size) keys["keep_size"] = true;
  return {{"auto", std::move(keys)}};
}
Json json_of(const Move& move) {
  return json_of_any(move);
}

Json json_of_part(const TransplantStep& step) {
  if (!step.part_region) return step.part.string();
  Json keys;
  if (!step.part.empty()) keys["mesh"] = step.part.string();
  keys["region"] = json_of(*step.part_region);
  return keys;
}

Json json_of(const TransplantStep& step) {
  const TransplantParameters& parameters = step.parameters;
  Json keys{{"op", "transplant"}, {"part", json_of_part(step)}};
  if (step.loop) keys["loop"] = *step.loop;
  keys["place"] = json_of_any(step.place);
  if (step.snap) keys["snap"] = true;
  keys["target_region"] = json_of(step.target_region);
  if (parameters.transition) keys["transition"] = json_of(*parameters.transition);
  if (parameters.padding) keys["belt"]["padding"] = *parameters.padding;
  if (parameters.belt) keys["belt"]["width"] = *parameters.belt;
  keys["weights"] = name_of(parameters.weights);
  keys["sampling"] = name_of(parameters.sampling);
  keys["remesh"] = name_of(parameters.remesh);
  return keys;
}

std::string atom(const Json& json) {
  if (!json.is_number_float()) return json.dump();
  // Shortest digits that read back to the same bits; 10, where the library writes 10.0.
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), json.get<double>());
  return {digits.data(), end.ptr};
}

// `json` on one line.
std::string flat(const Json& json) {
  if (!json.is_structured()) return atom(json);
  std::string text;
  for (const auto& [key, value] : json.items()) {
    if (!text.empty()) text += ", ";
    if (json.is_object()) text += Json(key).dump() + ": ";
    text += flat(value);
  }
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

// Numbers in lines filled up to the width.
std::string filled(const Json& list, const std::string& indent) {
  std::string text = "[";
  std::size_t column = kLineWidth;
  for (const Json& value : list) {
    const std::string number = atom(value);
    if (text.size() > 1) text += ",";
    if (column + number.size() + 2 > kLineWidth) {
      text += "\n" + indent + "  ";
      column = indent.size() + 2;
    } else {
      text += " ";
      ++column;
    }
    text += number;
    column += number.size() + 1;
  }
  return text + "\n" + indent + "]";
}

// `json` on one line where it fits behind what already stands there, else one child a line.
std::string pretty(const Json& json, const std::string& indent, std::size_t column) {
  const std::string line = flat(json);
  if (column + line.size() < kLineWidth || !json.is_structured()) return line;
  if (json.is_array() && json.front().is_number()) return filled(json, indent);
  const std::string inner = indent + "  ";
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string label = json.is_object() ? Json(key).dump() + ": " : "";
    text += (text.empty() ? "\n" : ",\n") + inner + label;
    text += pretty(value, inner, inner.size() + label.size());
  }
  text += "\n" + indent;
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::string to_json(const Recipe& recipe) {
  Json steps = Json::array();
  for (const Step& step : recipe.steps) steps.push_back(json_of_any(step));
  Json root{
      {"lapwing", kRecipeVersion}, {"mesh", recipe.mesh.string()}, {"steps", std::move(steps)}};
  if (!recipe.save.empty()) root["save"] = recipe.save.string();
  try {
    // Counted as standing at the line's end, so that the root always opens up.
    return pretty(root, "", kLineWidth) + "\n";
  } catch (const Json::type_error&) {
    throw InputError(
        "the name of the mesh, of a source or of the result is not UTF-8, which a recipe is "
        "written in; rename the file");
  }
}

}  // namespace lapwing
