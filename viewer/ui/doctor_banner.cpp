#include "ui/doctor_banner.h"

#include <algorithm>
#include <imgui.h>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "ui/widgets.h"
#include "work/doctor_text.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

// In letters of the font.
constexpr float kBannerLetters = 52.0F;
constexpr float kEmptyLetters = 30.0F;
// More rings than this hide the mesh. Then colours show the places, and only vertices on no face
// get rings.
constexpr std::size_t kMostRings = 200;
constexpr std::size_t kMostLooseRings = 2000;
constexpr float kBannerOpacity = 0.98F;

constexpr ImGuiWindowFlags kBanner =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_AlwaysAutoResize;

// Draws a tooltip with the name and the meaning of each finding.
void draw_findings(const CheckReport& report) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 32.0F);
  for (const Defect& defect : report.defects) {
    const DefectInfo& info = describe(defect.kind);
    if (info.severity == Severity::info) continue;
    ImGui::TextUnformatted(in_window_words(std::string(info.name)).c_str());
    ImGui::TextDisabled("%s", in_window_words(std::string(info.meaning)).c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

DoctorBanner::DoctorBanner(std::string name, std::shared_ptr<const Mesh> mesh, CheckReport report,
                           std::function<void()> wake)
    : name_(std::move(name)),
      mesh_(std::move(mesh)),
      report_(std::move(report)),
      problems_(problems_in_words(report_)),
      hindrance_(hindrance_in_words(report_)),
      job_([] { return std::make_unique<CpuKernels>(); }, std::move(wake)) {
  if (!is_empty() && problems_.empty()) state_ = State::ignored;
  problems_ = name_ + " has " + problems_ + ".";
}

std::shared_ptr<const Mesh> DoctorBanner::repair() const {
  return state_ == State::previewing ? repaired_->mesh : nullptr;
}

void DoctorBanner::update(Editor& editor, bool others_preview) {
  try {
    if (auto result = job_.take(); result && state_ == State::repairing) {
      repaired_ = std::move(result);
      editor.view().shown().show_preview(repaired_->mesh);
      state_ = State::previewing;
    }
  } catch (const Error& error) {
    trouble_ = in_window_words(error.what());
    state_ = State::offering;
  }
  if (!has_picture() || (editor.view().shown().previews() && !others_preview)) return;
  // An edit, an undo or another preview has replaced the picture.
  if (state_ == State::marking) editor.view().point_at({});
  state_ = State::offering;
  repaired_.reset();
}

void DoctorBanner::mark(Editor& editor) {
  const FaultyVertices faulty = faulty_vertices(*mesh_, report_);
  places_ = places_of(*mesh_, faulty);
  side_ = side_of(*mesh_, places_);
  std::vector<VertexClass> classes(mesh_->vertex_count(), VertexClass::outside);
  for (const Index v : faulty.others) classes[v] = VertexClass::handle;
  for (const Index v : places_) classes[v] = VertexClass::handle;
  for (const Index v : faulty.hindering) classes[v] = VertexClass::belt;
  editor.view().shown().show_preview(mesh_, std::move(classes));
  // The edit may have other vertices by now, and only its vertices can be framed and ringed.
  std::erase_if(places_, [&](Index v) { return v >= editor.view().positions().size(); });
  std::vector<Index> ringed = places_;
  if (ringed.size() > kMostRings) {
    std::vector<unsigned char> has_face(mesh_->vertex_count(), 0);
    for (const Index v : mesh_->face_vertices()) has_face[v] = 1;
    std::erase_if(ringed, [&](Index v) { return has_face[v] != 0; });
    ringed.resize(std::min(ringed.size(), kMostLooseRings));
  }
  editor.view().point_at(std::move(ringed));
  state_ = State::marking;
}

void DoctorBanner::show_as_before(Editor& editor) {
  editor.view().point_at({});
  editor.view().shown().end_preview();
  repaired_.reset();
  state_ = State::offering;
}

std::optional<BannerWish> DoctorBanner::draw(Editor& editor, const Eigen::Vector2d& corner,
                                             const Eigen::Vector2d& free_size) {
  height_ = 0.0;
  if (state_ == State::ignored) return {};
  const float letter = ImGui::GetFontSize();
  const ImVec2 at = to_imgui(corner);
  const ImVec2 free = to_imgui(free_size);
  const float width = std::min((is_empty() ? kEmptyLetters : kBannerLetters) * letter, free.x);
  if (is_empty()) {
    ImGui::SetNextWindowPos({at.x + 0.5F * free.x, at.y + 0.5F * free.y}, ImGuiCond_Always,
                            {0.5F, 0.5F});
  } else {
    ImGui::SetNextWindowPos(at);
  }
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, free.y});
  ImGui::SetNextWindowBgAlpha(kBannerOpacity);
  std::optional<BannerWish> wish;
  if (ImGui::Begin("Mesh doctor", nullptr, kBanner)) {
    if (is_empty()) {
      wish = draw_empty();
    } else if (state_ == State::repairing) {
      draw_repairing();
    } else if (state_ == State::previewing) {
      wish = draw_preview(editor);
    } else {
      wish = draw_offer(editor);
    }
    if (!is_empty()) height_ = static_cast<double>(ImGui::GetWindowHeight());
  }
  ImGui::End();
  return wish;
}

