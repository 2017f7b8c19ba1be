// A person edits meshes in a real window, by real events.
#include "viewer_window/editing_window.h"

namespace lapwing {
namespace {

TEST_F(Editing, EachSelectionToolChoosesWhatItShows) {
  open_tube();
  const auto roi = [&] { return resolve(person_->draft().value().open.roi, mesh_); };
  const Vector2d middle = person_->pixel_of({0.5, 0.0, 3.0});
  const Vector2d rim = person_->pixel_of({0.5, 0.0, 4.0});

  person_->keys("d i");
  person_->drag_disk({0.5, 0.0, 3.0}, {0.5, 0.0, 4.0});
  ASSERT_TRUE(has_disk_as_roi());
  const double dragged = std::get<GeodesicDisk>(person_->draft()->open.roi.form).radius;
  EXPECT_NEAR(dragged, 1.0, 0.15) << "the radius goes to the cursor";

  person_->keys("i");
  person_->click(middle);
  person_->scroll(middle, 2, "ctrl");
  EXPECT_TRUE(person_->eventually_is([&](const Draft& d) {
    const auto* disk = std::get_if<GeodesicDisk>(&d.open.roi.form);
    return disk != nullptr && disk->radius > 1.15 * dragged;
  })) << "Ctrl and the wheel enlarge the disk that was clicked";

  person_->keys("i o");
  for (const Vector3d& corner : {Vector3d(0.5, -0.2, 2.5), Vector3d(0.5, 0.2, 2.5),
                                 Vector3d(0.5, 0.2, 3.5), Vector3d(0.5, -0.2, 3.5)}) {
    person_->click(person_->pixel_of(corner));
  }
  person_->keys("Return");
  person_->click(middle);
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return is<LoopRegion>(d.open.roi); }));
  EXPECT_LT(roi().size(), 200U) << "the side that was clicked";

  person_->keys("b i");
  person_->drag({person_->pixel_of({0.5, -0.6, 1.0}), person_->pixel_of({0.5, 0.6, 5.0})});
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return !is<LoopRegion>(d.open.roi); }));
  const std::size_t in_box = roi().size();
  EXPECT_GT(in_box, 250U);
  for (const Index v : roi()) {
    EXPECT_GT(mesh_.positions[v].x(), -0.2) << "only what is seen is chosen";
  }

  person_->keys("p");
  person_->drag({middle, rim}, "ctrl");
  ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
    return resolve(d.open.roi, mesh_).size() < in_box;
  })) << "Ctrl erases under the brush";
  const std::size_t erased = roi().size();

  person_->keys("l");
  const Vector2d across(0.0, 40.0);
  person_->drag({middle - across, rim - across, rim + across, middle + across});
  ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
    return resolve(d.open.roi, mesh_).size() > erased;
  })) << "the lasso adds what it goes around";

  const std::size_t before = roi().size();
  person_->keys("ctrl+equal");
  ASSERT_TRUE(person_->eventually_is(
      [&](const Draft& d) { return resolve(d.open.roi, mesh_).size() > before; }));
  person_->keys("ctrl+minus ctrl+i");
  EXPECT_TRUE(person_->eventually_is([&](const Draft& d) {
    return resolve(d.open.roi, mesh_).size() > mesh_.vertex_count() - before - 100;
  })) << "inverted";
  expect_quits_silently();
}

TEST_F(Editing, ADotOfTheRimSizesTheDisk) {
  open_tube();
  const auto disk = [&] { return std::get<GeodesicDisk>(person_->draft().value().open.roi.form); };
  const Vector2d middle = person_->pixel_of({0.5, 0.0, 3.0});
  const Vector2d rim = person_->pixel_of({0.5, 0.0, 4.0});
  person_->keys("d i");
  person_->drag_disk({0.5, 0.0, 3.0}, {0.5, 0.0, 4.0});
  ASSERT_TRUE(has_disk_as_roi());
  const GeodesicDisk before = disk();
  const Index center = std::get<Index>(before.center);
  const auto distances = geodesic_distances(mesh_.topology(), mesh_.positions, {&center, 1});
  Vector2d leftmost = middle;
  for (const viewer::RimGrip& grip :
       viewer::rim_grips(mesh_.topology(), mesh_.positions, distances, center, before.radius)) {
    const Vector2d pixel = person_->pixel_of(grip.position);
    if (grip.faces_eye(person_->projection()) && pixel.x() < leftmost.x()) leftmost = pixel;
  }
  person_->move_to(leftmost);
  keep_picture("grip");
  const Vector2d wider = leftmost + 0.4 * (rim - middle);
  person_->drag({leftmost, 0.5 * (leftmost + wider), wider});
  EXPECT_TRUE(person_->eventually_is([&](const Draft& d) {
    const auto* now = std::get_if<GeodesicDisk>(&d.open.roi.form);
    return now != nullptr && now->center == before.center && now->radius > 1.2 * before.radius;
  }));
  person_->keys("ctrl+z");
  EXPECT_TRUE(person_->eventually_is([&](const Draft& d) {
    const auto* now = std::get_if<GeodesicDisk>(&d.open.roi.form);
    return now != nullptr && *now == before;
  })) << "one step";
  expect_discards_silently();
}

