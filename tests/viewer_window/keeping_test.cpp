// What a person edits in a real window is kept: saved, asked about, restored and replayed.
#include "viewer_window/editing_window.h"

namespace lapwing {
namespace {

TEST_F(Editing, ClosingAsksWhetherToSave) {
  bend_tube();
  person_->open_dialog("ctrl+q");
  person_->keys("Escape");
  desktop_->settled_picture();
  ASSERT_TRUE(person_->draft()) << "still editing";
  person_->open_dialog("ctrl+q");
  person_->open_dialog("Return");
  person_->keys("Return");
  EXPECT_EQ(person_->wait(), 0);
  EXPECT_EQ(read_mesh(tube()).positions, mesh_.positions) << "the opened file stays";
  EXPECT_GT(
      test::largest_distance(read_mesh(folder_ / "tube-edited.obj").positions, mesh_.positions),
      0.1)
      << "saved under the suggested name";
  EXPECT_FALSE(person_->draft()) << "nothing is left to restore";
}

TEST_F(Editing, TheFirstSaveAsksWhereAndTheNextOnesDoNot) {
  bend_tube();
  person_->open_dialog("ctrl+s");
  keep_picture("first-save");
  person_->keys("Return");
  const fs::path edited = folder_ / "tube-edited.obj";
  ASSERT_TRUE(test::eventually(60.0, [&] { return fs::exists(edited); }));
  const Positions first = read_mesh(edited).positions;
  EXPECT_EQ(read_mesh(tube()).positions, mesh_.positions) << "the opened file stays";
  desktop_->settled_picture();
  move_by("0.4");
  ASSERT_TRUE(settles());
  person_->keys("ctrl+s");
  EXPECT_TRUE(test::eventually(60.0, [&] { return read_mesh(edited).positions != first; }));
  desktop_->settled_picture();
  expect_quits_silently();
}

TEST_F(Editing, ARecipeExportedAfterReplacingTheOpenedFileBendsOnlyOnce) {
  bend_tube();
  person_->open_dialog("ctrl+s");
  person_->type(tube().string());
  person_->open_dialog("Return");
  EXPECT_EQ(read_mesh(tube()).positions, mesh_.positions) << "asks before it replaces";
  person_->keys("Return");
  ASSERT_TRUE(
      test::eventually(60.0, [&] { return read_mesh(tube()).positions != mesh_.positions; }));
  desktop_->settled_picture();
  const fs::path recipe = folder_ / "bend.json";
  ASSERT_TRUE(saves_as("ctrl+e", recipe));
  keep_picture("recipe-after-replacing");
  expect_quits_silently();
  EXPECT_EQ(read_recipe(recipe).mesh, "tube-original.obj");
  CpuKernels kernels;
  EXPECT_LT(test::largest_distance(run_recipe(read_recipe(recipe), kernels)->mesh.positions,
                                   read_mesh(tube()).positions),
            1e-5 * bounds_of(mesh_.positions).diagonal());
}

TEST_F(Editing, OpeningAnotherFileAsksWhetherToSave) {
  bend_tube();
  const fs::path ball = folder_ / "ball.obj";
  write_mesh(icosphere(2), ball);
  person_->open_dialog("ctrl+o");
  person_->type(ball.string());
  person_->keys("Return");
  desktop_->settled_picture();
  EXPECT_EQ(read_mesh(tube()).positions, mesh_.positions) << "the key that accepts is no answer";
  ASSERT_TRUE(person_->draft()) << "still there";
  person_->keys("Delete");
  EXPECT_TRUE(is_open("ball.obj"));
  EXPECT_EQ(read_mesh(tube()).positions, mesh_.positions) << "discarded";
  desktop_->settled_picture();
  expect_quits_silently();
}

TEST_F(Editing, SavingAsAFileThatIsThereAsksFirst) {
  open_tube();
  choose_parts();
  move_by("0.5");
  const fs::path there = folder_ / "there.ply";
  replace_file(there, "precious");
  person_->open_dialog("ctrl+shift+s");
  person_->type(there.string());
  person_->open_dialog("Return");
  EXPECT_EQ(fs::file_size(there), 8U) << "not without a word";
  person_->keys("Escape");
  desktop_->settled_picture();
  EXPECT_EQ(fs::file_size(there), 8U);
  person_->open_dialog("Return");
  person_->keys("Return");
  EXPECT_TRUE(test::eventually(60.0, [&] { return fs::file_size(there) > 1000; }));
  desktop_->settled_picture();
  expect_quits_silently();
  EXPECT_GT(test::largest_distance(read_mesh(there).positions, mesh_.positions), 0.1)
      << "settled, though it was saved at once";
}

TEST_F(Editing, EveryStepSurvivesBeingKilledAtAnyMoment) {
  open_tube();
  choose_parts();
  std::mt19937 random(20040708);
  for (int crash = 0; crash < 20; ++crash) {
    const std::string number = "0." + std::to_string(1 + crash % 7);
    person_->keys(crash % 2 == 0 ? "g" : "r");
    person_->type(number);
    person_->keys("Return");
    test::sleep_seconds(std::uniform_real_distribution(0.0, 0.4)(random));
    const Draft seen = person_->draft().value();
    person_->kill();
    const auto edits = viewer::find_interrupted(person_->journals());
    ASSERT_EQ(edits.size(), 1U) << "crash " << crash;
    const Draft left = edits[0].draft;
    EXPECT_TRUE(left == seen || left.settled || left.open != seen.open)
        << "what was recorded is there, or what came after it";

    person_->start();
    ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
    desktop_->settled_picture();
    person_->keys("Return");
    ASSERT_TRUE(test::eventually(60.0, [&] { return !fs::exists(edits[0].journal); }))
        << "crash " << crash << ": nobody took the edit over";
    ASSERT_TRUE(person_->eventually_is([&](const Draft& d) { return d.open == left.open; }))
        << "crash " << crash;
  }
  ASSERT_TRUE(settles()) << "what was moved and not settled is settled now";
  const SimilarityMove moved = move();
  EXPECT_GT(moved.translate.norm() + moved.rotate.degrees, 0.0) << "steps were made in between";
}

// Its triangles come out as others, so that the surface on the device is made anew each time.
TEST_F(Editing, ACoatOfAnOpenedRecipeIsUndoneRedoneAndSaved) {
  const viewer::test::SheetAndRelief files;
  const fs::path opened = files.folder() / "coat.json";
  replace_file(opened, to_json({files.sheet(), {files.coat(1.0, Remeshing::automatic)}, "", {}}));
  person_->open(opened);
  ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
  ASSERT_TRUE(has_steps(1));
  // Half of what the relief makes of the sheet, which is dark.
  constexpr double kRelief = 0.04;
  const Image with_panels = desktop_->settled_picture();
  person_->keys("Tab");
  ASSERT_TRUE(differs_from(with_panels, 1.0));
  const Image coated = desktop_->settled_picture();
  person_->keys("ctrl+z");
  ASSERT_TRUE(has_steps(0));
  ASSERT_TRUE(differs_from(coated, kRelief));
  const Image undone = desktop_->settled_picture();
  person_->keys("ctrl+shift+z");
  EXPECT_TRUE(shows(coated, kRelief));
  person_->keys("ctrl+z");
  EXPECT_TRUE(shows(undone, kRelief));
  person_->keys("ctrl+shift+z");
  ASSERT_TRUE(has_steps(1));

  const fs::path saved = folder_ / "again.json";
  ASSERT_TRUE(saves_as("ctrl+e", saved));
  expect_quits_silently();
  CpuKernels kernels;
  EXPECT_EQ(run_recipe(read_recipe(saved), kernels)->mesh.positions,
            run_recipe(read_recipe(opened), kernels)->mesh.positions);
}

TEST_F(Editing, AScriptedPersonPosesThreeLimbsOfTheArmadilloByGrabs) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  open_armadillo();
  const double size = bounds_of(mesh_.positions).diagonal();
  const auto farthest = [&](const Vector3d& direction) {
    return *std::ranges::max_element(mesh_.positions, {},
                                     [&](const Vector3d& p) { return p.dot(direction); });
  };
  // Each limb is grabbed near its tip, on its front, and pulled by a fifteenth of the size.
  const std::vector<std::pair<Vector3d, Vector3d>> pulls{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                                                         {{-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
                                                         {{0.3, 1.0, 0.0}, {1.0, 0.0, 0.0}}};
  std::size_t grabbed = 0;
  for (const auto& [limb, way] : pulls) {
    const Vector3d tip = farthest(limb) - 0.02 * size * limb.normalized();
    const Vector2d from = person_->pixel_of(tip);
    const Vector2d to = person_->pixel_of(tip + size / 15.0 * way);
    person_->drag({from, 0.5 * (from + to), to});
    ++grabbed;
    ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
      return d.steps.size() + 1 == grabbed && d.open.handles.size() == 1 && d.settled;
    })) << "grab "
        << grabbed;
    keep_picture("grab-" + std::to_string(grabbed));
  }
  ASSERT_TRUE(saves_as("ctrl+e", folder_ / "pose.json"));
  ASSERT_TRUE(saves_as("ctrl+shift+s", folder_ / "pose.ply"));
  expect_quits_silently();

