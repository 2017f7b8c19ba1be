#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/step.h"

namespace lapwing::viewer {

/// The severity of a message.
enum class Tone {
  note,     ///< information
  warning,  ///< the action was carried out, but the result may be unintended
  error,    ///< the action was not carried out
};

/// A message to the user.
struct Message {
  std::string text;
  Tone tone = Tone::note;
  std::shared_ptr<const Step> step;  ///< the step that the message is about, or null

  Message(std::string words, Tone its_tone = Tone::note,
          std::shared_ptr<const Step> its_step = nullptr)
      : text(std::move(words)), tone(its_tone), step(std::move(its_step)) {}
  Message(const char* words) : text(words) {}
  /// Reports an action that failed, with the reason.
  explicit Message(const std::exception& error) : text(error.what()), tone(Tone::error) {}

  bool operator==(const Message&) const = default;
};

/// Shows a message to the user. An empty message removes those of its tone that are still shown:
/// the note, or the errors once their cause is gone.
using Say = std::function<void(Message)>;

/// Calls `act` and returns true. If `act` throws an Error, passes its message to `say` and returns
/// false.
template <class Act>
bool say_errors(const Say& say, const Act& act) {
  try {
    act();
    return true;
  } catch (const Error& error) {
    say(Message(error));
    return false;
  }
}

}  // namespace lapwing::viewer
