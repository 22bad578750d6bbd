// SPDX-License-Identifier: MIT
// The mean of an environment map over a stretched GGX lobe (src/brdf/ggx_surroundings.h): Karis' split sum (2013), with
// several lookups along the lobe's long axis, about the dominant direction of Lagarde and de Rousiers (2014).
// needs: environment.glsl ggx.glsl

// `frame`: tangent along the larger alpha (alpha.x), bitangent, normal; `view` lies in it, above the horizon.
vec3 ggx_surroundings(vec2 alpha, mat3 frame, vec3 view, int lookups) {
  float count = float(lookups);
  float extra = alpha.x * alpha.x - alpha.y * alpha.y;
  float blur = sqrt(alpha.y * alpha.y + extra / (count * count));
  float view_masking = 1.0 + lambda_ggx(alpha, view);
  float smoothness = 1.0 - alpha.y;
  float off = smoothness * (sqrt(smoothness) + alpha.y);  // rough lobes lean from the mirror direction towards the normal
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int i = 0; i < lookups; ++i) {
    float c = (2.0 * float(i) + 1.0) / count - 1.0;
    vec3 h = normalize(vec3(sqrt(extra) * c * inversesqrt(1.0 - c * c), 0.0, 1.0));
    float cosine = dot(view, h);
    vec3 light = normalize(mix(vec3(0.0, 0.0, 1.0), 2.0 * cosine * h - view, off));
    if (cosine <= 0.0 || light.z <= 1e-4) continue;
    float weight = cosine / h.z * view_masking / (view_masking + lambda_ggx(alpha, light));
    sum += weight * environment_radiance(frame * light, blur);
    total += weight;
  }
  return total > 0.0 ? sum / total : vec3(0.0);
}
