#pragma once

#include <exception>
#include <functional>
#include <string>
#include <utility>

namespace lapwing::viewer {

/// How much of a person's attention something asks for.
enum class Tone {
  note,     ///< what was done, what is there
  warning,  ///< done, but not as it may have been meant
  error,    ///< not done
};

/// Something said to the person.
struct Message {
  std::string text;
  Tone tone = Tone::note;

  Message(std::string words, Tone its_tone = Tone::note) : text(std::move(words)), tone(its_tone) {}
  Message(const char* words) : text(words) {}
  /// What was not done, and why.
  explicit Message(const std::exception& error) : text(error.what()), tone(Tone::error) {}

  bool operator==(const Message&) const = default;
};

/// Whoever shows messages; an empty one takes back what was said last.
using Say = std::function<void(Message)>;

}  // namespace lapwing::viewer
