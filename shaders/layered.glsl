// SPDX-License-Identifier: MIT
// A diffuse base, a GGX reflection and a layer of fuzz under lamps and surroundings (src/brdf/layered.h, which it follows
// line by line); the ambient terms are Patry's, "Samurai Shading" (2020), by table or as printed.
// needs: surface.glsl hemisphere_table.glsl fibre_table.glsl environment.glsl punctual.glsl fibre_diffuse.glsl ggx.glsl
// needs: ggx_surroundings.glsl fuzz.glsl

// Layers a material does not have are left out at compile time: layered_no_*.glsl and layered_slides.glsl in front of this
// file define the switches otherwise.
#ifndef LAYERED_FIBRES
#define LAYERED_FIBRES true
#endif
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
#ifndef LAYERED_FUZZ_SLIDES
#define LAYERED_FUZZ_SLIDES false
#endif
#ifndef LAYERED_SIMPLE_FUZZ
#define LAYERED_SIMPLE_FUZZ true
#endif

uniform vec3 base_colour;
uniform vec3 base_bands[3];  // Legendre coefficients of what a diffuse base receives, under the fuzz if there is one
uniform vec2 base_lobe;  // the fibres' light is (|l across the fibre| + x n.l) y
uniform vec3 base_moments;  // of that over the hemisphere: xx, yy, zz
uniform float base_moment_z;
uniform vec2 base_axis;  // cosine and sine of the fibres' azimuth, as every *_axis here
uniform float simple_fuzziness;

uniform float ggx_alpha_t;  // the larger
uniform float ggx_alpha_b;
uniform vec2 ggx_axis;
uniform vec3 ggx_f0;
uniform int ggx_lobe_samples;  // 0: no environment map to reflect
uniform float ggx_mean_albedo;
uniform sampler2D ggx_albedo_table;  // scale, bias

uniform float fuzz_density;
uniform float fuzz_alpha;
uniform vec2 fuzz_schlick;
uniform vec3 fuzz_fibre;
uniform float fuzz_smoothing;  // of the layer's normal, from the shading normal to the mesh's
uniform vec2 fuzz_axis;
uniform vec3 fuzz_colour;
uniform vec3 fuzz_down_low;
uniform vec3 fuzz_down_high;
uniform vec2 fuzz_table_along;         // fibre_table.glsl
uniform sampler2D fuzz_down_table;     // P_s of a light
uniform sampler2D fuzz_ambient_table;  // where a view's fuzz looks: x, y over v.y, z; w: its response over G~

uniform sampler2D fuzz_fibre_map;  // x and y of the fibre as f / 2 + 1/2, in place of fuzz_fibre, fuzz_axis, base_bands
uniform vec2 fuzz_fibre_repeat;
uniform vec3 fuzz_passing_bands;  // of base_bands, the part that all fibres share
uniform sampler2D fuzz_band_table;
uniform sampler3D fuzz_down_volume;  // the tables above, over tilt
uniform sampler3D fuzz_ambient_volume;

const float LAYERED_LOWEST_VIEW = 1e-3;
const vec2 FUZZ_DOWN_TEXELS = vec2(65.0, 17.0);  // of the tables, as in src/brdf/fuzz_table.h
const vec2 FUZZ_AMBIENT_TEXELS = vec2(129.0, 33.0);
const float FUZZ_TILTS = 33.0;
const float SIMPLE_DENSITY = 0.5;
const float SIMPLE_ALPHA = 0.95;
const float SIMPLE_COLOUR = 5.0;

// Into the frame whose x axis lies at the azimuth of `axis`, and back out of it.
vec3 layered_turned(vec3 w, vec2 axis) {
  return vec3(dot(w.xy, axis), axis.x * w.y - axis.y * w.x, w.z);
}
vec3 layered_back(vec3 w, vec2 axis) {
  return layered_turned(w, vec2(axis.x, -axis.y));
}

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

mat3 layered_frame(Surface s, vec3 normal) {
  vec3 tangent = s.tangent - normal * dot(normal, s.tangent);
  tangent *= inversesqrt(max(dot(tangent, tangent), 1e-12));
  return mat3(tangent, s.bitangent_sign * cross(normal, tangent), normal);
}

// Into the frame; interpolated normals turn away from the eye at the rim.
vec3 layered_view(vec3 view, mat3 frame) {
  vec3 v = view * frame;
  return v.z < LAYERED_LOWEST_VIEW ? normalize(vec3(v.xy, LAYERED_LOWEST_VIEW)) : v;
}

