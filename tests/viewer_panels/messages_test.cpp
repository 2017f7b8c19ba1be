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
  messages.say("vertex 1", 0.0);
  messages.say("vertex 2", 0.1);
  EXPECT_THAT(texts_of(messages), ElementsAre("vertex 2"));
  EXPECT_THAT(messages.log(), ElementsAre(Message("vertex 1"), Message("vertex 2")));
}

TEST(Messages, ANoteGoesWithWhatIsDoneNextOnceItCouldBeRead) {
  Messages messages;
  messages.say("saved", 0.0);
  messages.acted(0.5);
  EXPECT_THAT(texts_of(messages), ElementsAre("saved"));
  messages.acted(kLong);
  EXPECT_THAT(texts_of(messages), IsEmpty());
}

TEST(Messages, AnEmptyOneTakesTheNoteBack) {
  Messages messages;
  messages.say({"no", Tone::error}, 0.0);
  messages.say("vertex 1", 0.0);
  messages.say("", 0.0);
  EXPECT_THAT(texts_of(messages), ElementsAre("no"));
}

TEST(Messages, AnErrorStaysUntilItIsClosed) {
  Messages messages;
  messages.say({"cannot read a.obj", Tone::error}, 0.0);
  messages.say("saved", 0.0);
  messages.acted(kLong);
  EXPECT_THAT(texts_of(messages), ElementsAre("cannot read a.obj"));
  messages.close(0);
  EXPECT_THAT(texts_of(messages), IsEmpty());
  EXPECT_THAT(messages.log(), SizeIs(2));
}

TEST(Messages, TheSameAgainIsCounted) {
  Messages messages;
  for (int k = 0; k < 3; ++k) messages.say({"no", Tone::error}, k);
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