  CpuKernels kernels;
  const auto replayed = run_recipe(read_recipe(folder_ / "pose.json"), kernels);
  const Positions saved = read_mesh(folder_ / "pose.ply").positions;
  EXPECT_LT(test::largest_distance(saved, replayed->mesh.positions), 1e-3 * size);
  EXPECT_GT(test::largest_distance(saved, mesh_.positions), size / 20.0);
  EXPECT_LT(test::largest_distance(saved, mesh_.positions), size / 10.0);
}

TEST_F(Editing, AScriptedPersonBendsTheArmOfTheArmadillo) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  open_armadillo();
  const Image opened = desktop_->settled_picture();

  // The left hand is what lies farthest to one side.
  const Vector3d hand =
      *std::max_element(mesh_.positions.begin(), mesh_.positions.end(),
                        [](const Vector3d& a, const Vector3d& b) { return a.x() < b.x(); });
  const double size = bounds_of(mesh_.positions).diagonal();
  const auto at = [&](double share) { return Vector3d(hand - share * size * Vector3d::UnitX()); };
  person_->drag_disk(at(0.02), at(0.16));
  ASSERT_TRUE(has_disk_as_roi());
  person_->drag_disk(at(0.02), at(0.07));
  ASSERT_TRUE(has_handles(1));

  drag_part(GizmoMode::translate, GizmoPart::y, {0.0, -40.0});
  ASSERT_TRUE(settles());
  const Draft bent = person_->draft().value();
  // The journal is written before the window is painted.
  Image edited;
  EXPECT_TRUE(test::eventually(60.0, [&] {
    edited = desktop_->settled_picture();
    return test::mean_difference(edited, opened) > 0.5;
  }));
  const auto eventually_shown = [&](const std::function<bool(double)>& is_right) {
    return test::eventually(
        60.0, [&] { return is_right(test::mean_difference(desktop_->settled_picture(), edited)); });
  };

  person_->keys("ctrl+z");
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return !d.settled; }));
  EXPECT_TRUE(eventually_shown([](double difference) { return difference > 0.3; }));
  person_->keys("ctrl+shift+z");
  ASSERT_TRUE(person_->eventually_is([&](const Draft& d) { return d == bent; }));
  EXPECT_TRUE(eventually_shown([](double difference) { return difference < 0.3; }));

  ASSERT_TRUE(saves_as("ctrl+e", folder_ / "arm.json"));
  ASSERT_TRUE(saves_as("ctrl+shift+s", folder_ / "arm.ply"));
  expect_quits_silently();

  CpuKernels kernels;
  const auto replayed = run_recipe(read_recipe(folder_ / "arm.json"), kernels);
  EXPECT_TRUE(replayed->report.steps.at(0).deform->certificate.settled);
  const Positions saved = read_mesh(folder_ / "arm.ply").positions;
  EXPECT_LT(test::largest_distance(saved, replayed->mesh.positions), 1e-5 * size);
  EXPECT_GT(test::largest_distance(saved, mesh_.positions), 0.02 * size);
}

}  // namespace
}  // namespace lapwing
