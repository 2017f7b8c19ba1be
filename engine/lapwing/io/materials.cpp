// MTL: "MTL Material Format (Lightwave, OBJ)", Alias|Wavefront, Object Files, version 4.0.
#include "lapwing/io/materials.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string_view>
#include <unordered_set>

#include "lapwing/base/errors.h"
#include "lapwing/base/srgb.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/gltf_file.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/uri.h"

namespace lapwing {

namespace {

constexpr std::uintmax_t kMostLibraryBytes = std::uintmax_t{64} << 20U;
constexpr std::string_view kMtlBlanks = " \t\v\f\r";

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kMtlBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kMtlBlanks) - first + 1);
}

// Removes the first word from `rest` and returns it.
std::string_view take_word(std::string_view& rest) {
  rest = without_blanks(rest);
  const std::string_view word = rest.substr(0, rest.find_first_of(kMtlBlanks));
  rest.remove_prefix(word.size());
  return word;
}

// The same if the word is a finite number; otherwise leaves `rest` unchanged.
std::optional<double> take_number(std::string_view& rest) {
  std::string_view behind = rest;
  const std::string_view word = take_word(behind);
  double value = 0.0;
  const char* const end = word.data() + word.size();
  if (word.empty() || parse_number(word.data(), end, value) != end || !std::isfinite(value)) {
    return {};
  }
  rest = behind;
  return value;
}

// Options of map_Kd that change where the image lies on the surface.
struct ImageOptions {
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  bool is_clamped = false;
};

// If the first word of `rest` is one of `words`, removes it and returns its index in `words`.
std::optional<std::size_t> take_one_of(std::span<const std::string_view> words,
                                       std::string_view& rest) {
  std::string_view behind = rest;
  const auto at = std::ranges::find(words, lowered(take_word(behind)));
  if (at == words.end()) return {};
  rest = behind;
  return static_cast<std::size_t>(at - words.begin());
}

// Removes an option of map_Kd and its arguments from the beginning of `rest`. Returns false if
// `rest` does not begin with an option.
bool take_option(std::string_view& rest, ImageOptions& options) {
  constexpr std::array<std::string_view, 7> kWithNumbers{"-s",  "-o",     "-t",     "-mm",
                                                         "-bm", "-boost", "-texres"};
  constexpr std::array<std::size_t, 7> kMostNumbers{3, 3, 3, 2, 1, 1, 1};
  constexpr std::array<std::string_view, 6> kWithWord{"-clamp", "-blendu",  "-blendv",
                                                      "-cc",    "-imfchan", "-type"};
  constexpr std::array<std::string_view, 15> kWords{
      "on",     "off",      "r",           "g",          "b",         "m",         "l",         "z",
      "sphere", "cube_top", "cube_bottom", "cube_front", "cube_back", "cube_left", "cube_right"};
  if (const auto option = take_one_of(kWithNumbers, rest)) {
    Eigen::Vector2d* const targets[]{&options.scale, &options.offset};
    for (std::size_t k = 0; k < kMostNumbers[*option]; ++k) {
      const auto number = take_number(rest);
      if (!number) break;
      if (*option < 2 && k < 2) (*targets[*option])[static_cast<Eigen::Index>(k)] = *number;
    }
    return true;
  }
  const auto option = take_one_of(kWithWord, rest);
  if (!option) return false;
  const auto word = take_one_of(kWords, rest);
  if (*option == 0) options.is_clamped = word && kWords[*word] == "on";
  return true;
}

