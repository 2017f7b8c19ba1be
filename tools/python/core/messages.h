#pragma once

#include <string>
#include <vector>

namespace lapwing::python {

/// Rewrites a message of the engine for Python by replacing JSON pointers and shell commands. For
/// example, "deform: /handles/0/region: ..." becomes "deform: handles[0].region: ...", and
/// "`lapwing check MESH --fix OUT`" becomes "`lapwing.fix`".
std::string in_python_words(std::string message);
std::vector<std::string> in_python_words(std::vector<std::string> messages);

}  // namespace lapwing::python
