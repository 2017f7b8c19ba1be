#include "report/text_file.h"

#include <fstream>

#include "lapwing/base/errors.h"

namespace lapwing::bench {
namespace {

void require_good(const std::ofstream& file, const std::string& path) {
  if (!file) throw IoError("cannot write " + path + "; is its folder there and writable?");
}

}  // namespace

void require_writable(const std::string& path) {
  require_good(std::ofstream(path, std::ios::app), path);
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  require_good(file, path);
}

}  // namespace lapwing::bench
