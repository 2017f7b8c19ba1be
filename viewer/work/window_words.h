#pragma once

#include <string>
#include <string_view>

namespace lapwing::viewer {

/// The words by which the window shows a key of a step.
struct KeyWords {
  std::string_view key;   ///< as in recipes
  std::string_view flag;  ///< as in StepKey; distinguishes keys of the same name, otherwise empty
  std::string_view label;
  std::string_view help;  ///< a tooltip of one or more sentences
};

/// Returns the words for a key of the solver settings, or null if the window has none.
const KeyWords* words_of_key(std::string_view key, std::string_view flag = {});

/// Returns the label of a choice in a recipe, such as "Move along" for "carry". Other names are
/// returned with an initial capital.
std::string choice_in_words(std::string_view name);

/// Returns what the user sees while the engine works on `stage`, such as "Factorizing the matrix"
/// for "factor". Returns other stages unchanged.
std::string_view stage_in_words(std::string_view stage);

/// Returns a message of the engine in the words of the window: with labels instead of the keys of
/// recipes, "region" instead of "ROI", "fixed border" instead of "belt", and an initial capital.
std::string in_window_words(std::string message);

}  // namespace lapwing::viewer
