#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "lapwing/recipe/recipe.h"

namespace lapwing {

/// One key of a step: what recipes, flags and the reference have in common.
struct Key {
  std::string_view name;  ///< in recipes: "detail_length"
  std::string_view help;  ///< a sentence without capital and full stop
  bool required = false;
  std::string_view absent = "";  ///< what holds when an optional value is not given, in words
  bool automatic = false;        ///< "auto" stands for not given
  std::string_view flag = "";    ///< without dashes; the name with dashes if empty
  /// A flag without a value, in place of `flag`: it takes the last choice, or switches off.
  std::string_view off_flag = "";
  std::string_view off_help = "";
  std::string_view flag_default = "";  ///< makes a required key optional as a flag: "all"
};

/// The fewest digits that say `number`, without an exponent.
std::string digits(double number);

/// The numbers that a key takes.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool takes_least = true;
  std::string_view reason = "";  ///< why not more, in words

  bool contains(double number) const;
  /// "a number above 0", "0 or more"; with `whole` "a whole number from 1 to 1000".
  std::string words(bool whole = false) const;
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kAboveZero{.least = 0.0, .takes_least = false};
inline constexpr Range kFromZero{.least = 0.0};

template <class Enum>
struct Choice {
  Enum value;
  std::string_view name;
};

/// How an object that may be missing is written.
enum class ObjectForm {
  optional,  ///< left out where there is none
  boolean,   ///< true: as the defaults are; false: there is none
};

/// The sources of a mix: how many, and what they are called.
struct ListWords {
  std::string_view items;                    ///< "two sources"
  std::string_view fewer;                    ///< what to do with fewer
  std::span<const std::string_view> prefix;  ///< one per item: what their flags begin with
};

/// Goes through the keys of a step, in the order of the reference: reads them, writes them, makes
/// flags of them. What a key is, is said once, by the `describe` of its step (step_keys.h).
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;

  virtual void number(const Key& key, double& value, const Range& range) = 0;
  virtual void number(const Key& key, std::optional<double>& value, const Range& range) = 0;
  virtual void whole(const Key& key, int& value, const Range& range) = 0;
  virtual void whole(const Key& key, std::optional<std::size_t>& value) = 0;
  virtual void boolean(const Key& key, bool& value) = 0;
  template <class Enum>
  void choice(const Key& key, Enum& value,
              std::initializer_list<Choice<std::type_identity_t<Enum>>> choices) {
    std::vector<std::string_view> names;
    std::size_t chosen = 0;
    for (const auto& [each, name] : choices) {
      if (each == value) chosen = names.size();
      names.push_back(name);
    }
    choose(key, chosen, names);
    value = choices.begin()[chosen].value;
  }

  virtual void region(const Key& key, RegionSpec& value) = 0;
  virtual void belt(const Key& key, BeltSpec& value) = 0;
  virtual void handles(const Key& key, std::vector<MovedHandle>& value) = 0;
  virtual void pairs(const Key& key, std::vector<VertexPair>& value) = 0;
  virtual void weight(const Key& key, MixWeight& value) = 0;
  virtual void file(const Key& key, std::filesystem::path& value) = 0;
  /// A mesh file, or what is cut of one.
  virtual void part(const Key& key, std::filesystem::path& mesh,
                    std::optional<RegionSpec>& region) = 0;
  /// Where a part comes to; with a move, whether it is brought onto the surface (`snap`).
  virtual void place(const Key& key, PartPlace& value, const Key& snap_key, bool& snap) = 0;

  /// An object with keys of its own, by `describe(value, visitor)`.
  template <class Value>
  void object(const Key& key, std::optional<Value>& value, ObjectForm form) {
    Value inside = value.value_or(Value{});
    bool given = value.has_value();
    if (enter(key, given, form, inside == Value{})) {
      begin_keys([&](KeyVisitor& visitor) { describe(inside, visitor); });
      describe(inside, *this);
      leave();
    }
    value = given ? std::optional(inside) : std::nullopt;
  }
  /// An object that groups the keys that `members(visitor)` visits; left out where none is `given`.
  template <class Members>
  void group(const Key& key, bool given, const Members& members) {
    if (!enter(key, given, ObjectForm::optional, false)) return;
    begin_keys([&](KeyVisitor& visitor) { members(visitor); });
    members(*this);
    leave();
  }
  template <class Value, std::size_t N>
  void list(const Key& key, std::array<Value, N>& values, const ListWords& words) {
    begin_list(key, N, words);
    for (std::size_t k = 0; k < N; ++k) {
      begin_item(k, words);
      begin_keys([&](KeyVisitor& visitor) { describe(values[k], visitor); });
      describe(values[k], *this);
      end_item();
    }
    end_list(key);
  }

  /// What errors name the step or source by.
  virtual void where(std::string& name) = 0;
  /// The key, visited before, has a meaning only where `holds`.
  virtual void only_when(bool holds, std::string_view key, std::string_view otherwise) = 0;
  /// What must hold between keys; `pointer` is the one at fault, from the step.
  virtual void require(bool holds, const std::string& pointer, std::string_view otherwise) = 0;

 protected:
  virtual void choose(const Key& key, std::size_t& chosen,
                      const std::vector<std::string_view>& names) = 0;
  /// Whether the keys inside are to be visited; `given`: whether there is one.
  virtual bool enter(const Key& key, bool& given, ObjectForm form, bool is_default) = 0;
  virtual void leave() = 0;
  /// An object that was entered has the keys that `keys` visits.
  virtual void begin_keys(const std::function<void(KeyVisitor&)>&) {}
  virtual void begin_list(const Key& key, std::size_t count, const ListWords& words) = 0;
  virtual void begin_item(std::size_t number, const ListWords& words) = 0;
  virtual void end_item() = 0;
  virtual void end_list(const Key& key) = 0;
};

}  // namespace lapwing
