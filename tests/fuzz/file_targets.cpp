// Fuzz targets that read files of every format and write them again.
#include <array>
#include <numeric>

#include "fuzz/targets.h"
#include "io/gltf_sample.h"
#include "io/jpeg_file.h"
#include "io/rich_mesh.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/file_colors.h"
#include "lapwing/io/image.h"
#include "lapwing/io/materials.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/point_table.h"
#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/wrap/landmarks.h"

namespace lapwing::fuzz {
namespace {

namespace fs = std::filesystem;

bool is_same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // Here NaN counts as equal to NaN.
  for (int k = 0; k < 3; ++k) {
    if (a[k] != b[k] && !(std::isnan(a[k]) && std::isnan(b[k]))) return false;
  }
  return true;
}

bool are_same(const Positions& a, const Positions& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same);
}

// Requires that writing an unchanged mesh in its own format reproduces every byte of the file.
void require_kept(const Mesh& mesh, const fs::path& from, std::string_view name) {
  const fs::path to = file_of("", "kept-" + std::string(name));
  write_mesh(mesh, to);
  require(FileBytes::read(to).view() == FileBytes::read(from).view(),
          "what was not changed is written as it was");
}

// Requires that reading a newly written file gives the mesh that was written.
void require_read_back(const Mesh& mesh, std::string_view name, const WriteOptions& options) {
  const fs::path to = file_of("", name);
  try {
    write_mesh(mesh, to, options);
  } catch (const InputError&) {
    return;  // numbers that do not fit the format, say
  }
  const Mesh again = read_mesh(to);
  require(are_same(again.positions, mesh.positions), "positions come back");
  require(again.face_starts() == mesh.face_starts(), "faces come back");
  require(again.face_vertices() == mesh.face_vertices(), "corners come back");
}

// Returns whether `read` is `wanted` up to the rounding of a file in single precision.
bool is_stored(const Eigen::Vector3d& wanted, const Eigen::Vector3d& read) {
  for (int k = 0; k < 3; ++k) {
    const double as_float = static_cast<double>(static_cast<float>(wanted[k]));
    const bool are_no_numbers = std::isnan(wanted[k]) && std::isnan(read[k]);
    if (read[k] != wanted[k] && read[k] != as_float && !are_no_numbers) return false;
  }
  return true;
}

// A comparison for formats that store only the corners of triangles.
void require_corners(const Mesh& written, const Mesh& read) {
  require(read.face_count() == written.face_count(), "triangles come back");
  for (std::size_t c = 0; c < read.face_vertices().size(); ++c) {
    require(is_stored(written.positions[written.face_vertices()[c]],
                      read.positions[read.face_vertices()[c]]),
            "corners come back where they were");
  }
}

void require_stl_anew(const Mesh& mesh, Encoding encoding) {
  const fs::path to = file_of("", "anew.stl");
  try {
    write_mesh(mesh, to, {.encoding = encoding, .anew = true});
  } catch (const InputError&) {
    return;
  }
  require_corners(mesh, read_mesh(to));
}

// Requires that moving one vertex changes only this vertex in the file.
void require_moved(const Mesh& mesh, std::string_view name) {
  if (mesh.positions.empty()) return;
  const fs::path to = file_of("", "moved-" + std::string(name));
  Mesh moved = mesh;
  moved.positions.back() += Eigen::Vector3d(1.0, -2.0, 0.5);
  try {
    write_mesh(moved, to);
  } catch (const InputError&) {
    return;
  }
  const Mesh again = read_mesh(to);
  require(again.face_starts() == mesh.face_starts(), "faces come back with a vertex moved");
  if (to.extension() == ".stl") {  // its vertices are found again by position
    require_corners(moved, again);
    return;
  }
  require(again.face_vertices() == mesh.face_vertices(), "corners come back with a vertex moved");
  require(again.vertex_count() == mesh.vertex_count(), "vertices come back with one moved");
  require(std::equal(mesh.positions.begin(), mesh.positions.end() - 1, again.positions.begin(),
                     is_same),
          "what did not move comes back");
  require(is_stored(moved.positions.back(), again.positions.back()), "what moved comes back");
}

