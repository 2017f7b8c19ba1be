#include "lapwing/recipe/write_values.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

Json json_of(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const std::vector<RegionSpec>& parts) {
  Json list = Json::array();
  for (const RegionSpec& part : parts) list.push_back(json_of(part));
  return list;
}

// Writes a region; one overload per form.
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

Json json_of(const BoundaryAnchors& belt) {
  return {{"fraction", belt.fraction}};
}

Json json_of(const SimilarityMove& move) {
  Json keys{{"translate", json_of(move.translate)}};
  if (move.rotate != AxisRotation{}) {
    keys["rotate"] = {{"axis", json_of(move.rotate.axis)}, {"degrees", move.rotate.degrees}};
  }
  if (move.scale != Eigen::Vector3d::Ones()) {
    const bool is_uniform = move.scale.minCoeff() == move.scale.maxCoeff();
    keys["scale"] = is_uniform ? Json(move.scale[0]) : json_of(move.scale);
  }
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

Json json_of(const Transition& transition) {
  Json keys{{"width", transition.width}};
  if (transition.profile == Transition::Profile::linear) keys["profile"] = "linear";
  return keys;
}

Json factor_json(double factor) {
  return factor == kRigidStiffness ? Json("rigid") : Json(factor);
}

Json json_of(const LoopFit& fit) {
  Json keys{{"rotate_degrees", fit.rotate_degrees}};
  if (fit.scale != 1.0) keys["scale"] = fit.scale;
  if (fit.keep_size) keys["keep_size"] = true;
  return {{"auto", std::move(keys)}};
}

// Writes the active alternative of a variant.
template <class... Forms>
Json json_of_any(const std::variant<Forms...>& any) {
  return std::visit([](const auto& form) { return json_of(form); }, any);
}

}  // namespace

Json json_of(const RegionSpec& spec) {
  return std::visit(FormWriter{}, spec.form);
}
Json json_of(const BeltSpec& belt) {
  return json_of_any(belt);
}
Json json_of(const Move& move) {
  return json_of_any(move);
}
Json json_of(const std::vector<MovedHandle>& handles) {
  Json list = Json::array();
  for (const MovedHandle& handle : handles) {
    Json keys{{"region", json_of(handle.region)}, {"move", json_of_any(handle.move)}};
    if (const auto& transition = handle.falloff.transition) keys["falloff"] = json_of(*transition);
    if (const auto& field = handle.falloff.field; !field.empty()) {
      keys["weight"] = {{"field", field}};
    } else if (handle.falloff.weight) {
      keys["weight"] = *handle.falloff.weight;
    }
    if (handle.orientation == HandleOrientation::free) keys["orientation"] = "free";
    for (const Move& move : handle.path) keys["path"].push_back(json_of_any(move));
    list.push_back(std::move(keys));
  }
  return list;
}
Json json_of(const TargetSpec& targets) {
  Json rows = Json::array();
  for (const TargetRow& row : targets.rows) {
    Json numbers = Json::array();
    if (const auto* vertex = std::get_if<Index>(&row.point)) {
      numbers.push_back(*vertex);
    } else {
      for (const double number : std::get<Eigen::Vector3d>(row.point)) numbers.push_back(number);
    }
    for (const double number : row.position) numbers.push_back(number);
    if (row.weight != 1.0) numbers.push_back(row.weight);
    rows.push_back(std::move(numbers));
  }
  if (targets.file.empty() && !targets.hard) return rows;
  Json json;
  if (targets.file.empty()) {
    json["rows"] = std::move(rows);
  } else {
    json["file"] = targets.file.string();
  }
  if (targets.hard) json["hard"] = true;
  return json;
}
Json json_of(const LandmarkSpec& landmarks) {
  if (!landmarks.scan_file.empty()) {
    return {{"template", landmarks.file.string()}, {"scan", landmarks.scan_file.string()}};
  }
  if (!landmarks.file.empty()) return landmarks.file.string();
  Json rows = Json::array();
  for (const Landmark& row : landmarks.rows) {
    Json json;
    if (const auto* vertex = std::get_if<Index>(&row.on_template)) {
      json["vertex"] = *vertex;
    } else {
      json["point"] = json_of(std::get<Eigen::Vector3d>(row.on_template));
    }
    if (const auto* vertex = std::get_if<Index>(&row.on_scan)) {
      json["scan_vertex"] = *vertex;
    } else {
      json["position"] = json_of(std::get<Eigen::Vector3d>(row.on_scan));
    }
    if (row.weight != 1.0) json["weight"] = row.weight;
    if (!row.label.empty()) json["label"] = row.label;
    rows.push_back(std::move(json));
  }
  return rows;
}
Json json_of(const std::vector<StiffnessSpec>& stiffness) {
  Json list = Json::array();
  for (const StiffnessSpec& spec : stiffness) {
    Json factor = factor_json(spec.factor);
    if (!spec.field.empty()) {
      Json field = Json::array();
      for (const double each : spec.field) field.push_back(factor_json(each));
      factor = {{"field", std::move(field)}};
    }
    list.push_back({{"region", json_of(spec.region)}, {"factor", std::move(factor)}});
  }
  return list;
}
Json json_of(const MirrorSpec& mirror) {
  const auto* plane = std::get_if<MirrorPlane>(&mirror.plane);
  if (plane == nullptr) return "auto";
  return {{"point", json_of(plane->point)}, {"normal", json_of(plane->normal)}};
}
Json json_of(const std::vector<CarrySpec>& carry) {
  Json list = Json::array();
  for (const CarrySpec& spec : carry) {
    if (spec.save.empty()) {
      list.push_back(spec.file.string());
    } else {
      list.push_back({{"file", spec.file.string()}, {"save", spec.save.string()}});
    }
  }
  return list;
}
Json json_of(const MixWeight& weight) {
  return json_of_any(weight.form);
}
Json json_of(const PartPlace& place) {
  return json_of_any(place);
}

}  // namespace lapwing
