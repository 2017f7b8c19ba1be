#include "lapwing/io/ply_elements.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lapwing/io/text_scanner.h"

namespace lapwing {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kTypeNames{
    {{"char", "int8"},
     {"uchar", "uint8"},
     {"short", "int16"},
     {"ushort", "uint16"},
     {"int", "int32"},
     {"uint", "uint32"},
     {"float", "float32"},
     {"double", "float64"}}};

class HeaderReader {
 public:
  explicit HeaderReader(const SourceFile& file) : file_(file), scan_(file, '\0') {}

  PlyHeader read() {
    read_lines();
    header_.data_offset = scan_.offset();
    check_room();
    return std::move(header_);
  }

 private:
  void read_lines() {
    if (scan_.word() != "ply") file_.fail_at_line(0, "expected 'ply' on the first line");
    bool has_format = false;
    for (;;) {
      scan_.next_line();
      if (scan_.at_end()) scan_.fail_expected("'end_header'");
      const TextScanner line = scan_;
      const std::string_view keyword = scan_.word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        has_format = true;
        read_format();
      } else if (keyword == "comment" || keyword == "obj_info") {
        header_.comments.emplace_back(scan_.rest_of_line());
      } else if (keyword == "element") {
        read_element(line.offset());
      } else if (keyword == "property") {
        read_property(line);
      } else if (!keyword.empty()) {
        // Some exporters forget the keyword of a comment.
        TextScanner whole = line;
        header_.comments.emplace_back(whole.rest_of_line());
      }
    }
    if (!has_format) scan_.fail_expected("a 'format' line before 'end_header'");
    scan_.next_line();
  }

  void read_format() {
    const TextScanner start = scan_;
    const std::string_view name = scan_.word();
    if (name == "ascii") {
      header_.encoding = Encoding::ascii;
    } else if (name == "binary_little_endian") {
      header_.encoding = Encoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = Encoding::big_endian;
    } else {
      start.fail_expected("'ascii', 'binary_little_endian' or 'binary_big_endian'");
    }
  }

  void read_element(std::uint64_t offset) {
    PlyElement element;
    element.header_offset = offset;
    element.name = scan_.word();
    const TextScanner start = scan_;
    const std::int64_t count = scan_.integer("the number of records of an element");
    scan_.end_word("the number of records of an element");
    if (count < 0) start.fail_expected("the number of records of an element");
    element.promised = static_cast<std::uint64_t>(count);
    element.count = element.promised;
    header_.elements.push_back(std::move(element));
  }

  void read_property(const TextScanner& line) {
    if (header_.elements.empty()) line.fail_expected("an 'element' line before its properties");
    PlyProperty property;
    const TextScanner start = scan_;
    std::string_view type = scan_.word();
    if (type == "list") {
      const TextScanner count = scan_;
      property.count_type = ply_type(scan_.word());
      if (!property.count_type || !is_integer(*property.count_type)) {
        count.fail_expected("an integer type for the length of a list");
      }
      type = scan_.word();
    }
    const std::optional<Scalar> scalar = ply_type(type);
    if (!scalar) start.fail_expected("a type such as 'float' or 'list uchar int'");
    property.type = *scalar;
    property.name = scan_.word();
    if (property.name.empty()) scan_.fail_expected("the name of the property");
    PlyElement& element = header_.elements.back();
    const auto has_name = [&](const PlyProperty& other) { return other.name == property.name; };
    if (std::ranges::any_of(element.properties, has_name)) {
      file_.fail_at_line(line.offset(), "the property '" + property.name +
                                            "' appears twice in the element '" + element.name +
                                            "'");
    }
    element.properties.push_back(std::move(property));
  }

