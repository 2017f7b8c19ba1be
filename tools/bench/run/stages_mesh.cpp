#include <filesystem>
#include <string>

#include "lapwing/doctor/check.h"
#include "lapwing/io/mesh_file.h"
#include "run/stages.h"
#include "run/temporary_mesh.h"

namespace lapwing::bench {
namespace {

void measure_reading(BenchRun& run, const Subject& subject, const std::string& stage,
                     const std::string& extension) {
  if (!run.wants(stage, kLapwing, kProcessor, subject)) return;
  // Copy the bare mesh: a mesh that was read from a file is written back as that file.
  Mesh mesh;
  mesh.positions = subject.mesh.positions;
  for (const Triangle& t : subject.mesh.topology().triangles) mesh.add_face(t);
  const TemporaryMesh file(mesh, extension);
  Measurement* const row = run.measure(stage, kLapwing, subject, [&] { read_mesh(file.path()); });
  row->counts["file bytes"] = std::filesystem::file_size(file.path());
}

}  // namespace

void measure_mesh_stages(BenchRun& run, const Subject& subject) {
  measure_reading(run, subject, "read OBJ", ".obj");
  measure_reading(run, subject, "read PLY", ".ply");
  run.measure("topology", kLapwing, subject, [&] { build_topology(subject.mesh); });
  run.measure("check", kLapwing, subject, [&] { check(subject.mesh); });
}

}  // namespace lapwing::bench
