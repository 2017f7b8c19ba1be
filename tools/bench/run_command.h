#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lapwing::bench {

/// The command that runs the whole benchmark. Adds its options to `app`; call `run` after parsing.
class RunCommand {
 public:
  explicit RunCommand(CLI::App& app);

  /// Measures, prints the table and writes the report, or only shows a saved report (--show).
  /// Throws InputError if no row matches --filter and --vertices.
  void run(const std::string& command_line) const;

 private:
  bool quick_ = false;
  bool counts_ = false;
  bool no_peers_ = false;
  std::string filter_;
  std::string models_ = "build/models";
  std::vector<std::string> devices_{"cpu", "auto"};
  std::vector<std::size_t> vertices_;  // least and most
  int repeats_ = 0;
  double memory_gb_ = 16.0;
  std::string json_;
  std::string show_;
};

}  // namespace lapwing::bench
