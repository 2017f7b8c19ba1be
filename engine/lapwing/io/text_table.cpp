// The CSV format is RFC 4180 with additional separators. Quoted fields must not contain line ends.
// The page "Markups" of 3D Slicer's developer guide describes .fcsv and .mrk.json files.
#include "lapwing/io/text_table.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include "lapwing/base/errors.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/json/json_node.h"
#include "lapwing/json/json_text.h"

namespace lapwing {

namespace {

constexpr char kAnyBlanks = ' ';  // a separator that stands for blanks and tabs

// Removes blanks at both ends of `text`. Keeps tabs if they separate fields.
std::string_view trimmed(std::string_view text, char separator = kAnyBlanks) {
  const std::string_view blanks = separator == '\t' ? " " : " \t";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// Returns the length of the quoted field at the start of `line`, or 0 if `line` does not start with
// one. Two quotation marks within a field stand for one.
std::size_t quoted_size(std::string_view line) {
  if (!line.starts_with('"')) return 0;
  for (std::size_t at = 1; (at = line.find('"', at)) != std::string_view::npos; at += 2) {
    if (!line.substr(at + 1).starts_with('"')) return at + 1;
  }
  return 0;
}

// Returns the separator of a line. Semicolons have priority over commas, because numbers may have
// decimal commas. If the line contains no other separator, blanks separate its fields.
char separator_of(std::string_view line) {
  std::size_t commas = 0;
  std::size_t tabs = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    at += quoted_size(line.substr(at));
    if (at >= line.size()) break;
    if (line[at] == ';') return ';';
    if (line[at] == ',') ++commas;
    if (line[at] == '\t') ++tabs;
  }
  if (commas == 0 && tabs == 0) return kAnyBlanks;
  return commas >= tabs ? ',' : '\t';
}

// Splits a line into fields. Removes the blanks and quotation marks around each field.
std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  const std::string_view ends =
      separator == kAnyBlanks ? std::string_view(" \t") : std::string_view(&separator, 1);
  std::vector<std::string_view> fields;
  for (line = trimmed(line, separator);;) {
    const std::size_t quoted = quoted_size(line);
    std::string_view behind = line.substr(quoted);
    if (separator != kAnyBlanks) behind = trimmed(behind, separator);
    const bool is_quoted =
        quoted > 0 && (behind.empty() || ends.find(behind.front()) != std::string_view::npos);
    const std::size_t end = std::min(line.find_first_of(ends, is_quoted ? quoted : 0), line.size());
    fields.push_back(is_quoted ? line.substr(1, quoted - 2)
                               : trimmed(line.substr(0, end), separator));
    if (end == line.size()) return fields;
    line = trimmed(line.substr(end + 1), separator);
  }
}

std::optional<double> number_in(std::string_view field) {
  double value = 0.0;
  const char* const end = field.data() + field.size();
  if (field.empty() || parse_number(field.data(), end, value) != end) return {};
  return value;
}

// Returns whether a field is a number, or resembles one, such as "0,5" or "1.2.3".
bool is_like_number(std::string_view field) {
  return number_in(field) ||
         (field.find_first_of("0123456789") != std::string_view::npos &&
          field.find_first_not_of("0123456789+-.,eE ") == std::string_view::npos &&
          lowered(field.substr(0, 1)) != "e");
}

// Returns names in lower case and removes units in brackets. For example, "X (mm)" becomes "x".
std::vector<std::string> names_of(const std::vector<std::string_view>& fields) {
  std::vector<std::string> names;
  for (std::string_view field : fields) {
    if (field.size() > 1 && field.front() == '\'' && field.back() == '\'') {
      field = field.substr(1, field.size() - 2);
    }
    names.push_back(lowered(trimmed(field.substr(0, field.find_first_of("([")))));
  }
  return names;
}

class TextTableReader {
 public:
  explicit TextTableReader(NumberTable& table) : table_(table) {}

