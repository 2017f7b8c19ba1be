#include <filesystem>
#include <memory>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>

#include "arrays.h"
#include "interruptible.h"
#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/io/image.h"
#include "lapwing/render/picture_request.h"
#include "lapwing/render/surface.h"
#include "module.h"
#include "result.h"

namespace lapwing::python {
namespace {

PictureRequest request_of(const py::dict& picture) {
  PictureRequest request;
  request.width = picture["width"].cast<std::uint32_t>();
  request.height = picture["height"].cast<std::uint32_t>();
  request.view = view_named(picture["view"].cast<std::string>());
  if (!picture["from_"].is_none()) {
    request.from = Eigen::Vector3d(picture["from_"].cast<std::array<double, 3>>().data());
  }
  request.up = one_of<UpAxis>("render: up", picture["up"].cast<std::string>(),
                              {{"y", UpAxis::y}, {"z", UpAxis::z}});
  request.background =
      one_of<Background>("render: background", picture["background"].cast<std::string>(),
                         {{"gradient", Background::gradient},
                          {"white", Background::white},
                          {"transparent", Background::transparent}});
  request.orthographic = picture["orthographic"].cast<bool>();
  request.wireframe = picture["wireframe"].cast<bool>();
  request.flat = picture["flat"].cast<bool>();
  if (!request.can_look()) {
    throw InputError(
        "render: from_: the direction must not be 0 or along the upward axis; "
        "view=\"top\" or \"bottom\" looks along it");
  }
  return request;
}

using Values = py::array_t<float, py::array::c_style | py::array::forcecast>;

Image picture_of(const Mesh& mesh, std::span<const float> values,
                 const std::optional<ScalarRange>& limits, const std::string& legend,
                 const PictureRequest& request, const std::string& device) {
  Surface surface(std::make_shared<gpu::Context>(gpu::ContextOptions{device}), mesh.positions,
                  mesh.topology());
  SurfacePaint paint(surface);
  paint.set_polygons(mesh);
  RenderOptions options = request.options();
  const bool colored = !values.empty();
  if (colored) {
    paint.set_scalars(values);
    options.style.color = SurfaceColor::scalar;
    options.style.range = limits;
    options.legend_title = legend;
  }
  return render_image(surface, paint, request.camera(mesh.positions, colored), options);
}

// Renders the mesh and returns the image. If `path` is not empty, also writes the image to a file.
py::array_t<std::uint8_t> render(const Mesh& mesh, const std::optional<Values>& values,
                                 std::optional<std::pair<float, float>> limits,
                                 const std::string& legend, const py::dict& picture,
                                 const std::string& device, const std::filesystem::path& path) {
  const PictureRequest request = request_of(picture);
  if (!path.empty() && path.extension() != ".png") {
    throw InputError("render: path: expected a name that ends in .png, got \"" + path.string() +
                     "\"");
  }
  std::vector<float> numbers;
  if (values) {
    numbers.assign(values->data(), values->data() + values->size());
    if (numbers.size() != mesh.vertex_count()) {
      throw InputError("render: values: expected one for each of the mesh's " +
                       std::to_string(mesh.vertex_count()) + " vertices, got " +
                       std::to_string(numbers.size()));
    }
  }
  std::optional<ScalarRange> range;
  if (limits) range = ScalarRange{limits->first, limits->second};
  const Image image = Interruptible(py::none()).call([&](const Progress&) {
    Image drawn = picture_of(mesh, numbers, range, legend, request, device);
    if (!path.empty()) write_png(path, drawn);
    return drawn;
  });
  py::array_t<std::uint8_t> array({static_cast<py::ssize_t>(image.height),
                                   static_cast<py::ssize_t>(image.width), py::ssize_t{4}});
  std::copy(image.rgba.begin(), image.rgba.end(), array.mutable_data());
  return array;
}

// Returns an image for notebooks. Without Vulkan, returns None, and notebooks show text instead.
py::object png_of(const Mesh& mesh) {
  PictureRequest request;
  request.background = Background::white;
  request.width = 640;
  request.height = 480;
  try {
    return py::bytes(Interruptible(py::none()).call([&](const Progress&) {
      return encode_png(picture_of(mesh, {}, {}, "", request, "auto"));
    }));
  } catch (const GpuError&) {
    return py::none();
  }
}

}  // namespace

void add_render(py::module_& module) {
  module.def("render", &render, py::arg("mesh"), py::arg("values"), py::arg("limits"),
             py::arg("legend"), py::arg("picture"), py::arg("device"), py::arg("path"));
  static_cast<py::class_<Mesh>>(module.attr("Mesh")).def("_repr_png_", &png_of);
  static_cast<py::class_<Result>>(module.attr("Result"))
      .def("_repr_png_", [](const Result& result) { return png_of(result.mesh); });
}

}  // namespace lapwing::python