// Of a picture that shows nothing else that moves.
TEST_F(Editing, AMeasureIsDrawnStaysWhileTheViewTurnsAndGoesByEscape) {
  open_tube();
  const Image before = desktop_->settled_picture();
  person_->keys("u");
  person_->click(person_->pixel_of({0.5, 0.0, 1.5}));
  person_->click(person_->pixel_of({0.5, 0.0, 4.5}));
  person_->move_to({20.0, 100.0});
  const Image measured = desktop_->settled_picture();
  test::keep_picture(measured, "measure");
  EXPECT_GT(test::mean_difference(measured, before), kSamePicture);
  person_->keys("Left Right");
  EXPECT_LT(test::mean_difference(desktop_->settled_picture(), measured), kSamePicture);
  person_->keys("Escape");
  EXPECT_LT(test::mean_difference(desktop_->settled_picture(), before), kSamePicture);
  expect_quits_silently();
}

// Without a look at whether the first edit has settled.
TEST_F(Editing, ADiskElsewhereRightAfterADragBeginsTheNextEdit) {
  open_tube();
  person_->keys("b i");
  box_from(3.5);
  person_->keys("h");
  box_from(5.4);
  ASSERT_TRUE(has_handles(1));
  person_->keys("m");
  drag_part(GizmoMode::translate, GizmoPart::y, {0.0, -60.0});
  person_->keys("d");
  person_->drag_disk({0.5, 0.0, 1.5}, {0.5, 0.0, 2.3});
  person_->drag_disk({0.5, 0.0, 1.5}, {0.5, 0.0, 1.8});
  EXPECT_TRUE(person_->eventually_is([](const Draft& d) {
    return d.steps.size() == 1 && is<GeodesicDisk>(d.open.roi) && d.open.handles.size() == 1;
  }));
  keep_picture("elsewhere");
  person_->keys("Tab");
  keep_picture("panels");
  const auto moved = std::get<DeformRequest>(person_->draft().value().steps.front());
  EXPECT_GT(std::get<SimilarityMove>(moved.handles.at(0).move).translate.y(), 0.05);
  expect_discards_silently();
}

TEST_F(Editing, PinsHoldTheTubeAndOneIsDragged) {
  open_tube();
  person_->keys("v");
  person_->click(person_->pixel_of({0.5, 0.0, 0.5}));
  ASSERT_TRUE(has_handles(1));
  EXPECT_TRUE(is<AllVertices>(person_->draft()->open.roi)) << "nothing else was chosen";
  person_->click(person_->pixel_of({0.4, 0.3, 3.0}));
  ASSERT_TRUE(has_handles(2));
  person_->click(person_->pixel_of({0.4, -0.3, 2.0}));
  ASSERT_TRUE(has_handles(3));
  const Vector2d head = person_->pixel_of({0.5, 0.0, 5.5});
  const Vector2d up(0.0, -50.0);
  person_->drag({head, head + 0.5 * up, head + up});
  ASSERT_TRUE(has_handles(4));
  const Draft pinned = person_->draft().value();
  for (const MovedHandle& pin : pinned.open.handles) {
    EXPECT_EQ(resolve(pin.region, mesh_).size(), 1U);
  }
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) {
    return d.settled && std::get<SimilarityMove>(d.open.handles[3].move).translate.norm() > 0.1;
  })) << "set and dragged in one gesture";

  // And again, by the pin.
  const Draft dragged = person_->draft().value();
  const Vector3d moved = std::get<SimilarityMove>(dragged.open.handles[3].move).translate;
  const Index pin = resolve(dragged.open.handles[3].region, mesh_).front();
  const Vector2d there = person_->pixel_of(mesh_.positions[pin] + moved);
  person_->drag({there, there + 0.5 * up, there + up});
  ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
    return d.settled &&
           std::get<SimilarityMove>(d.open.handles[3].move).translate.y() > moved.y() + 0.05;
  }));
  EXPECT_EQ(person_->draft()->open.handles.size(), 4U);
  expect_discards_silently();
}

