// SPDX-License-Identifier: MIT
// A diffuse base, a GGX reflection and a layer of fuzz (src/brdf/layered/point.h, which it follows line by line), after Patry,
// "Samurai Shading" (2020). Four functions are left to layered.glsl.
// needs: surface.glsl hemisphere_table.glsl fibre_table.glsl environment.glsl shading_frame.glsl diffuse_base.glsl ggx.glsl
// needs: ggx_surroundings.glsl fuzz.glsl

// Layers a material does not have are left out at compile time.
#ifndef LAYERED_REFLECTION
#define LAYERED_REFLECTION true
#endif
#ifndef LAYERED_COMPENSATION
#define LAYERED_COMPENSATION true
#endif
#ifndef LAYERED_FUZZ
#define LAYERED_FUZZ true
#endif
#ifndef LAYERED_FUZZ_PHASE
#define LAYERED_FUZZ_PHASE FUZZ_SGGX
#endif
#ifndef LAYERED_FUZZ_DOWN
#define LAYERED_FUZZ_DOWN true
#endif
#ifndef LAYERED_FUZZ_SMOOTHING
#define LAYERED_FUZZ_SMOOTHING false
#endif
#ifndef LAYERED_FIBRE_MAP
#define LAYERED_FIBRE_MAP false
#endif
#ifndef LAYERED_WRAPPED
#define LAYERED_WRAPPED false  // the base is lit from below its horizon too
#endif

uniform float ggx_alpha_t;  // the larger
uniform float ggx_alpha_b;
uniform vec2 ggx_axis;      // cosine and sine of the azimuth, as every *_axis here
uniform vec3 ggx_f0;
uniform int ggx_lobe_samples;
uniform float ggx_mean_albedo;
uniform sampler2D ggx_albedo_table;  // scale, bias

uniform float fuzz_density;
uniform float fuzz_alpha;
uniform vec2 fuzz_schlick;
uniform vec3 fuzz_fibre;
uniform float fuzz_smoothing;  // of the layer's normal, from the shading normal to the mesh's
uniform vec2 fuzz_axis;
uniform vec3 fuzz_color;
uniform vec2 fuzz_table_along;         // fibre_table.glsl
uniform sampler2D fuzz_down_table;     // P_s of a light
uniform sampler2D fuzz_ambient_table;  // where a view's fuzz looks: x, y over v.y, z; w: its response over G~

uniform sampler2D fuzz_fibre_map;  // x and y of the fibre as f / 2 + 1/2, in place of fuzz_fibre, fuzz_axis, base_bands
uniform vec2 fuzz_fibre_repeat;
uniform vec3 fuzz_passing_bands;  // of base_bands, the part that all fibres share
uniform sampler2D fuzz_band_table;
uniform sampler3D fuzz_down_volume;  // the tables above, over tilt
uniform sampler3D fuzz_ambient_volume;

const vec2 FUZZ_DOWN_TEXELS = vec2(65.0, 17.0);  // of the tables, as in src/brdf/fuzz_table.h
const vec2 FUZZ_AMBIENT_TEXELS = vec2(129.0, 33.0);
const float FUZZ_TILTS = 33.0;

float layered_albedo(vec3 w) {
  vec2 albedo = hemisphere_table(ggx_albedo_table, w).xy;
  return albedo.x + albedo.y;
}

// The layer of fuzz as one view meets it.
struct Layer {
  mat3 frame;
  vec3 view;
  vec3 fibre;
  vec2 axis;      // of the fibre
  mat3 bands;     // as base_bands
  float cosine;   // between the view and the fibre
  float depth;    // d / v.n
  float leaving;  // P_e
};

void layered_read_fibre(vec2 uv, inout Layer layer) {
  vec2 xy = 2.0 * texture(fuzz_fibre_map, uv * fuzz_fibre_repeat).xy - 1.0;
  float size = length(xy);
  layer.axis = size > 1e-6 ? xy / size : vec2(1.0, 0.0);
  size = clamp(size, 1e-3, 1.0);  // kUprightTilt
  layer.fibre = vec3(size * layer.axis, sqrt(1.0 - size * size));
  float tilt = fibre_tilt(layer.fibre) * 0.7071067811865476;
  float at = tilt * (1.0 - 1.0 / FUZZ_TILTS) + 0.5 / FUZZ_TILTS;
  vec3 scattered = LAYERED_FUZZ_DOWN ? textureLod(fuzz_band_table, vec2(at, 0.5), 0.0).xyz : vec3(0.0);
  layer.bands = mat3(fuzz_passing_bands.x + fuzz_color * scattered.x, fuzz_passing_bands.y + fuzz_color * scattered.y,
                     fuzz_passing_bands.z + fuzz_color * scattered.z);
}

Layer layered_layer(Surface s, mat3 frame, vec3 view) {
  Layer layer = Layer(frame, view, fuzz_fibre, fuzz_axis, mat3(base_bands[0], base_bands[1], base_bands[2]), 0.0, 0.0, 1.0);
  if (LAYERED_FUZZ && LAYERED_FUZZ_SMOOTHING) {
    layer.frame = shading_frame(s, normalize(mix(s.normal, s.mesh_normal, fuzz_smoothing)));
    layer.view = lifted_view(s.view * layer.frame);
  }
  if (LAYERED_FUZZ) {
    if (LAYERED_FIBRE_MAP) layered_read_fibre(s.uv, layer);
    layer.cosine = dot(layer.view, layer.fibre);
    layer.depth = fuzz_density / layer.view.z;
    layer.leaving = exp(-layer.depth);
  }
  return layer;
}

