#include "lapwing/io/ply_columns.h"

#include <algorithm>

namespace lapwing {
namespace {

double color_scale(Scalar type) {
  if (!is_integer(type)) return 1.0;
  return type == Scalar::uint16 ? 1.0 / 65535.0 : 1.0 / 255.0;
}

}  // namespace

bool PlyColumns::take_colors(std::vector<Eigen::Vector4d>& colors) {
  const std::vector<Sink> before = sinks_;
  const bool found = take(colors,
                          {{"red", "green", "blue", "alpha"},
                           {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
                           {"r", "g", "b", "a"}},
                          1, kNoColor);
  for (std::size_t p = 0; p < sinks_.size(); ++p) {
    if (sinks_[p].taken && !before[p].taken) {
      sinks_[p].scale = color_scale(element_.properties[p].type);
    }
  }
  return found;
}

void PlyColumns::take_rest(std::vector<ExtraAttribute>& extras) {
  for (std::size_t p = 0; p < sinks_.size(); ++p) {
    const PlyProperty& property = element_.properties[p];
    if (property.count_type || sinks_[p].taken) continue;
    extras.push_back({property.name, std::string(ply_name(property.type)), 1,
                      std::vector<double>(element_.count)});
    sinks_[p] = {true, extras.back().values.data(), 1, 1.0};
  }
}

std::vector<std::size_t> PlyColumns::find(Names names) const {
  std::vector<std::size_t> found;
  for (const std::string_view name : names) {
    std::size_t p = 0;
    const auto& properties = element_.properties;
    while (p < properties.size() && (properties[p].name != name || properties[p].count_type)) ++p;
    found.push_back(p == properties.size() ? kNone : p);
  }
  return found;
}

bool PlyColumns::is_complete(const std::vector<std::size_t>& found, std::size_t optional) {
  return std::find(found.begin(), found.end() - static_cast<std::ptrdiff_t>(optional), kNone) ==
         found.end() - static_cast<std::ptrdiff_t>(optional);
}

PlyOffsets::PlyOffsets(NumberTriples& triples, const PlyElement& element,
                       const std::vector<std::size_t>& properties)
    : triples_(triples), axis_of_(element.properties.size(), 3) {
  if (std::find(properties.begin(), properties.end(), PlyColumns::kNone) != properties.end()) {
    return;
  }
  triples_.count = element.count;
  for (std::uint8_t k = 0; k < 3; ++k) {
    axis_of_[properties[k]] = k;
    triples_.types[k] = element.properties[properties[k]].type;
  }
}

void PlyOffsets::describe(const PlyElement& element, std::uint64_t first) {
  triples_.first = first;
  triples_.stride = element.binary_size();
  std::uint64_t place = 0;
  for (std::size_t p = 0; p < axis_of_.size(); ++p) {
    if (axis_of_[p] < 3) triples_.places[axis_of_[p]] = place;
    place += size_of(element.properties[p].type);
  }
}

}  // namespace lapwing
