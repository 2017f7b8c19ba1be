#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "messages.h"
#include "output_files.h"

namespace lapwing::cli {
namespace {

struct ConvertArguments {
  std::string from;
  std::string to;
  bool ascii = false;
  bool binary = false;
};

void convert(const ConvertArguments& arguments) {
  OutputFiles files;
  files.reads("FROM", arguments.from, true);
  files.writes_mesh("TO", arguments.to);
  WriteOptions options;
  if (arguments.ascii) options.encoding = Encoding::ascii;
  if (arguments.binary) options.encoding = Encoding::little_endian;
  print_notes(write_mesh(read_mesh(arguments.from), arguments.to, options));
}

}  // namespace

void add_convert(CLI::App& app) {
  auto* command = app.add_subcommand(
      "convert", "convert a mesh to another format; reports what that cannot store");
  auto arguments = std::make_shared<ConvertArguments>();
  command->add_option("FROM", arguments->from, "OBJ, OFF, PLY, STL or glTF")->required();
  command->add_option("TO", arguments->to, "its extension names the format")->required();
  auto* ascii = command->add_flag("--ascii", arguments->ascii, "PLY and STL as text");
  command->add_flag("--binary", arguments->binary, "PLY and STL as binary, the default")
      ->excludes(ascii);
  command->callback([arguments] { convert(*arguments); });
}

}  // namespace lapwing::cli
