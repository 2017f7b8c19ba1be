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
#include "lapwing/wrap/landmarks.h"

namespace lapwing {

/// The description of one key of a step, for recipes, flags and the reference.
struct StepKey {
  std::string_view name;  ///< name in recipes, such as "detail_length"
  std::string_view help;  ///< a sentence without a capital letter at the start or a full stop
  bool required = false;
  std::string_view absent = "";  ///< the default of an optional value, in words
  bool automatic = false;        ///< "auto" is the same as no value
  std::string_view flag = "";    ///< without leading dashes; if empty, `name` with dashes
  /// An alternative flag without a value. It selects the last choice, or false.
  std::string_view off_flag = "";
  std::string_view off_help = "";
  std::string_view flag_default = "";  ///< default of the flag of a required key, such as "all"
};

/// Returns the shortest decimal text, without exponent, that is read back as the same number.
std::string digits(double number);

/// The valid numbers of a key.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool takes_least = true;
  std::string_view reason = "";  ///< reason of the upper bound, in words
  /// Ends of the slider, relative to the size of the mesh if `of_size` is true. If `slider_to` is
  /// 0, there is a text field instead of a slider.
  double slider_from = 0.0;  ///< if positive, the slider is logarithmic
  double slider_to = 0.0;
  bool of_size = false;
  double first = 1.0;  ///< initial value when the user activates an optional number

  bool contains(double number) const;
  /// Returns "a number above 0" or "0 or more", or with `whole` "a whole number from 1 to 1000".
  std::string words(bool whole = false) const;
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kAboveZero{.least = 0.0, .takes_least = false};
inline constexpr Range kFromZero{.least = 0.0};
/// Weight of a constraint.
inline constexpr Range kWeight{.least = kMinWeight, .most = kMaxWeight};
/// A length on a mesh. The slider ends at a quarter of the mesh's size.
inline constexpr Range kLength{.least = 0.0, .slider_to = 0.25, .of_size = true};

template <class Enum>
struct Choice {
  Enum value;
  std::string_view name;
};

/// Whether the weights of a handle may vary over its vertices (Falloff).
enum class HandleForm { firm, graded };

/// Form in which an optional object is written.
enum class ObjectForm {
  optional,  ///< omitted if it is not set
  boolean,   ///< true for the defaults, false if it is not set
};

/// Names of the sources of a mix.
struct ListWords {
  std::string_view items;                    ///< "two sources"
  std::string_view fewer;                    ///< advice if there are fewer
  std::span<const std::string_view> prefix;  ///< prefix of the flags of each item
};

/// Visits the keys of a step, in the order of the reference. Visitors read and write recipes and
/// add flags. The keys of a step are described only in its `describe` function (step.h).
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;

  virtual void number(const StepKey& key, double&, const Range&) { other(key); }
  virtual void number(const StepKey& key, std::optional<double>&, const Range&) { other(key); }
  virtual void whole(const StepKey& key, int&, const Range&) { other(key); }
  virtual void whole(const StepKey& key, std::optional<std::size_t>&) { other(key); }
  virtual void boolean(const StepKey& key, bool&) { other(key); }
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

  virtual void region(const StepKey& key, RegionSpec&) { other(key); }
  virtual void belt(const StepKey& key, BeltSpec&) { other(key); }
  virtual void handles(const StepKey& key, std::vector<MovedHandle>&, HandleForm) { other(key); }
  virtual void targets(const StepKey& key, TargetSpec&) { other(key); }
  virtual void landmarks(const StepKey& key, LandmarkSpec&) { other(key); }
  virtual void stiffness(const StepKey& key, std::vector<StiffnessSpec>&) { other(key); }
  virtual void mirror(const StepKey& key, std::optional<MirrorSpec>&) { other(key); }
  virtual void carry(const StepKey& key, std::vector<CarrySpec>&) { other(key); }
  virtual void pairs(const StepKey& key, std::vector<VertexPair>&) { other(key); }
  virtual void weight(const StepKey& key, MixWeight&) { other(key); }
  virtual void file(const StepKey& key, std::filesystem::path&) { other(key); }
  /// A mesh file, and optionally a region to cut from it.
  virtual void part(const StepKey& key, std::filesystem::path&, std::optional<RegionSpec>&) {
    other(key);
  }
  /// Placement of a part. `snap_key` is the key for moving it onto the surface afterwards.
  virtual void place(const StepKey& key, PartPlace&, const StepKey& snap_key, bool&) {
    other(key);
    other(snap_key);
  }

  /// An object whose keys `describe(value, visitor)` visits.
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
  /// An object that contains the keys that `members(visitor)` visits. It is omitted unless `given`.
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

  /// Name of the step or source in error messages.
  virtual void where(std::string&) {}
  /// States that `key`, which was visited before, is only valid if `holds` is true.
  virtual void only_when(bool /*holds*/, std::string_view /*key*/, std::string_view /*otherwise*/) {
  }
  /// States a condition on several keys. `pointer` is the JSON pointer, relative to the step, of
  /// the invalid key.
  virtual void require(bool /*holds*/, const std::string& /*pointer*/,
                       std::string_view /*otherwise*/) {}

 protected:
  /// Called for every key whose member function is not overridden.
  virtual void other(const StepKey&) {}
  virtual void choose(const StepKey& key, std::size_t& /*chosen*/,
                      const std::vector<std::string_view>& /*names*/) {
    other(key);
  }
  /// Returns whether to visit the keys of the object. `given` tells whether the object is set.
  virtual bool enter(const StepKey& key, bool& /*given*/, ObjectForm /*form*/,
                     bool /*is_default*/) {
    other(key);
    return false;
  }
  virtual void leave() {}
  /// Called for an object that was entered, with a function that visits its keys.
  virtual void begin_keys(const std::function<void(KeyVisitor&)>&) {}
  virtual void begin_list(const StepKey& key, std::size_t /*count*/, const ListWords&) {
    other(key);
  }
  virtual void begin_item(std::size_t /*number*/, const ListWords&) {}
  virtual void end_item() {}
  virtual void end_list(const StepKey&) {}
};

}  // namespace lapwing
