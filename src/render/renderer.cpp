// SPDX-License-Identifier: MIT
#include "sateen/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/gpu/state_guard.h"
#include "sateen/render/geometry_buffers.h"
#include "sateen/render/surface_pass.h"

namespace sateen::render {
namespace {

/// What the mesh offers, which is all that the materials need.
scene::MeshOffer checked_offer(const scene::Scene& scene) {
  check(scene.mesh);
  const scene::MeshOffer offer = scene::offer_of(scene.mesh);
  if (scene.materials.size() < offer.materials) {
    throw Error(
        fmt::format("the mesh has {} materials and {} appearances", offer.materials, scene.materials.size()));
  }
  for (const scene::Material& material : scene.materials) check_material(offer, material);
  return offer;
}

struct Rectangle {
  int x = 0;
  int y = 0;  ///< from the top
  int width = 0;
  int height = 0;
};

/// Narrows a projection of the whole picture down to a part of it.
Mat4 tile_projection(const Mat4& clip_from_view, const Rectangle& tile, const PictureSettings& settings) {
  const double sx = static_cast<double>(settings.width) / tile.width;
  const double sy = static_cast<double>(settings.height) / tile.height;
  const double centre_x = (2.0 * tile.x + tile.width) / settings.width - 1;
  const double centre_y = 1 - (2.0 * tile.y + tile.height) / settings.height;
  Mat4 part = Mat4::Identity();
  part(0, 0) = sx;
  part(1, 1) = sy;
  part(0, 3) = -centre_x * sx;
  part(1, 3) = -centre_y * sy;
  return part * clip_from_view;
}

void paste(const Image& part, const Rectangle& at, Image& whole) {
  for (int y = 0; y < at.height; ++y) {
    const auto row = part.data.begin() + static_cast<std::ptrdiff_t>(part.index(0, y));
    std::copy(row, row + static_cast<std::ptrdiff_t>(at.width) * 4,
              whole.data.begin() + static_cast<std::ptrdiff_t>(whole.index(at.x, at.y + y)));
  }
}

}  // namespace

struct Renderer::Data {
  using Output = SurfaceProgram::Output;

  scene::MeshOffer offer;
  GeometryBuffers geometry;
  std::vector<scene::Material> materials;
  scene::RenderSwitches switches;
  light::Lighting lighting;
  double tangent_turn;
  Caches caches;
  std::vector<std::optional<SurfacePass>> colour_passes;   ///< by material; made when first needed
  std::vector<std::optional<SurfacePass>> surface_passes;  ///< the same, writing what is known of the surface
  gpu::Program display;
  gpu::Handle no_attributes;
  std::map<std::array<int, 4>, gpu::Framebuffer>
      framebuffers;  ///< by width, height, targets; or a second one

  explicit Data(const scene::Scene& scene)
      : offer(checked_offer(scene)),
        geometry(scene),
        materials(scene.materials),
        switches(scene.switches),
        lighting(scene.lighting),
        tangent_turn(scene.tangent_turn),
        display(std::array{gpu::shader_file("picture.vert")},
                gpu::with_needed(std::array{std::string("display.frag")})) {
    forget_passes();
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    no_attributes = gpu::Handle(name, [](unsigned id) { glDeleteVertexArrays(1, &id); });
  }

  void forget_passes() {
    colour_passes.assign(materials.size(), std::nullopt);
    surface_passes.assign(materials.size(), std::nullopt);
  }

  /// Takes up what materials have become since the last frame.
  void settle(bool wait) {
    for (const scene::Material& material : materials) material.appearance->settle(wait);
    caches.textures.sweep();
  }

  SurfacePass& pass(std::vector<std::optional<SurfacePass>>& passes, std::size_t material, Output output) {
    std::optional<SurfacePass>& found = passes[material];
    if (!found) {
      check_material(offer, materials[material]);
      found.emplace(materials[material], static_cast<int>(material), switches, output, caches);
    }
    found->update(caches);
    return *found;
  }

  void draw(const scene::View& view, const Mat4& clip_from_view, Output output, int first_target = 0) {
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    auto& passes = output == Output::color ? colour_passes : surface_passes;
    const FrameState frame{view, clip_from_view, geometry.counter_clockwise(), tangent_turn, lighting};
    for (std::size_t i = 0; i < materials.size(); ++i) {
      if (geometry.empty(i)) continue;
      const SurfacePass& surface = pass(passes, i, output);
      surface.use(frame, caches);
      if (output == Output::surface) surface.set_first_target(first_target);
      geometry.draw(i);
    }
  }

  /// Kept for the next picture: those of one size, and of the tiles at its edges.
  const gpu::Framebuffer& framebuffer(int width, int height, int targets, bool second = false) {
    const std::array key{width, height, targets, second ? 1 : 0};
    return framebuffers.try_emplace(key, width, height, targets).first->second;
  }

