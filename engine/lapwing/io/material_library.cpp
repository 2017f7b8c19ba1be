// MTL: "MTL Material Format (Lightwave, OBJ)", Alias|Wavefront, Object Files, version 4.0.
#include "lapwing/io/material_library.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_set>

#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/text_scanner.h"

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

bool is_keyword(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + 32) : a) == b;
  });
}

class MaterialReader {
 public:
  MaterialReader(const std::filesystem::path& path, std::vector<std::string>& notes)
      : path_(path), notes_(notes), bytes_(FileBytes::read(path)) {}

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
    if (is_keyword(keyword, "newmtl")) {
      begin_material(rest);
    } else if (current_ == nullptr) {
      return;
    } else if (is_keyword(keyword, "kd")) {
      read_color(rest);
    } else if (is_keyword(keyword, "map_kd")) {
      read_image(rest);
    }
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
    Eigen::Vector2d scale = Eigen::Vector2d::Ones();
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    for (bool is_option = true; is_option;) {
      rest = without_blanks(rest);
      std::string_view behind = rest;
      const std::string_view option = take_word(behind);
      is_option = skip_option(option, behind, scale, offset);
      if (is_option) rest = behind;
    }
    if (rest.size() > 1 && rest.front() == '"' && rest.back() == '"') {
      rest = rest.substr(1, rest.size() - 2);
    }
    if (rest.empty()) return add_note("map_Kd has no file name; write the image's name after it");
    current_->image = rest;
    current_->uv_scale = scale;
    current_->uv_offset = offset;
  }

  // Returns whether `option` is an option of map_Kd; removes its arguments from `rest`.
  static bool skip_option(std::string_view option, std::string_view& rest, Eigen::Vector2d& scale,
                          Eigen::Vector2d& offset) {
    // Options with one to three numbers.
    for (const auto& [name, target] : {std::pair<std::string_view, Eigen::Vector2d*>{"-s", &scale},
                                       {"-o", &offset},
                                       {"-t", nullptr}}) {
      if (!is_keyword(option, name)) continue;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const auto number = take_number(rest);
        if (!number) break;
        if (target != nullptr && k < 2) (*target)[k] = *number;
      }
      return true;
    }
    if (is_keyword(option, "-mm")) {
      take_word(rest);
      take_word(rest);
      return true;
    }
    for (const std::string_view name :
         {"-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-imfchan", "-texres", "-type"}) {
      if (!is_keyword(option, name)) continue;
      take_word(rest);
      return true;
    }
    return false;
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

}  // namespace lapwing
