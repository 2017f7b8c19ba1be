#include "lapwing/json/parse_json.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/json/json_text.h"

namespace lapwing {

using Json = nlohmann::ordered_json;

namespace {

// Iterates over a text and counts the characters that the library's parser has read.
class CountedText {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountedText(const char* at, std::size_t* count) : at_(at), count_(count) {}
  reference operator*() const { return *at_; }
  CountedText& operator++() {
    ++at_;
    ++*count_;
    return *this;
  }
  CountedText operator++(int) {
    const CountedText before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountedText& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  std::size_t* count_;
};

// Builds the document. Reports errors with line, column and JSON pointer.
class DocumentBuilder : public nlohmann::json_sax<Json> {
 public:
  DocumentBuilder(std::string_view text, const std::string& name, std::size_t first_line)
      : text_(text), name_(name), first_line_(first_line) {}

  Json build() {
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) {
      fail(0, "expected UTF-8 text, found UTF-16; save the file as UTF-8");
    }
    // nlohmann-json treats a NUL byte as the end of the text and would ignore the bytes after it.
    if (const std::size_t nul = text_.find('\0'); nul != std::string_view::npos) {
      fail(nul + 1, "expected UTF-8 text, found a NUL byte; the file is damaged, or is not text");
    }
    Json::sax_parse(CountedText(text_.data(), &read_),
                    CountedText(text_.data() + text_.size(), &read_), this);
    return std::move(root_);
  }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    if (open_.back()->contains(value)) {
      fail(read_, pointer(value) + ": the key \"" + value +
                      "\" appears twice in one object; remove one of the two");
    }
    keys_.back() = std::move(value);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    if (dynamic_cast<const nlohmann::detail::out_of_range*>(&error) != nullptr) {
      fail(position, pointer() + ": the number " + token +
                         " is too large for a double; write a number below 1.8e308");
    }
    fail(position, bare_message(error) + "; check commas, quotes and brackets before this place");
  }

 private:
  // Returns the library's message without its prefix of class, number and position.
  static std::string bare_message(const nlohmann::detail::exception& error) {
    const std::string_view text = error.what();
    const std::size_t at = text.find("syntax error");
    return std::string(at == std::string_view::npos ? text : text.substr(at));
  }

  template <class Value>
  bool add(Value value) {
    place(Json(std::move(value)));
    return true;
  }

  Json* place(Json value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Json& parent = *open_.back();
    if (parent.is_array()) {
      parent.push_back(std::move(value));
      return &parent.back();
    }
    Json& member = parent[keys_.back()];
    member = std::move(value);
    return &member;
  }

  bool open(Json empty) {
    if (open_.size() == kDeepestJson) {
      fail(read_, "lists and objects are nested more than " + std::to_string(kDeepestJson) +
                      " levels deep; reduce the nesting");
    }
    open_.push_back(place(std::move(empty)));
    keys_.emplace_back();
    return true;
  }

  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  // Returns the JSON pointer of the value being read.
  std::string pointer() const {
    return open_.empty()              ? "/"
           : open_.back()->is_array() ? pointer(std::to_string(open_.back()->size()))
                                      : pointer(keys_.back());
  }

  // Returns the JSON pointer of `last` in the innermost open object or list.
  std::string pointer(std::string_view last) const {
    std::string text;
    for (std::size_t k = 0; k + 1 < open_.size(); ++k) {
      text += "/" + (open_[k]->is_array() ? std::to_string(open_[k]->size() - 1)
                                          : pointer_token(keys_[k]));
    }
    return text + "/" + pointer_token(last);
  }

  [[noreturn]] void fail(std::size_t position, const std::string& message) const {
    throw InputError(name_ + ":" +
                     line_and_column(text_, position > 0 ? position - 1 : 0, first_line_) + ": " +
                     message);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t first_line_;
  std::size_t read_ = 0;
  Json root_;
  std::vector<Json*> open_;        // open objects and lists, outermost first
  std::vector<std::string> keys_;  // last key of each open object; empty for a list
};

}  // namespace

Json parse_json(std::string_view text, const std::string& name, std::size_t first_line) {
  return DocumentBuilder(text, name, first_line).build();
}

std::string pointer_token(std::string_view key) {
  std::string token;
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

}  // namespace lapwing
