#include "lapwing/batch/job_file.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class AJobFile : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
  }
  JobFile jobs(const std::string& text, const std::string& output = "mesh") const {
    write("jobs.jsonl", text);
    write("bend.json", kBend);
    return {folder_.path() / "jobs.jsonl", folder_.path() / "bend.json", output};
  }
  std::string error_of(const std::string& line) const { return jobs(line).jobs().at(0).error; }

  static constexpr const char* kBend = R"({"lapwing": 1, "mesh": "tube.obj", "steps": [
    {"op": "deform", "roi": {"all": true}, "belt": {"vertices": [0]},
     "handles": [{"region": {"vertices": [9]}, "move": {"translate": [1, 2, 3]}}]}]})";
  TemporaryFolder folder_;
};

TEST_F(AJobFile, HasAJobForEachLineThatIsNotBlank) {
  const JobFile file = jobs("{\"id\": \"a\"}\n\n  \r\n{\"id\": 7}\r\n{}");
  ASSERT_EQ(file.jobs().size(), 3U);
  EXPECT_EQ(file.jobs()[0].id, "a");
  EXPECT_EQ(file.jobs()[1].id, "7") << "a number is taken as its text";
  EXPECT_EQ(file.jobs()[2].id, "5") << "without one it is the line's number";
  for (const Job& job : file.jobs()) EXPECT_THAT(job.error, IsEmpty());
}

TEST_F(AJobFile, PutsValuesIntoACopyOfTheRecipe) {
  const JobFile file =
      jobs(R"({"set": {"/steps/0/handles/0/move/translate": [4, 5, 6], "/save": "out.ply"}})"
           "\n{}");
  const auto translate = [&](std::size_t job) {
    const Recipe recipe = file.recipe_of(file.jobs()[job]);
    return std::get<SimilarityMove>(std::get<DeformRequest>(recipe.steps[0]).handles[0].move)
        .translate;
  };
  EXPECT_EQ(translate(0), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(translate(1), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(file.recipe_of(file.jobs()[0]).save, "out.ply");
}

TEST_F(AJobFile, TakesARecipeFromTheLineItself) {
  const JobFile file = jobs(R"({"recipe": {"lapwing": 1, "mesh": "a.obj", "steps": []}})");
  EXPECT_EQ(file.recipe_of(file.jobs()[0]).mesh_path(), folder_.path() / "a.obj");
}

TEST_F(AJobFile, PutsJobsThatDifferInMovesAloneIntoOneGroup) {
  const JobFile file = jobs(
      R"({"set": {"/steps/0/handles/0/move/translate": [4, 5, 6]}})"
      "\n"
      R"({"set": {"/steps/0/handles/0/region/vertices": [8]}})"
      "\n"
      R"({"set": {"/steps/0/handles/0/move": {"translate": [1, 1, 1]}}})"
      "\n"
      R"({"set": {"/steps/0/handles/0": {"region": {"vertices": [7]}, "move": {"translate": [1, 0, 0]}}}})"
      "\n"
      R"({"set": {"/steps/0/handles/0": {"region": {"vertices": [7]}, "move": {"translate": [2, 0, 0]}}}})");
  std::vector<std::size_t> groups;
  for (const Job& job : file.jobs()) groups.push_back(job.group);
  EXPECT_THAT(groups, ::testing::ElementsAre(0, 1, 0, 2, 2));
}

TEST_F(AJobFile, AsksForTheSameWhereRecipeValuesAndOutputAre) {
  const std::string line = R"({"set": {"/save": "a.ply"}})";
  const auto asked = [&](const std::string& text, const std::string& output) {
    return jobs(text, output).jobs().at(0).asked;
  };
  EXPECT_EQ(asked(line, "mesh"), asked("\n" + line, "mesh"));
  EXPECT_NE(asked(line, "mesh"), asked("{}", "mesh"));
  EXPECT_NE(asked(line, "mesh"), asked(line, "npy"));
}

TEST_F(AJobFile, SaysWhatIsWrongWithALine) {
  EXPECT_THAT(error_of(R"({"id": "a", "set": {"/st)"),
              AllOf(HasSubstr("jobs.jsonl:1:"), HasSubstr("syntax error")));
  EXPECT_THAT(jobs("{}\n[1]").jobs().at(1).error, HasSubstr("jobs.jsonl:2: expected an object"));
  EXPECT_THAT(error_of(R"({"sets": {}})"), HasSubstr("did you mean \"set\"?"));
  EXPECT_THAT(error_of(R"({"id": null})"), HasSubstr("/id: expected a string"));
  EXPECT_THAT(error_of(R"({"set": [1]})"), HasSubstr("/set: expected an object"));
  EXPECT_THAT(error_of(R"({"recipe": 5})"), HasSubstr("/recipe: expected a file"));
  EXPECT_THAT(error_of(R"({"recipe": "none.json"})"), HasSubstr("none.json"));
  EXPECT_THAT(error_of("{\"id\": \"a\", \"id\": \"b\"}"), HasSubstr("appears twice"));
}

TEST_F(AJobFile, TakesNoIdThatIsNoNameOfAFile) {
  for (const char* const id : {"", ".", "..", "../a", "a/b", "/etc/passwd", "a\\u0000b", "a\\nb"}) {
    EXPECT_THAT(error_of(std::string(R"({"id": ")") + id + "\"}"),
                HasSubstr("/id: the id cannot be a file name"))
        << id;
  }
  EXPECT_THAT(error_of(R"({"id": ")" + std::string(201, 'a') + "\"}"), HasSubstr("longer"));
  EXPECT_THAT(error_of(R"({"id": ")" + std::string(200, 'a') + "\"}"), IsEmpty());
}

TEST_F(AJobFile, RefusesTwoLinesWithOneId) {
  EXPECT_THAT(
      error_message<InputError>([&] { jobs("{\"id\": \"a\"}\n{}\n{\"id\": \"a\"}"); }),
      AllOf(HasSubstr("jobs.jsonl:3:"), HasSubstr("the id \"a\" is already used in line 1")));
  EXPECT_THROW(jobs("{\"id\": \"2\"}\n{}"), InputError) << "one by its line's number, too";
}

TEST_F(AJobFile, SaysWhereInTheRecipeAValueDoesNotFit) {
  const JobFile file = jobs(R"({"set": {"/steps/0/roi": {"al": true}}})");
  EXPECT_THAT(error_message<InputError>([&] { file.recipe_of(file.jobs()[0]); }),
              AllOf(HasSubstr("jobs.jsonl:1 ("), HasSubstr("bend.json): /steps/0/roi")));
}

}  // namespace
}  // namespace lapwing
