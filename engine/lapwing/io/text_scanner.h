#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lapwing/io/source_file.h"

namespace lapwing {

/// Parses the number that starts at `begin`: decimal or exponent form, a leading '+', nan and inf
/// (also as "1.#INF", "1.#IND"). Returns the first byte behind it, or `begin` if there is none.
/// Values beyond the range of double become infinite.
const char* parse_number(const char* begin, const char* end, double& value);

/// Returns " (write numbers with a decimal point, not a comma)" if `word` is a number with a
/// decimal comma, such as "0,5"; otherwise returns "". For error messages.
std::string_view hint_of_decimal_comma(std::string_view word);

/// Walks over the text of a mesh file, word by word. Blanks are spaces, tabs and a backslash before
/// a line end; a line ends at "\n", "\r" or "\r\n". Reads never leave the file.
class TextScanner {
 public:
  /// `comment` is the character that opens a comment up to the line's end; NUL if there is none.
  TextScanner(const SourceFile& file, char comment, std::uint64_t begin = 0);

  bool at_end() const { return here_ == end_; }
  std::uint64_t offset() const { return static_cast<std::uint64_t>(here_ - begin_); }
  char peek() const { return *here_; }  ///< NUL at the end
  void advance() { ++here_; }           ///< only when not `at_end()`

  void skip_blanks() {
    while (*here_ == ' ' || *here_ == '\t' || *here_ == '\\' || *here_ == '\v' || *here_ == '\f') {
      if (*here_ == '\\' && !skip_continuation()) return;
      ++here_;
    }
  }
  /// Skips blanks. Returns true at a line end, a comment or the end of the file.
  bool at_line_end() {
    skip_blanks();
    return *here_ == '\n' || *here_ == '\r' || here_ == end_ ||
           (comment_ != '\0' && *here_ == comment_);
  }
  /// Skips the rest of this line.
  void next_line();
  /// Skips blanks, line ends and comments.
  void skip_space();

  /// Returns the next word of this line; empty at the line's end.
  std::string_view word();
  /// Returns the rest of the line, comments included, without blanks at either end. Stops before
  /// the line end.
  std::string_view rest_of_line();

  /// Returns the next number of this line. `what` names it in error messages.
  double number(std::string_view what);
  /// Returns the next three numbers of this line, and adds their locations to `places`. `what`
  /// names them in error messages.
  Eigen::Vector3d triple(NumberTriples& places, std::string_view what);
  /// Returns the next integer of this line, which may end at any byte that is not a digit.
  std::int64_t integer(std::string_view what);
  /// Throws InputError unless a blank, a line end or a comment follows.
  void end_word(std::string_view what) {
    if (!is_word_end()) fail_word(what);
  }
  /// Throws InputError: expected `what`, found the word at this position.
  [[noreturn]] void fail_expected(std::string_view what) const;

 private:
  bool is_word_end() const {
    const char c = *here_;
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f' ||
           here_ == end_ || (c == '\\' && (here_[1] == '\n' || here_[1] == '\r')) ||
           (comment_ != '\0' && c == comment_);
  }
  bool skip_continuation();
  [[noreturn]] void fail_word(std::string_view what);

  const SourceFile* file_;
  const char* begin_;
  const char* here_;
  const char* end_;
  char comment_;
};

/// Returns `text` in lower case. Changes only ASCII letters.
std::string lowered(std::string_view text);

/// Skips a UTF-8 byte order mark. Throws InputError for UTF-16 text and other files with NUL bytes.
TextScanner scan_text(const SourceFile& file, char comment);

}  // namespace lapwing
