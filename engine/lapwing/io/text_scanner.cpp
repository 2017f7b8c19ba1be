#include "lapwing/io/text_scanner.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include <fast_float/fast_float.h>

namespace lapwing {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// The spellings of the old Microsoft run-time library: 1.#INF, -1.#IND00, 1.#QNAN.
const char* parse_old_special(const char* begin, const char* end, double& value) {
  const bool negative = begin != end && *begin == '-';
  const char* at = negative ? begin + 1 : begin;
  if (end - at < 4 || std::string_view(at, 3) != "1.#") return begin;
  at += 3;
  const bool infinite = end - at >= 3 && std::string_view(at, 3) == "INF";
  while (at != end && std::isalnum(static_cast<unsigned char>(*at)) != 0) ++at;
  value =
      infinite ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  if (negative) value = -value;
  return at;
}

}  // namespace

const char* parse_number(const char* begin, const char* end, double& value) {
  const char* first = begin;
  if (first != end && *first == '+') {
    ++first;
    if (first != end && (*first == '-' || *first == '+')) return begin;
  }
  const fast_float::from_chars_result result = fast_float::from_chars(first, end, value);
  if (result.ptr == first) return begin;
  if (result.ptr != end && *result.ptr == '#') {
    const char* const special = parse_old_special(first, end, value);
    return special == first ? result.ptr : special;
  }
  return result.ptr;
}

std::string_view hint_of_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return {};
  std::string number(word);
  number[comma] = '.';
  double value = 0.0;
  const char* const end = number.data() + number.size();
  if (parse_number(number.data(), end, value) != end) return {};
  return " (write numbers with a decimal point, not a comma)";
}

TextScanner::TextScanner(const SourceFile& file, char comment, std::uint64_t begin)
    : file_(&file),
      begin_(file.bytes().data()),
      here_(begin_ + begin),
      end_(begin_ + file.bytes().size()),
      comment_(comment) {}

bool TextScanner::skip_continuation() {
  if (here_[1] == '\n') {
    ++here_;
    return true;
  }
  if (here_[1] != '\r') return false;
  here_ += here_[2] == '\n' ? 2 : 1;
  return true;
}

void TextScanner::next_line() {
  here_ = std::find_if(here_, end_, [](char c) { return c == '\n' || c == '\r'; });
  if (here_ == end_) return;
  here_ += *here_ == '\r' && here_[1] == '\n' ? 2 : 1;
}

void TextScanner::skip_space() {
  while (at_line_end() && !at_end()) next_line();
}

std::string_view TextScanner::word() {
  skip_blanks();
  const char* const begin = here_;
  while (!is_word_end()) ++here_;
  return {begin, static_cast<std::size_t>(here_ - begin)};
}

std::string_view TextScanner::rest_of_line() {
  while (is_blank(*here_)) ++here_;
  const char* const begin = here_;
  here_ = std::find_if(here_, end_, [](char c) { return c == '\n' || c == '\r'; });
  const char* last = here_;
  while (last != begin && is_blank(last[-1])) --last;
  return {begin, static_cast<std::size_t>(last - begin)};
}

double TextScanner::number(std::string_view what) {
  skip_blanks();
  double value = 0.0;
  const char* const behind = parse_number(here_, end_, value);
  if (behind == here_) fail_expected(what);
  const char* const begin = here_;
  here_ = behind;
  if (!is_word_end()) {
    here_ = begin;
    fail_expected(what);
  }
  return value;
}

Eigen::Vector3d TextScanner::triple(NumberTriples& places, std::string_view what) {
  std::array<std::uint64_t, 3> offsets{};
  Eigen::Vector3d value;
  for (std::size_t k = 0; k < 3; ++k) {
    skip_blanks();
    offsets[k] = offset();
    value[static_cast<Eigen::Index>(k)] = number(what);
  }
  places.add(offsets[0], offsets[1], offsets[2]);
  return value;
}

std::int64_t TextScanner::integer(std::string_view what) {
  skip_blanks();
  const char* at = here_;
  const bool negative = *at == '-';
  if (negative || *at == '+') ++at;
  constexpr int kMostDigits = 18;  // these always fit
  std::int64_t value = 0;
  const char* const digits = at;
  while (*at >= '0' && *at <= '9' && at - digits < kMostDigits) value = 10 * value + (*at++ - '0');
  if (at == digits || (*at >= '0' && *at <= '9')) fail_expected(what);
  here_ = at;
  return negative ? -value : value;
}

void TextScanner::fail_word(std::string_view what) {
  while (here_ != begin_ && !is_blank(here_[-1]) && here_[-1] != '\n' && here_[-1] != '\r') --here_;
  fail_expected(what);
}

void TextScanner::fail_expected(std::string_view what) const {
  TextScanner found = *this;
  found.skip_blanks();
  std::string message = "expected " + std::string(what) + ", found ";
  if (found.at_end()) {
    message += "the end of the file";
  } else if (found.at_line_end()) {
    message += "the end of the line";
  } else {
    constexpr std::size_t kShown = 40;
    std::string word(found.word().substr(0, kShown));
    const std::string_view hint = hint_of_decimal_comma(word);
    for (char& c : word) {
      if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '?';
    }
    message += "'" + word + "'" + std::string(hint);
  }
  file_->fail_at_line(offset(), message);
}

std::string lowered(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  }
  return lower;
}

TextScanner scan_text(const SourceFile& file, char comment) {
  const std::string_view bytes = file.bytes();
  if (bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE")) {
    file.fail_at_line(0, "expected ASCII or UTF-8 text, found UTF-16: save the file as UTF-8");
  }
  const std::size_t nul = bytes.find('\0');
  if (nul != std::string_view::npos) {
    file.fail_at_line(nul, "expected " + std::string(name_of(file.format())) +
                               " text, found binary data (a NUL byte)");
  }
  return {file, comment, bytes.starts_with("\xEF\xBB\xBF") ? 3U : 0U};
}

}  // namespace lapwing