  /// shaders/display.frag: the mean over samples x samples texels of `from` in each pixel of `to`.
  void show(const gpu::Framebuffer& from, const gpu::Framebuffer& to, const PictureSettings& settings) const {
    to.bind();
    glDisable(GL_DEPTH_TEST);
    display.use();
    display.set("supersampled", 0);
    display.set("samples", settings.samples);
    const Vec3f colour = settings.background.value_or(Vec3f::Zero());
    display.set("background", Vec4f(colour.x(), colour.y(), colour.z(), settings.background ? 1.0f : 0.0f));
    display.set("display_view", settings.display ? static_cast<int>(settings.display->view) : -1);
    display.set("display_gain", static_cast<float>(settings.display ? display_gain(*settings.display) : 1));
    from.bind_colour(0);
    glBindVertexArray(no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  Image colour_tile(const scene::View& view, const Mat4& clip_from_view, const Rectangle& tile,
                    const PictureSettings& settings) {
    const int samples = settings.samples;
    const gpu::Framebuffer& large = framebuffer(tile.width * samples, tile.height * samples, 1);
    large.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(view, clip_from_view, Output::color);
    if (samples == 1 && !settings.background && !settings.display) return large.read();
    // With one sample both are of one size, and nothing is read while it is written.
    const gpu::Framebuffer& small = framebuffer(tile.width, tile.height, 1, samples == 1);
    show(large, small, settings);
    return small.read();
  }

  void surface_tile(const scene::View& view, const Mat4& clip_from_view, const Rectangle& tile,
                    scene::SurfaceImages& images) {
    constexpr int kTargets = 4;  // as many as WebGL2 promises
    const gpu::Framebuffer& target = framebuffer(tile.width, tile.height, kTargets);
    for (int first = 0; first < scene::packed_pictures(); first += kTargets) {
      target.bind();
      glClearColor(0, 0, 0, 0);
      glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      draw(view, clip_from_view, Output::surface, first);
      for (int i = first; i < std::min(first + kTargets, scene::packed_pictures()); ++i) {
        paste(target.read(i - first), tile, images.packed[static_cast<std::size_t>(i)]);
      }
    }
  }
};

Renderer::Renderer(const scene::Scene& scene) {
  const gpu::StateGuard guard;
  data_ = std::make_unique<Data>(scene);
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::set_material(std::size_t index, scene::Material material) {
  Data& data = *data_;
  if (index >= data.materials.size()) {
    throw Error(fmt::format("there is no material {}; the scene has {}", index, data.materials.size()));
  }
  check_material(data.offer, material);
  data.materials[index] = std::move(material);
  data.colour_passes[index].reset();
  data.surface_passes[index].reset();
}

void Renderer::set_lighting(light::Lighting lighting) {
  data_->lighting = std::move(lighting);
}

void Renderer::set_switches(const scene::RenderSwitches& switches) {
  data_->switches = switches;
  data_->forget_passes();
}

void Renderer::set_tangent_turn(double angle) {
  data_->tangent_turn = angle;
}

Picture Renderer::render(const scene::View& view, const PictureSettings& settings,
                         const Progress& progress) const {
  if (settings.width < 1 || settings.height < 1 || settings.samples < 1) {
    throw Error("a picture needs at least one pixel and one sample");
  }
  const gpu::StateGuard guard;
  data_->settle(true);
  constexpr std::size_t kKept = 12;
  if (data_->framebuffers.size() > kKept) data_->framebuffers.clear();
  const int side = std::min(settings.tile, gpu::max_framebuffer_size()) / settings.samples;
  if (side < 1)
    throw Error(fmt::format("{} samples are more than this OpenGL driver can draw", settings.samples));

  Picture picture;
  picture.colour = Image(settings.width, settings.height, 4);
  if (settings.surfaces) {
    picture.surfaces =
        scene::SurfaceImages{std::vector<Image>(static_cast<std::size_t>(scene::packed_pictures()),
                                                Image(settings.width, settings.height, 4)),
                             view.perspective};
  }
  const int columns = (settings.width + side - 1) / side;
  const int rows = (settings.height + side - 1) / side;
  for (int i = 0; i < rows * columns; ++i) {
    Rectangle tile{(i % columns) * side, (i / columns) * side, 0, 0};
    tile.width = std::min(side, settings.width - tile.x);
    tile.height = std::min(side, settings.height - tile.y);
    const Mat4 clip_from_view = tile_projection(view.clip_from_view, tile, settings);
    paste(data_->colour_tile(view, clip_from_view, tile, settings), tile, picture.colour);
    if (picture.surfaces) data_->surface_tile(view, clip_from_view, tile, *picture.surfaces);
    report(progress, (i + 1.0) / (rows * columns));
  }
  return picture;
}

void Renderer::draw(const scene::View& view) const {
  const gpu::StateGuard guard;
  data_->settle(false);
  data_->draw(view, view.clip_from_view, SurfaceProgram::Output::color);
}

}  // namespace sateen::render
