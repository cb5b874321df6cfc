// Whatever rig() is given that is wrong is refused with a SkelError of one sentence, and the core lives on; the process's
// own handlers of errors stay alone. Runs in a project that has the package and hero.png (npm.mjs).
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { rig, SkelError } from 'skel';
import { startWorker } from 'skel/worker';

const listeners = () => ['uncaughtException', 'unhandledRejection', 'exit'].map((event) => process.listenerCount(event));
const before = listeners();

const png = new Uint8Array(await readFile('hero.png'));
const hero = await rig(png);
assert.deepEqual(listeners(), before);
const pixels = (width, height, bytes, Type = Uint8Array) => ({ width, height, rgba: new Type(bytes) });
const read = new Response(png);
await read.arrayBuffer();
const round = {};
round.round = round;
const withJoint = (image) => ({ ...hero.skeleton, joints: hero.skeleton.joints.map((joint, i) => (i === 3 ? { ...joint, image } : joint)) });

const refused = [ // [what rig() is given, the sentence or how it starts]
  [[], 'the drawing: is undefined; give the bytes'],
  [[null], 'the drawing: is null; give'],
  [['hero.png'], 'the drawing: is the text "hero.png"; give the bytes of a picture\'s file (Uint8Array, ArrayBuffer, Blob or Response), or { width, height, rgba }'],
  [[5], 'the drawing: is the number 5; give'],
  [[{}], 'the drawing: is of the type Object; give'],
  [[[1, 2]], 'the drawing: is of the type Array; give'],
  [[new Uint8Array(0)], 'drawing.png: is empty'],
  [[png.subarray(0, 5000)], 'drawing.png: is a broken PNG'],
  [[new TextEncoder().encode('hello'), { name: 'hello.txt' }], 'hello.txt: is not a picture that can be read (PNG; others as { width, height, rgba })'],
  [[new Uint8Array([0xff, 0xd8, 0xff, 0xe0, 0, 16]), { name: 'a.jpg' }], 'a.jpg: this build reads no JPEG; convert the picture to PNG'],
  [[new Response('none', { status: 404, statusText: 'Not Found' }), { name: 'a.png' }], 'a.png: the answer is 404 Not Found'],
  [[read, { name: 'a.png' }], 'a.png: cannot be read: '],
  [[png, null], 'the options: are null; give an object with name, plan, figure, upright, mask, skeleton'],
  [[png, 'biped'], 'the options: are the text "biped"; give'],
  [[png, ['biped']], 'the options: are of the type Array; give'],
  [[png, { pln: 'biped' }], 'pln: is no option; there are name, plan, figure, upright, mask, skeleton'],
  [[png, { name: 7 }], 'name: is the number 7; give the file\'s name'],
  [[png, { name: '' }], 'name: is the text ""; give'],
  [[png, { name: null }], 'name: is null; give'],
  [[png, { plan: 'spider' }], 'plan: is the text "spider"; it must be one of auto, biped, quadruped'],
  [[png, { plan: 4 }], 'plan: is the number 4; it must be'],
  [[png, { plan: '' }], 'plan: is the text ""; it must be'],
  ...[0, -1, 1.5, NaN, Infinity].map((figure) => [[png, { figure }], `figure: is the number ${figure}; it must be a whole number, 1 (the largest) or more`]),
  [[png, { figure: '1' }], 'figure: is the text "1"; it must be'],
  [[png, { figure: 1e12 }], 'figure: is 1000000000000; no drawing shows so many figures'],
  [[png, { upright: 'yes' }], 'upright: is the text "yes"; it must be true or false'],
  [[png, { upright: 1 }], 'upright: is the number 1; it must be'],
  [[png, { figure: 9 }], 'drawing.png: there is no figure 9, only 1'],
  [[png, { mask: 'm.png' }], 'mask: is the text "m.png"; give the bytes'],
  [[png, { mask: 3 }], 'mask: is the number 3; give'],
  [[png, { mask: new Uint8Array(10) }], 'the mask: is not a picture'],
  [[pixels(20, 10, 800), { mask: png }], 'the mask: is a mask of '],
  [[png, { skeleton: 3 }], 'skeleton: is the number 3; give one that rig() returned, or the text of a .skeleton.json file'],
  [[png, { skeleton: [] }], 'skeleton: is of the type Array; give'],
  [[png, { skeleton: round }], 'skeleton: cannot be written as JSON: '],
  [[png, { skeleton: '{' }], 'the skeleton: is not JSON'],
  [[png, { skeleton: '' }], 'the skeleton: is '],
  [[png, { skeleton: {} }], 'the skeleton: lacks "format"'],
  [[png, { skeleton: withJoint([NaN, 1]) }], 'the skeleton: joints[3].image[0]: must be a number'],
  [[png, { skeleton: withJoint([-5000, 1]) }], 'the skeleton: joints[3].image: '],
  [[png, { skeleton: hero.skeleton, plan: 'quadruped' }], 'plan: is quadruped, the skeleton is of plan biped; leave one of them out'],
  [[png, { skeleton: hero.skeleton, figure: 2 }], 'figure: is 2, the skeleton is of figure 1; leave one of them out'],
  [[pixels(20, 10, 799), { name: 'p' }], 'p: rgba has 799 bytes, 20x10 px of 4 bytes need 800'],
  [[pixels(600, 600, 0), { name: 'p' }], 'p: rgba has 0 bytes, 600x600 px of 4 bytes need 1440000'],
  [[pixels(20, 10, 801), { name: 'p' }], 'p: rgba has 801 bytes, 20x10 px of 4 bytes need 800'],
  [[pixels(20, 10, 600), { name: 'p' }], 'p: rgba has 600 bytes, 20x10 px of 4 bytes need 800; RGB needs a fourth byte a pixel, alpha'],
  [[pixels(100000, 100000, 4), { name: 'p' }], 'p: rgba has 4 bytes, '],
  [[pixels(40000, 1, 160000), { name: 'p' }], 'p: is too large: 40000x1 px'],
  [[pixels(0, 0, 0), { name: 'p' }], 'p: width is the number 0; it must be a whole number of pixels, 1 or more'],
  [[pixels(1.5, 2, 12), { name: 'p' }], 'p: width is the number 1.5; it must be'],
  [[pixels(2, -2, 16), { name: 'p' }], 'p: height is the number -2; it must be'],
  [[pixels('2', 2, 16), { name: 'p' }], 'p: width is the text "2"; it must be'],
  [[pixels(2, 2, 16, Uint16Array), { name: 'p' }], 'p: rgba is of the type Uint16Array; it must be a Uint8Array or a Uint8ClampedArray'],
  [[pixels(2, 2, 16, Array), { name: 'p' }], 'p: rgba is of the type Array; it must be'],
  [[{ width: 2, height: 2 }, { name: 'p' }], 'p: rgba is undefined; it must be'],
  [[pixels(1, 1, 4), { name: 'p' }], 'p: the picture is '],
];
const wrong = [];
for (const [given, sentence] of refused) {
  const error = await rig(...given).then(() => 'took it', (problem) => problem);
  if (!(error instanceof SkelError) || !error.message.startsWith(sentence) || /\n|--/.test(error.message)) wrong.push(`${error}, not: ${sentence}`);
}
assert.deepEqual(wrong, []);

