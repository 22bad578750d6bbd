// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sateen/appearance/parameter.h"
#include "sateen/appearance/shader_module.h"
#include "sateen/appearance/surface.h"
#include "sateen/light/lighting.h"

namespace sateen::appearance {

/// What an appearance asks of the mesh; without it the renderer refuses, with a message.
struct Needs {
  bool tangents = false;
  bool uvs = false;
  bool curvature = false;  ///< mean and directional
};

/// The share of a lamp's light that reaches a surface point, [0, 1]; empty: all of it. The lamp is an index
/// into light::Lighting::lamps. Shadows enter here.
using Visibility = std::function<double(std::size_t lamp, const Surface& surface)>;

/// What turns a surface point into a colour, in C++ and in GLSL. Either BakedLight or Reflectance. Renderer,
/// `sateen shade` and path tracers know nothing else about a model.
///
/// An appearance may be changed between frames, by the thread that draws; its revision() then grows.
/// Evaluation is const and may run on many threads.
class Appearance {
 public:
  virtual ~Appearance() = default;

  /// Linear radiance towards the eye, the publication's formula in double precision; occlusion included.
  virtual Vec3 radiance(const Surface& surface, const light::Lighting& lighting,
                        const Visibility& visible = {}) const = 0;
  /// Whether the scene's lighting makes a difference.
  virtual bool lit() const = 0;

  virtual ShaderModule shader() const = 0;
  virtual ShaderValues values() const = 0;
  virtual Needs needs() const { return {}; }
  /// Whether the surface is there at all at this point, 1 or 0, before anything else is asked; may change the
  /// point, for relief that lies deeper. Declared by ShaderModule::covers.
  virtual double cover(Surface&) const { return 1; }
  /// R: turning the tangent by 1/R of a turn changes nothing. The renderer interpolates tangent angles modulo
  /// 1/R.
  virtual int tangent_symmetry() const { return 1; }

  /// What can be changed, in the order a panel shows it.
  virtual std::vector<Parameter> parameters() const { return {}; }
  /// By name. Both throw Error for an unknown name, `set` for a value outside the range too.
  virtual ParameterValue get(const std::string& name) const;
  virtual void set(const std::string& name, const ParameterValue& value);

  /// Takes up tables that were computed on another thread since the last call; `wait` until none is missing.
  /// Called by the drawing thread before each frame: what takes long to prepare is drawn as it was until it
  /// is ready.
  virtual void settle(bool wait = false) { static_cast<void>(wait); }

  /// Another number whenever shader(), values() or needs() may differ from before.
  std::uint64_t revision() const { return revision_; }

 protected:
  void changed() { ++revision_; }

 private:
  std::uint64_t revision_ = 1;
};

/// Light and material in one: MatCap, Anisotropic MatCap, decomposed MatCap. A lookup by normal and tangent
/// in the eye frame.
class BakedLight : public Appearance {
 public:
  virtual Vec3 evaluate(const Surface& surface) const = 0;
  Vec3 radiance(const Surface& surface, const light::Lighting&, const Visibility&) const final {
    return evaluate(surface);
  }
  bool lit() const final { return false; }
};

/// Material alone, lit by the scene's lighting. The loop over lamps and their visibility stands once, in
/// radiance().
class Reflectance : public Appearance {
 public:
  struct LightSample {
    Vec3 light{0, 0, 1};  ///< unit, view space, towards the light
    double pdf = 0;       ///< 1/sr; 0: no light
  };

  /// One surface point seen from one direction, with everything done that all lights have in common.
  /// Directions are unit vectors in view space. It refers to the appearance, which must not change meanwhile.
  class Point {
   public:
    virtual ~Point() = default;
    /// f(light, view) (n.l): radiance per irradiance on a surface facing the light; 0 where none arrives.
    virtual Vec3 lit(const Vec3& light) const = 0;
    /// The reflection of the surroundings from prefiltered tables and harmonics: an approximation of the
    /// integral over all lights that the shader follows line by line.
    virtual Vec3 surroundings(const light::Surroundings& surroundings) const = 0;
    /// A light drawn about where lit() is large; `u` is uniform in [0, 1)^3.
    virtual LightSample sample(const Vec3& u) const = 0;
    /// The density of sample(), 1/sr.
    virtual double pdf(const Vec3& light) const = 0;
  };

  virtual std::unique_ptr<Point> at(const Surface& surface) const = 0;

  Vec3 radiance(const Surface& surface, const light::Lighting& lighting,
                const Visibility& visible) const final;
  bool lit() const final { return true; }
};

}  // namespace sateen::appearance
