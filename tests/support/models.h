#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::test {

/// Returns the folder of Debian's meshes (tools/setup/fetch-models). LAPWING_TEST_MODELS names
/// another one.
std::filesystem::path models_folder();

/// Returns the OBJ, OFF, PLY and STL files of one package in that folder ("cgal", "assimp"), sorted
/// by name. Empty if nothing was fetched.
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
