// The core for whoever holds it: pictures in, characters out. The worker of the page and the npm package stand on it.
const kMostPixels = 6e6; // larger pictures are made smaller, for the memory of a phone
const kLongSide = 2048;

// What is wrong with what was given, in the sentence of the tools.
export class SkelError extends Error {
  name = 'SkelError';
}

// Nobody here types a command line: its options by the names that they have in rig() and on the page, without what is
// mended in windows of the tools.
const kFormats = 'PNG, JPEG, WebP, BMP, TIFF or GIF'; // of the tools
const withoutDashes = (text) => text.replace(/--template (\w+)/g, 'plan "$1"').replace(/--template\b/g, 'plan').replace(/--(figure|upright)\b/g, '$1')
  .replace(/leave it out by --alpha [\d.]+/g, 'rub it out').replace(/ \(skel-label [^)]*\)/g, '')
  .replace(`(${kFormats})`, canBrowse() ? '(PNG, and what the browser shows)' : '(PNG; others as { width, height, rgba })');

function checked(said) {
  if (said.error) throw new SkelError(withoutDashes(said.error));
  return said;
}

const isPng = (bytes) => bytes.length > 24 && [0x89, 0x50, 0x4e, 0x47].every((byte, i) => bytes[i] === byte);
function pngPixels(bytes) {
  const header = new DataView(bytes.buffer, bytes.byteOffset);
  return header.getUint32(16) * header.getUint32(20);
}

const canBrowse = () => Boolean(globalThis.createImageBitmap && globalThis.OffscreenCanvas);

// What the browser knows and the core does not: JPEG, WebP, GIF, BMP; and large pictures. Null where it does not either.
// `of`: the size that the picture has in its file.
async function browserDecode(bytes) {
  if (!canBrowse()) return null;
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
  const of = { width: bitmap.width, height: bitmap.height };
  bitmap.close();
  return { width, height, of, rgba: new Uint8Array(context.getImageData(0, 0, width, height).data.buffer), scaled: shrink < 1 };
}

export class Skel {
  #core;

  // `createSkel`: what emcc made; `wasm`: the bytes of skel.wasm; `nets`: those of {page, parts, biped, quadruped}.
  static async start(createSkel, wasm, nets) {
    const skel = new Skel();
    let started = false; // until then the error says all that there is to say
    skel.#core = await createSkel({ wasmBinary: wasm, printErr: (line) => started && console.error(line) });
    started = true;
    const { error } = skel.#core.useNets(nets);
    if (error) throw new Error(error); // nothing that was given
    return skel;
  }

  // {name, width, height, of, rgba, scaled}. The size of what is not PNG is known only when it is there; the ending goes
  // where pixels are no longer the file's.
  async open(bytes, name) {
    const small = isPng(bytes) && pngPixels(bytes) <= kMostPixels;
    const picture = (small ? null : await browserDecode(bytes)) ?? { ...checked(this.#core.decode(bytes, name)), scaled: false };
    return { ...picture, name: picture.scaled ? name.replace(/\.[^.]*$/, '') + '.png' : name };
  }

  // Of a picture that was made smaller, of the size that it had or has.
  readMask({ width, height, of = { width, height } }, request) {
    return checked(this.#core.readMask({
      skeleton: null, skeletonFile: '', ...request, width, height, ofWidth: of.width, ofHeight: of.height,
    })).mask;
  }

  // What these calls return is that of the last rig(). In the skeleton, a file of the tools, warnings stay as they say them.
  rig({ name, width, height, rgba }, request) {
    const found = checked(this.#core.rig({
      mask: null, skeleton: null, skeletonFile: '', plan: '', figure: 1, upright: false, draft: false, ...request, file: name, width, height, rgba,
    }));
    return { ...found, warnings: found.warnings.map(withoutDashes) };
  }
  glb() { return this.#core.glb(); }
  flat() { return checked(this.#core.flat()); }
  flatClip(name, rate_hz) { return checked(this.#core.flatClip(name, rate_hz)); }
  texture() { return this.#core.texture(); }
  drawing() { return this.#core.drawing(); }
  mask() { return this.#core.mask(); }
}
