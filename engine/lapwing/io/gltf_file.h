#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lapwing/io/file_bytes.h"
#include "lapwing/io/source_file.h"
#include "lapwing/json/json_node.h"

namespace lapwing {

/// A buffer of a glTF file: its bytes, and where they stand.
struct GltfBuffer {
  enum class Kind : std::uint8_t { chunk, file, data_uri };
  Kind kind = Kind::chunk;
  std::string_view bytes;       ///< as long as the file says at least
  std::filesystem::path path;   ///< of a file of its own
  std::size_t data_offset = 0;  ///< of a data URI: where in the URI its base64 begins
};

/// The parts of a glTF 2.0 file, GLB or JSON: its document, and the bytes of its buffers. Views
/// bytes of `file`, which must outlive it.
class GltfFile {
 public:
  /// Throws InputError for a file that is no glTF 2.0, and for buffers that are not there, are too
  /// short, or are compressed; the message says what to do. Reads no buffer from outside the file's
  /// folder. Throws IoError for a buffer that cannot be read.
  explicit GltfFile(const SourceFile& file);

  const SourceFile& source() const { return source_; }
  bool is_binary() const { return is_binary_; }
  /// The JSON, with what fills its chunk.
  std::string_view json() const { return json_; }
  const JsonNode& root() const { return root_; }
  const std::vector<GltfBuffer>& buffers() const { return buffers_; }
  /// The bytes that a GLB has for its first buffer, whether that names them or not.
  std::optional<std::string_view> chunk() const { return chunk_; }
  /// What follows the JSON and the first buffer in a GLB: chunks of others, headers included.
  std::string_view further_chunks() const { return further_chunks_; }
  /// What stands in a GLB behind the length that its header names.
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
  std::vector<GltfBuffer> buffers_;
  std::vector<std::unique_ptr<const std::string>> decoded_;
  std::vector<std::unique_ptr<const FileBytes>> files_;
};

/// Of a GLB: what each chunk's type says, and the first number of the file.
inline constexpr std::uint32_t kGlbMagic = 0x46546C67;   // "glTF"
inline constexpr std::uint32_t kGlbJson = 0x4E4F534A;    // "JSON"
inline constexpr std::uint32_t kGlbBinary = 0x004E4942;  // "BIN"
inline constexpr std::size_t kGlbHeaderSize = 12;
inline constexpr std::size_t kGlbChunkHeaderSize = 8;

/// What material `number` is called: "material 3" where it has no name.
std::string gltf_material_name(const JsonNode& material, std::size_t number);

/// A GLB of `json`, the first buffer, and `further_chunks`.
std::string glb_of(std::string_view json, std::optional<std::string_view> buffer,
                   std::string_view further_chunks);

}  // namespace lapwing
