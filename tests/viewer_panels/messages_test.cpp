#include "ui/messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing::viewer {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kLong = 100.0;

std::vector<std::string> texts_of(const Messages& messages) {
  std::vector<std::string> texts;
  for (const Messages::Toast& toast : messages.toasts()) texts.push_back(toast.message.text);
  return texts;
}

TEST(Messages, OneNoteTakesThePlaceOfTheOther) {
  Messages messages;
  messages.say("Vertex 1", 0.0);
  messages.say("Vertex 2", 0.1);
  EXPECT_THAT(texts_of(messages), ElementsAre("Vertex 2"));
  EXPECT_THAT(messages.log(), ElementsAre(Message("Vertex 1"), Message("Vertex 2")));
}

TEST(Messages, ANoteGoesWithWhatIsDoneNextOnceItCouldBeRead) {
  Messages messages;
  messages.say("Saved", 0.0);
  messages.acted(0.5);
  EXPECT_THAT(texts_of(messages), ElementsAre("Saved"));
  messages.acted(kLong);
  EXPECT_THAT(texts_of(messages), IsEmpty());
}

TEST(Messages, AnEmptyOneTakesTheNoteBack) {
  Messages messages;
  messages.say({"No", Tone::error}, 0.0);
  messages.say("Vertex 1", 0.0);
  messages.say("", 0.0);
  EXPECT_THAT(texts_of(messages), ElementsAre("No"));
}

TEST(Messages, AnErrorStaysUntilItIsClosed) {
  Messages messages;
  messages.say({"Cannot read a.obj", Tone::error}, 0.0);
  messages.say("Saved", 0.0);
  messages.acted(kLong);
  EXPECT_THAT(texts_of(messages), ElementsAre("Cannot read a.obj"));
  messages.close(0);
  EXPECT_THAT(texts_of(messages), IsEmpty());
  EXPECT_THAT(messages.log(), SizeIs(2));
}

TEST(Messages, AnErrorGoesAwayWithItsCause) {
  Messages messages;
  messages.say({"No handle", Tone::error}, 0.0);
  messages.say({"Too coarse", Tone::warning}, 0.0);
  messages.say("Saved", 0.0);
  messages.say({"", Tone::error}, 0.1);
  EXPECT_THAT(texts_of(messages), ElementsAre("Too coarse", "Saved"));
  EXPECT_THAT(messages.log(), SizeIs(3));
}

TEST(Messages, AreInTheWordsOfTheWindow) {
  Messages messages;
  messages.say({"the handle leaves the ROI", Tone::error}, 0.0);
  messages.record({"the belt is empty", Tone::error});
  EXPECT_THAT(messages.log(), ElementsAre(Message("The handle leaves the region", Tone::error),
                                          Message("The fixed border is empty", Tone::error)));
}

TEST(Messages, TheSameAgainIsCounted) {
  Messages messages;
  for (int k = 0; k < 3; ++k) messages.say({"No", Tone::error}, k);
  ASSERT_THAT(messages.toasts(), SizeIs(1));
  EXPECT_EQ(messages.toasts()[0].times, 3);
}

TEST(Messages, TheOldestOfManyLeavesThePictureAndStaysInTheLog) {
  Messages messages;
  for (int k = 0; k < 7; ++k) messages.say({std::to_string(k), Tone::error}, k);
  EXPECT_THAT(texts_of(messages), ElementsAre("3", "4", "5", "6"));
  EXPECT_THAT(messages.log(), SizeIs(7));
}

}  // namespace
}  // namespace lapwing::viewer
