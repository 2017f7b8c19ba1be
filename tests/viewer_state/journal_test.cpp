#include "state/journal.h"

#include <csignal>
#include <fstream>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

// The k-th thing a person does in a long edit: chooses, drags, settles, takes back.
void do_something(History& history, std::size_t k) {
  switch (k % 7) {
    case 0:
      history.perform(Paint{kRoi, {static_cast<Index>(k % 24)}, {static_cast<Index>(k / 7 % 24)}});
      break;
    case 1:
    case 4:
      history.perform(MoveHandle{0, twisted(1.0 + static_cast<double>(k))});
      break;
    case 2:
    case 5:
      history.perform(Settle{handles_alone(history.state())});
      break;
    case 3:
      history.undo();
      history.undo();
      break;
    default:
      history.perform(SetParameters{{{.constraint_weight = 1.0 + static_cast<double>(k)}}});
      history.perform(Settle{handles_alone(history.state())});
      history.perform(Commit{});
  }
}

class AJournal : public ::testing::Test {
 protected:
  AJournal() { write_mesh(bumpy_tube(), mesh_); }

  static AppState moved(const AppState& state) { return apply(state, MoveHandle{0, bent()}); }
  std::vector<InterruptedEdit> interrupted() const { return find_interrupted(cache_); }
  MeshStamp stamp() const { return stamp_of(mesh_); }

  TemporaryFolder folder_;
  std::filesystem::path mesh_ = folder_ / "tube.obj";
  std::filesystem::path cache_ = folder_ / "cache";
};

TEST_F(AJournal, IsEmptyUntilSomethingIsDone) {
  const AppState opened = open_state(read_mesh(mesh_));
  Journal journal(cache_, stamp());
  const auto is_empty = [&](const AppState& state) {
    journal.record(state);
    return read_journal(journal.path())->is_empty();
  };
  EXPECT_TRUE(is_empty(opened));
  EXPECT_FALSE(is_empty(apply(opened, Choose{kRoi, box(0.3, 4.0)})));
  EXPECT_FALSE(is_empty(opened)) << "the choice can be redone";
}

TEST_F(AJournal, KeepsPaintedStiffness) {
  History history(chosen_tube());
  history.perform(
      SetStiffness{{{{ListedVertices{{1, 2, 3}}}, kRigidStiffness}, {{ListedVertices{{5}}}, 0.1}}});
  Journal(cache_, stamp()).record(history.state());
  ASSERT_EQ(interrupted().size(), 1U);
  EXPECT_EQ(interrupted()[0].draft.open.stiffness, history.state().selection.stiffness);
  EXPECT_EQ(interrupted()[0].draft.open.stiffness.size(), 2U);
}

TEST_F(AJournal, LeftBehindHoldsTheEdit) {
  History history(chosen_tube());
  {
    Journal journal(cache_, stamp());
    for (std::size_t k = 0; k < 40; ++k) {
      do_something(history, k);
      journal.record(history.state());
    }
  }
  const auto edits = interrupted();
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_EQ(edits[0].draft, draft_of(history.state()));
  EXPECT_GT(edits[0].draft.steps.size(), 3U);
  EXPECT_TRUE(edits[0].mesh_is_unchanged);
  EXPECT_EQ(edits[0].mesh.path, mesh_);
}

TEST_F(AJournal, TellsAHandleWithoutVerticesFromNone) {
  History history(chosen_tube());
  Journal journal(cache_, stamp());
  const auto written = [&] {
    journal.record(history.state());
    return read_journal(journal.path())->draft;
  };
  history.perform(Choose{{Part::Role::handle, 0}, RegionSpec{ListedVertices{}}});
  ASSERT_EQ(draft_of(history.state()).open.handles.size(), 1U);
  EXPECT_EQ(written(), draft_of(history.state()));
  history.perform(RemoveHandle{0});
  ASSERT_EQ(draft_of(history.state()).open.handles.size(), 0U);
  EXPECT_EQ(written(), draft_of(history.state()));
}

TEST_F(AJournal, ClosedLeavesNothing) {
  Journal journal(cache_, stamp());
  journal.record(settled_tube());
  journal.close();
  EXPECT_TRUE(interrupted().empty());
  EXPECT_TRUE(std::filesystem::is_empty(cache_));
}

TEST_F(AJournal, KeepsWhatAStepSettledTo) {
  const AppState settled = settled_tube();
  const AppState committed = apply(settled, Commit{});
  const AppState settled_again = apply(moved(committed), Settle{handles_alone(moved(committed))});
  {
    Journal journal(cache_, stamp());
    for (const AppState& state : {settled, committed, settled_again}) journal.record(state);
  }
  const InterruptedEdit edit = interrupted().at(0);
  EXPECT_EQ(kept_result(edit, moved(chosen_tube())), *settled.settled) << "of a step before";
  EXPECT_EQ(kept_result(edit, moved(committed)), *settled_again.settled);
  EXPECT_EQ(kept_result(edit, apply(chosen_tube(), MoveHandle{0, twisted(2.0)})), std::nullopt);
  discard(edit);
  EXPECT_TRUE(std::filesystem::is_empty(cache_));
}

