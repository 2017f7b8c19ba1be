// Tests the messages for wrong arguments, the help, and the output on a terminal.
#include <pty.h>
#include <regex>
#include <unistd.h>

#include "cli/command_line.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct Slip {
  const char* arguments;
  const char* answer;
};

// Lets GoogleTest name the test by its arguments.
std::ostream& operator<<(std::ostream& out, const Slip& slip) {
  return out << slip.arguments;
}

class MistypedArguments : public CommandLine, public ::testing::WithParamInterface<Slip> {};

TEST_P(MistypedArguments, AreAnsweredWithTheNearestOnesThatExist) {
  const Outcome outcome = lapwing(GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.output, std::string("lapwing: ") + GetParam().answer + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, MistypedArguments,
    ::testing::Values(
        Slip{"deforn tube.obj",
             "unknown command deforn. Did you mean deform? `lapwing --help` "
             "lists the commands"},
        Slip{"transplnt",
             "unknown command transplnt. Did you mean transplant? `lapwing --help` "
             "lists the commands"},
        Slip{"xyzzy", "unknown command xyzzy. `lapwing --help` lists the commands"},
        Slip{"--versoin",
             "unknown option --versoin. Did you mean --version? `lapwing --help` "
             "lists the commands"},
        Slip{"parts lst shelf",
             "unknown command lst. Did you mean list? `lapwing parts --help` "
             "lists the commands"},
        Slip{"deform tube.obj --handel 3 --save a.obj",
             "unknown option --handel. Did you mean --handle? `lapwing deform --help` lists the "
             "options"},
        Slip{"deform tube.obj --handle=3 --translat=0,0,1 --save a.obj",
             "unknown option --translat. Did you mean --translate? `lapwing deform --help` lists "
             "the options"},
        Slip{"deform --hepl",
             "unknown option --hepl. Did you mean --help? `lapwing deform --help` lists the "
             "options"},
        Slip{"parts show --sise 3",
             "unknown option --sise. Did you mean --size? `lapwing parts show --help` lists the "
             "options"},
        Slip{"info tube.obj more.obj",
             "unexpected argument more.obj. `lapwing info --help` lists the options"},
        Slip{"deform --save a.obj", "MESH is required. `lapwing deform --help` lists the options"},
        Slip{"", "A subcommand is required. `lapwing --help` lists the commands"}));

// Returns the commands that `lapwing --help` lists, each followed by its subcommands.
std::vector<std::string> commands_in(const std::string& help, const std::string& before) {
  std::vector<std::string> names;
  const std::size_t list = help.find("\nSubcommands:\n");
  if (list == std::string::npos) return names;
  std::istringstream lines(help.substr(list + 14));
  const std::regex name(R"(^  ([a-z]+)( .*)?$)");
  std::smatch match;
  for (std::string line; std::getline(lines, line) && !line.empty();) {
    if (std::regex_match(line, match, name)) names.push_back(before + match[1].str());
  }
  return names;
}

TEST_F(CommandLine, TwoExamplesOfEveryHelpRunInAnEmptyFolder) {
  LAPWING_NEEDS_GPU();
  std::vector<std::string> commands{""};
  for (std::size_t k = 0; k < commands.size(); ++k) {
    const std::string command = commands[k];
    const std::string help = succeed(command + " --help");
    for (const std::string& sub : commands_in(help, command.empty() ? "" : command + " ")) {
      commands.push_back(sub);
    }
    const std::size_t examples = help.find("Examples:\n");
    ASSERT_NE(examples, std::string::npos) << command;
    const std::string script = help.substr(examples + 10);
    std::size_t count = 0;
    const std::string own = "  lapwing" + (command.empty() ? "" : " " + command);
    for (std::size_t at = script.find(own); at != std::string::npos;
         at = script.find(own, at + 1)) {
      ++count;
    }
    EXPECT_GE(count, 2U) << command;
    const std::string folder = "examples-" + std::to_string(k);
    std::filesystem::create_directory(file(folder));
    write(folder + "/script", "set -e\nlapwing() { '" LAPWING_CLI "' \"$@\"; }\n" + script);
    const Outcome outcome = lapwing("--version >/dev/null; cd " + folder + " && sh ./script");
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << script << outcome.output;
  }
  EXPECT_THAT(commands, AllOf(::testing::Contains("deform"), ::testing::Contains("parts show")));
}

class OnATerminal : public CommandLine {
 protected:
  // Runs a command whose standard streams are a terminal. Returns the output on the terminal.
  std::string shown(const std::string& arguments, const std::string& environment = "") const {
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) {
      const std::string command = "cd '" + folder_.path().string() + "' && " + environment + " '" +
                                  LAPWING_CLI + "' " + arguments;
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(9);
    }
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t got = 0; (got = ::read(terminal, buffer.data(), buffer.size())) > 0;) {
      text.append(buffer.data(), static_cast<std::size_t>(got));
    }
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    return text;
  }

  const std::string cut_short_ = kLiftFlags +
                                 "--rotate 1,0,0,80 --max-iterations 1 --device cpu --mirror x "
                                 "--save b.obj ";
};

TEST_F(OnATerminal, NotesAndWarningsHaveDifferentColoursAndStagesAreShown) {
  const std::string text = shown(cut_short_);
  EXPECT_THAT(text, AllOf(HasSubstr("lapwing: \033[1;33mwarning:\033[0m step 1: not settled"),
                          HasSubstr("lapwing: \033[1;36mnote:\033[0m step 1: mirrored"),
                          HasSubstr("] topology")));
  EXPECT_THAT(shown(cut_short_, "NO_COLOR=1"), HasSubstr("lapwing: warning: step 1: not settled"));
}

TEST_F(OnATerminal, WithoutOneThereIsNoColourAndNoStage) {
  const std::string text = succeed(cut_short_);
  EXPECT_THAT(text, StartsWith("lapwing: warning: step 1: not settled after 1 iteration: "));
  EXPECT_THAT(text, AllOf(HasSubstr("\nlapwing: note: step 1: mirrored"), Not(HasSubstr("\033"))));
}

}  // namespace
}  // namespace lapwing
