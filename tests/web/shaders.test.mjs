// SPDX-License-Identifier: MIT
// Every shader program of the examples in a real browser: compiled and linked by WebGL2 as it is and behind the text that
// three.js puts in front of a ShaderMaterial, and held to what WebGL2 promises everywhere.
// node shaders.test.mjs PROGRAM EXAMPLES, where PROGRAM writes the texts (write_shader_modules.cpp). SATEEN_CHROMIUM
// names another browser than /usr/bin/chromium.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(process.env.SATEEN_REQUIRE_WEB ? 1 : 77);
}
const packages = new URL('node_modules/', import.meta.url);
if (!existsSync(new URL('playwright-core', packages))) skip('playwright-core is missing; run "npm ci" in tests/web (./test does)');
const browserPath = process.env.SATEEN_CHROMIUM ?? '/usr/bin/chromium';
if (!existsSync(browserPath)) skip(`there is no ${browserPath}; install the package chromium`);
const { chromium } = await import('playwright-core');

const folder = mkdtempSync(join(tmpdir(), 'sateen-shaders-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
execFileSync(process.argv[2], [folder, process.argv[3]], { stdio: 'inherit' });
const read = (name) => readFileSync(join(folder, name), 'utf8');
const modules = JSON.parse(read('modules.json')).map((module) => ({
  ...module, vertexText: read(module.vertex), fragmentText: read(module.fragment),
}));

// Many programs share a file and its faults: by words, the programs that have them.
const faults = new Map();
const fault = (module, words) => faults.set(words, [...(faults.get(words) ?? []), module.name]);

// What WebGL2 promises; a driver may give more, and this browser's does.
const PROMISED_OUTPUTS = 4;
for (const module of modules) {
  const text = preprocessed(module);
  const outputs = [...text.matchAll(/^\s*(?:layout\s*\(\s*location\s*=\s*(\d+)\s*\)\s*)?out\s+(?:\w+\s+)*?\w+\s+(\w+)\s*;/gm)];
  if (outputs.length === 0) fault(module, 'the fragment stage has no output');
  if (outputs.length > PROMISED_OUTPUTS || outputs.some(([, location]) => Number(location ?? 0) >= PROMISED_OUTPUTS)) {
    fault(module, `${outputs.length} outputs; WebGL2 promises ${PROMISED_OUTPUTS}`);
  }
  for (const { sampler, format, linear } of module.textures) {
    if (/32f$/.test(format) && linear) {
      fault(module, `${sampler} is ${format} and filtered: that needs OES_texture_float_linear, half floats do not`);
    }
  }
}

/// The fragment text that is left when preprocessing is done, by Khronos' compiler.
function preprocessed(module) {
  const stage = join(folder, `whole-${module.fragment}`);
  const result = execFileSync('sh', ['-c', '{ echo "#version 300 es"; cat "$1"; } > "$2" && glslangValidator -E -S frag "$2"', 'sh',
    join(folder, module.fragment), stage], { encoding: 'utf8' });
  return result;
}

// three.js comes as modules that import each other: the page needs an origin to fetch them from.
const server = createServer((request, response) => {
  const path = new URL(request.url, 'http://localhost').pathname;
  if (path === '/') {
    response.setHeader('content-type', 'text/html');
    response.end('<!doctype html><title>shaders</title>');
    return;
  }
  try {
    const text = readFileSync(fileURLToPath(new URL(`.${path}`, packages)));
    response.setHeader('content-type', 'text/javascript');
    response.end(text);
  } catch {
    response.statusCode = 404;
    response.end();
  }
});
await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });

const browser = await chromium.launch({
  executablePath: browserPath,
  headless: true,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--no-first-run'],
});
try {
  const page = await browser.newPage();
  page.on('pageerror', (error) => fault({ name: 'page' }, error.message));
  await page.goto(`http://127.0.0.1:${server.address().port}/`);

  const raw = await page.evaluate((list) => {
    const gl = document.createElement('canvas').getContext('webgl2');
    if (!gl) return null;
    const header = '#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp sampler3D;\n'
      + 'precision highp sampler2DArray;\nprecision highp samplerCube;\n';
    return list.map(({ vertexText, fragmentText }) => {
      const program = gl.createProgram();
      for (const [stage, text] of [[gl.VERTEX_SHADER, vertexText], [gl.FRAGMENT_SHADER, fragmentText]]) {
        const shader = gl.createShader(stage);
        gl.shaderSource(shader, header + text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
          return `the ${stage === gl.VERTEX_SHADER ? 'vertex' : 'fragment'} stage does not compile: ${gl.getShaderInfoLog(shader)}`;
        }
        gl.attachShader(program, shader);
      }
      gl.linkProgram(program);
      return gl.getProgramParameter(program, gl.LINK_STATUS) ? '' : `does not link: ${gl.getProgramInfoLog(program)}`;
    });
  }, modules);
  if (raw === null) throw new Error('the browser has no WebGL2');
  raw.forEach((words, i) => { if (words) fault(modules[i], `raw WebGL2: ${words.trim()}`); });

  // A renderer of three.js compiles each as users would write it.
  const behindThree = await page.evaluate(async (list) => {
    const THREE = await import('/three/build/three.module.js');
    const renderer = new THREE.WebGLRenderer({ canvas: document.createElement('canvas') });
    const words = [];
    renderer.debug.onShaderError = (gl, program, vertex, fragment) => {
      const logs = [gl.getProgramInfoLog(program), gl.getShaderInfoLog(vertex), gl.getShaderInfoLog(fragment)];
      words.push(logs.filter((log) => log && log.trim()).join('; ') || 'does not link');
    };
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute([0, 0, 0, 1, 0, 0, 0, 1, 0], 3));
    return list.map(({ vertexText, fragmentText }) => {
      words.length = 0;
      const material = new THREE.ShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: vertexText, fragmentShader: fragmentText });
      const mesh = new THREE.Mesh(geometry, material);
      mesh.frustumCulled = false;
      const scene = new THREE.Scene();
      scene.add(mesh);
      renderer.render(scene, new THREE.PerspectiveCamera());
      if (renderer.info.render.triangles !== 1) words.push('three.js did not draw it');
      return words.join('; ');
    });
  }, modules);
  behindThree.forEach((words, i) => { if (words) fault(modules[i], `behind three.js' prefix: ${words.trim()}`); });
} finally {
  await browser.close();
  server.close();
}

for (const [words, names] of faults) console.log(`${words.replace(/\0/g, '').replace(/\n+/g, '\n    ')}\n    in ${names.join('; ')}\n`);
console.log(`${modules.length} programs, ${faults.size} different faults`);
process.exit(faults.size === 0 ? 0 : 1);
