#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/source_file.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// One property of a PLY element: a number, or a list with its count's type.
struct PlyProperty {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> count_type;  ///< set for a list
};

struct PlyElement {
  std::string name;
  std::uint64_t promised = 0;  ///< number of records, as the header says
  std::uint64_t count = 0;     ///< `promised`; for faces, limited by the size of the file
  std::vector<PlyProperty> properties;
  std::uint64_t header_offset = 0;  ///< of its line, for messages

  bool has_list() const;
  /// Size of a binary record in bytes, without the contents of its lists.
  std::uint64_t binary_size() const;
};

struct PlyHeader {
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  ///< of `comment` and `obj_info` lines
  std::uint64_t data_offset = 0;      ///< first byte behind the header
};

/// Reads the header. Throws InputError, naming the line, if the header is malformed, or if the file
/// is too short for the promised records. Only the promised faces may exceed the file's size.
PlyHeader read_ply_header(const SourceFile& file);

/// Convert between types and their PLY names. `ply_type` takes both spellings ("uchar", "uint8").
std::string_view ply_name(Scalar type);
std::optional<Scalar> ply_type(std::string_view name);

/// Distributes the properties of a PLY element, record by record, to the lists of a mesh. Every
/// property except lists must be taken before the first `put`.
class PlyColumns {
 public:
  using Names = std::initializer_list<std::string_view>;

  explicit PlyColumns(const PlyElement& element)
      : element_(element), sinks_(element.properties.size()) {}

  /// Directs properties into `values`, which is resized and filled with `missing`. Takes the first
  /// of `choices` whose names the element has; the last `optional` names may be absent. Returns
  /// false if no choice fits.
  template <class Vector>
  bool take(std::vector<Vector>& values, std::initializer_list<Names> choices,
            std::size_t optional = 0, const Vector& missing = Vector::Zero()) {
    for (const Names& names : choices) {
      const std::vector<std::size_t> found = find(names);
      if (!is_complete(found, optional)) continue;
      values.assign(element_.count, missing);
      double* const first = values.empty() ? nullptr : values.front().data();
      for (std::size_t k = 0; k < found.size(); ++k) {
        if (found[k] != kNone)
          sinks_[found[k]] = {true, first == nullptr ? nullptr : first + k, found.size(), 1.0};
      }
      return true;
    }
    return false;
  }

  /// Directs red, green, blue and alpha, scaled to [0, 1] according to their type.
  bool take_colors(std::vector<Eigen::Vector4d>& colors);

  /// Directs every number that was not taken into an attribute of the same name.
  void take_rest(std::vector<ExtraAttribute>& extras);

  void put(std::size_t property, std::size_t record, double value) {
    const Sink& sink = sinks_[property];
    sink.first[record * sink.step] = sink.scale * value;
  }

  /// Returns the property of each name, or kNone if the element has no number of that name.
  std::vector<std::size_t> find(Names names) const;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

 private:
  // Destination of a property: the value of a record goes to first[record * step].
  struct Sink {
    bool taken = false;
    double* first = nullptr;
    std::size_t step = 1;
    double scale = 1.0;
  };

  static bool is_complete(const std::vector<std::size_t>& found, std::size_t optional);

  const PlyElement& element_;
  std::vector<Sink> sinks_;
};

/// Stores the file offsets of the three numbers of each record.
class PlyOffsets {
 public:
  /// `properties` is a result of PlyColumns::find. Stores nothing if one of the three is missing.
  PlyOffsets(NumberTriples& triples, const PlyElement& element,
             const std::vector<std::size_t>& properties);

  /// Describes records of equal size, the first at byte `first`.
  void describe(const PlyElement& element, std::uint64_t first);

  void note(std::size_t property, std::size_t record, std::uint64_t place) {
    if (axis_of_[property] < 3) triples_.offsets[3 * record + axis_of_[property]] = place;
  }

 private:
  NumberTriples& triples_;
  std::vector<std::uint8_t> axis_of_;  // per property: 0, 1, 2, or 3 for none
};

// Two cursors over the data of a PLY file, with one interface. Both return the numbers record by
// record, and `place` is the offset of the last one.

/// Ascii: one record per line.
class PlyTextCursor {
 public:
  PlyTextCursor(const SourceFile& file, const PlyHeader& header)
      : file_(file), scan_(file, '\0', header.data_offset) {}

  void begin_record() { scan_.skip_space(); }
  void end_record() {
    if (!scan_.at_line_end()) scan_.fail_expected("the end of the record");
  }
  double number(Scalar /*type*/) {
    scan_.skip_blanks();
    place_ = scan_.offset();
    return scan_.number("a number");
  }
  std::int64_t integer(Scalar /*type*/) {
    scan_.skip_blanks();
    place_ = scan_.offset();
    const std::int64_t value = scan_.integer("an integer");
    scan_.end_word("an integer");
    return value;
  }
  std::uint64_t offset() const { return scan_.offset(); }
  std::uint64_t place() const { return place_; }
  /// Throws InputError unless the file has room for a list of `count` numbers.
  void check_list(std::int64_t count, Scalar /*type*/) const {
    const std::uint64_t room = (file_.bytes().size() - scan_.offset()) / 2 + 1;
    if (count < 0 || static_cast<std::uint64_t>(count) > room) {
      file_.fail(place_, "a list cannot have " + std::to_string(count) + " entries here");
    }
  }
  bool at_end() {
    scan_.skip_space();
    return scan_.at_end();
  }

 private:
  const SourceFile& file_;
  TextScanner scan_;
  std::uint64_t place_ = 0;
};

/// Binary, in either byte order.
class PlyBinaryCursor {
 public:
  PlyBinaryCursor(const SourceFile& file, const PlyHeader& header)
      : file_(file), encoding_(header.encoding), at_(header.data_offset) {}

  void begin_record() {}
  void end_record() {}
  double number(Scalar type) {
    const std::size_t size = size_of(type);
    if (size > file_.bytes().size() - at_)
      file_.fail(at_, "expected a number, found the end of the file");
    place_ = at_;
    at_ += size;
    return load_number(file_.bytes().data() + place_, type, encoding_);
  }
  std::int64_t integer(Scalar type) { return static_cast<std::int64_t>(number(type)); }
  std::uint64_t offset() const { return at_; }
  std::uint64_t place() const { return place_; }
  void check_list(std::int64_t count, Scalar type) const {
    const std::uint64_t room = (file_.bytes().size() - at_) / size_of(type);
    if (count < 0 || static_cast<std::uint64_t>(count) > room) {
      file_.fail(place_, "a list cannot have " + std::to_string(count) + " entries here");
    }
  }
  bool at_end() const { return at_ == file_.bytes().size(); }

 private:
  const SourceFile& file_;
  Encoding encoding_;
  std::uint64_t at_;
  std::uint64_t place_ = 0;
};

}  // namespace lapwing
