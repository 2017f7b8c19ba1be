#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::test {

/// Where tools/setup/fetch-models put Debian's meshes; LAPWING_TEST_MODELS names another folder.
std::filesystem::path models_folder();

/// The OBJ, OFF, PLY and STL files of one package there ("cgal", "assimp"), by name; none where
/// nothing was fetched.
std::vector<std::filesystem::path> model_files(const std::string& package);

}  // namespace lapwing::test

/// Declares `files`, the models of `package`. A test skips without them, but on CI it fails.
#define LAPWING_NEEDS_MODELS(files, package)                                                      \
  const auto files = ::lapwing::test::model_files(package);                                       \
  if ((files).empty()) {                                                                          \
    ASSERT_EQ(std::getenv("CI"), nullptr) << "no meshes in " << ::lapwing::test::models_folder(); \
    GTEST_SKIP() << "run tools/setup/fetch-models " << ::lapwing::test::models_folder();          \
  }                                                                                               \
  static_assert(true)