// Returns the file name without the options that some exporters write after it. The name may
// contain blanks and words such as "-s". Options are therefore recognized only if nothing else
// follows them on the line.
std::string_view without_options_behind(std::string_view rest, ImageOptions& options) {
  for (std::size_t at = rest.find('-', 1); at != std::string_view::npos; at = rest.find('-', at)) {
    ImageOptions found = options;
    std::string_view behind = rest.substr(at);
    const bool begins_word = kMtlBlanks.find(rest[at - 1]) != std::string_view::npos;
    while (begins_word && take_option(behind, found)) {
    }
    behind = without_blanks(behind);
    if (behind.empty()) {
      options = found;
      return without_blanks(rest.substr(0, at));
    }
    at = std::max(at + 1, static_cast<std::size_t>(behind.data() - rest.data()));
  }
  return rest;
}

class MaterialReader {
 public:
  MaterialReader(const std::filesystem::path& path, std::vector<std::string>& notes)
      : path_(path), notes_(notes), bytes_(FileBytes::read_data(path)) {}

  std::vector<Material> read() {
    std::string_view text = bytes_.view();
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      read_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return std::move(materials_);
  }

 private:
  void read_line(std::string_view line) {
    const std::string_view keyword = take_word(line);
    const std::string_view rest = without_blanks(line);
    if (lowered(keyword) == "newmtl") {
      begin_material(rest);
    } else if (current_ == nullptr) {
      return;
    } else if (lowered(keyword) == "kd") {
      read_color(rest);
    } else if (lowered(keyword) == "map_kd") {
      read_image(rest);
    } else {
      read_other(lowered(keyword), rest);
    }
  }

  void read_other(const std::string& keyword, std::string_view rest) {
    if (keyword == "d" || keyword == "tr") {
      const auto number = take_number(rest);
      if (!number) return;  // "d -halo 0.5" is not a constant opacity
      const auto share = static_cast<float>(std::clamp(*number, 0.0, 1.0));
      current_->opacity = keyword == "d" ? share : 1.0F - share;
      return;
    }
    constexpr std::array<std::string_view, 5> kImages{"bump", "disp", "decal", "refl", "norm"};
    const bool is_image =
        keyword.starts_with("map_") || std::ranges::find(kImages, keyword) != kImages.end();
    if (is_image) ++current_->further_images;
  }

  void begin_material(std::string_view name) {
    current_ = nullptr;
    if (!names_.emplace(name).second) {
      return add_note("material '" + std::string(name) +
                      "' is defined a second time; the first definition is used");
    }
    current_ = &materials_.emplace_back();
    current_->name = name;
  }

  // Kd r g b, or one number for all three.
  void read_color(std::string_view rest) {
    std::array<double, 3> color{};
    std::size_t count = 0;
    for (; count < 3; ++count) {
      const auto number = take_number(rest);
      if (!number) break;
      color[count] = std::clamp(*number, 0.0, 1.0);
    }
    const bool ends = rest.empty() || rest.front() == '#';
    if (count == 1 && ends) {
      color[1] = color[2] = color[0];
    } else if (count < 3) {
      return add_note("expected Kd with one or three numbers; write the colour as red green blue");
    }
    current_->color = Eigen::Vector3d(color.data()).cast<float>();
  }

  void read_image(std::string_view rest) {
    ImageOptions options;
    while (take_option(rest, options)) {
    }
    rest = without_options_behind(without_blanks(rest), options);
    if (rest.size() > 1 && rest.front() == '"' && rest.back() == '"') {
      rest = rest.substr(1, rest.size() - 2);
    }
    if (rest.empty()) return add_note("map_Kd has no file name; write the image's name after it");
    current_->image = rest;
    current_->uv_scale = options.scale;
    current_->uv_offset = options.offset;
    current_->is_clamped = options.is_clamped;
  }

  void add_note(const std::string& message) {
    notes_.push_back(path_.string() + ":" + std::to_string(line_) + ": " + message);
  }

  const std::filesystem::path& path_;
  std::vector<std::string>& notes_;
  FileBytes bytes_;
  std::vector<Material> materials_;
  std::unordered_set<std::string> names_;
  Material* current_ = nullptr;  // last of `materials_`; null before the first and in a duplicate
  std::size_t line_ = 0;
};

}  // namespace

