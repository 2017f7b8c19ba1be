#include "lapwing/deform/deform.h"

#include <algorithm>
#include <functional>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/certificate_warnings.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/deform/modifiers/joined_request.h"
#include "lapwing/deform/modifiers/mirrored_request.h"
#include "lapwing/deform/modifiers/substeps.h"
#include "lapwing/deform/modifiers/winding.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/ring_fit.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// A request that is being carried out, which moves its mesh in substeps.
struct Work {
  const ResolvedRequest& bound;
  Kernels& kernels;
  DeformWorkspace& workspace;
  const Progress& progress;
  Deformed& result;
  const Positions& start;
  // Of each ring: the product over all completed substeps.
  std::vector<Eigen::Matrix3d> transforms = {};

  // Returns the region with targets at the fraction `to` of their motion: like handles, they move
  // in substeps.
  EditRegion region_at(double to) const {
    EditRegion region = bound.region;
    if (to == 1.0) return region;
    for (Target& target : region.targets) {
      const Vector3d from = point_of(target, start);
      target.position = from + to * (target.position - from);
    }
    return region;
  }

  const DeformSolver& solver_of(EditRegion region) const {
    const Positions& rest = result.mesh.positions;
    const DeformOptions& options = bound.request.parameters;
    std::optional<DeformSolver>& solver = workspace.solver;
    if (solver && solver->is_of(rest, bound.topology, region, options, kernels)) {
      return *solver;
    }
    solver.reset();  // frees its memory before the next solver is created
    if (!workspace.prepared || &workspace.prepared->topology() != &bound.topology) {
      workspace.prepared = std::make_unique<PreparedRegion>(bound.topology);
    }
    solver.emplace(*workspace.prepared, rest, std::move(region), options, kernels, progress);
    for (const auto& [name, ms] : solver->timings().stages()) result.timings.add(name, ms);
    return *solver;
  }

  // Multiplies the transforms of the rings by those of another substep: T_i becomes R_i S_i T_i.
  // `S` is the rest stretch of the substep. R_i is fitted to its result `positions`.
  void add_transforms(std::span<const Eigen::Matrix3d> S, const Positions& positions) {
    if (S.empty()) return;
    const Positions& rest = result.mesh.positions;
    if (transforms.empty()) transforms.assign(rest.size(), Eigen::Matrix3d::Identity());
    for (const Index i : bound.region.roi) {
      const Eigen::Matrix3d R = fit_rotation(i, bound.topology.rings[i], rest, positions, S[i]);
      transforms[i] = R * S[i] * transforms[i];
    }
  }

  // Carries out the motions from fraction `from` to fraction `to`.
  Certificate carry_out(double from, double to) {
    const DeformSolver& solver = solver_of(region_at(to));
    const HandleMotions motions = bound.handle_motions(from, to);
    Certificate certificate;
    stage("solve", result.timings, progress, [&] {
      const std::vector<HandleMotions> path =
          to - from == 1.0 ? bound.path() : std::vector<HandleMotions>();
      DeformResult solved = solver.solve_along(path, motions, progress);
      certificate = std::move(solved.certificate);
      if (result.commits > 1) add_transforms(solved.rest_stretch, solved.positions);
      result.rest_stretch = std::move(solved.rest_stretch);
      result.mesh.positions = std::move(solved.positions);
    });
    result.solver = solver.solver_name();
    return certificate;
  }

  Certificate carry_out_in_parts() {
    const auto share = [&](std::size_t parts) {
      return static_cast<double>(parts) / static_cast<double>(result.commits);
    };
    std::vector<Certificate> parts;
    for (std::size_t k = 0; k < result.commits; ++k) {
      parts.push_back(carry_out(share(k), share(k + 1)));
    }
    Certificate certificate;
    for (std::size_t v = 0; v < transforms.size(); ++v) {
      result.rest_stretch[v] = polar_stretch(transforms[v]);
    }
    stage("certify", result.timings, progress, [&] {
      certificate = certify(bound, start, result.mesh.positions, parts, result.rest_stretch);
    });
    return certificate;
  }
};

