// SPDX-License-Identifier: MIT
// A reflectance that the library does not know, with GLSL of its own, drawn through the installed library and
// compared with its evaluator: Minnaert's moon, albedo / pi (n.l)^k (n.v)^(k - 1).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <sateen/appearance/appearance.h>
#include <sateen/core/error.h>
#include <sateen/render/draw_picture.h>
#include <sateen/scene/surface_images.h>

namespace {

using namespace sateen;

class Moon final : public appearance::Reflectance {
 public:
  explicit Moon(double darkening) : k_(darkening) {}

  class Seen final : public Point {
   public:
    Seen(const appearance::Surface& s, double k)
        : normal_(s.normal), view_(std::max(s.normal.dot(s.view), 1e-3)), k_(k) {}
    Vec3 lit(const Vec3& light) const override {
      const double cosine = std::max(normal_.dot(light), 0.0);
      return Vec3(0.5, 0.5, 0.6) * (std::pow(cosine, k_) * std::pow(view_, k_ - 1) / std::numbers::pi);
    }
    Vec3 surroundings(const light::Surroundings& s) const override {
      return Vec3(0.5, 0.5, 0.6).cwiseProduct(s.harmonics.hemisphere_mean(normal_));
    }
    LightSample sample(const Vec3& u) const override {
      const double z = 1 - 2 * u.x();
      const double r = std::sqrt(std::max(1 - z * z, 0.0));
      const double phi = 2 * std::numbers::pi * u.y();
      return {Vec3(r * std::cos(phi), r * std::sin(phi), z), pdf({})};
    }
    double pdf(const Vec3&) const override { return 1 / (4 * std::numbers::pi); }

   private:
    Vec3 normal_;
    double view_;
    double k_;
  };
  std::unique_ptr<Point> at(const appearance::Surface& s) const override {
    return std::make_unique<Seen>(s, k_);
  }

  appearance::ShaderModule shader() const override {
    return {.texts = {{"moon.glsl", R"(
// needs: surface.glsl environment.glsl
uniform float moon_darkening;
struct MoonPoint { vec3 normal; float view; };
MoonPoint moon_at(Surface s) { return MoonPoint(s.normal, max(dot(s.normal, s.view), 1e-3)); }
vec3 moon_lit(MoonPoint p, vec3 light) {
  float cosine = max(dot(p.normal, light), 0.0);
  return vec3(0.5, 0.5, 0.6) * pow(cosine, moon_darkening) * pow(p.view, moon_darkening - 1.0) * 0.3183098861837907;
}
vec3 moon_surroundings(MoonPoint p) { return vec3(0.5, 0.5, 0.6) * harmonics_lobe(p.normal, vec3(1.0, 0.5, 0.0)); }
)"}},
            .defines = {},
            .entry = "moon",
            .point = "MoonPoint"};
  }
  appearance::ShaderValues values() const override {
    return {.uniforms = {{"moon_darkening", static_cast<float>(k_)}}, .textures = {}};
  }

 private:
  double k_;
};

/// A bumpy sheet that fills the picture.
Mesh sheet() {
  Mesh mesh;
  constexpr int kSide = 24;
  for (int j = 0; j <= kSide; ++j) {
    for (int i = 0; i <= kSide; ++i) {
      const double x = 2.0 * i / kSide - 1;
      const double y = 2.0 * j / kSide - 1;
      mesh.positions.push_back(Vec3(x, y, 0).cast<float>());
      mesh.normals.push_back(
          Vec3(0.6 * std::sin(4 * x), 0.5 * std::cos(3 * y), 1).normalized().cast<float>());
    }
  }
  const auto vertex = [](int i, int j) { return static_cast<std::uint32_t>(j * (kSide + 1) + i); };
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace

int main() {
  try {
    scene::Scene scene;
    scene.mesh = sheet();
    scene.materials.resize(1);
    scene.materials[0].appearance = std::make_shared<Moon>(0.7);
    scene.lighting.lamps.resize(1);
    scene.lighting.lamps[0].direction = Vec3(0.4, 0.3, 0.8).normalized();
    scene.lighting.surroundings = light::even_surroundings(Vec3(0.1, 0.2, 0.3));
    render::PictureSettings settings;
    settings.width = settings.height = 64;
    settings.samples = 1;
    settings.surfaces = true;
    const render::Picture picture = render::draw_picture(scene, settings);
    double largest = 0;
    int pixels = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const auto surface = scene::surface_at(*picture.surfaces, x, y);
        if (!surface) continue;
        ++pixels;
        const Vec3 expected = scene.materials[0].appearance->radiance(*surface, scene.lighting);
        largest =
            std::max(largest, (picture.colour.rgb(x, y).cast<double>() - expected).cwiseAbs().maxCoeff());
      }
    }
    std::printf("%d pixels, largest difference %g\n", pixels, largest);
    return pixels > 2000 && largest < 1e-3 ? 0 : 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