  void read() {
    std::string_view text = table_.bytes->view();
    if (text.find('\0') != std::string_view::npos) {
      throw InputError(table_.name +
                       ": expected text, found binary data (a NUL byte); save the table as UTF-8");
    }
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
      read_line(trimmed(text.substr(0, end), '\t'));
      text.remove_prefix(end);
      text.remove_prefix(text.empty() ? 0 : text.starts_with("\r\n") ? 2 : 1);
    }
  }

 private:
  void read_line(std::string_view line) {
    if (line.starts_with('#')) return read_comment(trimmed(line.substr(1)));
    if (trimmed(line).empty()) return;
    const bool may_be_header = may_have_header();
    if (may_be_header) separator_ = separator_of(line);
    const std::vector<std::string_view> fields = fields_of(line, separator_);
    if (std::ranges::all_of(fields, &std::string_view::empty)) return;
    if (may_be_header && std::ranges::none_of(fields, is_like_number)) {
      table_.header = names_of(fields);
    } else {
      add_row(fields);
    }
  }

  bool may_have_header() const { return table_.row_count() == 0 && table_.header.empty(); }

  // 3D Slicer names the columns in a comment such as "# columns = id,x,y,z".
  void read_comment(std::string_view comment) {
    constexpr std::string_view kColumns = "columns";
    if (!comment.starts_with(kColumns) || !may_have_header()) return;
    const std::string_view names = trimmed(comment.substr(kColumns.size()));
    if (!names.starts_with('=')) return;
    separator_ = separator_of(names.substr(1));
    table_.header = names_of(fields_of(names.substr(1), separator_));
    table_.header_is_comment = true;
  }

  void add_row(const std::vector<std::string_view>& fields) {
    for (const std::string_view field : fields) {
      const std::optional<double> number = number_in(field);
      if (!number) table_.texts.push_back({table_.numbers.size(), field});
      table_.numbers.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
      table_.offsets.push_back(
          static_cast<std::uint64_t>(field.data() - table_.bytes->view().data()));
    }
    table_.end_row(line_);
  }

  NumberTable& table_;
  char separator_ = kAnyBlanks;
  std::size_t line_ = 0;
};

// Adds a row for the position at `place`, which must be a list of three numbers.
void add_position(const JsonText& text, JsonPlace place, std::size_t line, NumberTable& table) {
  const std::vector<JsonPlace> coordinates = text.elements(place);
  for (const JsonPlace at : coordinates) {
    const std::optional<double> number = number_in(text.text().substr(at.begin, at.end - at.begin));
    if (!number) break;
    table.numbers.push_back(*number);
    table.offsets.push_back(at.begin);
  }
  table.end_row(line);
  const std::size_t row = table.row_count() - 1;
  if (coordinates.size() == 3 && table.row(row).size() == 3) return;
  throw InputError(table.place(row) +
                   ": expected a position of three numbers; correct it, or save the file again");
}

}  // namespace

void read_text_table(NumberTable& table) {
  TextTableReader(table).read();
}

void read_markups(NumberTable& table) {
  JsonNode::parse(table.bytes->view(), table.name);
  const JsonText text(table.bytes->view(), table.name);
  table.header = {"x", "y", "z"};
  std::size_t line = 1;
  std::size_t counted = 0;  // number of bytes whose line ends are counted in `line`
  for (const JsonPlace markup : text.elements(text.at(text.root(), "markups"))) {
    const auto points = text.find(markup, "controlPoints");
    if (!points) continue;
    for (const JsonPlace point : text.elements(*points)) {
      const auto position = text.find(point, "position");
      // 3D Slicer saves "" as the position of a control point that has no position.
      if (!position || text.text()[position->begin] != '[') continue;
      line += static_cast<std::size_t>(
          std::ranges::count(text.text().substr(counted, position->begin - counted), '\n'));
      counted = position->begin;
      add_position(text, *position, line, table);
    }
  }
}

}  // namespace lapwing