TEST_F(AJournal, WhoseFileOfResultsIsDamagedStillHasTheSteps) {
  std::filesystem::path results;
  {
    Journal journal(cache_, stamp());
    journal.record(settled_tube());
    results = journal.path();
    results.replace_extension(".results");
  }
  const std::string whole = content_of(results);
  const auto expect_none = [&](const char* what) {
    const InterruptedEdit edit = interrupted().at(0);
    EXPECT_EQ(edit.draft, draft_of(settled_tube())) << what;
    EXPECT_EQ(kept_result(edit, moved(chosen_tube())), std::nullopt) << what;
  };
  std::ofstream(results, std::ios::binary) << whole.substr(0, whole.size() - 1);
  expect_none("torn");
  std::ofstream(results, std::ios::binary) << std::string(whole.size(), '\xff');
  expect_none("of other bytes");
  std::filesystem::remove(results);
  expect_none("gone");
}

TEST_F(AJournal, OfARunningEditIsNotInterrupted) {
  Journal journal(cache_, stamp());
  journal.record(chosen_tube());
  EXPECT_TRUE(interrupted().empty());
}

TEST_F(AJournal, LastLineTornAnywhereLosesThatLineOnly) {
  std::filesystem::path path;
  {
    Journal journal(cache_, stamp());
    AppState state = chosen_tube();
    journal.record(state);
    journal.record(apply(std::move(state), MoveHandle{0, bent()}));
    path = journal.path();
  }
  const std::string whole = content_of(path);
  const std::size_t last_line = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = last_line; size < whole.size(); ++size) {
    std::filesystem::resize_file(path, size);
    ASSERT_EQ(interrupted().at(0).draft, draft_of(chosen_tube())) << "torn at byte " << size;
    std::ofstream(path, std::ios::binary) << whole;
  }
}

TEST_F(AJournal, TornInItsFirstLineIsNone) {
  std::filesystem::create_directories(cache_);
  std::ofstream(cache_ / "edit-1-0.journal") << R"({"lapwing_journal": 1, "me)";
  std::ofstream(cache_ / "edit-2-0.journal") << "something else\n";
  EXPECT_TRUE(interrupted().empty());
}

TEST_F(AJournal, SaysWhenTheMeshIsAnotherOne) {
  { Journal(cache_, stamp()).record(chosen_tube()); }
  write_mesh(grid(2, 2), mesh_);
  EXPECT_FALSE(interrupted().at(0).mesh_is_unchanged);
  std::filesystem::remove(mesh_);
  EXPECT_FALSE(interrupted().at(0).mesh_is_unchanged);
}

TEST_F(AJournal, DiskThatFillsUpLosesOnlyWhatDidNotFit) {
  const AppState state = chosen_tube();
  {
    Journal journal(cache_, stamp());
    journal.record(state);
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    rlimit full = before;
    full.rlim_cur = std::filesystem::file_size(journal.path()) + 100;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &full);
    EXPECT_THROW(journal.record(apply(state, MoveHandle{0, bent()})), IoError);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    journal.record(apply(state, SetBeltWidth{0.2}));
  }
  EXPECT_EQ(interrupted().at(0).draft, draft_of(apply(state, SetBeltWidth{0.2})));
}

TEST_F(AJournal, KeepsTheMeshThatIsSavedOver) {
  const std::string before = content_of(mesh_);
  {
    Journal journal(cache_, stamp());
    journal.record(chosen_tube());
    journal.keep_mesh();
    write_mesh(grid(2, 2), mesh_);
    journal.keep_mesh();
  }
  const auto edits = interrupted();
  ASSERT_EQ(edits.size(), 1U);
  EXPECT_EQ(edits[0].opened, mesh_);
  EXPECT_TRUE(edits[0].mesh_is_unchanged);
  EXPECT_EQ(content_of(edits[0].mesh.path), before);
  EXPECT_EQ(edits[0].draft, draft_of(chosen_tube()));
  discard(edits[0]);
  EXPECT_TRUE(std::filesystem::is_empty(cache_));
}

TEST_F(AJournal, KeepsAMeshFromElsewhereUnderTheNameItWasOpenedBy) {
  const std::filesystem::path elsewhere = folder_ / "elsewhere.obj";
  write_mesh(grid(2, 2), elsewhere);
  {
    Journal journal(cache_, stamp());
    journal.keep_mesh(elsewhere);
    journal.record(chosen_tube());
  }
  const std::string before = content_of(elsewhere);
  std::filesystem::remove(elsewhere);
  const auto edit = interrupted().at(0);
  EXPECT_EQ(edit.opened, mesh_);
  EXPECT_TRUE(edit.has_copy());
  EXPECT_TRUE(edit.mesh_is_unchanged);
  EXPECT_EQ(content_of(edit.mesh.path), before);
}

