#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/file_bytes.h"
#include "lapwing/io/source_file.h"
#include "lapwing/json/json_node.h"
#include "lapwing/json/json_text.h"

namespace lapwing {

/// A buffer of a glTF file: its bytes and where they are stored.
struct GltfBuffer {
  enum class Kind : std::uint8_t { chunk, file, data_uri };
  Kind kind = Kind::chunk;
  std::string_view bytes;       ///< at least "byteLength" of them
  std::filesystem::path path;   ///< of a separate file
  std::size_t data_offset = 0;  ///< in a data URI, the first byte of the base64 text
};

/// The JSON document of a glTF 2.0 file (GLB or JSON), and the bytes of its buffers. Views the
/// bytes of `file`, which must outlive it.
class GltfFile {
 public:
  /// Throws InputError if the file is not glTF 2.0, if it requires an extension that is not
  /// supported, or if a buffer is missing, too short or compressed; the message says what to do.
  /// Reads no buffer from outside the file's folder. Throws IoError if a buffer cannot be read.
  explicit GltfFile(const SourceFile& file);

  const SourceFile& source() const { return source_; }
  bool is_binary() const { return is_binary_; }
  const JsonNode& root() const { return root_; }
  /// Locates the values of `root` in the JSON text, which excludes the padding of its chunk.
  const JsonText& json() const { return json_text_; }
  const std::vector<GltfBuffer>& buffers() const { return buffers_; }
  /// The binary chunk of a GLB, even if no buffer uses it.
  std::optional<std::string_view> chunk() const { return chunk_; }
  /// The further chunks of a GLB, behind JSON and binary chunk, including their headers.
  std::string_view further_chunks() const { return further_chunks_; }
  /// The bytes of a GLB beyond the length in its header.
  std::string_view tail() const { return tail_; }

 private:
  void split_chunks();
  void read_buffers();
  GltfBuffer read_buffer(const JsonNode& node, std::size_t number);

  const SourceFile& source_;
  bool is_binary_ = false;
  std::string_view json_;
  std::optional<std::string_view> chunk_;
  std::string_view further_chunks_;
  std::string_view tail_;
  JsonNode root_;
  JsonText json_text_;
  std::vector<GltfBuffer> buffers_;
  std::vector<std::unique_ptr<const std::string>> decoded_;
  std::vector<std::unique_ptr<const FileBytes>> files_;
};

/// Magic number, chunk types and header sizes (bytes) of a GLB.
inline constexpr std::uint32_t kGlbMagic = 0x46546C67;   // "glTF"
inline constexpr std::uint32_t kGlbJson = 0x4E4F534A;    // "JSON"
inline constexpr std::uint32_t kGlbBinary = 0x004E4942;  // "BIN"
inline constexpr std::size_t kGlbHeaderSize = 12;
inline constexpr std::size_t kGlbChunkHeaderSize = 8;

/// An extension that shows the mesh of a node several times, each time with another transform.
inline constexpr std::string_view kInstancingExtension = "EXT_mesh_gpu_instancing";

/// Returns whether the readers use the data of an extension, so that a conversion to another format
/// carries it.
bool is_carried_extension(std::string_view extension);

/// Throws InputError if the file has its data a second time, compressed. Other programs would show
/// that copy, without an edit of the first one.
void require_no_compressed_copy(const JsonNode& root);

/// The wrap modes of a sampler that have an equivalent in MTL files: -clamp off and on.
inline constexpr std::size_t kGltfRepeat = 10497;
inline constexpr std::size_t kGltfClampToEdge = 33071;

/// Returns a unique name for each material. A material without a name is called "material 3". If an
/// earlier material is also called "Skin", the name is "Skin (material 3)".
std::vector<std::string> gltf_material_names(const JsonNode& root);

/// Returns the index of the image that a material uses as its base colour, or nullopt if it uses
/// none. The image may have any format, such as WebP (EXT_texture_webp). Throws InputError if the
/// texture is malformed.
std::optional<std::size_t> base_color_image(const JsonNode& root, const JsonNode& material);
/// Returns the indices of the images that materials use as base colours. Ignores malformed
/// textures.
std::set<std::size_t> base_color_images(const JsonNode& root);

/// Returns a GLB of `json`, the first buffer and `further_chunks`. Throws InputError above 4 GB.
std::string glb_of(std::string_view json, std::optional<std::string_view> buffer,
                   std::string_view further_chunks);

}  // namespace lapwing
