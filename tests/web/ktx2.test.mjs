// SPDX-License-Identifier: MIT
// Reads textures written by Sateen with ktx-parse and with three.js' KTX2Loader.
// node ktx2.test.mjs PROGRAM, where PROGRAM writes the textures into the folder it is given.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

if (!existsSync(new URL('node_modules', import.meta.url))) {
  console.log('skipped: node_modules is missing; run "npm ci" in tests/web (./test does)');
  process.exit(process.env.SATEEN_REQUIRE_WEB ? 1 : 77);
}
const ktx = await import('ktx-parse');
const three = await import('three');
const { KTX2Loader } = await import('three/addons/loaders/KTX2Loader.js');
const { ZSTDDecoder } = await import('zstddec');
const zstd = new ZSTDDecoder();
await zstd.init();

const folder = mkdtempSync(join(tmpdir(), 'sateen-web-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
execFileSync(process.argv[2], [folder], { stdio: 'inherit' });

const srgb = {
  colorModel: ktx.KHR_DF_MODEL_RGBSDA, transferFunction: ktx.KHR_DF_TRANSFER_SRGB, block: [0, 0], typeSize: 1,
  samples: [[0, 8, 0, 0, 255], [8, 8, 1, 0, 255], [16, 8, 2, 0, 255],
    [24, 8, ktx.KHR_DF_CHANNEL_RGBSDA_ALPHA | ktx.KHR_DF_SAMPLE_DATATYPE_LINEAR, 0, 255]],
};
const signedFloat = ktx.KHR_DF_SAMPLE_DATATYPE_SIGNED | ktx.KHR_DF_SAMPLE_DATATYPE_FLOAT;
const half = {
  colorModel: ktx.KHR_DF_MODEL_RGBSDA, transferFunction: ktx.KHR_DF_TRANSFER_LINEAR, block: [0, 0], typeSize: 2,
  samples: [0, 1, 2, ktx.KHR_DF_CHANNEL_RGBSDA_ALPHA].map((channel, i) => [16 * i, 16, channel | signedFloat,
    0xbf800000, 0x3f800000]),
};
const KHR_DF_MODEL_BC7 = 134;
const bc7 = {
  colorModel: KHR_DF_MODEL_BC7, transferFunction: ktx.KHR_DF_TRANSFER_SRGB, block: [3, 3], typeSize: 1,
  samples: [[0, 128, 0, 0, 0xffffffff]],
};

// size: width, height, depth, layers; three: what KTX2Loader should make of it.
const textures = {
  'flat.ktx2': {
    vkFormat: ktx.VK_FORMAT_R8G8B8A8_SRGB, size: [13, 7, 0, 0], levels: [364, 72, 12, 4], bytes: 4, ...srgb,
    three: { kind: 'isDataTexture', type: three.UnsignedByteType, colorSpace: three.SRGBColorSpace },
  },
  'volume_srgb.ktx2': {
    vkFormat: ktx.VK_FORMAT_R8G8B8A8_SRGB, size: [8, 8, 6, 0], levels: [1536], bytes: 4, zstd: true, ...srgb,
    three: { kind: 'isData3DTexture', type: three.UnsignedByteType, colorSpace: three.SRGBColorSpace },
  },
  'volume_half.ktx2': {
    vkFormat: ktx.VK_FORMAT_R16G16B16A16_SFLOAT, size: [8, 6, 5, 0], levels: [1920], bytes: 8, zstd: true, ...half,
    three: { kind: 'isData3DTexture', type: three.HalfFloatType, colorSpace: three.LinearSRGBColorSpace },
  },
  'volume_half_plain.ktx2': {
    vkFormat: ktx.VK_FORMAT_R16G16B16A16_SFLOAT, size: [3, 5, 2, 0], levels: [240], bytes: 8, ...half,
    three: { kind: 'isData3DTexture', type: three.HalfFloatType, colorSpace: three.LinearSRGBColorSpace },
  },
  // KTX2Loader reads no uncompressed arrays; it takes the first layer for the whole.
  'array.ktx2': {
    vkFormat: ktx.VK_FORMAT_R16G16B16A16_SFLOAT, size: [4, 4, 0, 4], levels: [512], bytes: 8, zstd: true, ...half,
  },
  'blocks.ktx2': {
    vkFormat: ktx.VK_FORMAT_BC7_SRGB_BLOCK, size: [12, 8, 0, 0], levels: [96, 32], bytes: 16, zstd: true, ...bc7,
    three: { kind: 'isCompressedTexture', colorSpace: three.SRGBColorSpace },
  },
};

const expectedLevel = (length, level) => Uint8Array.from({ length }, (_, i) => (31 * i + 7 * level + 3) % 251);

function checkWithKtxParse(file, expected) {
  const container = ktx.read(file);
  assert.equal(container.vkFormat, expected.vkFormat);
  assert.equal(container.typeSize, expected.typeSize);
  assert.deepEqual([container.pixelWidth, container.pixelHeight, container.pixelDepth, container.layerCount],
    expected.size);
  assert.equal(container.faceCount, 1);
  assert.equal(container.supercompressionScheme,
    expected.zstd ? ktx.KHR_SUPERCOMPRESSION_ZSTD : ktx.KHR_SUPERCOMPRESSION_NONE);

  const [descriptor] = container.dataFormatDescriptor;
  assert.equal(container.dataFormatDescriptor.length, 1);
  assert.equal(descriptor.vendorId, 0);
  assert.equal(descriptor.descriptorType, ktx.KHR_DF_KHR_DESCRIPTORTYPE_BASICFORMAT);
  assert.equal(descriptor.versionNumber, ktx.KHR_DF_VERSION);
  assert.equal(descriptor.colorModel, expected.colorModel);
  assert.equal(descriptor.colorPrimaries, ktx.KHR_DF_PRIMARIES_BT709);
  assert.equal(descriptor.transferFunction, expected.transferFunction);
  assert.equal(descriptor.flags, ktx.KHR_DF_FLAG_ALPHA_STRAIGHT);
  assert.deepEqual(descriptor.texelBlockDimension, [...expected.block, 0, 0]);
  assert.deepEqual(descriptor.bytesPlane, [expected.bytes, 0, 0, 0, 0, 0, 0, 0]);
  assert.deepEqual(
    descriptor.samples.map((s) => [s.bitOffset, s.bitLength + 1, s.channelType, s.sampleLower >>> 0,
      s.sampleUpper >>> 0]),
    expected.samples);
  for (const sample of descriptor.samples) assert.deepEqual([...sample.samplePosition], [0, 0, 0, 0]);

  const { KTXwriter, ...metadata } = container.keyValue;
  assert.match(KTXwriter, /^Sateen \d+\.\d+\.\d+$/);
  // ktx-parse reads the keys of the specification as text and gives the bytes of others, the final zero included.
  const text = (value) => typeof value === 'string' ? value : new TextDecoder().decode(value).replace(/\0$/, '');
  const texts = Object.fromEntries(Object.entries(metadata).map(([key, value]) => [key, text(value)]));
  assert.deepEqual(texts, {
    KTXorientation: expected.size[2] === 0 ? 'rd' : 'rdi', 'sateen.symmetry': '2', 'étoffe': 'soie',
  });

  assert.deepEqual(container.levels.map((level) => level.uncompressedByteLength), expected.levels);
  container.levels.forEach((level, i) => {
    const data = expected.zstd ? zstd.decode(level.levelData, expected.levels[i]) : level.levelData;
    assert.deepEqual(new Uint8Array(data), expectedLevel(expected.levels[i], i));
  });
}

// KTX2Loader asks the renderer for one thing only: which block formats it can sample.
const loader = new KTX2Loader().detectSupport({
  extensions: { has: (name) => name === 'EXT_texture_compression_bptc', get: () => null },
});

async function checkWithThree(file, expected) {
  const buffer = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
  const texture = await new Promise((resolve, reject) => loader.parse(buffer, resolve, reject));
  assert.equal(texture[expected.three.kind], true);
  assert.equal(texture.colorSpace, expected.three.colorSpace);
  const [width, height, depth] = expected.size;
  assert.deepEqual([texture.image.width, texture.image.height], [width, height]);
  if (depth > 0) assert.equal(texture.image.depth, depth);
  if (expected.three.type !== undefined) {
    assert.equal(texture.format, three.RGBAFormat);
    assert.equal(texture.type, expected.three.type);
  }
  assert.equal(texture.mipmaps.length, expected.levels.length);
  texture.mipmaps.forEach(({ data }, i) => {
    assert.deepEqual(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), expectedLevel(expected.levels[i], i));
  });
}

for (const [name, expected] of Object.entries(textures)) {
  const file = new Uint8Array(readFileSync(join(folder, name)));
  checkWithKtxParse(file, expected);
  if (expected.three) await checkWithThree(file, expected);
  console.log(`${name}: read alike by ktx-parse${expected.three ? ' and three.js' : ''}`);
}
