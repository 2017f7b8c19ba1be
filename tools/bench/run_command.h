#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lapwing::bench {

struct Report;

/// Declares the options of a run of the whole benchmark on `app`. What they ask for is done by
/// `run_command` after parsing.
class RunCommand {
 public:
  explicit RunCommand(CLI::App& app);

  /// Measures, prints and writes; or compares. The exit code: 0, or 1 when a comparison found
  /// something worse.
  int run(const std::string& command_line) const;

 private:
  void write(const Report& report) const;
  int compare_reports(const std::filesystem::path& before,
                      const std::filesystem::path& after) const;

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
  std::string page_;
  std::string plots_;
  std::vector<std::string> compare_;
  std::string against_;
  std::string show_;
};

}  // namespace lapwing::bench
