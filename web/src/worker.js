// The core, in a thread of its own so that the page never freezes.
import { gunzipSync, unzipSync } from 'fflate';
import createSkel from 'skel-core';
import { bytesOfText } from './bytes_text.js';

const kMostPixels = 6e6; // larger pictures are made smaller, for the memory of a phone
const kLongSide = 2048;

let core;
let picture; // {name, width, height, rgba}

const isPng = (bytes) => [0x89, 0x50, 0x4e, 0x47].every((byte, i) => bytes[i] === byte);
const pngPixels = (bytes) => new DataView(bytes.buffer, bytes.byteOffset).getUint32(16) * new DataView(bytes.buffer, bytes.byteOffset).getUint32(20);

function checked(said) {
  if (said.error) throw new Error(said.error);
  return said;
}

// What the browser knows and the core does not: JPEG, WebP, GIF, BMP; and large pictures.
async function browserDecode(bytes, name) {
  let bitmap;
  try {
    bitmap = await createImageBitmap(new Blob([bytes]), {
      imageOrientation: 'from-image', premultiplyAlpha: 'none', colorSpaceConversion: 'none',
    });
  } catch {
    return null;
  }
  const shrink = bitmap.width * bitmap.height > kMostPixels ? kLongSide / Math.max(bitmap.width, bitmap.height) : 1;
  const width = Math.max(1, Math.round(bitmap.width * shrink)), height = Math.max(1, Math.round(bitmap.height * shrink));
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, width, height);
  bitmap.close();
  const rgba = new Uint8Array(context.getImageData(0, 0, width, height).data.buffer);
  return { width, height, rgba, scaled: shrink < 1 };
}

// The size of what is not PNG is known only when it is there: the extension goes where pixels are no longer the file's.
async function decode(bytes, name) {
  const small = isPng(bytes) && bytes.length > 24 && pngPixels(bytes) <= kMostPixels;
  const decoded = small ? null : await browserDecode(bytes, name);
  const made = decoded ?? checked(core.decode(bytes, name));
  return { name: made.scaled ? name.replace(/\.[^.]*$/, '') + '.png' : name, ...made };
}

const calls = {
  async start(wasm, nets) {
    core = await createSkel({ wasmBinary: typeof wasm === 'string' ? gunzipSync(bytesOfText(wasm)) : wasm });
    checked(core.useNets(unzipSync(typeof nets === 'string' ? bytesOfText(nets) : nets)));
  },
  async open(bytes, name) {
    picture = await decode(bytes, name);
    return { name: picture.name, width: picture.width, height: picture.height, rgba: picture.rgba, scaled: picture.scaled };
  },
  readMask: (request) => checked(core.readMask({ skeleton: null, skeletonFile: '', ...request, width: picture.width, height: picture.height })),
  rig(request) {
    return checked(core.rig({
      mask: null, skeleton: null, skeletonFile: '', plan: '', figure: 1,
      ...request, file: picture.name, width: picture.width, height: picture.height, rgba: picture.rgba,
    }));
  },
  glb: () => core.glb(),
  texture: () => core.texture(),
  drawing: () => core.drawing(),
  mask: () => core.mask(),
};

onmessage = async ({ data: { id, call, values } }) => {
  try {
    postMessage({ id, result: await calls[call](...values) });
  } catch (error) {
    postMessage({ id, error: error.message ?? String(error), fatal: !(error instanceof Error) || error instanceof WebAssembly.RuntimeError });
  }
};
