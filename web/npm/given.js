// What rig() is given, looked at before anything is done with it: whatever is wrong is a SkelError with one sentence.
import { SkelError } from '../src/skel.js';

const kOptions = ['name', 'plan', 'figure', 'upright', 'mask', 'skeleton'];
const kPlans = ['auto', 'biped', 'quadruped'];
const kMostFigures = 2 ** 31 - 1; // that the core can count
const kFile = 'the bytes of a picture\'s file (Uint8Array, ArrayBuffer, Blob or Response)';

function refuse(what, problem) {
  throw new SkelError(`${what}: ${problem}`);
}

// By its name, not by instanceof: test runners and frames have types of their own that are called the same.
const typeOf = (value) => Object.prototype.toString.call(value).slice(8, -1);

function described(value) {
  if (value === undefined || value === null || typeof value === 'boolean') return String(value);
  if (typeof value === 'string') return `the text ${JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}…` : value)}`;
  if (typeof value === 'number') return `the number ${value}`;
  return `of the type ${typeOf(value)}`;
}

const isFile = (data) => ArrayBuffer.isView(data) || ['ArrayBuffer', 'SharedArrayBuffer'].includes(typeOf(data)) || typeof data?.arrayBuffer === 'function';

function checkFile(data, what, wanted) {
  if (!isFile(data)) refuse(what, `is ${described(data)}; give ${wanted}`);
}

const isCount = (value) => Number.isInteger(value) && value >= 1;

// `name`d pixels: as many as they say, and no view of other numbers than bytes.
function checkPixels({ width, height, rgba }, name) {
  for (const [side, value] of Object.entries({ width, height }))
    if (!isCount(value)) refuse(name, `${side} is ${described(value)}; it must be a whole number of pixels, 1 or more`);
  if (!['Uint8Array', 'Uint8ClampedArray'].includes(typeOf(rgba)))
    refuse(name, `rgba is ${described(rgba)}; it must be a Uint8Array or a Uint8ClampedArray`);
  const needs = width * height * 4;
  if (rgba.length !== needs)
    refuse(name, `rgba has ${rgba.length} bytes, ${width}x${height} px of 4 bytes need ${needs}` +
      (rgba.length * 4 === needs * 3 ? '; RGB needs a fourth byte a pixel, alpha' : ''));
}

// The text of a skeleton file.
function skeletonText(skeleton) {
  if (typeof skeleton === 'string') return skeleton;
  if (typeOf(skeleton) !== 'Object') refuse('skeleton', `is ${described(skeleton)}; give one that rig() returned, or the text of a .skeleton.json file`);
  let text;
  try {
    text = JSON.stringify(skeleton);
  } catch (error) {
    refuse('skeleton', `cannot be written as JSON: ${error.message.split('\n')[0]}`);
  }
  return text ?? refuse('skeleton', 'cannot be written as JSON');
}

// {drawing, name, plan, figure, upright, mask, skeleton}: `figure` undefined where none was asked for, `mask` a file or
// null, `skeleton` a text or null. Takes what it has returned, too.
export function checkedGiven(drawing, options = {}) {
  if (typeOf(options) !== 'Object') refuse('the options', `are ${described(options)}; give an object with ${kOptions.join(', ')}`);
  for (const option of Object.keys(options))
    if (!kOptions.includes(option)) refuse(option, `is no option; there are ${kOptions.join(', ')}`);
  const { name = 'drawing.png', plan = 'auto', figure, upright = false, mask = null, skeleton = null } = options;
  if (typeof name !== 'string' || !name) refuse('name', `is ${described(name)}; give the file's name`);
  if (!kPlans.includes(plan)) refuse('plan', `is ${described(plan)}; it must be one of ${kPlans.join(', ')}`);
  if (figure !== undefined && !isCount(figure)) refuse('figure', `is ${described(figure)}; it must be a whole number, 1 (the largest) or more`);
  if (figure > kMostFigures) refuse('figure', `is ${figure}; no drawing shows so many figures`);
  if (typeof upright !== 'boolean') refuse('upright', `is ${described(upright)}; it must be true or false`);
  if (mask !== null) checkFile(mask, 'mask', kFile);
  if (!isFile(drawing) && typeof drawing === 'object' && drawing && ('rgba' in drawing || 'width' in drawing)) checkPixels(drawing, name);
  else checkFile(drawing, 'the drawing', `${kFile}, or { width, height, rgba }`);
  return { drawing, name, plan, figure, upright, mask, skeleton: skeleton === null ? null : skeletonText(skeleton) };
}

// `data` as it is now, whatever becomes of the memory that it came in.
export function copied(data) {
  if (ArrayBuffer.isView(data)) return new Uint8Array(data.buffer, data.byteOffset, data.byteLength).slice();
  if (['ArrayBuffer', 'SharedArrayBuffer'].includes(typeOf(data))) return new Uint8Array(data).slice();
  return data?.rgba ? { width: data.width, height: data.height, rgba: data.rgba.slice() } : data;
}

// The bytes of a file that checkedGiven() let through and copied() has taken.
export async function bytesOf(data, what) {
  if (data?.ok === false) refuse(what, `the answer is ${data.status} ${data.statusText}`.trim());
  try {
    return ArrayBuffer.isView(data) ? data : new Uint8Array(await data.arrayBuffer());
  } catch (error) {
    return refuse(what, `cannot be read: ${error.message}`); // read already, changed on the disk, moved to another thread
  }
}