// What is right: the same bytes in each of their forms; options that are undefined are those that are left out.
const same = async (drawing, options) => assert.deepEqual((await rig(drawing, options)).glb, hero.glb);
await same(Buffer.from(png), { name: undefined, plan: undefined, figure: undefined, mask: null, skeleton: null });
await same(png.buffer, {});
await same(new Blob([png]));
await same(new Response(png), Object.assign(Object.create(null), { figure: 1 }));
// Whatever becomes of the memory after the call.
for (const change of [(bytes) => bytes.fill(0), ({ buffer }) => structuredClone(buffer, { transfer: [buffer] })])
  for (const given of [(bytes) => bytes, ({ buffer }) => buffer]) {
    const mine = png.slice(), asked = same(given(mine));
    change(mine);
    await asked;
  }

// A picture with a grey square wherever one is asked for: [left, top, size].
function squares(width, height, ...places) {
  const picture = pixels(width, height, 4 * width * height, Uint8ClampedArray);
  picture.rgba.fill(255);
  for (const [left, top, size] of places)
    for (let y = top; y < top + size; ++y)
      for (let x = left; x < left + size; ++x) picture.rgba.fill(90, 4 * (width * y + x), 4 * (width * y + x) + 3);
  return picture;
}
assert.equal((await rig(squares(300, 300, [90, 60, 150]), { name: 'a square' })).width, 300);
const moved = squares(300, 300, [90, 60, 150]), still = rig(moved, { name: 'a square' });
moved.rgba.fill(255);
assert.equal((await still).figures, 1);

// One call after the other leaves what else waits its turn.
let turns = 0;
const timer = setInterval(() => ++turns);
for (let i = 0; i < 4; ++i) await rig(png);
clearInterval(timer);
assert.ok(turns >= 3, `${turns} turns`);

// Words of the command line are none of JavaScript's.
const { warnings, figures } = await rig(squares(600, 300, [60, 40, 200], [400, 40, 120]), { name: 'two' });
assert.equal(figures, 2);
assert.ok(warnings.some((warning) => warning.includes('choose another with figure')), warnings.join('\n'));
assert.ok(!warnings.some((warning) => warning.includes('--')), warnings.join('\n'));

// A drawing that is turned, by the name that the option has here.
const createSkel = createRequire(import.meta.url)('./node_modules/skel/skel-core.cjs');
const wasmBinary = await readFile('node_modules/skel/skel.wasm');
const core = await createSkel({ wasmBinary, printErr: () => {} });
const { width, height, rgba } = core.decode(png, 'hero.png');
const turned = pixels(height, width, 4 * width * height);
for (let y = 0; y < height; ++y)
  for (let x = 0; x < width; ++x)
    turned.rgba.set(rgba.subarray(4 * (width * y + x), 4 * (width * y + x) + 4), 4 * (height * x + height - 1 - y));
const lying = await rig(turned, { name: 'lying' });
assert.ok(lying.warnings.includes('the figure is turned by 90 degrees (if it is not, use upright)'), lying.warnings.join('\n'));
assert.ok(lying.warnings.every((warning) => !/--|skel-label/.test(warning)), lying.warnings.join('\n'));
const standing = await rig(turned, { name: 'lying', upright: true });
assert.ok(!standing.warnings.some((warning) => warning.includes('turned by')), standing.warnings.join('\n'));
assert.deepEqual((await rig(png, { upright: true })).skeleton.joints, hero.skeleton.joints);

// The workers of browsers are not node's.
assert.throws(startWorker, (error) => error instanceof SkelError && error.message.includes('node:worker_threads'));

// A core that fails leaves the process as it was, and so does the next one.
assert.throws(() => core.texture(), WebAssembly.RuntimeError); // of no character: it aborts
assert.deepEqual(listeners(), before);
let seen = 0;
process.once('uncaughtException', () => ++seen);
process.once('unhandledRejection', () => ++seen);
Promise.reject(new Error('of another part'));
setTimeout(() => { throw new Error('of another part'); });
await new Promise((resolve) => setTimeout(resolve, 200));
assert.equal(seen, 2);
await same(png);
