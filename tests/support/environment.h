#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace lapwing::test {

/// Returns the integer in the environment variable `variable`, or `usual` if the variable is not
/// set. Endurance tests set larger numbers in order to find more defects.
inline int how_often(const char* variable, int usual) {
  const char* const wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

/// Sets an environment variable while this object exists.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (before_) {
      setenv(name_, before_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

}  // namespace lapwing::test
