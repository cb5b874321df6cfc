// The core, in a thread of its own so that the page never freezes.
import { gunzipSync, unzipSync } from 'fflate';
import createSkel from 'skel-core';
import { bytesOfText } from './bytes_text.js';
import { Skel } from './skel.js';

let skel;
let picture; // that is open

const calls = {
  async start(wasm, nets) {
    skel = await Skel.start(createSkel, typeof wasm === 'string' ? gunzipSync(bytesOfText(wasm)) : wasm,
      unzipSync(typeof nets === 'string' ? bytesOfText(nets) : nets));
  },
  async open(bytes, name) {
    picture = await skel.open(bytes, name);
    return picture;
  },
  readMask: (request) => ({ mask: skel.readMask(picture, request) }),
  rig: (request) => skel.rig(picture, request),
  glb: () => skel.glb(),
  flat: () => skel.flat(),
  flatClip: (name, rate_hz) => skel.flatClip(name, rate_hz),
  texture: () => skel.texture(),
  drawing: () => skel.drawing(),
  mask: () => skel.mask(),
};

onmessage = async ({ data: { id, call, values } }) => {
  try {
    postMessage({ id, result: await calls[call](...values) });
  } catch (error) {
    postMessage({ id, error: error.message ?? String(error), fatal: !(error instanceof Error) || error instanceof WebAssembly.RuntimeError });
  }
};
