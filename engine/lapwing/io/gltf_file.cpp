#include "lapwing/io/gltf_file.h"

#include <algorithm>
#include <array>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/paths.h"
#include "lapwing/io/uri.h"

namespace lapwing {
namespace {

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(
      load_number(bytes.data() + at, Scalar::uint32, Encoding::little_endian));
}

void append_word(std::string& out, std::size_t value) {
  append_binary(out, static_cast<double>(value), Scalar::uint32, Encoding::little_endian);
}

void append_chunk(std::string& out, std::uint32_t type, std::string_view bytes, char filler) {
  const std::size_t filled = (bytes.size() + 3) / 4 * 4;
  append_word(out, filled);
  append_word(out, type);
  out += bytes;
  out.append(filled - bytes.size(), filler);
}

// Extensions of textures that name an image in another format than PNG and JPEG.
constexpr std::array<std::string_view, 4> kImageExtensions{
    "EXT_texture_avif", "EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds"};

bool is_compression(std::string_view extension) {
  return extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression" ||
         extension == "KHR_meshopt_compression";
}

// Returns whether an extension changes neither positions nor triangles nor the number of objects,
// so that a mesh can be edited without knowing the extension.
bool leaves_shape(std::string_view extension) {
  constexpr std::array<std::string_view, 10> kNames{
      "EXT_feature_metadata",    "EXT_instance_features",
      "EXT_mesh_features",       "EXT_mesh_manifold",
      "EXT_structural_metadata", "KHR_animation_pointer",
      "KHR_interactivity",       "KHR_xmp",
      "KHR_xmp_json_ld",         "CESIUM_primitive_outline"};
  constexpr std::array<std::string_view, 8> kPrefixes{
      "EXT_lights_",    "EXT_materials_", "KHR_audio",     "KHR_lights_",
      "KHR_materials_", "KHR_technique",  "MSFT_packing_", "VRM"};
  return std::ranges::find(kNames, extension) != kNames.end() ||
         std::ranges::any_of(
             kPrefixes, [&](std::string_view prefix) { return extension.starts_with(prefix); });
}

// Throws InputError if the file requires an extension that could change the shape of the mesh.
void require_supported_extensions(const JsonNode& root) {
  const auto required = root.find("extensionsRequired");
  if (!required) return;
  for (const JsonNode& node : required->elements()) {
    const std::string name = node.string();
    if (is_carried_extension(name) || leaves_shape(name)) continue;
    if (is_compression(name)) {
      node.fail("data compressed by " + name +
                " cannot be read; export the file without compression");
    }
    node.fail("the file requires the extension " + name +
              ", which is not supported; export the file without this extension");
  }
}

}  // namespace

GltfFile::GltfFile(const SourceFile& file)
    : source_(file),
      is_binary_(file.bytes().size() >= 4 && word_at(file.bytes(), 0) == kGlbMagic),
      json_(file.bytes()),
      root_([this] {
        if (is_binary_) split_chunks();
        return JsonNode::parse(json_, source_.path().string());
      }()),
      json_text_(json_, source_.path().string()) {
  const auto asset = root_.find("asset");
  const auto version = asset ? asset->find("version") : std::nullopt;
  if (!version || !version->is_string() || !version->string().starts_with("2.")) {
    root_.fail("the file is not glTF 2.0; export it again as glTF 2.0");
  }
  require_supported_extensions(root_);
  read_buffers();
}

void GltfFile::split_chunks() {
  const std::string_view bytes = source_.bytes();
  if (bytes.size() < kGlbHeaderSize + kGlbChunkHeaderSize) {
    source_.fail(0, "a GLB has at least 20 bytes; this one has " + std::to_string(bytes.size()));
  }
  if (word_at(bytes, 4) != 2) {
    source_.fail(4, "version " + std::to_string(word_at(bytes, 4)) +
                        " of GLB is not supported, only version 2");
  }
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size()) {
    source_.fail(8, "the header promises " + std::to_string(length) + " bytes, the file has " +
                        std::to_string(bytes.size()));
  }
  const auto chunk_at = [&](std::size_t at) {
    const std::size_t size = word_at(bytes, at);
    const std::size_t room = length - at - kGlbChunkHeaderSize;
    if (size > room) {
      source_.fail(at, "the chunk's header announces " + std::to_string(size) + " bytes, but " +
                           std::to_string(room) + " follow");
    }
    return bytes.substr(at + kGlbChunkHeaderSize, size);
  };
  std::size_t at = kGlbHeaderSize;
  if (length < at + kGlbChunkHeaderSize || word_at(bytes, at + 4) != kGlbJson) {
    source_.fail(at, "the first chunk of a GLB must be JSON");
  }
  const std::string_view padded = chunk_at(at);
  // Some exporters pad the chunk with NULs, which are not JSON.
  constexpr std::string_view kPadding(" \t\r\n\0", 5);
  json_ = padded.substr(0, padded.find_last_not_of(kPadding) + 1);
  at += kGlbChunkHeaderSize + padded.size();
  if (length >= at + kGlbChunkHeaderSize && word_at(bytes, at + 4) == kGlbBinary) {
    chunk_ = chunk_at(at);
    at += kGlbChunkHeaderSize + chunk_->size();
  }
  further_chunks_ = bytes.substr(at, length - at);
  tail_ = bytes.substr(length);
}