// Requires that a damaged file is either rejected or read as a valid mesh. A file that is written
// from this mesh must have no defects.
void require_read_past_defects(const fs::path& path) {
  DamagedMesh damaged;
  try {
    damaged = read_damaged_mesh(path);
  } catch (const InputError&) {
    return;
  }
  validate_indices(damaged.mesh);
  validate_attributes(damaged.mesh);
  if (!damaged.defects.empty()) require_read_back(damaged.mesh, "past-defects.ply", {});
}

void read_and_write(Bytes bytes, std::string_view name) {
  const fs::path path = file_of(bytes, name);
  Mesh mesh;
  try {
    mesh = read_mesh(path);
  } catch (const InputError&) {
    return require_read_past_defects(path);
  }
  validate_indices(mesh);
  require(mesh.face_starts().back() == mesh.face_vertices().size(), "faces end with the corners");
  require_kept(mesh, path, name);
  if (path.extension() == ".stl") {
    require_stl_anew(mesh, Encoding::ascii);
    require_stl_anew(mesh, Encoding::little_endian);
  } else {
    require_read_back(mesh, "anew-" + std::string(name), {.anew = true});
  }
  require_read_back(mesh, "anew.ply", {});
  require_read_back(mesh, "anew.obj", {});
  require_read_back(mesh, "anew.off", {});
  require_moved(mesh, name);
}

// glTF stores local coordinates as 32-bit floats or integers. Positions are therefore rounded, and
// vertices with equal positions are merged.
void read_glb(Bytes bytes) {
  const fs::path path = file_of(bytes, "a.glb");
  Mesh mesh;
  try {
    mesh = read_mesh(path);
  } catch (const InputError&) {
    return require_read_past_defects(path);
  }
  validate_indices(mesh);
  require_kept(mesh, path, "a.glb");
  require_read_back(mesh, "anew.ply", {});
  const fs::path anew = file_of("", "anew.glb");
  const fs::path moved = file_of("", "moved.glb");
  try {
    write_mesh(mesh, anew, {.anew = true});
    read_mesh(anew);
    if (mesh.positions.empty()) return;
    Mesh other = mesh;
    other.positions.back() += Eigen::Vector3d(1.0, -2.0, 0.5);
    write_mesh(other, moved);
  } catch (const InputError&) {
    return;
  }
  require(read_mesh(moved).face_count() == mesh.face_count(), "faces come back with one moved");
}

void read_colors(Bytes bytes) {
  try {
    std::vector<std::string> notes;
    read_material_library(file_of(bytes, "a.mtl"), notes);
  } catch (const InputError&) {
    // It is a file of another kind, such as a web page.
  }
  Mesh mesh;
  mesh.edit_attributes().material_libraries = {"a.mtl"};
  mesh.edit_attributes().materials = {"wool", "wax"};
  read_file_colors(mesh, file_of("", "colors.obj"));
}

void read_picture(Bytes bytes) {
  const fs::path path = file_of(bytes, "a.png");
  try {
    const ImageSize size = read_image_size(path);
    // A tiny file can declare a huge image, and writing it would take most of the time.
    constexpr std::uint64_t kMostPixels = 1U << 8U;
    if (std::uint64_t{size.width} * size.height > kMostPixels) return;
    const Image image = read_image(path);
    require(image.rgba.size() == std::size_t{4} * image.width * image.height, "all pixels");
    read_image(file_of(encode_png(image), "again.png"));
  } catch (const InputError&) {
  }
}

void read_table(Bytes bytes, std::string_view name) {
  try {
    const fs::path path = file_of(bytes, name);
    const PointTable table = read_point_table(path);
    require(bytes_of(table) == FileBytes::read(path).view(),
            "what was not changed is written as it was");
  } catch (const InputError&) {
  }
}