// Returns a text such as "3 loose components with 310 vertices, starting at vertex 4, 90, 200".
std::string describe_parts(const std::vector<const VertexSet*>& parts) {
  constexpr std::size_t kNamed = 8;
  std::size_t vertices = 0;
  std::string names;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    vertices += parts[k]->size();
    if (k < kNamed) names += (k == 0 ? "" : ", ") + std::to_string(parts[k]->front());
    if (k == kNamed) names += ", ...";
  }
  return std::to_string(parts.size()) +
         (parts.size() == 1 ? " loose component" : " loose components") + " with " +
         std::to_string(vertices) + (vertices == 1 ? " vertex" : " vertices") +
         ", starting at vertex " + names;
}

void add_loose_parts(const EditRegion& region, const auto& add) {
  std::vector<const VertexSet*> parts;
  for (const LoosePart& part : region.loose) parts.push_back(&part.vertices);
  if (!parts.empty()) {
    add(describe_parts(parts) + ": carried along with the nearest surface");
  }
  if (!region.held_holes.empty()) {
    add("nothing but the rims of holes can hold the surface, so the belt is those of the largest, "
        "at " +
        name_vertices(region.held_holes) +
        ". To let them move along, choose a belt, or add a handle that stays");
  }
  if (region.turns_freely) {
    add("belt and handles lie on one line, about which the surface can rotate freely; it rotates "
        "as little as possible");
  }
  parts.clear();
  for (const VertexSet& part : region.left_out) parts.push_back(&part);
  if (!parts.empty()) add(describe_parts(parts) + ": left in place");
}

void add_notes(const DeformRequest& request, Deformed& result) {
  add_loose_parts(result.region, [&](const std::string& text) {
    result.notes.push_back(request.where + ": " + text);
  });
}

void add_warnings(const DeformRequest& request, Deformed& result) {
  const auto add = [&](const std::string& text) {
    result.warnings.push_back(request.where + ": " + text);
  };
  if (const std::string text = winding_warning(request, result.winding_degrees); !text.empty()) {
    add(text);
  }
  for (const std::string& text : warnings_of(result.certificate)) add(text);
}

DeformRequest unmoved(DeformRequest request) {
  for (MovedHandle& handle : request.handles) {
    handle.move = {};
    handle.orientation = HandleOrientation::kept;
    handle.path.clear();
  }
  return request;
}

// Caches the resolved region, because distances along the surface take a fifth of the time of a
// solve. Does not cache requests with targets, which usually change.
EditRegion region_of(const DeformRequest& request, const Mesh& mesh, DeformWorkspace& workspace) {
  if (!request.targets.empty()) return resolve_edit_region(request, mesh);
  DeformRequest asked = unmoved(request);
  std::optional<ResolvedRegion>& last = workspace.resolved;
  if (!last || last->request != asked || !same_bits(last->rest, mesh.positions)) {
    last.reset();
    EditRegion region = resolve_edit_region(request, mesh);
    last = {std::move(asked), mesh.positions, std::move(region)};
  }
  return last->region;
}