void GltfFile::read_buffers() {
  const auto list = root_.find("buffers");
  if (!list) return;
  const std::vector<JsonNode> nodes = list->elements();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    GltfBuffer buffer = read_buffer(nodes[k], k);
    const std::size_t promised = nodes[k].at("byteLength").count();
    if (promised > buffer.bytes.size()) {
      nodes[k].fail("the buffer promises " + std::to_string(promised) + " bytes but has " +
                    std::to_string(buffer.bytes.size()) + "; export the file again");
    }
    buffers_.push_back(std::move(buffer));
  }
}

GltfBuffer GltfFile::read_buffer(const JsonNode& node, std::size_t number) {
  GltfBuffer buffer;
  const auto uri_node = node.find("uri");
  if (!uri_node) {
    if (number > 0 || !chunk_) {
      node.fail(
          "the buffer has no \"uri\", and the file has no chunk for it; export the file again");
    }
    buffer.bytes = *chunk_;
    return buffer;
  }
  const std::string uri = uri_node->string();
  if (uri.starts_with("data:")) {
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    if (mark == std::string::npos) uri_node->fail("expected data in base64");
    buffer.kind = GltfBuffer::Kind::data_uri;
    buffer.data_offset = mark + kMark.size();
    auto decoded = decode_base64(std::string_view(uri).substr(buffer.data_offset));
    if (!decoded) uri_node->fail("the text after \"base64,\" is not valid base64");
    decoded_.push_back(std::make_unique<const std::string>(std::move(*decoded)));
    buffer.bytes = *decoded_.back();
    return buffer;
  }
  const auto path = find_named_file(source_.path().parent_path(), path_of_uri(uri));
  if (!path) {
    uri_node->fail("there is no file '" + path_of_uri(uri) +
                   "' in the folder of the glTF file; copy it there");
  }
  buffer.kind = GltfBuffer::Kind::file;
  buffer.path = *path;
  files_.push_back(std::make_unique<const FileBytes>(FileBytes::read_data(*path)));
  buffer.bytes = files_.back()->view();
  return buffer;
}

std::vector<std::string> gltf_material_names(const JsonNode& root) {
  std::vector<std::string> names;
  const auto materials = root.find("materials");
  if (!materials) return names;
  std::set<std::string> taken;
  for (const JsonNode& material : materials->elements()) {
    const std::string numbered = "material " + std::to_string(names.size());
    const auto node = material.find("name");
    std::string name = node && node->is_string() ? node->string() : std::string();
    if (name.empty()) name = numbered;
    if (!taken.insert(name).second) name += " (" + numbered + ")";
    names.push_back(std::move(name));
  }
  return names;
}

void require_no_compressed_copy(const JsonNode& root) {
  const auto used = root.find("extensionsUsed");
  if (!used) return;
  for (const JsonNode& node : used->elements()) {
    if (!node.is_string() || !is_compression(node.string())) continue;
    node.fail("the file has a second copy of its data, compressed by " + node.string() +
              ", which the edit would not change; save another format, or export the file without "
              "compression");
  }
}

bool is_carried_extension(std::string_view extension) {
  return extension == kInstancingExtension || extension == "KHR_mesh_quantization" ||
         extension == "KHR_texture_transform" ||
         std::ranges::find(kImageExtensions, extension) != kImageExtensions.end();
}

std::optional<std::size_t> base_color_image(const JsonNode& root, const JsonNode& material) {
  const auto surface = material.find("pbrMetallicRoughness");
  const auto texture = surface ? surface->find("baseColorTexture") : std::nullopt;
  const auto number = texture ? texture->find("index") : std::nullopt;
  const auto textures = number ? root.find("textures") : std::nullopt;
  const auto found = textures ? textures->element(number->count()) : std::nullopt;
  auto source = found ? found->find("source") : std::nullopt;
  const auto extensions = found ? found->find("extensions") : std::nullopt;
  for (const std::string_view name : kImageExtensions) {
    // The image without an extension is PNG or JPEG, so it is preferred.
    if (source || !extensions) break;
    if (const auto extension = extensions->find(name)) source = extension->find("source");
  }
  const auto images = source ? root.find("images") : std::nullopt;
  if (!images || !images->element(source->count())) return {};
  return source->count();
}

std::set<std::size_t> base_color_images(const JsonNode& root) {
  std::set<std::size_t> images;
  const auto materials = root.find("materials");
  if (!materials) return images;
  for (const JsonNode& material : materials->elements()) {
    try {
      if (const auto image = base_color_image(root, material)) images.insert(*image);
    } catch (const InputError&) {
      // A malformed texture does not prevent editing the mesh.
    }
  }
  return images;
}

std::string glb_of(std::string_view json, std::optional<std::string_view> buffer,
                   std::string_view further_chunks) {
  std::string chunks;
  append_chunk(chunks, kGlbJson, json, ' ');
  if (buffer) append_chunk(chunks, kGlbBinary, *buffer, '\0');
  chunks += further_chunks;
  const std::size_t length = kGlbHeaderSize + chunks.size();
  constexpr std::size_t kMost = 0xFFFFFFFFU;
  if (length > kMost) {
    throw InputError("a GLB holds at most 4 GB; write a .gltf file, or a smaller mesh");
  }
  std::string out;
  out.reserve(length);
  append_word(out, kGlbMagic);
  append_word(out, 2);
  append_word(out, length);
  return out + chunks;
}

}  // namespace lapwing
