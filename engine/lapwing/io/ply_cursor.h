#pragma once

#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/ply_header.h"
#include "lapwing/io/text_scanner.h"

namespace lapwing {

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
