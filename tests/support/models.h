#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::test {

/// Returns the folder of Debian's meshes, which tools/setup/fetch-models fills. The environment
/// variable LAPWING_TEST_MODELS can select another folder.
std::filesystem::path models_folder();

/// Returns the OBJ, OFF, PLY and STL files of one package in that folder, such as "cgal", sorted by
/// name. The result is empty if the package was not fetched.
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
