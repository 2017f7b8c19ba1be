#include "lapwing/base/counted.h"

#include <algorithm>

namespace lapwing {
namespace {

std::string_view word_at(std::string_view words, std::size_t begin) {
  return words.substr(begin, words.find(' ', begin) - begin);
}

void make_noun_singular(std::string& words) {
  for (std::size_t begin = 0; begin < words.size();) {
    const std::string_view word = word_at(words, begin);
    const std::size_t end = begin + word.size();
    if (word == "vertices") {
      words.replace(begin, word.size(), "vertex");
      return;
    }
    if (word.ends_with('s')) {
      words.erase(end - 1, 1);
      return;
    }
    begin = end + 1;
  }
}

// Appends -s to the verb after "that", so that "face that repeat a vertex" becomes "face that
// repeats a vertex". A verb in the past tense ends in -ed and does not change.
void make_verb_singular(std::string& words) {
  constexpr std::string_view kThat = " that ";
  const std::size_t that = words.find(kThat);
  if (that == std::string::npos) return;
  const std::size_t begin = that + kThat.size();
  const std::string_view verb = word_at(words, begin);
  if (!verb.ends_with("ed")) words.insert(begin + verb.size(), "s");
}

}  // namespace

std::string singular(std::string_view plural) {
  std::string words(plural);
  if (plural.starts_with("of ")) return words;
  make_noun_singular(words);
  make_verb_singular(words);
  return words;
}

}  // namespace lapwing