TEST_F(AJournal, CountsTheEditsAndSaysWhenTheLastWas) {
  const AppState still = chosen_tube();
  const AppState moved = apply(still, MoveHandle{0, bent()});
  const AppState committed = apply(apply(moved, Settle{handles_alone(moved)}), Commit{});
  const AppState moved_on = apply(committed, MoveHandle{0, bent()});
  const auto left_at = [this](const AppState& state) {
    { Journal(cache_, stamp()).record(state); }
    const InterruptedEdit edit = interrupted().at(0);
    EXPECT_EQ(edit.last_step, std::filesystem::last_write_time(edit.journal));
    discard(edit);
    return edit.step_count();
  };
  EXPECT_EQ(left_at(still), 0U) << "nothing is moved yet";
  EXPECT_EQ(left_at(moved), 1U);
  EXPECT_EQ(left_at(committed), 1U);
  EXPECT_EQ(left_at(moved_on), 2U);
}

TEST_F(AJournal, IsNotWrittenWithoutNews) {
  Journal journal(cache_, stamp());
  journal.record(chosen_tube());
  const auto size = std::filesystem::file_size(journal.path());
  journal.record(chosen_tube());
  EXPECT_EQ(std::filesystem::file_size(journal.path()), size);
}

TEST_F(AJournal, ThatCannotBeWrittenLeavesNothing) {
  EXPECT_THROW(Journal(mesh_ / "inside", stamp()), IoError);
  const std::filesystem::path latin = folder_ / "m\xF6we.obj";
  std::filesystem::copy_file(mesh_, latin);
  EXPECT_THROW(Journal(cache_, stamp_of(latin)), InputError) << "the name is not UTF-8";
  EXPECT_TRUE(interrupted().empty());
  EXPECT_FALSE(std::filesystem::exists(cache_));
}

TEST_F(AJournal, HoldsNoMoreHandlesThanItLists) {
  std::filesystem::create_directories(cache_);
  const std::filesystem::path journal = cache_ / "edit-1-0.journal";
  {
    const Journal whole(cache_, stamp());
    std::filesystem::copy_file(whole.path(), journal);
  }
  std::ofstream(journal, std::ios::app)
      << R"({"keep": 0, "add": [], "open": {"op": "deform", "roi": {"all": true}, "handles": )"
      << R"([{"region": {"vertices": [1]}, "move": {"translate": [0, 0, 1]}}]}, )"
      << R"("handles": 1000000000000, "settled": false})"
      << "\n";
  const auto edit = read_journal(journal);
  ASSERT_TRUE(edit.has_value());
  EXPECT_EQ(edit->draft.open.handles.size(), 1U);
}

// A child edits and tells through a pipe how many steps are committed; the parent kills it.
TEST_F(AJournal, KilledAtRandomMomentsLosesNoCommittedStep) {
  constexpr std::size_t kSteps = 400;
  std::vector<Draft> drafts;
  {
    History history(chosen_tube());
    drafts.push_back(draft_of(history.state()));
    for (std::size_t k = 0; k < kSteps; ++k) {
      do_something(history, k);
      drafts.push_back(draft_of(history.state()));
    }
  }
  std::mt19937 random(20);
  std::size_t restored_steps = 0;
  for (int round = 0; round < 200; ++round) {
    std::array<int, 2> pipe_ends{};
    ASSERT_EQ(::pipe(pipe_ends.data()), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      Journal journal(cache_, stamp());
      History history(chosen_tube());
      for (std::size_t k = 0; k < kSteps; ++k) {
        do_something(history, k);
        journal.record(history.state());
        const char told = 1;
        if (::write(pipe_ends[1], &told, 1) != 1) break;
      }
      ::pause();
    }
    ::close(pipe_ends[1]);
    char told = 0;
    ASSERT_EQ(::read(pipe_ends[0], &told, 1), 1);
    ::usleep(static_cast<useconds_t>(random() % 40000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    std::size_t committed = 1;
    while (::read(pipe_ends[0], &told, 1) == 1) ++committed;
    ::close(pipe_ends[0]);

    const auto edits = interrupted();
    ASSERT_EQ(edits.size(), 1U);
    // The step after the last one told of may or may not be there.
    const Draft& next = drafts[std::min(committed + 1, kSteps)];
    EXPECT_THAT(edits[0].draft, ::testing::AnyOf(drafts[committed], next))
        << "killed after " << committed << " steps";
    restored_steps += committed;
    discard(edits[0]);
  }
  EXPECT_GT(restored_steps, 20U);
}

TEST(JournalFolder, FollowsTheCacheFolderOfTheSystem) {
  const char* const before = std::getenv("XDG_CACHE_HOME");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(journal_folder(), "/somewhere/lapwing");
  if (before != nullptr) {
    ::setenv("XDG_CACHE_HOME", kept.c_str(), 1);
  } else {
    ::unsetenv("XDG_CACHE_HOME");
  }
}

}  // namespace
}  // namespace lapwing::viewer::test