TEST_F(Editing, MirrorMakesTheEditOnBothSides) {
  open_tube();
  person_->keys("b i");
  box_from(0.5);
  ASSERT_TRUE(
      person_->eventually_is([](const Draft& d) { return is<ListedVertices>(d.open.roi); }));
  person_->keys("v");
  const Vector2d side = person_->pixel_of({0.4, 0.3, 4.5});
  person_->keys("shift+m");
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return d.open.mirror.has_value(); }));
  person_->drag({side, side + Vector2d(0.0, -20.0), side + Vector2d(0.0, -40.0)});
  ASSERT_TRUE(person_->eventually_is(
      [](const Draft& d) { return d.settled && d.open.handles.size() == 1; }));
  const Draft draft = person_->draft().value();
  CpuKernels kernels;
  Recipe recipe;
  recipe.mesh = tube();
  recipe.steps.emplace_back(draft.open);
  const Mesh made = std::move(run_recipe(recipe, kernels)->mesh);
  std::size_t moved = 0;
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    moved += (made.positions[v] - mesh_.positions[v]).norm() > 0.1 ? 1U : 0U;
  }
  EXPECT_GT(moved, 1U) << "the pin's image, too";
  expect_discards_silently();
}

TEST_F(Editing, EachGizmoModeMovesTheHandle) {
  open_tube();
  choose_parts();

  drag_part(GizmoMode::translate, GizmoPart::y, {0.0, -60.0});
  ASSERT_TRUE(settles());
  EXPECT_GT(move().translate.y(), 0.1);
  EXPECT_EQ(move().translate.x(), 0.0);

  drag_part(GizmoMode::translate, GizmoPart::without_x, {40.0, 30.0});
  ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
    return d.settled && std::get<SimilarityMove>(d.open.handles[0].move).translate.z() < -0.05;
  })) << "the plane across x";

  person_->keys("e");
  drag_part(GizmoMode::rotate, GizmoPart::y, {60.0, 0.0});
  ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
    return d.settled && std::get<SimilarityMove>(d.open.handles[0].move).rotate.degrees > 5.0;
  })) << "the ring about y";
  EXPECT_NEAR(std::abs(move().rotate.axis.normalized().y()), 1.0, 1e-6);

  person_->keys("q");
  drag_part(GizmoMode::scale, GizmoPart::y, {0.0, -20.0});
  ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
    const auto* moved = std::get_if<SimilarityMove>(&d.open.handles[0].move);
    return d.settled && moved != nullptr && moved->scale.y() > 1.05;
  })) << "the arm along y stretches";
  EXPECT_NEAR(move().scale.x(), 1.0, 1e-9);
  EXPECT_NEAR(move().scale.z(), 1.0, 1e-9);

  // Keys and typed numbers, from rest.
  person_->keys("ctrl+z ctrl+z ctrl+z ctrl+z");
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) {
    return d.open.handles[0].move == Move(SimilarityMove{});
  })) << "each move is one step with its result";
  const auto after = [&](const std::string& mode, const std::string& axis,
                         const std::string& number, auto wanted) {
    person_->keys(mode);
    if (!axis.empty()) person_->keys(axis);
    person_->type(number);
    person_->keys("Return");
    return person_->eventually_is([&](const Draft& d) {
      const auto* now = std::get_if<SimilarityMove>(&d.open.handles[0].move);
      return now != nullptr && wanted(*now);
    });
  };
  EXPECT_TRUE(after("g", "y", "0.5", [](const SimilarityMove& m) {
    return m.translate.isApprox(Vector3d(0.0, 0.5, 0.0), 1e-9);
  }));
  EXPECT_TRUE(after("r", "z", "30", [](const SimilarityMove& m) {
    return std::abs(m.rotate.degrees - 30.0) < 1e-9;
  }));
  EXPECT_TRUE(after("s", "", "1.5",
                    [](const SimilarityMove& m) { return std::abs(m.scale.x() - 1.5) < 1e-9; }));
  EXPECT_TRUE(settles());
  expect_discards_silently();
}