std::optional<BannerWish> DoctorBanner::draw_offer(Editor& editor) {
  draw_colored(Tone::warning, problems_);
  if (ImGui::IsItemHovered()) draw_findings(report_);
  ImGui::TextWrapped("%s", hindrance_.c_str());
  std::optional<BannerWish> wish;
  if (state_ == State::marking) {
    if (ImGui::Button("Back")) {
      show_as_before(editor);
      wish = BannerWish::look_back;
    }
  } else if (ImGui::Button("Show")) {
    mark(editor);
    wish = BannerWish::look_at_places;
  }
  ImGui::SameLine();
  const bool is_edited = editor.session().history().done() > 0;
  if (!report_.is_fixable()) {
    ImGui::TextDisabled("No safe automatic repair.");
  } else if (is_edited) {
    ImGui::TextDisabled("Undo all edits to repair the mesh.");
  } else if (ImGui::Button("Repair")) {
    trouble_.clear();
    if (state_ == State::marking) show_as_before(editor);
    state_ = State::repairing;
    job_.start([mesh = mesh_](const std::shared_ptr<Kernels>&, const Progress& progress) {
      return repaired(*mesh, progress);
    });
  }
  ImGui::SameLine();
  if (ImGui::Button("Ignore")) {
    if (state_ == State::marking) {
      show_as_before(editor);
      wish = BannerWish::look_back;
    }
    state_ = State::ignored;
  }
  if (!trouble_.empty()) draw_colored(Tone::warning, trouble_);
  return wish;
}

void DoctorBanner::draw_repairing() {
  const WorkStatus status = job_.status();
  ImGui::Text("%s: %s", name_.c_str(), stage_in_words(status.stage).data());
  if (!ImGui::Button("Stop")) return;
  job_.cancel();
  state_ = State::offering;
}

std::optional<BannerWish> DoctorBanner::draw_preview(Editor& editor) {
  std::optional<BannerWish> wish;
  ImGui::TextWrapped("Repaired: %s.", repairs_in_words(repaired_->done).c_str());
  const std::string left = problems_in_words(repaired_->left);
  if (!left.empty()) ImGui::TextWrapped("Remaining: %s.", left.c_str());
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("Preview. Saving writes the repaired mesh to a new file and opens that file.");
  ImGui::PopStyleColor();
  const float right = right_end();
  if (ImGui::Button("Save repaired mesh...")) wish = BannerWish::keep_repair;
  stay_on_line(button_width("Discard repair"), right);
  if (ImGui::Button("Discard repair")) show_as_before(editor);
  return wish;
}

std::optional<BannerWish> DoctorBanner::draw_empty() {
  draw_colored(Tone::warning, "Nothing to show");
  ImGui::TextWrapped("%s", emptiness_in_words(name_, report_.statistics).c_str());
  if (ImGui::Button("Open another file...")) return BannerWish::open_another;
  return {};
}

}  // namespace lapwing::viewer