// A direction of the shading frame in the layer's, whose normal may be a smoother one.
vec3 layered_into(Layer layer, mat3 frame, vec3 w) {
  return LAYERED_FUZZ_SMOOTHING ? (frame * w) * layer.frame : w;
}

// What layered.glsl, or a form for comparison (shaders/research), fills in:
// P_s of a light, by its cosine to the fibre;
float layered_scattered_down(vec3 fibre, vec3 light, float cosine);
// the diffuse base for a light in the shading frame, of unit irradiance; and under the surroundings;
vec3 layered_base_lit(vec3 light, vec3 view);
vec3 layered_base_surroundings(mat3 frame, vec3 view, mat3 bands);
// the fuzz under the surroundings.
vec3 layered_fuzz_surroundings(Layer layer);

// Attenuation of the base, [P_p + c (1 - P_p) P_s] P_e; `crossing` is P_p P_e.
vec3 layered_attenuation(Layer layer, vec3 light, float cosine, float crossing) {
  if (!LAYERED_FUZZ_DOWN) return vec3(crossing);
  return crossing + fuzz_color * ((layer.leaving - crossing) * layered_scattered_down(layer.fibre, light, cosine));
}

// What one point has in common for all lights.
struct LayeredPoint {
  mat3 frame;
  vec3 view;
  vec3 ggx_view;     // in the frame of the roughness' axis
  vec2 ggx_albedo;   // of that view: scale, bias
  Layer layer;
};

LayeredPoint layered_at(Surface s) {
  LayeredPoint p;
  p.frame = mat3(s.tangent, s.bitangent_sign * cross(s.normal, s.tangent), s.normal);
  p.view = lifted_view(s.view * p.frame);
  p.ggx_view = turned(p.view, ggx_axis);
  p.ggx_albedo = vec2(1.0, 0.0);
  if (LAYERED_REFLECTION) p.ggx_albedo = hemisphere_table(ggx_albedo_table, p.ggx_view).xy;
  p.layer = layered_layer(s, p.frame, p.view);
  return p;
}

// What a lamp of unit irradiance in direction `towards`, in view space, sends towards the eye.
vec3 layered_lit(LayeredPoint p, vec3 towards) {
  vec3 light = towards * p.frame;
  // Below the horizon only wrapped light arrives, or what a smoother normal lets see it.
  if (!LAYERED_WRAPPED && !LAYERED_FUZZ_SMOOTHING && light.z <= 0.0) return vec3(0.0);
  vec3 base = layered_base_lit(light, p.view);
  if (LAYERED_REFLECTION && light.z > 0.0) {
    vec3 u = turned(light, ggx_axis);
    vec3 f = ggx_brdf(vec2(ggx_alpha_t, ggx_alpha_b), ggx_f0, u, p.ggx_view);
    if (LAYERED_COMPENSATION) {
      f += ggx_multiple_scattering(ggx_f0, layered_albedo(u), p.ggx_albedo.x + p.ggx_albedo.y, ggx_mean_albedo);
    }
    base += f * light.z;
  }
  if (!LAYERED_FUZZ) return base;
  vec3 u = layered_into(p.layer, p.frame, light);
  if (LAYERED_FUZZ_SMOOTHING && u.z <= 0.0) return vec3(0.0);
  float depth = fuzz_density / u.z;
  // The exponent of the layer is that of both crossings: exp(-d (1/u.n + 1/v.n)) = P_p P_e.
  float crossing = exp(-depth) * p.layer.leaving;
  float scattered = fuzz_scattered(depth + p.layer.depth, crossing);
  float cosine = dot(u, p.layer.fibre);
  vec3 sum = u + p.layer.view;
  float phase = fuzz_phase(LAYERED_FUZZ_PHASE, fuzz_alpha, fuzz_schlick, cosine, p.layer.cosine, dot(sum, sum));
  return base * layered_attenuation(p.layer, u, cosine, crossing) + fuzz_color * (phase * scattered * u.z / sum.z);
}

vec3 layered_reflected_surroundings(LayeredPoint p) {
  mat3 bands = p.layer.bands;
  mat3 along = p.frame * mat3(vec3(ggx_axis, 0.0), vec3(-ggx_axis.y, ggx_axis.x, 0.0), vec3(0.0, 0.0, 1.0));
  vec3 reflected = ggx_surroundings(vec2(ggx_alpha_t, ggx_alpha_b), along, p.ggx_view, ggx_lobe_samples) *
                   (ggx_f0 * p.ggx_albedo.x + p.ggx_albedo.y);
  reflected *= bands[0];  // what crosses the fuzz, for probes as for harmonics
  if (LAYERED_COMPENSATION) {
    vec3 lobe = ggx_multiple_scattering(ggx_f0, 0.0, p.ggx_albedo.x + p.ggx_albedo.y, ggx_mean_albedo);
    vec3 bounces = lobe * (3.141592653589793 * (1.0 - ggx_mean_albedo));
    reflected += bounces * received(p.frame[2], bands);
  }
  return reflected;
}

vec3 layered_surroundings(LayeredPoint p) {
  vec3 base = layered_base_surroundings(p.frame, p.view, p.layer.bands);
  if (LAYERED_REFLECTION && environment_present) base += layered_reflected_surroundings(p);
  if (!LAYERED_FUZZ) return base;
  return base * p.layer.leaving + layered_fuzz_surroundings(p.layer);
}
