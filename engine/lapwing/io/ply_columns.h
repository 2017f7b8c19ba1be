#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/ply_header.h"
#include "lapwing/io/reading.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Distributes the properties of a PLY element, record by record, to the lists of a mesh. Every
/// property except lists must be taken before the first `put`.
class PlyColumns {
 public:
  using Names = std::initializer_list<std::string_view>;

  explicit PlyColumns(const PlyElement& element)
      : element_(element), sinks_(element.properties.size()) {}

  /// Directs properties into `values`, which is resized and filled with `missing`. Takes the first
  /// of `choices` whose names the element has; the last `optional` names may be absent. Returns
  /// false if no choice fits.
  template <class Vector>
  bool take(std::vector<Vector>& values, std::initializer_list<Names> choices,
            std::size_t optional = 0, const Vector& missing = Vector::Zero()) {
    for (const Names& names : choices) {
      const std::vector<std::size_t> found = find(names);
      if (!is_complete(found, optional)) continue;
      values.assign(element_.count, missing);
      double* const first = values.empty() ? nullptr : values.front().data();
      for (std::size_t k = 0; k < found.size(); ++k) {
        if (found[k] != kNone)
          sinks_[found[k]] = {true, first == nullptr ? nullptr : first + k, found.size(), 1.0};
      }
      return true;
    }
    return false;
  }

  /// Directs red, green, blue and alpha, scaled to [0, 1] according to their type.
  bool take_colors(std::vector<Eigen::Vector4d>& colors);

  /// Directs every number that was not taken into an attribute of the same name.
  void take_rest(std::vector<ExtraAttribute>& extras);

  void put(std::size_t property, std::size_t record, double value) {
    const Sink& sink = sinks_[property];
    sink.first[record * sink.step] = sink.scale * value;
  }

  /// Returns the property of each name, or kNone if the element has no number of that name.
  std::vector<std::size_t> find(Names names) const;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

 private:
  // Destination of a property: the value of a record goes to first[record * step].
  struct Sink {
    bool taken = false;
    double* first = nullptr;
    std::size_t step = 1;
    double scale = 1.0;
  };

  static bool is_complete(const std::vector<std::size_t>& found, std::size_t optional);

  const PlyElement& element_;
  std::vector<Sink> sinks_;
};

/// Stores the file offsets of the three numbers of each record.
class PlyOffsets {
 public:
  /// `properties` is from PlyColumns::find. Nothing is stored unless all three exist.
  PlyOffsets(NumberTriples& triples, const PlyElement& element,
             const std::vector<std::size_t>& properties);

  /// Describes records of equal size, the first at byte `first`.
  void describe(const PlyElement& element, std::uint64_t first);

  void note(std::size_t property, std::size_t record, std::uint64_t place) {
    if (axis_of_[property] < 3) triples_.offsets[3 * record + axis_of_[property]] = place;
  }

 private:
  NumberTriples& triples_;
  std::vector<std::uint8_t> axis_of_;  // per property: 0, 1, 2, or 3 for none
};

}  // namespace lapwing
