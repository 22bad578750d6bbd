// SPDX-License-Identifier: MIT
// Anisotropic asperity scattering: Patry, "Samurai Shading" (2020), after Koenderink and Pont 2003, corrected where the
// slides slip (src/brdf/fuzz.h). Shading frame, normal z; the fibre is a unit line.

#define FUZZ_SGGX 0
#define FUZZ_SGGX_SYMMETRIC 1
#define FUZZ_SCHLICK 2

// 1 - exp(-x) without cancellation for thin layers; `passing` is exp(-x), at hand where x is a sum.
float fuzz_scattered(float x, float passing) {
  return x < 0.01 ? x * (1.0 - x * (0.5 - x * 0.16666667)) : 1.0 - passing;
}

// p(u, v) of light and view above the horizon, by their cosines to the fibre and |u + v|^2. `schlick`: k, and
// r(k) (1 - k^2) / (4 pi).
float fuzz_phase(int kind, float alpha, vec2 schlick, float light_cosine, float view_cosine, float squared) {
  float along = light_cosine + view_cosine;
  if (kind == FUZZ_SCHLICK) {
    float q = 1.0 - schlick.x * sqrt(max(1.0 - along * along / squared, 0.0));
    return schlick.y / (q * q);
  }
  float a2 = alpha * alpha;
  float ratio = squared / (along * along * (1.0 - a2) + a2 * squared);
  float cosine = light_cosine;
  if (kind == FUZZ_SGGX_SYMMETRIC) cosine = min(abs(light_cosine), abs(view_cosine));  // the larger sigma
  float area2 = 1.0 - cosine * cosine * (1.0 - a2);
  return alpha * a2 * 0.07957747154594767 * ratio * ratio * inversesqrt(area2);  // D / (4 sigma); 1 / (4 pi)
}

// G~ of the slides, with the coefficients bench_fuzz_fit prints (kVisibilitySlides in src/brdf/fuzz_approximations.h).
float fuzz_visibility_fit(float density, float m) {
  const vec4 c = vec4(-1.048755973, 0.573646848, 0.662396866, -0.131619429);
  return density > 0.0 ? density * (1.0 + m * (c.x + m * c.y)) / (density + m * (c.z + m * m * c.w)) : 0.0;
}

// P_s of the slides: six terms in x = u.n, y = u.t.
float fuzz_scattered_down_fit(vec3 low, vec3 high, float x, float y) {
  return clamp(low.x + low.y * x + low.z * y + high.x * x * x + high.y * x * y + high.z * y * y, 0.0, 1.0);
}

// Wrapped lighting (McAuley 2013) of the slides' simplified version, n = 2, w = 0.2, in place of u.n.
float fuzz_wrapped_cosine(float cosine) {
  float x = max(cosine + 0.2, 0.0) / 1.2;
  return 1.25 * x * x;
}
