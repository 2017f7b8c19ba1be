#include "lapwing/run/run_step.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/coating/coat.h"
#include "lapwing/deform/modifiers/attachments.h"
#include "lapwing/doctor/self_intersections.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/number_table.h"
#include "lapwing/transplant/transplant.h"
#include "lapwing/wrap/wrap.h"

namespace lapwing {
namespace {

// Opens the files that no earlier step opened. Returns the indices of `files` in
// `on.result.carried`.
std::vector<std::size_t> open_carried(std::span<const CarrySpec> files, const StepContext& on) {
  std::vector<AttachmentFile>& open = on.result.carried;
  std::vector<std::size_t> chosen;
  for (const CarrySpec& spec : files) {
    const std::filesystem::path path = (on.base_directory / spec.file).lexically_normal();
    auto at = std::find_if(open.begin(), open.end(),
                           [&](const AttachmentFile& file) { return file.file() == path; });
    const auto number = static_cast<std::size_t>(at - open.begin());
    if (at == open.end()) {
      at = open.insert(at, AttachmentFile(path));
      on.result.inputs.push_back(split_mesh_path(path).file);
    }
    if (!spec.save.empty()) at->save = on.base_directory / spec.save;
    if (std::count(chosen.begin(), chosen.end(), number) == 0) chosen.push_back(number);
  }
  return chosen;
}

StepReport run_step(const DeformRequest& step, const StepContext& on) {
  DeformRequest named = step;
  if (on.number > 0) named.where = "step " + std::to_string(on.number);
  named.carry.clear();
  const std::vector<std::size_t> carried = open_carried(step.carry, on);
  if (!named.targets.file.empty()) {
    const std::filesystem::path file = on.base_directory / named.targets.file;
    named.targets.rows = read_target_rows(file);
    named.targets.where = file.string();
    on.result.inputs.emplace_back(file);
  }
  RunResult& result = on.result;
  const Positions rest = carried.empty() ? Positions() : result.mesh.positions;
  Deformed done = deform(std::move(result.mesh), named, on.kernels, result.deformed, on.progress);
  if (!carried.empty()) {
    stage("carry", done.timings, on.progress, [&] {
      const AttachmentDeformer carrier(rest, done);
      for (const std::size_t k : carried) {
        result.carried[k].move(carrier.carry(result.carried[k].positions()));
      }
    });
  }
  result.mesh = std::move(done.mesh);
  result.warn(done.warnings);
  result.note(done.notes);
  StepReport report = report_of(done);
  result.region = std::move(done.region);
  return report;
}

std::vector<SharedSource> read_sources(std::span<const FileSource> sources, const StepContext& on,
                                       StageTimings& timings) {
  std::vector<SharedSource> meshes;
  stage("source", timings, on.progress,
        [&] { meshes = read_source_meshes(sources, on.base_directory, on.meshes); });
  for (std::size_t k = 0; k < sources.size(); ++k) {
    if (sources[k].mesh.empty()) continue;
    on.result.inputs.push_back(split_mesh_path(on.base_directory / sources[k].mesh).file);
    on.result.note(reading_notes(*meshes[k]));
  }
  return meshes;
}

// Stores the result of `coat` at `positions` in `result`: mesh, region and warnings. `timings`
// contains the earlier stages.
StepReport take_over(const LayeredCoat& coat, StageTimings timings, Positions positions,
                     RunResult& result) {
  StepReport report;
  report.roi = coat.target_patch().vertices.size();
  report.belt = coat.target_patch().loop.size();
  report.free = coat.free_count();
  report.timings = std::move(timings);
  const StageTimings own = coat.timings();
  for (const auto& [name, ms] : own.stages()) report.timings.add(name, ms);
  report.coat = coat.report(positions);
  result.region = {coat.target_patch().vertices, border_of(coat.target_patch()), {}};
  for (const TargetHandle& handle : coat.handles()) {
    report.handles.push_back(handle.vertices.size());
    result.region.handles.push_back(handle.vertices);
  }
  result.warn(texts_of(coat.warnings()));
  if (const RemeshResult* remeshed = coat.remeshed()) {
    // The original position of a new vertex is its position in the remeshed patch.
    Positions original = remeshed->mesh.positions;
    for (std::size_t v = 0; v < original.size(); ++v) {
      if (remeshed->kept[v] != kNoIndex) original[v] = result.original[remeshed->kept[v]];
    }
    result.original = std::move(original);
    result.mesh = remeshed->mesh;
  }
  result.mesh.positions = std::move(positions);
  return report;
}

StepReport run_step(const CoatStep& step, const StepContext& on) {
  StageTimings timings;
  const std::vector<SharedSource> sources = read_sources({&step.source, 1}, on, timings);
  const PreparedCoat coat({step.source, step.target_patch, step.parameters, step.where},
                          on.result.mesh, sources.front(), on.kernels, on.progress);
  return take_over(coat.layers(), std::move(timings), coat.positions(step.source.amplitude),
                   on.result);
}

StepReport run_step(const MixStep& step, const StepContext& on) {
  StageTimings timings;
  const std::vector<SharedSource> sources = read_sources(step.sources, on, timings);
  const LayeredCoat mix(layered(step), on.result.mesh, sources, on.kernels, on.progress);
  return take_over(mix, std::move(timings), mix.positions(1.0), on.result);
}

StepReport run_step(const TransplantStep& step, const StepContext& on) {
  RunResult& result = on.result;
  StepReport report;
  std::shared_ptr<const Mesh> read;
  stage("part", report.timings, on.progress,
        [&] { read = read_part_mesh(step, on.base_directory, on.meshes); });
  if (read) {
    result.inputs.push_back(split_mesh_path(on.base_directory / step.part).file);
    result.note(reading_notes(*read));
  }
  const Mesh& part = read ? *read : result.mesh;
  const std::string name = read ? step.part.stem().string() : "part";
  Transplanted done = transplant(result.mesh, part, name, step, on.kernels, on.progress);
  for (const auto& [stage_name, ms] : done.timings.stages()) report.timings.add(stage_name, ms);
  result.warn(texts_of(done.report.warnings));
  report.roi = done.region.size();
  report.belt = done.belt.size();
  report.free = report.roi - report.belt;
  report.transplant = std::move(done.report);
  Positions original = std::move(done.placed);
  for (std::size_t v = 0; v < original.size(); ++v) {
    const Index host = done.host_vertices[v];
    if (host != kNoIndex) original[v] = result.original[host];
  }
  result.original = std::move(original);
  result.mesh = std::move(done.mesh);
  result.region = {std::move(done.region), std::move(done.belt), {}};
  return report;
}

StepReport run_step(const PeelRequest& step, const StepContext& on) {
  StepReport report;
  Peeled peeled;
  stage("peel", report.timings, on.progress,
        [&] { peeled = peel(on.result.mesh, step, on.progress); });
  const VertexSet region = resolve(step.region, on.result.mesh);
  report.roi = region.size();
  report.free = peeled.moved.size();
  report.belt = report.roi - report.free;
  report.peel = PeelReport{peeled.mean_coating, peeled.largest_coating};
  on.result.region = {region, subtract(region, peeled.moved), {}};
  on.result.warn(peeled.warnings);
  on.result.mesh.positions = std::move(peeled.mesh.positions);
  return report;
}

// Replaces the mesh by one whose vertex v was vertex `old[v]`, or is new if this is kNoIndex.
// `old` may be shorter than the list of vertices; the rest is new.
void replace_mesh(Mesh mesh, std::span<const Index> old, RunResult& result) {
  Positions original = mesh.positions;
  for (std::size_t v = 0; v < old.size(); ++v) {
    if (old[v] != kNoIndex) original[v] = result.original[old[v]];
  }
  result.original = std::move(original);
  result.mesh = std::move(mesh);
}

std::vector<Index> first_vertices(std::size_t count) {
  std::vector<Index> vertices(count);
  std::iota(vertices.begin(), vertices.end(), Index{0});
  return vertices;
}

// Returns the report of a step that may have changed all vertices of `region`.
StepReport report_of_mesh_step(VertexSet region, StageTimings timings, RunResult& result) {
  StepReport report;
  report.roi = report.free = region.size();
  report.timings = std::move(timings);
  result.region = {std::move(region), {}, {}};
  return report;
}

StepReport run_step(const RemeshRequest& step, const StepContext& on) {
  StageTimings timings;
  Remeshed done;
  stage("remesh", timings, on.progress, [&] { done = remesh(on.result.mesh, step, on.progress); });
  on.result.warn(done.warnings);
  replace_mesh(std::move(done.mesh), done.kept, on.result);
  return report_of_mesh_step(std::move(done.region), std::move(timings), on.result);
}

StepReport run_step(const DecimateRequest& step, const StepContext& on) {
  StageTimings timings;
  DecimatedMesh done;
  stage("decimate", timings, on.progress,
        [&] { done = decimate(on.result.mesh, step, on.progress); });
  replace_mesh(std::move(done.mesh), done.kept, on.result);
  return report_of_mesh_step(first_vertices(done.kept.size()), std::move(timings), on.result);
}

StepReport run_step(const SubdivideRequest& step, const StepContext& on) {
  StageTimings timings;
  Mesh fine;
  stage("subdivide", timings, on.progress,
        [&] { fine = subdivide(on.result.mesh, step, on.progress); });
  const std::vector<Index> old = first_vertices(on.result.mesh.vertex_count());
  replace_mesh(std::move(fine), old, on.result);
  return report_of_mesh_step(first_vertices(on.result.mesh.vertex_count()), std::move(timings),
                             on.result);
}

StepReport run_step(const FillRequest& step, const StepContext& on) {
  StageTimings timings;
  FilledHoles done;
  stage("fill", timings, on.progress,
        [&] { done = fill_holes(on.result.mesh, step, on.progress); });
  on.result.warn(done.warnings);
  on.result.note(done.notes);
  const std::vector<Index> old = first_vertices(on.result.mesh.vertex_count());
  VertexSet added(done.vertices);
  std::iota(added.begin(), added.end(), static_cast<Index>(old.size()));
  if (done.holes > 0) replace_mesh(std::move(done.mesh), old, on.result);
  return report_of_mesh_step(std::move(added), std::move(timings), on.result);
}

// Returns, for each triangle, whether it intersects another triangle.
std::vector<char> intersecting(std::span<const Triangle> triangles, const Positions& positions) {
  std::vector<char> intersects(triangles.size(), 0);
  for (const auto& [a, b] : self_intersections(triangles, positions)) {
    intersects[a] = intersects[b] = 1;
  }
  return intersects;
}

// Returns the number of triangles that intersect others only in the pose `after`; nullopt if too
// many overlap.
std::optional<std::size_t> new_intersections(std::span<const Triangle> triangles,
                                             const Positions& before, const Positions& after) {
  try {
    const std::vector<char> old = intersecting(triangles, before);
    const std::vector<char> now = intersecting(triangles, after);
    return std::inner_product(now.begin(), now.end(), old.begin(), std::size_t{0}, std::plus<>(),
                              [](char in_result, char in_template) {
                                return static_cast<std::size_t>(in_result > in_template);
                              });
  } catch (const InputError&) {
    return std::nullopt;
  }
}

StepReport run_step(const WrapStep& step, const StepContext& on) {
  RunResult& result = on.result;
  StepReport report;
  std::shared_ptr<const Mesh> scan;
  LandmarkSpec landmarks;
  stage("scan", report.timings, on.progress, [&] {
    scan = on.meshes.mesh(on.base_directory, step.scan);
    std::vector<std::string> notes;
    landmarks = with_rows(step.landmarks, on.base_directory, notes);
    result.note(notes);
  });
  result.note(reading_notes(*scan));
  for (const std::filesystem::path& file :
       {split_mesh_path(step.scan).file, step.landmarks.file, step.landmarks.scan_file}) {
    if (!file.empty()) result.inputs.push_back(on.base_directory / file);
  }
  const WrapRequest request = wrap_request(step, landmarks, result.mesh, *scan);
  Wrapped done;
  stage("wrap", report.timings, on.progress,
        [&] { done = wrap(result.mesh, *scan, request, on.kernels, on.progress); });
  const Topology& topology = result.mesh.topology();
  const std::string trouble = why_failed(done.report, topology.triangles.size());
  if (!trouble.empty()) result.warn(std::array{trouble});
  std::optional<std::size_t> self_intersecting;
  stage("check", report.timings, on.progress, [&] {
    self_intersecting =
        new_intersections(topology.triangles, result.mesh.positions, done.positions);
  });
  report.wrap = WrapStepReport{std::move(done.report), bounds_of(scan->positions).diagonal(),
                               trouble, self_intersecting, std::move(done.distances)};
  result.mesh.positions = std::move(done.positions);
  result.region = {first_vertices(topology.vertex_count()), {}, {}};
  report.roi = report.free = result.region.roi.size();
  return report;
}

// Records the device. If it replaced another device that failed, adds a note once.
void record_device(const DeviceInfo& device, RunResult& result) {
  if (!device.took_over.empty() && device.took_over != result.report.device.took_over) {
    result.note(std::array{device.took_over});
  }
  result.report.device = device;
}

}  // namespace

WrapRequest wrap_request(const WrapStep& step, const LandmarkSpec& landmarks, const Mesh& wrapped,
                         const Mesh& scan) {
  WrapRequest request{.landmarks = targets_of(landmarks, wrapped, scan),
                      .aligned = step.aligned,
                      .stiffness = step.stiffness,
                      .mirror = step.mirror,
                      .detail = step.detail};
  request.landmarks.hard = step.hard;
  return request;
}

std::vector<TargetRow> read_target_rows(const std::filesystem::path& path) {
  const NumberTable table = read_number_table(path);
  const NumberColumns columns = number_columns(table);
  std::vector<TargetRow> rows;
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    rows.push_back(target_row(columns.of_row(table, r), table.place(r)));
  }
  return rows;
}