// The first byte selects the kind of file. Two files of points are separated by "|".
void read_landmark_files(Bytes bytes) {
  constexpr std::array<std::string_view, 5> kNames{"a.csv", "a.json", "a.txt", "a.fcsv",
                                                   "a.mrk.json"};
  const std::string_view text = text_of(bytes);
  if (text.empty()) return;
  const std::string_view name = kNames[bytes[0] % kNames.size()];
  const std::size_t bar = text.find('|');
  LandmarkSpec spec{.file = file_of(text.substr(1, bar - 1), name)};
  if (bar != std::string_view::npos) {
    spec.scan_file = file_of(text.substr(bar + 1), "scan-" + std::string(name));
  }
  static const Mesh ball = icosphere(1);
  try {
    std::vector<std::string> notes;
    const LandmarkSpec read = with_rows(spec, {}, notes);
    const TargetSpec targets = targets_of(read, ball, ball);
    require(targets.rows.size() == read.rows.size(), "each row is a landmark");
    VertexSet all(ball.vertex_count());
    std::iota(all.begin(), all.end(), Index{0});
    for (const lapwing::Target& target : resolve_targets(targets, all, {}, ball)) {
      require(point_of(target, ball.positions).allFinite(), "a landmark is on the template");
      require(target.position.allFinite(), "a landmark has a position on the scan");
    }
  } catch (const InputError&) {
  }
}

std::vector<std::string> meshes_with(std::string_view extension) {
  std::vector<std::string> seeds;
  for (const Storage& storage : kStorages) {
    if (!storage.name.ends_with(extension)) continue;
    for (const Mesh& mesh : {rich_mesh(), icosphere(0), Mesh()}) {
      const fs::path path = file_of("", "seed" + std::string(extension));
      write_mesh(mesh, path, {.encoding = storage.encoding});
      seeds.emplace_back(FileBytes::read(path).view());
    }
  }
  return seeds;
}