std::vector<Material> read_material_library(const std::filesystem::path& path,
                                            std::vector<std::string>& notes) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error && bytes > kMostLibraryBytes) {
    throw InputError(path.string() +
                     ": the file is larger than 64 MiB; check that it is a material library");
  }
  return MaterialReader(path, notes).read();
}

namespace {

class GltfMaterialReader {
 public:
  GltfMaterialReader(const GltfFile& file, std::vector<std::string>& notes)
      : file_(file), names_(gltf_material_names(file.root())), notes_(notes) {}

  std::vector<Material> read() {
    std::vector<Material> materials;
    const auto list = file_.root().find("materials");
    if (!list) return materials;
    for (const JsonNode& node : list->elements()) {
      Material& material = materials.emplace_back();
      material.name = names_[materials.size() - 1];
      try {
        read_surface(node, material);
      } catch (const Error& error) {
        notes_.emplace_back(error.what());
      }
    }
    return materials;
  }

 private:
  void read_surface(const JsonNode& node, Material& material) {
    const auto surface = node.find("pbrMetallicRoughness");
    if (!surface) return;
    Eigen::Vector3f color = Eigen::Vector3f::Ones();
    if (const auto factor = surface->find("baseColorFactor")) {
      const std::vector<double> numbers = factor->numbers();
      for (std::size_t c = 0; c < 3 && c < numbers.size(); ++c) {
        color[static_cast<Eigen::Index>(c)] = srgb_of_linear(static_cast<float>(numbers[c]));
      }
      const auto mode = node.find("alphaMode");
      if (numbers.size() > 3 && mode && mode->is_string() && mode->string() == "BLEND") {
        material.opacity = static_cast<float>(std::clamp(numbers[3], 0.0, 1.0));
      }
    }
    material.color = color;
    const auto image = base_color_image(file_.root(), node);
    if (!image) return;
    read_image(*image, material);
    read_transform(surface->at("baseColorTexture"), material);
    read_wrap_modes(surface->at("baseColorTexture"), material);
  }

  void read_image(std::size_t number, Material& material) {
    const JsonNode image = file_.root().at("images").at(number);
    const auto uri = image.find("uri");
    const bool is_file = uri && !uri->string().starts_with("data:");
    if (is_file) {
      material.image = path_of_uri(uri->string());
      return;
    }
    auto [known, is_new] = embedded_.try_emplace(number);
    if (is_new) {
      const std::string bytes(uri ? decoded(*uri) : std::string(view_of(image)));
      known->second = std::make_shared<const std::string>(bytes);
    }
    material.embedded_image = known->second;
    material.image = file_name_of(image, number, *known->second);
  }

  static std::string decoded(const JsonNode& uri) {
    const std::string text = uri.string();
    constexpr std::string_view kBase64 = ";base64,";
    const std::size_t at = text.find(kBase64);
    auto bytes = at == std::string::npos
                     ? std::nullopt
                     : decode_base64(std::string_view(text).substr(at + kBase64.size()));
    if (!bytes) uri.fail("the image is not base64; export the file again");
    return std::move(*bytes);
  }

  std::string_view view_of(const JsonNode& image) const {
    const JsonNode view = file_.root().at("bufferViews").at(image.at("bufferView").count());
    const std::size_t buffer = view.at("buffer").count();
    const auto start = view.find("byteOffset");
    const std::size_t offset = start ? start->count() : 0;
    const std::size_t length = view.at("byteLength").count();
    if (buffer >= file_.buffers().size()) view.fail("the buffer does not exist");
    const std::string_view bytes = file_.buffers()[buffer].bytes;
    if (offset > bytes.size() || length > bytes.size() - offset) {
      view.fail("the image reaches beyond the end of its buffer; export the file again");
    }
    return bytes.substr(offset, length);
  }