  // In text, each number takes at least two bytes ("0 "), except the last of the file.
  void check_room() {
    std::uint64_t room = file_.bytes().size() - header_.data_offset;
    const bool ascii = header_.encoding == Encoding::ascii;
    if (ascii) ++room;
    for (PlyElement& element : header_.elements) {
      const std::uint64_t size = ascii ? 2 * element.properties.size() : element.binary_size();
      if (size > 0 && element.name == "face") element.count = std::min(element.count, room / size);
      if (size > 0 && element.count > room / size) {
        file_.fail_at_line(element.header_offset,
                           "the header promises " + std::to_string(element.count) + " '" +
                               element.name + "' records, but the file has room for at most " +
                               std::to_string(room / size));
      }
      room -= size * element.count;
    }
  }

  const SourceFile& file_;
  TextScanner scan_;
  PlyHeader header_;
};

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.count_type.has_value(); });
}

std::uint64_t PlyElement::binary_size() const {
  std::uint64_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.count_type.value_or(p.type));
  return size;
}

PlyHeader read_ply_header(const SourceFile& file) {
  return HeaderReader(file).read();
}

std::string_view ply_name(Scalar type) {
  return kTypeNames[static_cast<std::size_t>(type)].first;
}

std::optional<Scalar> ply_type(std::string_view name) {
  for (std::size_t i = 0; i < kTypeNames.size(); ++i) {
    if (name == kTypeNames[i].first || name == kTypeNames[i].second) return static_cast<Scalar>(i);
  }
  return std::nullopt;
}

namespace {

double color_scale(Scalar type) {
  if (!is_integer(type)) return 1.0;
  return type == Scalar::uint16 ? 1.0 / 65535.0 : 1.0 / 255.0;
}

}  // namespace

bool PlyColumns::take_colors(std::vector<Eigen::Vector4d>& colors) {
  const std::vector<Sink> before = sinks_;
  const bool found = take(colors,
                          {{"red", "green", "blue", "alpha"},
                           {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
                           {"r", "g", "b", "a"}},
                          1, kNoColor);
  for (std::size_t p = 0; p < sinks_.size(); ++p) {
    if (sinks_[p].taken && !before[p].taken) {
      sinks_[p].scale = color_scale(element_.properties[p].type);
    }
  }
  return found;
}

void PlyColumns::take_rest(std::vector<ExtraAttribute>& extras) {
  for (std::size_t p = 0; p < sinks_.size(); ++p) {
    const PlyProperty& property = element_.properties[p];
    if (property.count_type || sinks_[p].taken) continue;
    extras.push_back({property.name, std::string(ply_name(property.type)), 1,
                      std::vector<double>(element_.count)});
    sinks_[p] = {true, extras.back().values.data(), 1, 1.0};
  }
}

std::vector<std::size_t> PlyColumns::find(Names names) const {
  std::vector<std::size_t> found;
  for (const std::string_view name : names) {
    std::size_t p = 0;
    const auto& properties = element_.properties;
    while (p < properties.size() && (properties[p].name != name || properties[p].count_type)) ++p;
    found.push_back(p == properties.size() ? kNone : p);
  }
  return found;
}

bool PlyColumns::is_complete(const std::vector<std::size_t>& found, std::size_t optional) {
  return std::find(found.begin(), found.end() - static_cast<std::ptrdiff_t>(optional), kNone) ==
         found.end() - static_cast<std::ptrdiff_t>(optional);
}

PlyOffsets::PlyOffsets(NumberTriples& triples, const PlyElement& element,
                       const std::vector<std::size_t>& properties)
    : triples_(triples), axis_of_(element.properties.size(), 3) {
  if (std::find(properties.begin(), properties.end(), PlyColumns::kNone) != properties.end()) {
    return;
  }
  triples_.count = element.count;
  for (std::uint8_t k = 0; k < 3; ++k) {
    axis_of_[properties[k]] = k;
    triples_.types[k] = element.properties[properties[k]].type;
  }
}

void PlyOffsets::describe(const PlyElement& element, std::uint64_t first) {
  triples_.first = first;
  triples_.stride = element.binary_size();
  std::uint64_t place = 0;
  for (std::size_t p = 0; p < axis_of_.size(); ++p) {
    if (axis_of_[p] < 3) triples_.places[axis_of_[p]] = place;
    place += size_of(element.properties[p].type);
  }
}

}  // namespace lapwing
