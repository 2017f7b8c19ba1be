#include "lapwing/io/gltf_writer.h"

#include <numeric>

#include "lapwing/io/gltf_file.h"
#include "lapwing/io/gltf_primitives.h"
#include "lapwing/io/uri.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

void report_losses(const Mesh& mesh, MeshFormat format, WriteReport& report) {
  const MeshAttributes& a = mesh.attributes();
  std::size_t polygons = 0;
  std::vector<bool> used(mesh.vertex_count(), false);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    polygons += mesh.face(f).size() > 3 ? 1 : 0;
    for (const Index v : mesh.face(f)) used[v] = true;
  }
  const auto loose = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  report_loss(report, format, "polygons, now written as triangles", polygons);
  report_loss(report, format, "vertices without a face", loose);
  if (narrowest_type(numbers_of(mesh.positions)) != Scalar::float32) {
    report_loss(report, format, "positions in double precision, now rounded to 32-bit floats",
                mesh.vertex_count());
  }
  report_loss(report, format, "face colours", a.face_colors.size());
  report_loss(report, format, "comments", a.comments.size());
  report_extras(report, format, a);
  report_uneditable(report, format, a);
}

}  // namespace

std::vector<FileContent> write_gltf(const Mesh& mesh, const std::filesystem::path& target,
                                    WriteReport& report) {
  const MeshFormat format = format_of(target);
  report_losses(mesh, format, report);
  const MeshAttributes& a = mesh.attributes();
  const std::string frame = R"({"bufferViews":[],"accessors":[]})";
  GltfAppender appender(frame, 0, 0);
  std::vector<Index> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), Index{0});
  const std::string primitives =
      add_primitives(mesh, faces, Eigen::Affine3d::Identity(), 0, appender);

  const std::string name = quoted_json(target.stem().string());
  std::string head = R"({"asset":{"version":"2.0","generator":"Lapwing"})";
  if (!primitives.empty()) {
    head += R"(,"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":)" + name +
            R"(}],"meshes":[{"name":)" + name + R"(,"primitives":[)" + primitives + "]}]";
    const std::string buffer_name = target.stem().string() + ".bin";
    head += R"(,"buffers":[{"byteLength":)" + std::to_string(appender.data().size());
    if (format == MeshFormat::gltf) head += R"(,"uri":")" + uri_of_path(buffer_name) + '"';
    head += "}]";
  }
  if (!a.materials.empty()) {
    std::string materials;
    for (const std::string& material : a.materials) {
      materials += (materials.empty() ? "" : ",") + (R"({"name":)" + quoted_json(material)) + "}";
    }
    head += R"(,"materials":[)" + materials + "]";
  }
  TextEdits edits;
  appender.finish(edits);
  const std::string json =
      head + (primitives.empty() ? "}" : "," + edits.applied_to(frame).substr(1));

  const std::string_view data = appender.data();
  if (format == MeshFormat::glb) {
    return {{target, glb_of(json, primitives.empty() ? std::nullopt : std::optional(data), {})}};
  }
  std::vector<FileContent> files{{target, json}};
  if (!primitives.empty()) {
    files.push_back({target.parent_path() / (target.stem().string() + ".bin"), std::string(data)});
  }
  return files;
}

}  // namespace lapwing