TEST_F(Editing, ASettledHandleTakenHoldOfAgainMovesNothing) {
  open_tube();
  choose_parts();
  drag_part(GizmoMode::translate, GizmoPart::y, {0.0, -120.0});
  ASSERT_TRUE(settles());
  const Image before = free_part();
  const Draft draft = person_->draft().value();
  const Vector2d arm =
      test::middle_of(gizmo(GizmoMode::translate), GizmoPart::y, person_->projection());
  person_->hold({arm});
  EXPECT_LT(test::mean_difference(free_part(), before), kSamePicture);
  person_->let_go();
  EXPECT_LT(test::mean_difference(free_part(), before), 0.01);
  EXPECT_EQ(person_->draft(), draft) << "no step";
  person_->hold({arm, arm + Vector2d(0.0, 3.0), arm});
  EXPECT_LT(test::mean_difference(free_part(), before), kSamePicture) << "there and back";
  person_->let_go();
  expect_discards_silently();
}

TEST_F(Editing, WhatADragShowsIsWhatItComesTo) {
  open_tube();
  choose_parts();
  const Image still = free_part();
  const Vector2d arm =
      test::middle_of(gizmo(GizmoMode::translate), GizmoPart::y, person_->projection());
  const Vector2d up(0.0, -260.0);
  person_->hold({arm, arm + 0.3 * up, arm + 0.7 * up, arm + up});
  const Image held = free_part();
  EXPECT_GT(test::mean_difference(held, still), 2.0 * kSamePicture);
  person_->let_go();
  ASSERT_TRUE(settles());
  EXPECT_LT(test::mean_difference(free_part(), held), kSamePicture);
  expect_discards_silently();
}

// Makes five gestures, each from where the last one ended. The picture before the button is
// released must equal the picture after it. The saved recipe must give the saved mesh.
TEST_F(Editing, LettingGoChangesNothingOfWhatIsShown) {
  open_tube();
  choose_parts();
  std::size_t gesture = 0;
  const auto expect_kept = [&](const std::function<void()>& let_go) {
    const Image shown = free_part();
    const Draft before = person_->draft().value();
    let_go();
    ASSERT_TRUE(person_->eventually_is([&](const Draft& d) {
      return d.settled && d.open.handles != before.open.handles;
    })) << "gesture "
        << gesture;
    EXPECT_TRUE(test::eventually(
        60.0, [&] { return test::mean_difference(free_part(), shown) < kSamePicture; }))
        << "gesture " << gesture;
    ++gesture;
  };
  const auto pull = [&](const Vector3d& by) {
    // On the handle, beside its gizmo.
    const Vector3d from = gizmo(GizmoMode::translate).center + Vector3d(0.4, -0.3, 0.0);
    const auto at = [&](double share) { return person_->pixel_of(from + share * by); };
    person_->hold({at(0.0), at(0.2), at(0.4), at(0.6), at(0.8), at(1.0)});
    expect_kept([&] { person_->let_go(); });
    EXPECT_EQ(person_->draft().value().open.handles[0].orientation, HandleOrientation::free);
  };
  const auto type = [&](const std::string& keys, const std::string& number) {
    person_->keys(keys);
    person_->type(number);
    expect_kept([&] { person_->keys("Return"); });
    EXPECT_EQ(person_->draft().value().open.handles[0].orientation, HandleOrientation::kept);
  };
  // These gestures keep the gizmo out of the part that is compared.
  pull({0.0, 1.2, 0.0});
  pull({0.0, -2.2, 0.3});
  type("r", "60");
  type("g", "0.4");
  type("r", "45");

  ASSERT_TRUE(saves_as("ctrl+e", folder_ / "kept.json"));
  ASSERT_TRUE(saves_as("ctrl+shift+s", folder_ / "kept.obj"));
  CpuKernels kernels;
  const Recipe recipe = read_recipe(folder_ / "kept.json");
  EXPECT_FALSE(std::get<DeformRequest>(recipe.steps.at(0)).handles.at(0).path.empty());
  const Positions run = run_recipe(recipe, kernels)->mesh.positions;
  EXPECT_LT(test::largest_distance(run, read_mesh(folder_ / "kept.obj").positions),
            1e-3 * bounds_of(mesh_.positions).diagonal());
  expect_quits_silently();
}

}  // namespace
}  // namespace lapwing