StepReport report_of(Deformed& done) {
  StepReport report;
  report.roi = done.region.roi.size();
  report.free = done.region.free_count();
  report.belt = done.region.belt.size();
  for (const VertexSet& handle : done.region.handles) report.handles.push_back(handle.size());
  report.timings = std::move(done.timings);
  report.deform = std::move(static_cast<DeformReport&>(done));
  return report;
}

std::vector<SharedSource> read_source_meshes(std::span<const FileSource> sources,
                                             const std::filesystem::path& base_directory,
                                             const MeshCache& meshes) {
  std::vector<SharedSource> all;
  for (const FileSource& source : sources) {
    all.push_back(source.mesh.empty() ? nullptr : meshes.mesh(base_directory, source.mesh));
  }
  return all;
}

std::shared_ptr<const Mesh> read_part_mesh(const TransplantStep& step,
                                           const std::filesystem::path& base_directory,
                                           const MeshCache& meshes) {
  return step.part.empty() ? nullptr : meshes.mesh(base_directory, step.part);
}

StepReport run_step(const Step& step, const StepContext& on) {
  // Only a following deform step on the same triangles can reuse the workspace.
  if (!std::holds_alternative<DeformRequest>(step)) on.result.deformed = {};
  StepReport report = std::visit([&](const auto& each) { return run_step(each, on); }, step);
  report.op = operation_of(step).name;
  record_device(on.kernels.device(), on.result);
  return report;
}

}  // namespace lapwing
