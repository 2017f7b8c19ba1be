#include "window/ui_renderer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <imgui.h>
#include <span>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/io/image.h"
#include "lapwing/shaders/ui_frag.h"
#include "lapwing/shaders/ui_vert.h"

namespace lapwing::viewer {
namespace {

// The push constants in shaders/ui.glsl.
struct UiPush {
  std::array<float, 2> clip_per_unit;
  std::array<float, 2> origin;
  std::array<std::uint32_t, 2> atlas_size;
};

// The vertex layout that shaders/ui.vert reads.
static_assert(sizeof(ImDrawVert) == 20 && offsetof(ImDrawVert, pos) == 0 &&
              offsetof(ImDrawVert, uv) == 8 && offsetof(ImDrawVert, col) == 16);

// The values of the specialization constant in shaders/ui.frag.
constexpr std::uint32_t kOfFont = 0;
constexpr std::uint32_t kColored = 1;

GraphicsPipelineInfo pipeline_info(std::span<const std::uint32_t> kind) {
  return {.name = "the panels",
          .vertex_spirv = shaders::ui_vert(),
          .fragment_spirv = shaders::ui_frag(),
          .storage_buffers = 3,
          .push_constant_bytes = sizeof(UiPush),
          .constants = kind,
          .blend = true};
}

constexpr VkDeviceSize kSmallest = 65536;

void make_room(const gpu::Context& context, gpu::Buffer& buffer, VkDeviceSize bytes) {
  if (buffer.bytes() >= bytes) return;
  const std::string name = buffer.name();
  buffer = gpu::Buffer(context, name, std::max(2 * buffer.bytes(), bytes), gpu::Memory::upload);
}

std::span<const ImDrawList* const> lists_of(const ImDrawData& panels) {
  return {panels.CmdLists, static_cast<std::size_t>(panels.CmdListsCount)};
}

// Returns the rectangle of the image, in pixels, into which a command may draw.
VkRect2D scissor_of(const ImVec4& clip, const ImDrawData& panels, VkExtent2D extent) {
  const auto pixel = [](float place, float origin, float scale, std::uint32_t limit) {
    return static_cast<std::int32_t>(
        std::clamp((place - origin) * scale, 0.0F, static_cast<float>(limit)));
  };
  const ImVec2 origin = panels.DisplayPos;
  const ImVec2 scale = panels.FramebufferScale;
  const std::int32_t left = pixel(clip.x, origin.x, scale.x, extent.width);
  const std::int32_t top = pixel(clip.y, origin.y, scale.y, extent.height);
  const std::int32_t right = pixel(clip.z, origin.x, scale.x, extent.width);
  const std::int32_t bottom = pixel(clip.w, origin.y, scale.y, extent.height);
  return {{left, top},
          {static_cast<std::uint32_t>(std::max(0, right - left)),
           static_cast<std::uint32_t>(std::max(0, bottom - top))}};
}

}  // namespace

UiPicture::UiPicture(gpu::Context& context, const Image& image)
    : pixels_(context, "picture in a panel", image.rgba.size()),
      width_(image.width),
      height_(image.height) {
  gpu::Transfer(context).upload(pixels_, std::as_bytes(std::span(image.rgba)));
}

UiRenderer::UiRenderer(gpu::Context& context, VkFormat color)
    : context_(context),
      texts_(context, {color, VK_FORMAT_UNDEFINED, VK_SAMPLE_COUNT_1_BIT},
             pipeline_info({&kOfFont, 1})),
      pictures_(context, {color, VK_FORMAT_UNDEFINED, VK_SAMPLE_COUNT_1_BIT},
                pipeline_info({&kColored, 1})),
      corners_(context, "corners of the panels", kSmallest, gpu::Memory::upload),
      vertices_(context, "vertices of the panels", kSmallest, gpu::Memory::upload) {}

void UiRenderer::set_fonts() {
  unsigned char* opacities = nullptr;
  int width = 0;
  int height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&opacities, &width, &height);
  atlas_width_ = static_cast<std::uint32_t>(width);
  atlas_height_ = static_cast<std::uint32_t>(height);
  // The size is a multiple of 4 bytes, because the width of ImGui's atlas is a power of two.
  const std::size_t bytes = std::size_t{atlas_width_} * atlas_height_;
  atlas_.emplace(context_, "font", bytes);
  gpu::Transfer(context_).upload(*atlas_, std::as_bytes(std::span(opacities, bytes)));
}

void UiRenderer::take(const ImDrawData& panels) {
  const auto corner_count = static_cast<VkDeviceSize>(panels.TotalIdxCount);
  const auto vertex_count = static_cast<VkDeviceSize>(panels.TotalVtxCount);
  make_room(context_, corners_, corner_count * sizeof(std::uint32_t));
  make_room(context_, vertices_, vertex_count * sizeof(ImDrawVert));
  auto* corner = corners_.mapped_as<std::uint32_t>().data();
  auto* vertices = vertices_.mapped_as<ImDrawVert>().data();
  std::uint32_t first_vertex = 0;
  for (const ImDrawList* list : lists_of(panels)) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      const ImDrawIdx* indices = list->IdxBuffer.Data + command.IdxOffset;
      const std::uint32_t base = first_vertex + command.VtxOffset;
      for (unsigned i = 0; i < command.ElemCount; ++i) corner[i] = base + indices[i];
      corner += command.ElemCount;
    }
    const auto count = static_cast<std::uint32_t>(list->VtxBuffer.Size);
    std::memcpy(vertices + first_vertex, list->VtxBuffer.Data, count * sizeof(ImDrawVert));
    first_vertex += count;
  }
  context_.count_upload(corner_count * sizeof(std::uint32_t) + vertex_count * sizeof(ImDrawVert));
}

void UiRenderer::draw(VkCommandBuffer commands, VkExtent2D extent, const ImDrawData& panels) const {
  if (!atlas_) return;
  const VkViewport viewport{
      0.0F, 0.0F, static_cast<float>(extent.width), static_cast<float>(extent.height), 0.0F, 1.0F};
  context_.vk().vkCmdSetViewport(commands, 0, 1, &viewport);
  UiPush push{{2.0F / panels.DisplaySize.x, 2.0F / panels.DisplaySize.y},
              {panels.DisplayPos.x, panels.DisplayPos.y},
              {}};
  std::uint32_t first = 0;
  for (const ImDrawList* list : lists_of(panels)) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      const VkRect2D scissor = scissor_of(command.ClipRect, panels, extent);
      if (scissor.extent.width > 0 && scissor.extent.height > 0 && command.ElemCount > 0) {
        context_.vk().vkCmdSetScissor(commands, 0, 1, &scissor);
        const auto* picture = static_cast<const UiPicture*>(command.GetTexID());
        push.atlas_size = picture != nullptr ? std::array{picture->width(), picture->height()}
                                             : std::array{atlas_width_, atlas_height_};
        const gpu::Buffer* pixels = picture != nullptr ? &picture->pixels() : &*atlas_;
        const GraphicsPipeline& pipeline = picture != nullptr ? pictures_ : texts_;
        pipeline.draw(commands, {corners_, vertices_, *pixels}, push, command.ElemCount, first);
      }
      first += command.ElemCount;
    }
  }
}

}  // namespace lapwing::viewer
