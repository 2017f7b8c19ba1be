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

#include "lapwing/coating/coat_request.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/region/region_spec.h"
#include "lapwing/transplant/transplant_request.h"

namespace lapwing {

/// One key of a step: what recipes, flags and the reference have in common.
struct StepKey {
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
  /// What a slider goes through, with `of_size` as shares of the mesh's; 0 to 0: it is typed in.
  double slider_from = 0.0;  ///< above 0: by its logarithm
  double slider_to = 0.0;
  bool of_size = false;
  double first = 1.0;  ///< of an optional number that a person switches on

  bool contains(double number) const;
  /// "a number above 0", "0 or more"; with `whole` "a whole number from 1 to 1000".
  std::string words(bool whole = false) const;
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kAboveZero{.least = 0.0, .takes_least = false};
inline constexpr Range kFromZero{.least = 0.0};
/// How strongly something is held.
inline constexpr Range kWeight{.least = kLeastWeight, .most = kMostWeight};
/// A length on a mesh, which a slider takes to a quarter of its size.
inline constexpr Range kLength{.least = 0.0, .slider_to = 0.25, .of_size = true};

template <class Enum>
struct Choice {
  Enum value;
  std::string_view name;
};

/// Whether handles may hold some vertices less than others (Grading).
enum class HandleForm { firm, graded };

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
/// flags of them. What a key is, is said once, by the `describe` of its step (step.h).
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;

  virtual void number(const StepKey& key, double& value, const Range& range);
  virtual void number(const StepKey& key, std::optional<double>& value, const Range& range);
  virtual void whole(const StepKey& key, int& value, const Range& range);
  virtual void whole(const StepKey& key, std::optional<std::size_t>& value);
  virtual void boolean(const StepKey& key, bool& value);
  template <class Enum>
  void choice(const StepKey& key, Enum& value,
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

  virtual void region(const StepKey& key, RegionSpec& value);
  virtual void belt(const StepKey& key, BeltSpec& value);
  virtual void handles(const StepKey& key, std::vector<MovedHandle>& value, HandleForm form);
  virtual void targets(const StepKey& key, TargetSpec& value);
  virtual void mirror(const StepKey& key, std::optional<MirrorSpec>& value);
  virtual void carry(const StepKey& key, std::vector<CarrySpec>& value);
  virtual void pairs(const StepKey& key, std::vector<VertexPair>& value);
  virtual void weight(const StepKey& key, MixWeight& value);
  virtual void file(const StepKey& key, std::filesystem::path& value);
  /// A mesh file, or what is cut of one.
  virtual void part(const StepKey& key, std::filesystem::path& mesh,
                    std::optional<RegionSpec>& region);
  /// Where a part comes to; with a move, whether it is brought onto the surface (`snap`).
  virtual void place(const StepKey& key, PartPlace& value, const StepKey& snap_key, bool& snap);

  /// An object with keys of its own, by `describe(value, visitor)`.
  template <class Value>
  void object(const StepKey& key, std::optional<Value>& value, ObjectForm form) {
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
  void group(const StepKey& key, bool given, const Members& members) {
    if (!enter(key, given, ObjectForm::optional, false)) return;
    begin_keys([&](KeyVisitor& visitor) { members(visitor); });
    members(*this);
    leave();
  }
  template <class Value, std::size_t N>
  void list(const StepKey& key, std::array<Value, N>& values, const ListWords& words) {
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
  virtual void where(std::string&) {}
  /// The key, visited before, has a meaning only where `holds`.
  virtual void only_when(bool /*holds*/, std::string_view /*key*/, std::string_view /*otherwise*/) {
  }
  /// What must hold between keys; `pointer` is the one at fault, from the step.
  virtual void require(bool /*holds*/, const std::string& /*pointer*/,
                       std::string_view /*otherwise*/) {}

 protected:
  /// Any key whose own function is not overridden.
  virtual void other(const StepKey&) {}
  virtual void choose(const StepKey& key, std::size_t& chosen,
                      const std::vector<std::string_view>& names);
  /// Whether the keys inside are to be visited; `given`: whether there is one.
  virtual bool enter(const StepKey& key, bool& given, ObjectForm form, bool is_default);
  virtual void leave() {}
  /// An object that was entered has the keys that `keys` visits.
  virtual void begin_keys(const std::function<void(KeyVisitor&)>&) {}
  virtual void begin_list(const StepKey& key, std::size_t count, const ListWords& words);
  virtual void begin_item(std::size_t /*number*/, const ListWords&) {}
  virtual void end_item() {}
  virtual void end_list(const StepKey&) {}
};

}  // namespace lapwing
