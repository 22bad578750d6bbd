// SPDX-License-Identifier: MIT
#include "sateen/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "sateen/core/error.h"
#include "sateen/gpu/framebuffer.h"
#include "sateen/render/geometry_buffers.h"
#include "sateen/render/surface_pipeline.h"

namespace sateen::render {
namespace {

const scene::Scene& checked(const scene::Scene& scene) {
  const Mesh& mesh = scene.mesh;
  if (mesh.triangles.empty()) throw Error("the mesh has no triangles");
  if (mesh.normals.empty()) throw Error("the mesh has no normals; compute them first");
  std::uint32_t materials = 1;
  for (const std::uint32_t id : mesh.material_ids) materials = std::max(materials, id + 1);
  if (scene.materials.size() < materials) {
    throw Error(
        fmt::format("the mesh has {} materials and {} appearances", materials, scene.materials.size()));
  }
  for (const scene::Material& material : scene.materials) {
    if (!material.appearance) throw Error("a material has no appearance");
    const appearance::Appearance::Needs needs = material.appearance->needs();
    const bool mapped =
        material.normal_map.texture || material.direction_map.texture || material.occlusion_map.texture;
    if ((needs.tangents || material.normal_map.texture || material.direction_map.texture) &&
        mesh.tangents.empty()) {
      throw Error("the material needs tangents and the mesh has none");
    }
    if ((needs.uvs || mapped) && mesh.uvs.empty()) {
      throw Error("the material needs texture coordinates (UVs) and the mesh has none");
    }
    if (needs.curvature && mesh.curvature.empty()) {
      throw Error("the material needs curvature and the mesh has none");
    }
  }
  return scene;
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
  GeometryBuffers geometry;
  std::vector<SurfacePipeline> pipelines;  ///< by material
  std::vector<SurfacePipeline>
      surface_pipelines;  ///< the same, writing the surface too; made when first needed
  std::vector<scene::Material> materials;
  scene::RenderSwitches switches;
  gpu::Program display;
  gpu::Handle no_attributes;

  explicit Data(const scene::Scene& scene)
      : geometry(scene),
        materials(scene.materials),
        switches(scene.switches),
        display(std::array{gpu::shader_file("picture.vert")},
                gpu::with_needed(std::array{std::string("display.frag")})) {
    pipelines = compile(false);
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    no_attributes = gpu::Handle(name, [](unsigned id) { glDeleteVertexArrays(1, &id); });
  }

  std::vector<SurfacePipeline> compile(bool write_surface) const {
    std::vector<SurfacePipeline> result;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      result.emplace_back(materials[i], static_cast<int>(i), switches, write_surface);
    }
    return result;
  }

  void draw(const std::vector<SurfacePipeline>& with, const scene::View& view,
            const Mat4& clip_from_view) const {
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    for (std::size_t i = 0; i < with.size(); ++i) {
      with[i].use(view, clip_from_view, geometry.counter_clockwise());
      geometry.draw(i);
    }
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
                    const PictureSettings& settings) const {
    const int samples = settings.samples;
    const gpu::Framebuffer large(tile.width * samples, tile.height * samples);
    large.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(pipelines, view, clip_from_view);
    if (samples == 1 && !settings.background && !settings.display) return large.read();
    const gpu::Framebuffer small(tile.width, tile.height);
    show(large, small, settings);
    return small.read();
  }

  void surface_tile(const scene::View& view, const Mat4& clip_from_view, const Rectangle& tile,
                    scene::SurfaceImages& images) {
    if (surface_pipelines.empty()) surface_pipelines = compile(true);
    const gpu::Framebuffer target(tile.width, tile.height, 7);
    target.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(surface_pipelines, view, clip_from_view);
    int location = 1;
    for (Image* image : {&images.position, &images.normal, &images.tangent, &images.eye_normal,
                         &images.uv_and_curvature, &images.mesh_normal}) {
      paste(target.read(location++), tile, *image);
    }
  }
};

Renderer::Renderer(const scene::Scene& scene) : data_(std::make_unique<Data>(checked(scene))) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Picture Renderer::render(const scene::View& view, const PictureSettings& settings,
                         const Progress& progress) const {
  if (settings.width < 1 || settings.height < 1 || settings.samples < 1) {
    throw Error("a picture needs at least one pixel and one sample");
  }
  const int side = std::min(settings.tile, gpu::max_framebuffer_size()) / settings.samples;
  if (side < 1)
    throw Error(fmt::format("{} samples are more than this OpenGL driver can draw", settings.samples));

  Picture picture;
  picture.colour = Image(settings.width, settings.height, 4);
  if (settings.surfaces) {
    const Image empty(settings.width, settings.height, 4);
    picture.surfaces = scene::SurfaceImages{empty, empty, empty, empty, empty, empty, view.perspective};
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
  data_->draw(data_->pipelines, view, view.clip_from_view);
}

}  // namespace sateen::render