std::vector<std::string> obj_seeds() {
  std::vector<std::string> seeds = meshes_with(".obj");
  seeds.emplace_back(
      "v 0 0 0 1\nv 1 0 0 0.5 0.2 0.1\nv 0 1 0\nvt 0 0 0\nvn 0 0 1\nvp 1\n"
      "o a\ng b c\ns 1\nusemtl m\nmtllib a b.mtl\nf 1/1/1 2//1 3/1 \\\n -1\nl 1 2\np 1\n");
  return seeds;
}
std::vector<std::string> off_seeds() {
  std::vector<std::string> seeds = meshes_with(".off");
  seeds.emplace_back(
      "STCNOFF # all\n3 1 0\n0 0 0 0 0 1 0.1 0.2 0.3 1 0 0\n"
      "1 0 0 0 0 1 0.1 0.2 0.3 1 1 0\n0 1 0 0 0 1 255 2 3 255 0 1\n3 0 1 2 0.5 1 0\n");
  return seeds;
}
std::vector<std::string> ply_seeds() {
  std::vector<std::string> seeds = meshes_with(".ply");
  seeds.emplace_back(
      "ply\nformat ascii 1.0\ncomment c\nobj_info i\nelement vertex 3\n"
      "property uchar red\nproperty double x\nproperty float y\nproperty short z\n"
      "property list uchar int many\nelement face 1\n"
      "property list uchar uint vertex_indices\nproperty list uchar float texcoord\n"
      "element edge 1\nproperty int vertex1\nend_header\n"
      "1 0 0 0 0\n2 1 0 0 1 5\n3 0 1 0 2 7 8\n3 0 1 2 6 0 0 1 0 0 1\n4\n");
  seeds.emplace_back(
      "ply\nformat ascii 1.0\nelement tristrips 2\nproperty list int int vertex_indices\n"
      "property uchar cost\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "property int label\nend_header\n"
      "5 0 1 2 3 -1 7\n6 0 1 1 2 -1 3 8\n0 0 0\n1 0 0\n0 1 0\n1 1 1\n3 0 1 3 5\n");
  return seeds;
}
std::vector<std::string> glb_seeds() {
  std::vector<std::string> seeds;
  const fs::path path = file_of("", "seed.glb");
  for (const Mesh& mesh : {rich_mesh(), icosphere(0), Mesh()}) {
    write_mesh(mesh, path);
    seeds.emplace_back(FileBytes::read(path).view());
  }
  test::GltfSample sample;
  sample.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  sample.add(std::vector<std::uint16_t>{2}, 5123, "SCALAR", 1);
  sample.add(std::vector<float>{0, 3, 0}, 5126, "VEC3", 1);
  sample.add_accessor(
      R"("bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,3,0],)"
      R"("sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},)"
      R"("values":{"bufferView":2}})");
  const std::string primitive = R"({"attributes":{"POSITION":3},"mode":5})";
  seeds.push_back(sample.glb(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"mesh":0,)"
                             R"("scale":[2,2,-2]}],"meshes":[{"primitives":[)" +
                             primitive + "]}]"));
  // In this seed, two nodes show one mesh, and a byte-order mark precedes the JSON text.
  seeds.push_back(sample.glb(R"("nodes":[{"mesh":0},{"mesh":0,"translation":[2,0,0]}],"meshes":[)"
                             R"({"primitives":[)" +
                                 primitive + "]}]",
                             "\xEF\xBB\xBF"));
  // In this seed, one node shows two instances of a mesh, the second of which has a scale of 0.
  const std::size_t translations =
      sample.add(std::vector<float>{0, 0, 0, 2, 0, 0}, 5126, "VEC3", 2);
  const std::size_t scales = sample.add(std::vector<float>{1, 1, 1, 0, 0, 0}, 5126, "VEC3", 2);
  seeds.push_back(
      sample.glb(R"("extensionsUsed":["EXT_mesh_gpu_instancing"],"nodes":[{"mesh":0,"extensions":)"
                 R"({"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" +
                 std::to_string(translations) + R"(,"SCALE":)" + std::to_string(scales) +
                 R"(}}}}],"meshes":[{"primitives":[)" + primitive + "]}]"));
  seeds.push_back(
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0}}]}],"buffers":[{"byteLength":36,"uri":"data:;base64,)"
      R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"bufferViews":[{"buffer":0,)"
      R"("byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,)"
      R"("type":"VEC3"}]})");
  return seeds;
}
std::vector<std::string> mtl_seeds() {
  return {
      "newmtl wool\nKd 0.1 0.2 0.3\nmap_Kd -o 1 2 -s 0.5 2 -clamp on wool.png\n"
      "newmtl wax\r\nKd spectral x\nmap_Kd \"w x.png\"\n# end\n"};
}
std::vector<std::string> picture_seeds() {
  Image image{.width = 3, .height = 2, .rgba = std::vector<std::uint8_t>(24, 200)};
  std::vector<std::string> seeds{encode_png(image)};
  image.rgba[3] = 7;
  seeds.push_back(encode_png(image, "made by a test"));
  // TGA and BMP of one pixel.
  seeds.emplace_back("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\1\2\3", 21);
  seeds.emplace_back(
      "BM\x3A\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0"
      "\0\0\0\0\4\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\1\2\3\0",
      58);
  // JPEG: grey, colour of fewer samples, and inks, each as baseline and progressive.
  for (JpegOptions options :
       {JpegOptions{.pixels = TJPF_GRAY, .sampling = TJSAMP_GRAY, .quality = 80},
        JpegOptions{.pixels = TJPF_RGB, .sampling = TJSAMP_420, .quality = 80},
        JpegOptions{.pixels = TJPF_CMYK, .sampling = TJSAMP_444, .quality = 80}}) {
    const std::vector<std::uint8_t> values{0,  40, 80,  120, 160, 200, 240, 30, 70,  110, 150, 190,
                                           20, 60, 100, 140, 180, 220, 10,  50, 255, 130, 170, 210};
    const std::size_t count =
        std::size_t{6} * static_cast<std::size_t>(tjPixelSize[options.pixels]);
    seeds.push_back(jpeg_file(std::span(values).first(count), 3, options));
    options.progressive = true;
    seeds.push_back(jpeg_file(std::span(values).first(count), 3, options));
  }
  return seeds;
}
std::vector<std::string> csv_seeds() {
  return {"x,y,z\n0,1,2\n-1e3, 2.5 ,+7\n",
          "vertex; x; y; z; weight\r\n3; 0,5; 1; 2; 1\r\n",
          "x y z nx ny nz qw qx qy qz\n0 0 0 0 0 1 1 0 0 0\n",
          "1\t2\t3\n# c\n\n4\t5\t6\n",
          "\"a \"\"b\"\", c\",1,2,3,\n",
          "# columns = id,x,y,z,label\ni,1,2,3,F-1,,2\r\r\n"};
}
std::vector<std::string> markups_seeds() {
  return {R"({"markups": [{"controlPoints": [{"label": "a", "position": [1, 2.5, -3e0]},)"
          R"({"position": ""}]}, {"type": "Plane"}]})"};
}
std::vector<std::string> landmarks_seeds() {
  const std::string kTable(1, '\0');
  const std::string kPoints = R"({"markups": [{"coordinateSystem": "RAS", "controlPoints": [)"
                              R"({"label": "a", "position": [0, 0, 1]}]}]})";
  return {kTable + "vertex,x,y,z,weight\n3,0,0,1,2\n",
          kTable + "a,0,0,1,0,0,2\n",
          kTable + "x,y,z,label\n0,0,1,a\n1,0,0,b|label,x,y,z\nb,1,0,0\na,0,0,2\n",
          "\1[[3, 0, 0, 1], {\"vertex\": 5, \"scan_vertex\": 6, \"weight\": 2, \"label\": \"b\"},"
          " {\"point\": [0, 0, 1], \"position\": [0, 0, 2]}, [1, 2]]",
          "\2 3 0 0 1\n4 1 0 0\n",
          "\3# CoordinateSystem = 0\n# columns = id,x,y,z,label\ni,0,0,-1,F-1|"
          "# columns = id,x,y,z,label\ni,0,0,1,F-1\n",
          "\4" + kPoints + "|" + kPoints};
}
std::vector<std::string> npy_seeds() {
  const auto npy = [](std::string header, const std::string& data) {
    header.resize(118, ' ');
    return "\x93NUMPY\x01" + std::string("\0\x76\0", 3) + header + data;
  };
  return {npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", std::string(24, '\1')),
          npy("{'descr': '>f8', 'fortran_order': True, 'shape': (1, 3), }", std::string(24, '\2')),
          npy("{'descr': [('x', '<f8'), ('y', '<f8'), ('z', '<f8')], 'fortran_order': False, "
              "'shape': (1,), }",
              std::string(24, '\3'))};
}

