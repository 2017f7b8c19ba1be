#include "report/report_json.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_report.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string complaint_about(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.json", text);
  return error_message<InputError>([&] { read_report(path); });
}

TEST(ReportJson, ComesBackAsItWasWritten) {
  const TemporaryFolder folder;
  const Report report = small_report();
  const Report read = read_report(folder.file("a.json", to_json(report)));
  EXPECT_EQ(read.date, report.date);
  EXPECT_EQ(read.commit, report.commit);
  EXPECT_EQ(read.host.memory_bytes, report.host.memory_bytes);
  ASSERT_EQ(read.limits.size(), 2u);
  EXPECT_EQ(read.limits[1].matmul_gflops_float32, 20'000.0);
  ASSERT_EQ(read.measurements.size(), 3u);
  EXPECT_EQ(read.measurements[0].wall_ms, report.measurements[0].wall_ms);
  EXPECT_EQ(read.measurements[0].counts, report.measurements[0].counts);
  EXPECT_EQ(read.measurements[2].device_ms, report.measurements[2].device_ms);
  ASSERT_EQ(read.targets.size(), 2u);
  EXPECT_FALSE(read.targets[0].is_floor);
  EXPECT_TRUE(read.targets[1].is_floor);
  EXPECT_EQ(to_json(read), to_json(report)) << "and nothing else is lost either";
}

TEST(ReportJson, BeginsWithItsFormatAndHasAMeasurementToALine) {
  const std::string text = to_json(small_report());
  EXPECT_THAT(text, StartsWith("{\n  \"format\": \"lapwing-bench 1\",\n  \"date\": "));
  EXPECT_THAT(text, HasSubstr("\n    {\"stage\":\"factor\",\"by\":\"CHOLMOD\",\"device\":\"CPU\","
                              "\"mesh\":\"armadillo\",\"vertices\":26002,"
                              "\"wall_ms\":[400.0,404.0,408.0],"));
}

TEST(ReportJson, WritesSixDigitsOfATimeAndAllOfACount) {
  Measurement m = row("factor", {1.23456789, 123456.789});
  m.counts["flops"] = 123'456'789'012'345;
  const std::string text = to_json(report_of({m}));
  EXPECT_THAT(text, HasSubstr("[1.23457,123457.0]"));
  EXPECT_THAT(text, HasSubstr("\"flops\":123456789012345"));
}

TEST(ReportJson, WithNothingMeasuredIsReadToo) {
  const TemporaryFolder folder;
  const Report read = read_report(folder.file("a.json", to_json(Report())));
  EXPECT_TRUE(read.measurements.empty());
}

TEST(ReportJson, NamesTheFileAndWhatIsWrong) {
  const std::string json = to_json(small_report());
  for (const auto& [from, to, said] :
       {std::array{"lapwing-bench 1", "lapwing-bench 2", "\"lapwing-bench 2\""},
        std::array{"\"by\":\"CHOLMOD\",", "", "'by' not found"},
        std::array{"404.0", "\"404\"", "must be number"},
        std::array{"\"limits\"", "", "parse error"}}) {
    const std::string message = complaint_about(changed(json, from, to));
    EXPECT_THAT(message, HasSubstr("a.json: "));
    EXPECT_THAT(message, HasSubstr(said));
  }
}

TEST(ReportJson, ThatIsNotThereIsAnIoError) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_report(folder / "none.json"), IoError);
}

}  // namespace
}  // namespace lapwing::bench