// Deforms `mesh` without joining seams, for a request without a mirror. Adds no warnings.
Deformed deform_surface(Mesh mesh, const DeformRequest& request, Kernels& kernels,
                        DeformWorkspace& workspace, const Progress& progress) {
  if (request.targets.rows.empty() && !request.targets.file.empty()) {
    throw InputError(request.targets.where + ": " + request.targets.file.string() +
                     " was not read; read the file and pass its rows");
  }
  if (!request.carry.empty()) {
    throw InputError(request.where + ": " + request.carry.front().file.string() +
                     " cannot be carried by this function; pass its points to carry_points");
  }
  if (request.handles.empty() && request.targets.empty()) {
    throw InputError(request.where + ": nothing is moved; give at least one handle or target");
  }
  Deformed result;
  const LargestTurn largest = largest_turn(request);
  result.turn_degrees = largest.turn.degrees;
  result.commits = commit_count(request);
  result.mesh = std::move(mesh);
  stage("region", result.timings, progress,
        [&] { result.region = region_of(request, result.mesh, workspace); });
  const Positions start = result.mesh.positions;
  std::vector<Vector3d> centroids;
  for (const VertexSet& handle : result.region.handles) {
    centroids.push_back(handle_frame(handle, start).centroid);
  }
  const ResolvedRequest bound{request, result.region, result.mesh.topology(), centroids};
  Work work{bound, kernels, workspace, progress, result, start};
  result.certificate = result.commits == 1 ? work.carry_out(0.0, 1.0) : work.carry_out_in_parts();
  result.winding_degrees = winding_degrees(bound, largest, start, result.mesh.positions);
  return result;
}

// Returns null if nothing is joined.
JoinedSurface* joined_for(const Mesh& mesh, SeamPolicy policy, DeformWorkspace& workspace) {
  if (policy == SeamPolicy::leave) return nullptr;
  std::optional<JoinedSurface>& joined = workspace.joined;
  const bool was_there = joined && !joined->empty();
  if (!was_there || !joined->is_closed_at(mesh.positions)) {
    if (was_there) {  // these may refer to the topology of the old surface
      workspace.resolved.reset();
      workspace.solver.reset();
      workspace.prepared.reset();
    }
    joined = joined_surface(mesh);
  }
  if (joined->empty()) return nullptr;
  joined->surface.positions = mesh.positions;
  return &*joined;
}

}  // namespace

EditRegion resolve_edit_region(const DeformRequest& request, const Mesh& mesh) {
  std::vector<HandleSpec> handles;
  for (const MovedHandle& handle : request.handles) {
    handles.push_back({handle.region, handle.falloff});
  }
  EditRegion region = resolve_edit_region(request.roi, request.belt, handles, mesh,
                                          request.parameters.loose, request.targets);
  region.stiffness = resolve_stiffness(request.stiffness, region.roi, mesh);
  return region;
}

Deformed deform(Mesh mesh, const DeformRequest& request, Kernels& kernels,
                DeformWorkspace& workspace, const Progress& progress) {
  const ProgressScope scope(progress);
  const JoinedSurface* joined = joined_for(mesh, request.parameters.seams, workspace);
  const auto on_surface = [&](const DeformRequest& asked, Mesh surface) {
    StageTimings timings;
    MirroredRequest both;
    if (asked.mirror) {
      stage("mirror", timings, progress, [&] { both = mirrored_request(asked, surface); });
    } else {
      both.request = asked;
    }
    Deformed result =
        deform_surface(std::move(surface), both.request, kernels, workspace, progress);
    for (const auto& [name, ms] : result.timings.stages()) timings.add(name, ms);
    result.timings = std::move(timings);
    for (const std::string& note : both.notes) {
      result.notes.push_back(request.where + ": " + note);
    }
    if (joined != nullptr) give_back_seams(*joined, std::move(mesh), request.where, result);
    add_notes(both.request, result);
    add_warnings(both.request, result);
    return result;
  };
  if (joined == nullptr) return on_surface(request, std::move(mesh));
  return on_surface(joined_request(request, *joined), joined->surface);
}

Deformed deform(const Eigen::Ref<const Eigen::MatrixX3d>& V,
                const Eigen::Ref<const Eigen::MatrixX3i>& F, const DeformRequest& request) {
  return deform(mesh_of(V, F), request);
}

Deformed deform(Mesh mesh, const DeformRequest& request) {
  CpuKernels kernels;
  DeformWorkspace workspace;
  return deform(std::move(mesh), request, kernels, workspace);
}

}  // namespace lapwing