constexpr std::array kFileTargets{
    Target{"obj", "read, written in place and anew, read back",
           [](Bytes bytes) { read_and_write(bytes, "a.obj"); }, &obj_seeds, "obj.dict", 400},
    Target{"off", "the same of OFF", [](Bytes bytes) { read_and_write(bytes, "a.off"); },
           &off_seeds, "off.dict", 400},
    Target{"ply", "the same of PLY", [](Bytes bytes) { read_and_write(bytes, "a.ply"); },
           &ply_seeds, "ply.dict", 400},
    Target{"stl", "the same of STL", [](Bytes bytes) { read_and_write(bytes, "a.stl"); },
           [] { return meshes_with(".stl"); }, "stl.dict", 400},
    Target{"glb", "glTF, written in place and anew", &read_glb, &glb_seeds, "gltf.dict", 400},
    Target{"mtl", "material libraries, with what they name", &read_colors, &mtl_seeds, "mtl.dict",
           400},
    Target{"picture", "PNG, JPEG, BMP, TGA; written as PNG and read", &read_picture, &picture_seeds,
           "", 400},
    Target{"csv", "tables of points, written as they were",
           [](Bytes bytes) { read_table(bytes, "a.csv"); }, &csv_seeds, "", 400},
    Target{"markups", "the same of control points of 3D Slicer",
           [](Bytes bytes) { read_table(bytes, "a.mrk.json"); }, &markups_seeds, "", 400},
    Target{"landmarks", "files of landmarks, placed on a template", &read_landmark_files,
           &landmarks_seeds, "", 400},
    Target{"npy", "the same of arrays of numpy", [](Bytes bytes) { read_table(bytes, "a.npy"); },
           &npy_seeds, "npy.dict", 400}};

}  // namespace

std::span<const Target> file_targets() {
  return kFileTargets;
}

}  // namespace lapwing::fuzz
