#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes the pictures of docs/fuzz.md, docs/ggx.md and docs/materials.md from the examples, with the program in
# build/release. Needs ffmpeg to put pictures side by side.
set -eu
cd "$(dirname "$0")/.."
sateen=build/release/bin/sateen
images=docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mesh=examples/garment/jacket.obj
env=examples/environments/studio.hdr
size=360x250

# draw NAME OPTIONS... with the material on stdin
draw() {
  name=$1
  shift
  cat > "$work/$name.json"
  $sateen render "$mesh" --material "$work/$name.json" -o "$work/$name.png" --size "$size" --background 0.02,0.02,0.02 \
    --occlusion none --rotate 0,25,0 "$@"
}

# row OUTPUT NAMES...: side by side
row() {
  output=$1
  shift
  inputs=
  count=0
  for name; do
    inputs="$inputs -i $work/$name.png"
    count=$((count + 1))
  done
  # shellcheck disable=SC2086
  ffmpeg -v error -y $inputs -filter_complex "hstack=inputs=$count,format=rgb24" -frames:v 1 "$images/$output"
}

base='"model": "layered", "base": {"color": [0.05, 0.05, 0.1]}'
fuzz() { # DENSITY ALPHA TILT
  echo "\"fuzz\": {\"density\": $1, \"alpha\": $2, \"tilt\": $3, \"color\": [0.7, 0.75, 1]}"
}
lamp='"lights": [{"direction": [-0.5, 0.6, 0.6], "color": 3}]'
ambient='"ambient": 1'

echo "{$base, $lamp}" | draw off
echo "{$base, $lamp, $(fuzz 0.35 0.4 35)}" | draw on
echo "{$base}" | draw off-env --env "$env"
echo "{$base, $(fuzz 0.35 0.4 35)}" | draw on-env --env "$env"
row fuzz-off-on.png off on off-env on-env

for d in 0 0.1 0.2 0.5; do echo "{$base, $lamp, $(fuzz $d 0.4 35)}" | draw "density-$d"; done
row fuzz-density.png density-0 density-0.1 density-0.2 density-0.5
for a in 0.2 0.45 0.7 1; do echo "{$base, $lamp, $(fuzz 0.35 $a 35)}" | draw "spread-$a"; done
row fuzz-spread.png spread-0.2 spread-0.45 spread-0.7 spread-1
for t in 0 23 45 90; do echo "{$base, $lamp, $(fuzz 0.35 0.3 $t)}" | draw "tilt-$t"; done
row fuzz-tilt.png tilt-0 tilt-23 tilt-45 tilt-90

# Even ambient light alone: what is left to see comes from the fibres. Tilt 0 has no direction; the others do.
for t in 0 45 90; do echo "{$base, $ambient, $(fuzz 0.35 0.3 $t)}" | draw "ambient-$t"; done
echo "{$base, $ambient, $(fuzz 0.35 0.3 45 | sed 's/"tilt"/"azimuth": 180, "tilt"/')}" | draw ambient-45-back
row fuzz-ambient.png ambient-0 ambient-45 ambient-45-back ambient-90

for m in velvet satin brushed-metal felt moss; do
  $sateen render "$mesh" --material examples/materials/$m.json --env "$env" -o "$work/$m.png" --size $size \
    --background 0.02,0.02,0.02 --occlusion none --rotate 0,25,0
done
row materials.png velvet satin brushed-metal felt moss

mesh=$work/sphere.obj
size=300x300
awk 'BEGIN { pi = atan2(0, -1); n = 96; m = 48
  for (j = 0; j <= m; ++j) for (i = 0; i <= n; ++i) { p = 2 * pi * i / n; t = pi * j / m
    x = sin(t) * sin(p); y = -cos(t); z = sin(t) * cos(p)
    print "v", x, y, z; print "vn", x, y, z; print "vt", i / n, j / m }
  for (j = 0; j < m; ++j) for (i = 0; i < n; ++i) { a = j * (n + 1) + i + 1; b = a + 1; c = b + n + 1; d = a + n + 1
    printf "f %d/%d/%d %d/%d/%d %d/%d/%d %d/%d/%d\n", a, a, a, b, b, b, c, c, c, d, d, d } }' > "$mesh"
for c in gltf materialx blender filament; do
  echo "{\"model\": \"layered\", \"base\": {\"color\": 0.02}, $lamp, \"specular\": {\"convention\": \"$c\", \"roughness\": 0.45,
    \"anisotropy\": 0.8, \"rotation\": 30, \"f0\": [0.9, 0.7, 0.4]}}" | draw "sphere-$c"
done
row brdf-conventions.png sphere-gltf sphere-materialx sphere-blender sphere-filament

for a in 0 90; do
  for m in maximum-normal fibre-diffuse; do
    echo "{\"model\": \"layered\", $lamp, \"base\": {\"model\": \"$m\", \"azimuth\": $a, \"color\": [0.7, 0.5, 0.3]}}" |
      draw "fibre-$m-$a"
  done
done
row fibre-diffuse.png fibre-maximum-normal-0 fibre-fibre-diffuse-0 fibre-maximum-normal-90 fibre-fibre-diffuse-90

$sateen brdf plot fuzz --params examples/brdf/fuzz.json -o $images/brdf-fuzz.svg
$sateen brdf plot ggx --params examples/brdf/ggx.json -o $images/brdf-ggx.svg
