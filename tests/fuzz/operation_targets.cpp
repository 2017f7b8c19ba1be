// Whole operations on small meshes, with regions and moves of any kind.
#include <array>
#include <cmath>
#include <random>

#include "fuzz/choices.h"
#include "lapwing/base/errors.h"
#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/lapwing.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/region/region_spec.h"

namespace lapwing::fuzz {
namespace {

using Eigen::Vector3d;

bool is_finite(const Vector3d& p) {
  return p.allFinite();
}

// Requires the same number of vertices, finite positions, and bitwise identical positions outside
// `region`.
void require_kept_outside(const Mesh& before, const Mesh& after, const VertexSet& region) {
  require(after.vertex_count() == before.vertex_count(), "as many vertices");
  std::vector<bool> inside(before.vertex_count());
  for (const Index v : region) inside[v] = true;
  for (Index v = 0; v < before.vertex_count(); ++v) {
    const Vector3d& p = before.positions[v];
    const Vector3d& q = after.positions[v];
    if (is_finite(p)) require(is_finite(q), "finite");
    if (!inside[v] && is_finite(p)) require(p == q, "to the bit outside of the region");
  }
}

bool is_unmoved(const Vector3d& a, const Vector3d& b) {
  return std::equal(a.data(), a.data() + 3, b.data(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

// Requires that the vertices that come from `before` did not move. `sources` contains the old index
// of each vertex, or kNoIndex for a new vertex.
void require_unmoved(const Mesh& before, const Mesh& after, std::span<const Index> sources) {
  require(sources.size() == after.vertex_count(), "a source for every vertex");
  for (Index v = 0; v < after.vertex_count(); ++v) {
    if (sources[v] == kNoIndex) continue;
    require(sources[v] < before.vertex_count(), "a source that there is");
    require(is_unmoved(before.positions[sources[v]], after.positions[v]),
            "to the bit where it was");
  }
}

// Cancels an operation after a given number of progress reports.
class Cancelling {
 public:
  explicit Cancelling(int after) : left_(after) {}
  bool report() { return left_-- > 0; }
  bool has_cancelled() const { return left_ < 0; }

 private:
  int left_;
};

// Returns the largest absolute value of the finite coordinates.
double reach(const Mesh& mesh) {
  double most = 0.0;
  for (const Vector3d& p : mesh.positions) {
    if (is_finite(p)) most = std::max(most, p.cwiseAbs().maxCoeff());
  }
  return most;
}

// The squares of lengths far above this bound overflow.
constexpr double kModerate = 1e100;

// Reports a violation after `most` progress reports, because no input may cause unbounded work.
Progress bounded(long most) {
  return [left = most](std::string_view, double) mutable {
    require(--left > 0, "an end within bounded work");
    return true;
  };
}

DeformRequest deform_request(Choices& choices, const Mesh& mesh) {
  DeformRequest request;
  if (choices.one_in(4)) request.roi = choices.region(mesh);
  if (choices.one_in(3)) request.belt = choices.region(mesh);
  for (int h = choices.byte() % 3; h >= 0; --h) {
    const auto count = static_cast<Index>(mesh.vertex_count());
    request.handles.push_back({{ListedVertices{choices.vertices(count)}}, choices.move()});
  }
  DeformParameters& p = request.parameters;
  if (choices.one_in(3)) p.constraint_weight = choices.above_zero();
  if (choices.one_in(3)) p.detail_length = choices.above_zero();
  if (choices.one_in(4)) p.hard = true;
  if (choices.one_in(4)) p.weights = LaplacianWeights::uniform;
  if (choices.one_in(6)) p.settle = std::nullopt;
  if (choices.one_in(6)) p.commit_every = choices.between(10.0, 180.0);
  if (choices.one_in(6)) p.loose = LoosePolicy::leave;
  return request;
}

// The largest distance of a handle's vertices from their targets, and the rounding error of this
// distance.
struct HandleError {
  double distance = 0.0;
  double rounding = 0.0;
};
HandleError handle_error(const Mesh& rest, const Mesh& moved, const DeformRequest& request) {
  HandleError error;
  for (const MovedHandle& handle : request.handles) {
    const VertexSet& vertices = std::get<ListedVertices>(handle.region.form).vertices;
    Vector3d centroid = Vector3d::Zero();
    for (const Index v : vertices) centroid += rest.positions[v];
    centroid /= static_cast<double>(vertices.size());
    const Eigen::Affine3d map = to_affine(handle.move, centroid);
    error.rounding = std::max(error.rounding, 1e-9 * map.linear().norm() * reach(rest));
    for (const Index v : vertices) {
      error.distance =
          std::max(error.distance, (map * rest.positions[v] - moved.positions[v]).norm());
    }
  }
  return error;
}

// Requires that the flips, rotations and scales in the certificate match the resulting mesh.
void require_measures(const Mesh& mesh, const Deformed& result) {
  if (!joined_surface(mesh).empty()) return;  // measured on the joined surface
  Certificate again;
  measure_shape(result.region.roi, mesh.topology(), mesh.positions, result.mesh.positions, again,
                result.rest_stretch);
  const Certificate& told = result.certificate;
  require(again.all_finite == told.all_finite, "as finite as told");
  require(again.flipped_triangles == told.flipped_triangles, "as many flipped as told");
  require(again.largest_rotation_degrees == told.largest_rotation_degrees, "turned as told");
  require(again.largest_scale == told.largest_scale, "as large as told");
  require(again.smallest_scale == told.smallest_scale, "as small as told");
}

void cancel_deform(const Mesh& mesh, const DeformRequest& request, int after) {
  CpuKernels kernels;
  DeformWorkspace workspace;
  Cancelling cancelling(after);
  deform(mesh, request, kernels, workspace,
         [&](std::string_view, double) { return cancelling.report(); });
  require(!cancelling.has_cancelled(), "no result once it is cancelled");
}

void deform_mesh(Bytes bytes) {
  Choices choices(bytes);
  const Mesh mesh = choices.mesh();
  const DeformRequest request = deform_request(choices, mesh);
  CpuKernels kernels;
  DeformWorkspace workspace;
  try {
    if (choices.one_in(8)) cancel_deform(mesh, request, choices.byte());
    const Deformed result = deform(mesh, request, kernels, workspace, bounded(100'000));
    require_kept_outside(mesh, result.mesh, result.region.roi);
    require(result.certificate.all_finite, "the certificate says so");
    require_measures(mesh, result);
    if (reach(mesh) > kModerate || request.parameters.commit_every) return;  // measured in parts
    const auto [error, turned] = handle_error(mesh, result.mesh, request);
    const double told = result.certificate.handle_error;
    const double rounding = turned + 1e-9 * (reach(mesh) + reach(result.mesh));
    require(
        error == told || std::abs(error - told) <= rounding,
        "the handle's error is as told: " + std::to_string(told) + ", is " + std::to_string(error));
  } catch (const Error&) {
  }
}

CoatParameters coat_parameters(Choices& choices) {
  CoatParameters p;
  if (choices.one_in(3)) p.smooth_target = choices.above_zero();
  if (choices.one_in(3)) p.domain = Domain::square;
  if (choices.one_in(2)) p.remesh = Remeshing::none;
  return p;
}

// If the patch was not remeshed, requires that the rest of the target did not move.
void require_coated(const Mesh& target, const RegionSpec& patch, const Coated& result) {
  if (result.report.vertices_before_remeshing == 0) {
    require_kept_outside(target, result.mesh, resolve(patch, target));
    return;
  }
  validate_indices(result.mesh);
  const auto is_broken = [](const Vector3d& p) { return !is_finite(p); };
  require(std::ranges::count_if(result.mesh.positions, is_broken) <=
              std::ranges::count_if(target.positions, is_broken),
          "finite where the target was");
}

void coat_mesh(Bytes bytes) {
  Choices choices(bytes);
  const Mesh target = choices.mesh();
  const Mesh source = choices.mesh();
  CoatRequest request;
  request.source.patch = choices.patch(source);
  request.source.detail_size = choices.between(0.1, 2.0);
  if (choices.one_in(3)) request.source.amplitude = choices.number();
  request.target_patch = choices.patch(target);
  request.parameters = coat_parameters(choices);
  try {
    require_coated(target, request.target_patch, coat(target, source, request));
  } catch (const Error&) {
  }
}

void mix_meshes(Bytes bytes) {
  Choices choices(bytes);
  const Mesh target = choices.mesh();
  const std::array<Mesh, 2> meshes{choices.mesh(), choices.mesh()};
  MixRequest request;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    request.sources[k].patch = choices.patch(meshes[k]);
    request.sources[k].detail_size = choices.between(0.1, 2.0);
  }
  request.target_patch = choices.patch(target);
  request.parameters = coat_parameters(choices);
  if (choices.one_in(2)) {
    request.weight.form = DistanceRamp{choices.region(target), choices.between(0.0, 2.0)};
  } else {
    request.parameters.domain = Domain::square;
  }
  if (choices.one_in(4)) request.transfer = TransferMode::shape;
  try {
    require_coated(target, request.target_patch, mix(target, meshes[0], meshes[1], request));
  } catch (const Error&) {
  }
}

void transplant_part(Bytes bytes) {
  Choices choices(bytes);
  const Mesh host = choices.mesh();
  const Mesh part = choices.mesh();
  TransplantRequest request;
  request.target_region = choices.patch(host);
  if (choices.one_in(2)) request.part_region = choices.patch(part);
  if (choices.one_in(3)) {
    SimilarityMove move;
    move.translate =
        Vector3d(choices.between(-1, 1), choices.between(-1, 1), choices.between(-1, 1));
    for (double& scale : move.scale) scale = choices.between(0.2, 2.0);
    request.place = move;
    request.snap = choices.one_in(2);
  }
  if (choices.one_in(2)) request.parameters.remesh = Remeshing::none;
  try {
    const Transplanted result = transplant(host, part, request);
    validate_indices(result.mesh);
    std::vector<Index> sources = result.host_vertices;
    for (const Index v : result.region) sources.at(v) = kNoIndex;
    require_unmoved(host, result.mesh, sources);
  } catch (const Error&) {
  }
}

void remesh_region(Bytes bytes) {
  Choices choices(bytes);
  const Mesh mesh = choices.mesh();
  RemeshRequest request;
  request.region = choices.region(mesh);
  request.scale = choices.between(0.4, 3.0);
  try {
    const Remeshed result = remesh(mesh, request, bounded(100'000));
    validate_indices(result.mesh);
    require_unmoved(mesh, result.mesh, result.kept);
    for (const Index v : result.region) require(is_finite(result.mesh.positions[v]), "finite");
  } catch (const Error&) {
  }
}

void parameterize_region(Bytes bytes) {
  Choices choices(bytes);
  const Mesh mesh = choices.mesh();
  ParameterizeRequest request;
  request.region = choices.patch(mesh);
  if (choices.one_in(2)) request.domain = Domain::square;
  try {
    const Parameterized result = parameterize(mesh, request);
    for (const Eigen::Vector2d& p : result.map.points) require(p.allFinite(), "finite");
  } catch (const Error&) {
  }
}

void peel_region(Bytes bytes) {
  Choices choices(bytes);
  const Mesh mesh = choices.mesh();
  PeelRequest request;
  request.region = choices.region(mesh);
  request.detail_size = choices.above_zero();
  try {
    const Peeled result = peel(mesh, request);
    require_kept_outside(mesh, result.mesh, result.moved);
  } catch (const Error&) {
  }
}

void check_and_fix(Bytes bytes) {
  Choices choices(bytes);
  Mesh mesh = choices.mesh();
  CheckReport report = check(mesh);
  add_self_intersections(mesh, report);
  fix(mesh);
  validate_indices(mesh);
  const Mesh once = mesh;
  require(!fix(mesh).changed(), "what is repaired needs no repair");
  require(mesh.positions == once.positions, "and stays");
}

void fill_and_resample(Bytes bytes) {
  Choices choices(bytes);
  Mesh mesh = choices.mesh();
  FillRequest request;
  if (choices.one_in(2)) request.shape = FillShape::flat;
  request.borders = choices.one_in(2);
  try {
    fix(mesh);
    const FilledHoles filled = fill_holes(mesh, request);
    validate_indices(filled.mesh);
    validate_attributes(filled.mesh);
    require(std::ranges::all_of(filled.mesh.positions, is_finite), "finite");
    for (const Hole& hole : find_holes(filled.mesh)) {
      require(!request.borders || !hole.trouble.empty(), "a hole without trouble is filled");
    }
    const DecimatedMesh coarse = decimate(filled.mesh, {.share = 0.5});
    validate_attributes(coarse.mesh);
    validate_attributes(subdivide(coarse.mesh, {.times = 1, .smooth = choices.one_in(2)}));
  } catch (const Error&) {
  }
}

std::vector<std::string> some_bytes() {
  std::vector<std::string> seeds;
  std::mt19937 random(23);  // NOLINT(cert-msc51-cpp): the same every time
  for (int k = 0; k < 40; ++k) {
    std::string bytes(64, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    seeds.push_back(std::move(bytes));
  }
  return seeds;
}

constexpr std::array kOperationTargets{
    Target{"deform", "any region, move and setting; the certificate tells the truth", &deform_mesh,
           &some_bytes, "", 300},
    Target{"coat", "any patches of two meshes", &coat_mesh, &some_bytes, "", 150},
    Target{"mix", "any patches of three meshes", &mix_meshes, &some_bytes, "", 150},
    Target{"transplant", "any part on any mesh", &transplant_part, &some_bytes, "", 150},
    Target{"remesh", "any region", &remesh_region, &some_bytes, "", 150},
    Target{"parameterize", "any region", &parameterize_region, &some_bytes, "", 300},
    Target{"peel", "any region and size", &peel_region, &some_bytes, "", 300},
    Target{"doctor", "checked, repaired, repaired again: nothing left", &check_and_fix, &some_bytes,
           "", 500},
    Target{"fill", "holes filled, then decimated and subdivided", &fill_and_resample, &some_bytes,
           "", 200}};

}  // namespace

std::span<const Target> operation_targets() {
  return kOperationTargets;
}

}  // namespace lapwing::fuzz