  // Returns a file name for an image. The name in the file is untrusted, so characters that are not
  // allowed in file names are replaced.
  std::string file_name_of(const JsonNode& image, std::size_t number,
                           std::string_view bytes) const {
    const auto node = image.find("name");
    std::string name = node && node->is_string() ? node->string() : std::string();
    for (char& c : name) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x20 || std::string_view(R"(/\:*?"<>|#%)").find(c) != std::string_view::npos)
        c = '_';
    }
    const bool has_extension =
        name.ends_with(".png") || name.ends_with(".jpg") || name.ends_with(".jpeg");
    if (has_extension) name.resize(name.rfind('.'));
    while (name.starts_with('.') || name.starts_with(' ')) name.erase(0, 1);
    if (name.empty()) {
      name = file_.source().path().stem().string() + "-" + std::to_string(number);
    }
    return name + std::string(image_extension(bytes));
  }

  void read_transform(const JsonNode& texture, Material& material) const {
    const auto extensions = texture.find("extensions");
    const auto transform = extensions ? extensions->find("KHR_texture_transform") : std::nullopt;
    if (!transform) return;
    const auto pair = [&](const char* key, Eigen::Vector2d value) {
      const auto node = transform->find(key);
      const std::vector<double> numbers = node ? node->numbers() : std::vector<double>();
      return numbers.size() == 2 ? Eigen::Vector2d(numbers[0], numbers[1]) : value;
    };
    const Eigen::Vector2d scale = pair("scale", Eigen::Vector2d::Ones());
    const Eigen::Vector2d offset = pair("offset", Eigen::Vector2d::Zero());
    // In glTF v runs downwards.
    material.uv_scale = scale;
    material.uv_offset = {offset.x(), 1.0 - scale.y() - offset.y()};
    const auto rotation = transform->find("rotation");
    if (!rotation || rotation->number() == 0.0) return;
    notes_.push_back(rotation->where() + ": the image of material '" + material.name +
                     "' is not rotated, because this is not supported; rotate the texture "
                     "coordinates instead");
  }

  void read_wrap_modes(const JsonNode& texture, Material& material) const {
    const std::size_t number = texture.at("index").count();
    const auto sampler_number = file_.root().at("textures").at(number).find("sampler");
    if (!sampler_number) return;
    const JsonNode sampler = file_.root().at("samplers").at(sampler_number->count());
    const auto mode = [&](const char* key) {
      const auto node = sampler.find(key);
      return node ? node->count() : kGltfRepeat;
    };
    const std::size_t s = mode("wrapS");
    const std::size_t t = mode("wrapT");
    material.is_clamped = s == kGltfClampToEdge && t == kGltfClampToEdge;
    if (material.is_clamped || (s == kGltfRepeat && t == kGltfRepeat)) return;
    notes_.push_back(sampler.where() + ": the image of material '" + material.name +
                     "' is repeated without mirroring or clamping it; give the sampler the same "
                     "wrap mode in both directions, REPEAT or CLAMP_TO_EDGE");
  }

  const GltfFile& file_;
  std::vector<std::string> names_;
  std::vector<std::string>& notes_;
  std::map<std::size_t, std::shared_ptr<const std::string>> embedded_;
};

}  // namespace

std::string_view image_extension(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return ".png";
  if (bytes.starts_with("\xFF\xD8")) return ".jpg";
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return ".webp";
  if (bytes.substr(0, 12).ends_with("ftypavif")) return ".avif";
  if (bytes.starts_with("\xABKTX")) return ".ktx2";
  if (bytes.starts_with("DDS ")) return ".dds";
  return ".image";
}

std::vector<Material> read_gltf_materials(const std::filesystem::path& path,
                                          std::vector<std::string>& notes) {
  MeshPath name = split_mesh_path(path);
  const MeshFormat format = format_of(name.file);
  const SourceFile source(std::move(name), format);
  const GltfFile file(source);
  return GltfMaterialReader(file, notes).read();
}

}  // namespace lapwing