void layered_read_fibre(vec2 uv, inout Layer layer) {
  vec2 xy = 2.0 * texture(fuzz_fibre_map, uv * fuzz_fibre_repeat).xy - 1.0;
  float size = length(xy);
  layer.axis = size > 1e-6 ? xy / size : vec2(1.0, 0.0);
  size = clamp(size, 1e-3, 1.0);  // kUprightTilt
  layer.fibre = vec3(size * layer.axis, sqrt(1.0 - size * size));
  float tilt = fibre_tilt(layer.fibre) * 0.7071067811865476;
  float at = tilt * (1.0 - 1.0 / FUZZ_TILTS) + 0.5 / FUZZ_TILTS;
  vec3 scattered = LAYERED_FUZZ_DOWN ? textureLod(fuzz_band_table, vec2(at, 0.5), 0.0).xyz : vec3(0.0);
  layer.bands = mat3(fuzz_passing_bands.x + fuzz_colour * scattered.x, fuzz_passing_bands.y + fuzz_colour * scattered.y,
                     fuzz_passing_bands.z + fuzz_colour * scattered.z);
}

Layer layered_layer(Surface s, mat3 frame, vec3 view) {
  Layer layer = Layer(frame, view, fuzz_fibre, fuzz_axis, mat3(base_bands[0], base_bands[1], base_bands[2]), 0.0, 0.0, 1.0);
  if (LAYERED_FUZZ && LAYERED_FUZZ_SMOOTHING) {
    layer.frame = layered_frame(s, normalize(mix(s.normal, s.mesh_normal, fuzz_smoothing)));
    layer.view = layered_view(s.view, layer.frame);
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

// P_s of a light, by its cosine to the fibre.
float layered_scattered_down(vec3 fibre, vec3 light, float cosine) {
  if (LAYERED_FUZZ_SLIDES) return fuzz_scattered_down_fit(fuzz_down_low, fuzz_down_high, light.z, cosine);
  if (LAYERED_FIBRE_MAP) return fibre_volume(fuzz_down_volume, vec3(FUZZ_DOWN_TEXELS, FUZZ_TILTS), fibre, light, cosine).x;
  return fibre_table(fuzz_down_table, FUZZ_DOWN_TEXELS, fibre, fuzz_table_along, light, cosine).x;
}

// Attenuation of the base, [P_p + c (1 - P_p) P_s] P_e; `crossing` is P_p P_e.
vec3 layered_attenuation(Layer layer, vec3 light, float cosine, float crossing) {
  if (!LAYERED_FUZZ_DOWN) return vec3(crossing);
  return crossing + fuzz_colour * ((layer.leaving - crossing) * layered_scattered_down(layer.fibre, light, cosine));
}

vec3 layered_simple_fuzz(vec3 light, vec3 view) {
  float x = fuzz_wrapped_cosine(light.z);
  if (x <= 0.0) return vec3(0.0);
  vec3 across = light + view;
  float phase = fuzz_phase(FUZZ_SGGX, SIMPLE_ALPHA, vec2(0.0), light.z, view.z, dot(across, across));
  float scattered = 1.0 - exp(-SIMPLE_DENSITY * (x + view.z) / (x * view.z));
  return base_colour * (SIMPLE_COLOUR * phase * scattered * x / (x + view.z));
}

// What a lamp of unit irradiance in direction `light` sends towards `view`.
vec3 layered_direct(mat3 frame, vec3 light, vec3 view, Layer layer) {
  vec3 base = vec3(0.0);
  if (light.z > 0.0) {
    float diffuse = LAYERED_FIBRES ? fibre_lobe(layered_turned(light, base_axis), base_lobe) : light.z * 0.3183098861837907;
    base = base_colour * diffuse;
  }
  if (LAYERED_SIMPLE_FUZZ) base = mix(base, layered_simple_fuzz(light, view), simple_fuzziness);
  if (LAYERED_REFLECTION && light.z > 0.0) {
    vec3 u = layered_turned(light, ggx_axis);
    vec3 v = layered_turned(view, ggx_axis);
    vec3 f = ggx_brdf(vec2(ggx_alpha_t, ggx_alpha_b), ggx_f0, u, v);
    if (LAYERED_COMPENSATION) f += ggx_multiple_scattering(ggx_f0, layered_albedo(u), layered_albedo(v), ggx_mean_albedo);
    base += f * light.z;
  }
  if (!LAYERED_FUZZ) return base;
  vec3 u = layered_into(layer, frame, light);
  if (LAYERED_FUZZ_SMOOTHING && u.z <= 0.0) return vec3(0.0);
  float depth = fuzz_density / u.z;
  // The exponent of the layer is that of both crossings: exp(-d (1/u.n + 1/v.n)) = P_p P_e.
  float crossing = exp(-depth) * layer.leaving;
  float scattered = fuzz_scattered(depth + layer.depth, crossing);
  float cosine = dot(u, layer.fibre);
  vec3 sum = u + layer.view;
  float phase = fuzz_phase(LAYERED_FUZZ_PHASE, fuzz_alpha, fuzz_schlick, cosine, layer.cosine, dot(sum, sum));
  return base * layered_attenuation(layer, u, cosine, crossing) + fuzz_colour * (phase * scattered * u.z / sum.z);
}

// The light of the surroundings on a flat diffuse surface, per albedo.
vec3 layered_received(vec3 normal, mat3 bands) {
  return environment_harmonics[0] * bands[0] + harmonics_linear(normal) * bands[1] + harmonics_quadratic(normal) * bands[2];
}

vec3 layered_diffuse_surroundings(mat3 frame, mat3 bands) {
  if (!LAYERED_FIBRES) return base_colour * layered_received(frame[2], bands);
  vec3 fibre = frame * vec3(base_axis, 0.0);
  vec3 across = frame * vec3(-base_axis.y, base_axis.x, 0.0);
  return base_colour * bands[0] *
         (environment_harmonics[0] + harmonics_linear(frame[2]) * base_moment_z + harmonics_quadratic(fibre) * base_moments.x +
          harmonics_quadratic(across) * base_moments.y + harmonics_quadratic(frame[2]) * base_moments.z);
}

vec3 layered_reflected_surroundings(mat3 frame, vec3 view, mat3 bands) {
  mat3 along = frame * mat3(vec3(ggx_axis, 0.0), vec3(-ggx_axis.y, ggx_axis.x, 0.0), vec3(0.0, 0.0, 1.0));
  vec3 v = layered_turned(view, ggx_axis);
  vec2 albedo = hemisphere_table(ggx_albedo_table, v).xy;
  vec3 reflected = ggx_surroundings(vec2(ggx_alpha_t, ggx_alpha_b), along, v, ggx_lobe_samples) * (ggx_f0 * albedo.x + albedo.y);
  reflected *= bands[0];  // what crosses the fuzz, for probes as for harmonics
  if (LAYERED_COMPENSATION) {
    vec3 lobe = ggx_multiple_scattering(ggx_f0, 0.0, albedo.x + albedo.y, ggx_mean_albedo);
    vec3 bounces = lobe * (3.141592653589793 * (1.0 - ggx_mean_albedo));
    reflected += bounces * layered_received(frame[2], bands);
  }
  return reflected;
}

vec4 layered_ambient(Layer layer) {
  if (LAYERED_FIBRE_MAP) {
    return fibre_volume(fuzz_ambient_volume, vec3(FUZZ_AMBIENT_TEXELS, FUZZ_TILTS), layer.fibre, layer.view, layer.cosine);
  }
  return fibre_table(fuzz_ambient_table, FUZZ_AMBIENT_TEXELS, layer.fibre, fuzz_table_along, layer.view, layer.cosine);
}

vec3 layered_fuzz_surroundings(Layer layer) {
  float visibility = fuzz_visibility_fit(fuzz_density, layer.view.z);
  if (LAYERED_FUZZ_SLIDES) {
    return fuzz_colour * harmonics_lobe(layer.frame[2], vec3(1.0, 0.5, 0.0)) *
           (visibility * (1.0 - layered_scattered_down(layer.fibre, layer.view, layer.cosine)));
  }
  vec3 v = layered_turned(layer.view, layer.axis);
  vec4 ambient = layered_ambient(layer);
  vec3 gaze = layer.frame * layered_back(vec3(ambient.x, ambient.y * v.y, ambient.z), layer.axis);
  return fuzz_colour * harmonics_mean(gaze) * (ambient.w * visibility);
}

vec3 layered_surroundings(mat3 frame, vec3 view, Layer layer) {
  vec3 base = layered_diffuse_surroundings(frame, layer.bands);
  if (LAYERED_SIMPLE_FUZZ) {
    float response = fuzz_visibility_fit(SIMPLE_DENSITY, view.z) * 0.5;
    vec3 fuzz = base_colour * harmonics_lobe(frame[2], vec3(1.0, 0.5, 0.0)) * (SIMPLE_COLOUR * response);
    base = mix(base, fuzz, simple_fuzziness);
  }
  if (LAYERED_REFLECTION && ggx_lobe_samples > 0) base += layered_reflected_surroundings(frame, view, layer.bands);
  if (!LAYERED_FUZZ) return base;
  return base * layer.leaving + layered_fuzz_surroundings(layer);
}

vec3 layered(Surface s) {
  mat3 frame = mat3(s.tangent, s.bitangent_sign * cross(s.normal, s.tangent), s.normal);
  vec3 view = layered_view(s.view, frame);
  Layer layer = layered_layer(s, frame, view);
  vec3 sum = s.occlusion * layered_surroundings(frame, view, layer);
  for (int i = 0; i < light_count; ++i) {
    vec3 direction;
    vec3 irradiance = arriving_light(i, s.position, direction);
    vec3 light = direction * frame;
    // Below the horizon only wrapped light arrives, or what a smoother normal lets see it.
    if (LAYERED_SIMPLE_FUZZ || LAYERED_FUZZ_SMOOTHING || light.z > 0.0) {
      sum += irradiance * layered_direct(frame, light, view, layer);
    }
  }
  return max(sum, 0.0);
}
