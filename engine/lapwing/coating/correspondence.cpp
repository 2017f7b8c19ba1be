#include "lapwing/coating/correspondence.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/parameterize/domain_locator.h"

namespace lapwing {
namespace {

constexpr std::array<std::string_view, 2> kSides{"source", "target"};

std::string place_of(const std::string& where, const char* list, std::size_t pair) {
  return where + "/" + list + "/" + std::to_string(pair);
}

// Returns the local index of one vertex of a pair. It must be on the boundary if `boundary` is
// true, otherwise inside.
Index own_number(const PlacedPatch& side, std::size_t which, const VertexPair& pair, bool boundary,
                 const std::string& place) {
  const Index v = pair[which];
  const Index own = side.patch.own_number(v);
  const std::string name = "vertex " + std::to_string(v);
  const std::string patch = "the " + std::string(kSides[which]) + " patch";
  if (own == kNoIndex) {
    throw InputError(place + ": " + name + " is not in " + patch + ", which has " +
                     std::to_string(side.patch.vertices.size()) +
                     " vertices; choose one of them, such as vertex " +
                     std::to_string(side.patch.vertices.front()));
  }
  const auto& loop = side.patch.loop;
  const bool on_loop = std::find(loop.begin(), loop.end(), own) != loop.end();
  if (boundary && !on_loop) {
    const auto nearest = *std::min_element(loop.begin(), loop.end(), [&](Index a, Index b) {
      return (side.positions[a] - side.positions[own]).squaredNorm() <
             (side.positions[b] - side.positions[own]).squaredNorm();
    });
    throw InputError(place + ": " + name + " lies inside " + patch +
                     ", but a boundary pair needs a vertex on its boundary; the nearest is " +
                     std::to_string(side.patch.vertices[nearest]));
  }
  if (!boundary && on_loop) {
    throw InputError(place + ": " + name + " lies on the boundary of " + patch +
                     ", but inner pairs need inner vertices; give it in \"boundary_pairs\"");
  }
  return own;
}

void require_pair_count(const CorrespondenceOptions& options, const std::string& where) {
  const std::size_t count = options.boundary_pairs.size();
  const std::size_t wanted = pin_count(options.domain);
  if (count == 0 || count == wanted) return;
  throw InputError(where + "/boundary_pairs: the " +
                   (wanted == 1 ? "disk needs one pair"
                                : "square needs four pairs in order around the boundary") +
                   ", got " + std::to_string(count));
}

BoundaryPins pins_of(const PlacedPatch& side, std::size_t which,
                     const CorrespondenceOptions& options, const std::string& where) {
  require_pair_count(options, where);
  if (options.boundary_pairs.empty()) {
    return default_pins(side.patch, side.positions, options.domain);
  }
  BoundaryPins pins;
  for (std::size_t p = 0; p < options.boundary_pairs.size(); ++p) {
    pins.push_back(own_number(side, which, options.boundary_pairs[p], true,
                              place_of(where, "boundary_pairs", p)));
  }
  return pins;
}

DomainMap map_of(const PlacedPatch& side, std::size_t which, Domain domain,
                 const BoundaryPins& pins, const std::string& where) {
  try {
    return mean_value_map(side.patch, side.positions, domain, pins);
  } catch (const InputError& error) {
    throw InputError(where + ": the " + std::string(kSides[which]) + " patch: " + error.what(),
                     error.vertices());
  }
}

[[noreturn]] void fail_contradicting(const CorrespondenceOptions& options, const WarpReport& report,
                                     const std::string& where) {
  std::string text = where +
                     "/inner_pairs: these pairs cannot all be satisfied without folding the "
                     "map:";
  for (const Index p : report.unmet) {
    const VertexPair& pair = options.inner_pairs[p];
    text += " [" + std::to_string(pair[0]) + ", " + std::to_string(pair[1]) + "]";
  }
  throw InputError(text + ". Remove or correct one of them");
}

// Returns the pulls of the source's vertices to the points of the domain that the inner pairs
// require.
std::vector<PointPull> pulls_of(const PlacedPatch& source, const PlacedPatch& target,
                                const CorrespondenceOptions& options, const std::string& where,
                                const DomainMap& target_map) {
  std::vector<PointPull> pulls;
  for (std::size_t p = 0; p < options.inner_pairs.size(); ++p) {
    const std::string place = place_of(where, "inner_pairs", p);
    const Index from = own_number(source, 0, options.inner_pairs[p], false, place);
    const Index to = own_number(target, 1, options.inner_pairs[p], false, place);
    const auto same = std::find_if(pulls.begin(), pulls.end(),
                                   [&](const PointPull& pull) { return pull.vertex == from; });
    if (same != pulls.end()) {
      throw InputError(place + ": vertex " + std::to_string(options.inner_pairs[p][0]) +
                       " of the source is also in pair " + std::to_string(same - pulls.begin()) +
                       "; give each vertex in one pair only");
    }
    pulls.push_back({from, target_map.points[to]});
  }
  return pulls;
}

Eigen::Vector2d center_of(Domain domain) {
  return domain == Domain::disk ? Eigen::Vector2d::Zero() : Eigen::Vector2d(0.5, 0.5);
}

// Returns the angle of the rotation that maps the domain onto itself and moves the pulled vertices
// closest to their targets.
double best_turn(const DomainMap& map, std::span<const PointPull> pulls) {
  const Eigen::Vector2d center = center_of(map.domain);
  std::complex<double> sum = 0.0;
  for (const PointPull& pull : pulls) {
    const Eigen::Vector2d from = map.points[pull.vertex] - center;
    const Eigen::Vector2d to = pull.target - center;
    sum += std::complex(to.x(), to.y()) * std::conj(std::complex(from.x(), from.y()));
  }
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  const double angle = std::arg(sum);
  return map.domain == Domain::disk ? angle : kQuarter * std::round(angle / kQuarter);
}

// Rotates the source's map about the centre of the domain. Its pins become the boundary vertices
// nearest to the target's pins.
void turn(double angle, const Patch& source, std::span<const Index> target_pins,
          const DomainMap& target, FlattenedPatch& laid) {
  const Eigen::Vector2d center = center_of(target.domain);
  const Eigen::Rotation2Dd rotation(angle);
  for (Eigen::Vector2d& point : laid.map.points) point = center + rotation * (point - center);
  for (std::size_t p = 0; p < target_pins.size(); ++p) {
    const Eigen::Vector2d place = target.points[target_pins[p]];
    laid.pins[p] = *std::min_element(source.loop.begin(), source.loop.end(), [&](Index a, Index b) {
      return (laid.map.points[a] - place).squaredNorm() <
             (laid.map.points[b] - place).squaredNorm();
    });
  }
}

// Warps the source's map so that the vertices of the inner pairs coincide.
void meet_inner_pairs(const Patch& source, std::span<const PointPull> pulls,
                      const CorrespondenceOptions& options, const std::string& where,
                      Correspondence& result) {
  if (pulls.empty()) return;
  WarpResult warped = warp_domain(source.triangles, source.loop, result.source.points, pulls);
  result.warp = std::move(warped.report);
  if (!result.warp.unmet.empty()) fail_contradicting(options, result.warp, where);
  result.source.points = std::move(warped.points);
}

}  // namespace

FlattenedPatch lay(const PlacedPatch& side, MapSide which, const CorrespondenceOptions& options,
                   const std::string& where) {
  const auto index = static_cast<std::size_t>(which);
  FlattenedPatch laid;
  laid.pins_are_chosen = options.boundary_pairs.empty();
  laid.pins = pins_of(side, index, options, where);
  laid.map = map_of(side, index, options.domain, laid.pins, where);
  return laid;
}

Correspondence correspond(const PlacedPatch& source, FlattenedPatch laid_source,
                          const PlacedPatch& target, FlattenedPatch laid_target,
                          const CorrespondenceOptions& options, const std::string& where) {
  Correspondence result;
  const auto pulls = pulls_of(source, target, options, where, laid_target.map);
  if (laid_source.pins_are_chosen && !pulls.empty()) {
    turn(best_turn(laid_source.map, pulls), source.patch, laid_target.pins, laid_target.map,
         laid_source);
  }
  for (std::size_t p = 0; p < laid_source.pins.size(); ++p) {
    result.pins.push_back(
        {source.patch.vertices[laid_source.pins[p]], target.patch.vertices[laid_target.pins[p]]});
  }
  result.source = std::move(laid_source.map);
  result.target = std::move(laid_target.map);
  meet_inner_pairs(source.patch, pulls, options, where, result);
  result.flipped_source = flipped_triangles(source.patch.triangles, result.source.points).size();
  result.flipped_target = flipped_triangles(target.patch.triangles, result.target.points).size();
  const DomainLocator locator(source.patch.triangles, result.source.points);
  result.points = locator.locate(result.target.points);
  return result;
}

Correspondence correspond(const PlacedPatch& source, const PlacedPatch& target,
                          const CorrespondenceOptions& options, const std::string& where) {
  FlattenedPatch laid_source;
  FlattenedPatch laid_target;
  parallel_invoke([&] { laid_source = lay(source, MapSide::source, options, where); },
                  [&] { laid_target = lay(target, MapSide::target, options, where); });
  return correspond(source, std::move(laid_source), target, std::move(laid_target), options, where);
}

}  // namespace lapwing
