#include "lapwing/deform/proxy_drag.h"

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform_solver_state.h"
#include "lapwing/deform/motion_target.h"
#include "lapwing/laplacian/springs.h"

namespace lapwing {

using Eigen::Vector3d;

std::unique_ptr<ProxyDrag> ProxyDrag::make(std::shared_ptr<const DeformSolver> solver) {
  const EditSystem& edit = *solver->state_->edit;
  if (!edit.options.settle) {
    throw InputError("a proxy drag requires settling; set \"settle\" in the deform options");
  }
  if (edit.springs != nullptr || !edit.region.targets.empty() || !edit.region.loose.empty()) {
    return nullptr;
  }
  std::unique_ptr<CoarseProxy> proxy = CoarseProxy::make(edit);
  if (proxy == nullptr || proxy->vertex_count() > DragFrameProblem::kMostNodes) return nullptr;
  return std::unique_ptr<ProxyDrag>(new ProxyDrag(std::move(solver), edit, std::move(proxy)));
}

ProxyDrag::ProxyDrag(std::shared_ptr<const DeformSolver> solver, const EditSystem& edit,
                     std::unique_ptr<CoarseProxy> proxy)
    : solver_(std::move(solver)),
      edit_(edit),
      proxy_(std::move(proxy)),
      problem_(std::make_shared<const DragFrameProblem>(make_problem())) {}

DragFrameProblem ProxyDrag::make_problem() {
  DragFrameProblem problem;
  problem.rings = edit_.laplacian->shared_rings();
  problem.vertices = problem.rings->vertices;
  const std::vector<Index> in_rings = inverse_index(problem.rings->vertices, edit_.rest->size());
  for (const VertexSet& handle : edit_.region.handles) {
    for (const Index v : handle) {
      prescribed_vertices_.push_back(v);
      if (in_rings[v] == kNoIndex) problem.vertices.push_back(v);
    }
  }
  problem.exact_count = prescribed_vertices_.size();
  for (const FalloffVertex& graded : edit_.region.graded) {
    prescribed_vertices_.push_back(graded.vertex);
  }

  const CoarseEmbedding& embedding = proxy_->embedding();
  problem.origin = embedding.origin();
  problem.node_count = proxy_->vertex_count();
  for (const Index v : problem.vertices) problem.rest.push_back((*edit_.rest)[v] - problem.origin);
  const std::vector<Index> entry_of = inverse_index(prescribed_vertices_, edit_.rest->size());
  std::vector<char> is_held(edit_.rest->size(), 0);
  for (const Index v : edit_.region.belt) is_held[v] = 1;
  for (const VertexSet& handle : edit_.region.handles) {
    for (const Index v : handle) is_held[v] = 1;
  }
  const std::vector<Index> embedded_of = inverse_index(embedding.vertices(), edit_.rest->size());
  for (const Index v : problem.vertices) {
    problem.prescribed_entries.push_back(entry_of[v]);
    const bool follows = embedded_of[v] != kNoIndex && is_held[v] == 0;
    problem.embedded.push_back(follows ? with_rounded_weights(embedding.embedded()[embedded_of[v]])
                                       : EmbeddedVertex{});
  }

  const Unknowns& unknowns = edit_.constraints.unknowns;
  problem.stiffness.resize(prescribed_vertices_.size(), 0.0);
  for (std::size_t k = problem.exact_count; k < prescribed_vertices_.size(); ++k) {
    const Index unknown = unknowns.of_vertex[prescribed_vertices_[k]];
    if (unknown != kNoIndex) problem.stiffness[k] = edit_.constraints.W[unknown];
  }
  std::vector<char> moves;
  for (const Index row : problem.rings->unknown_rows) {
    moves.push_back(is_held[problem.vertices[row]] == 0 ? 1 : 0);
  }
  problem.set_sweeps(moves);
  return problem;
}

std::vector<Vector3d> ProxyDrag::begin(const DragState& start) {
  motions_ = start.motions;
  if (start.empty()) {
    motions_ = handle_motions(
        std::vector(edit_.region.handles.size(), Eigen::Affine3d(Eigen::Affine3d::Identity())));
    displacement_.assign(edit_.rest->size(), Vector3d::Zero());
  } else {
    displacement_ = start.displacement;
  }
  MotionTarget target = motion_target(edit_, motions_, std::move(prescribed_));
  proxy_->begin(target.settle_target(), displacement_);
  prescribed_ = std::move(target.prescribed);
  input_.prescribed.clear();
  for (const Index v : prescribed_vertices_) input_.prescribed.push_back(displacement_[v]);
  std::vector<Vector3d> own;
  own.reserve(problem_->vertices.size());
  for (const Index v : problem_->vertices) own.push_back(displacement_[v]);
  return own;
}

const DragFrameInput* ProxyDrag::step(const HandleMotions& motions) {
  // Without the force of the fine surface, the proxy turns a free handle by far too much.
  if (motions.any_free() || any_turned_far_since(motions_, motions)) return nullptr;
  MotionTarget target = motion_target(edit_, motions, std::move(next_prescribed_));
  if (!target.stretch.of_vertices.empty()) {
    next_prescribed_ = std::move(target.prescribed);
    return nullptr;
  }
  input_.motions = proxy_->step(target.settle_target());
  for (std::size_t k = 0; k < prescribed_vertices_.size(); ++k) {
    const Index v = prescribed_vertices_[k];
    if (k < problem_->exact_count) {
      input_.prescribed[k] += target.prescribed[v] - prescribed_[v];
    } else {
      input_.prescribed[k] = target.prescribed[v];
    }
  }
  motions_ = std::move(target.motions);
  next_prescribed_ = std::exchange(prescribed_, std::move(target.prescribed));
  return &input_;
}

DragState ProxyDrag::pose(std::span<const Vector3d> displacement) const {
  DragState state{motions_, displacement_, {}};
  for (std::size_t k = 0; k < displacement.size(); ++k) {
    state.displacement[problem_->vertices[k]] = displacement[k];
  }
  return state;
}

}  // namespace lapwing
