#include "lapwing/step/key_visitor.h"

#include <charconv>

namespace lapwing {

std::string digits(double number) {
  // Long enough for the smallest double.
  std::array<char, 512> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

bool Range::contains(double number) const {
  return (takes_least ? number >= least : number > least) && number <= most;
}

std::string Range::words(bool whole) const {
  const bool has_most = most < std::numeric_limits<double>::infinity();
  std::string text = whole ? "a whole number" : "a number";
  if (has_most && takes_least) {
    text += " from " + digits(least) + " to " + digits(most);
  } else if (!takes_least) {
    text += " above " + digits(least) + (has_most ? " and at most " + digits(most) : "");
  } else if (least == 0.0) {
    text = whole ? "a whole number from 0" : "0 or more";
  }
  return reason.empty() ? text : text + " (" + std::string(reason) + ")";
}

void KeyVisitor::number(const StepKey& key, double&, const Range&) {
  other(key);
}
void KeyVisitor::number(const StepKey& key, std::optional<double>&, const Range&) {
  other(key);
}
void KeyVisitor::whole(const StepKey& key, int&, const Range&) {
  other(key);
}
void KeyVisitor::whole(const StepKey& key, std::optional<std::size_t>&) {
  other(key);
}
void KeyVisitor::boolean(const StepKey& key, bool&) {
  other(key);
}
void KeyVisitor::region(const StepKey& key, RegionSpec&) {
  other(key);
}
void KeyVisitor::belt(const StepKey& key, BeltSpec&) {
  other(key);
}
void KeyVisitor::mirror(const StepKey& key, std::optional<MirrorSpec>&) {
  other(key);
}
void KeyVisitor::carry(const StepKey& key, std::vector<CarrySpec>&) {
  other(key);
}
void KeyVisitor::targets(const StepKey& key, TargetSpec&) {
  other(key);
}
void KeyVisitor::handles(const StepKey& key, std::vector<MovedHandle>&, HandleForm) {
  other(key);
}
void KeyVisitor::pairs(const StepKey& key, std::vector<VertexPair>&) {
  other(key);
}
void KeyVisitor::weight(const StepKey& key, MixWeight&) {
  other(key);
}
void KeyVisitor::file(const StepKey& key, std::filesystem::path&) {
  other(key);
}
void KeyVisitor::part(const StepKey& key, std::filesystem::path&, std::optional<RegionSpec>&) {
  other(key);
}
void KeyVisitor::place(const StepKey& key, PartPlace&, const StepKey& snap_key, bool&) {
  other(key);
  other(snap_key);
}
void KeyVisitor::choose(const StepKey& key, std::size_t&, const std::vector<std::string_view>&) {
  other(key);
}
bool KeyVisitor::enter(const StepKey& key, bool&, ObjectForm, bool) {
  other(key);
  return false;
}
void KeyVisitor::begin_list(const StepKey& key, std::size_t, const ListWords&) {
  other(key);
}

}  // namespace lapwing
