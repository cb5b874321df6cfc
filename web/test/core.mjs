// The core in node against skel-infer: node core.mjs WASM_DIR NATIVE PLAN PNG... NATIVE holds what skel-infer wrote of
// the pictures (json, glb). Joints within 0.1 px; of the GLB files, the same structure, texture and triangles, weights
// within 0.01 %, texture coordinates within 1 of 65535 and other numbers within a few units in the last place (sines and powers are the C library's own).
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { basename } from 'node:path';

const [wasmDir, native, plan, ...files] = process.argv.slice(2);
const kTolerance_px = 0.1;

globalThis.fetch = undefined; // node's is not for files
const createSkel = createRequire(import.meta.url)(`${wasmDir}/skel.js`);
const core = await createSkel({ wasmBinary: await readFile(`${wasmDir}/skel.wasm`) });
const net = (name) => readFile(new URL(`../../weights/${name}.bin`, import.meta.url));
core.useNets({ page: await net('page_net'), parts: await net('part_net'), biped: await net('joint_net'), quadruped: await net('quadruped_joint_net') });

const kFloat = 5126, kShort = 5123; // glTF's names of them
const kNumber = 1e-6, kWeight = 4; // of a glTF weight's 65535

function chunks(glb) {
  const size = glb.readUInt32LE(12);
  return { json: JSON.parse(glb.subarray(20, 20 + size)), bytes: glb.subarray(20 + size + 8) };
}

// How the joints that carry the vertices differ, or null. Of two that carry nearly the same either may come first.
function skinDifference(a, b) {
  const { JOINTS_0: joints, WEIGHTS_0: weights } = a.json.meshes[0].primitives[0].attributes;
  const viewOf = ({ json, bytes }, accessor) => {
    const { byteOffset = 0, byteLength } = json.bufferViews[json.accessors[accessor].bufferView];
    return bytes.subarray(byteOffset, byteOffset + byteLength);
  };
  const shares = (glb, vertex) => {
    const carried = new Map();
    for (let k = 4 * vertex; k < 4 * vertex + 4; ++k) {
      const joint = viewOf(glb, joints)[k];
      carried.set(joint, (carried.get(joint) ?? 0) + viewOf(glb, weights).readUInt16LE(2 * k));
    }
    return carried;
  };
  for (let vertex = 0; vertex < a.json.accessors[joints].count; ++vertex) {
    const mine = shares(a, vertex), theirs = shares(b, vertex);
    for (const joint of [...mine.keys(), ...theirs.keys()])
      if (Math.abs((mine.get(joint) ?? 0) - (theirs.get(joint) ?? 0)) > kWeight) return `has ${mine.get(joint) ?? 0} for ${theirs.get(joint) ?? 0} of 65535 of joint ${joint} at vertex ${vertex}`;
  }
  return null;
}

// How two GLB files differ, or null.
function difference(mine, theirs) {
  const a = chunks(mine), b = chunks(theirs);
  if (JSON.stringify(a.json.bufferViews) !== JSON.stringify(b.json.bufferViews)) return 'has other buffers';
  const { JOINTS_0: joints, WEIGHTS_0: weights } = a.json.meshes[0].primitives[0].attributes;
  const skin = [joints, weights].map((accessor) => a.json.accessors[accessor].bufferView);
  for (const [i, { byteOffset = 0, byteLength }] of a.json.bufferViews.entries()) {
    const x = a.bytes.subarray(byteOffset, byteOffset + byteLength), y = b.bytes.subarray(byteOffset, byteOffset + byteLength);
    if (x.equals(y) || skin.includes(i)) continue;
    const values = a.json.accessors.find((one) => one.bufferView === i);
    if (values?.componentType === kShort && values.type === 'VEC2') { // texture coordinates, rounded
      for (let at = 0; at < byteLength; at += 2)
        if (Math.abs(x.readUInt16LE(at) - y.readUInt16LE(at)) > 1) return `has ${x.readUInt16LE(at)} for ${y.readUInt16LE(at)} in buffer view ${i}`;
      continue;
    }
    if (values?.componentType !== kFloat) return `differs in buffer view ${i}`;
    for (let at = 0; at < byteLength; at += 4)
      if (!(Math.abs(x.readFloatLE(at) - y.readFloatLE(at)) <= kNumber)) return `has ${x.readFloatLE(at)} for ${y.readFloatLE(at)} in buffer view ${i}`;
  }
  return skinDifference(a, b);
}

let worst = 0, sameGlb = 0, failed = 0;
const times = [];
const fail = (name, problem) => {
  console.error(`${name}: ${problem}`);
  ++failed;
};
for (const file of files) {
  const name = basename(file), stem = name.replace(/\.png$/, '');
  const picture = core.decode(await readFile(file), name);
  if (picture.error) {
    fail(name, picture.error);
    continue;
  }
  const start = performance.now();
  const found = core.rig({ ...picture, file: name, mask: null, skeleton: null, skeletonFile: '', plan, figure: 1 });
  times.push(performance.now() - start);
  if (found.error) {
    fail(name, found.error);
    continue;
  }
  const mine = JSON.parse(found.skeleton), theirs = JSON.parse(await readFile(`${native}/${stem}.skeleton.json`, 'utf8'));
  const off = Math.max(...mine.joints.map((joint, i) =>
    Math.hypot(joint.image[0] - theirs.joints[i].image[0], joint.image[1] - theirs.joints[i].image[1])));
  worst = Math.max(worst, off);
  if (off > kTolerance_px) fail(name, `a joint lies ${off.toFixed(2)} px from the native one`);
  if (mine.figure.sha256 !== theirs.figure.sha256) fail(name, 'the figure is outlined otherwise');
  if (JSON.stringify(mine.warnings) !== JSON.stringify(theirs.warnings)) fail(name, `says ${mine.warnings}, not ${theirs.warnings}`);
  const glb = Buffer.from(core.glb()), theirGlb = await readFile(`${native}/${stem}.glb`);
  if (glb.equals(theirGlb)) ++sameGlb;
  // A joint that is rounded to the next hundredth of a pixel moves everything that hangs on it.
  const differs = off === 0 ? difference(glb, theirGlb) : null;
  if (off > 0) console.log(`${name}: a joint is rounded otherwise, by ${off.toFixed(2)} px: the model is not compared`);
  if (differs) fail(`${stem}.glb`, differs);
}

// The drawing as a cut-out: every corner has a place in every frame, and drawn as it is each lies where the drawing has it.
if (files.length) {
  const name = basename(files[0]), picture = core.decode(await readFile(files[0]), name);
  core.rig({ ...picture, file: name, mask: null, skeleton: null, skeletonFile: '', plan, figure: 1 });
  const flat = core.flat(), rest = core.flatClip('', 30), walk = core.flatClip('walk', 30);
  const vertices = Math.max(...flat.vertex) + 1, corners = flat.vertex.length;
  if (flat.error ?? rest.error ?? walk.error) fail(name, flat.error ?? rest.error ?? walk.error);
  else if (flat.rgba.length !== 4 * flat.width * flat.height || flat.texcoords.length !== 2 * corners || Math.max(...flat.triangles) !== corners - 1)
    fail(name, 'the cut-out has other numbers of pixels or corners than it says');
  else if (rest.frames !== 1 || rest.places.length !== 2 * vertices || walk.frames < 10 || walk.places.length !== 2 * vertices * walk.frames)
    fail(name, 'the cut-out has other numbers of places than of vertices');
  else if (!walk.places.every(Number.isFinite) || walk.places.subarray(0, 2 * vertices).every((place, i) => Math.abs(place - walk.places[2 * vertices * 8 + i]) < 1e-3))
    fail(name, 'the cut-out does not walk');
}

// A joint that is dragged moves in the model that is there; at rest the character is what it would be from the start.
if (files.length) {
  const name = basename(files[0]), picture = core.decode(await readFile(files[0]), name), end = plan === 'biped' ? 'left_hand' : 'tail';
  const rig = (request) => core.rig({ ...picture, file: name, mask: null, skeleton: null, skeletonFile: '', plan: '', figure: 1, ...request });
  const skeleton = JSON.parse(rig({ plan }).skeleton), joint = skeleton.joints.find((one) => one.name === end);
  Object.assign(joint, { image: [joint.image[0] - 9, joint.image[1] + 4], origin: 'edited' });
  const moved = { skeleton: JSON.stringify({ ...skeleton, mask: null }), skeletonFile: 'edited.skeleton.json' };
  const whole = rig({}); // of a figure of any plan, as the page asks
  if (whole.plan !== plan) rig({ plan });
  const draft = whole.plan === plan ? rig({ ...moved, draft: true }) : null;
  for (const stage of ['silhouette', 'recognition', 'layers', 'mesh', 'stretch'])
    if (draft && stage in draft.times) fail(name, `a draft runs the stage ${stage}`);
  const kept = rig(moved), glb = Buffer.from(core.glb());
  if ('silhouette' in kept.times || 'recognition' in kept.times) fail(name, 'a moved joint has the picture looked at again');
  if (draft && JSON.stringify(JSON.parse(draft.skeleton).joints[0].image) !== JSON.stringify(JSON.parse(kept.skeleton).joints[0].image))
    fail(name, 'a draft has other joints');
  rig({ ...core.decode(await readFile(files.at(-1)), 'other.png'), file: 'other.png' });
  rig(moved);
  if (files.length > 1 && !glb.equals(Buffer.from(core.glb()))) fail(name, 'a joint moved and the same from the start are not the same model');
}
// Pixels that are too few or too many are refused: the rest would be what another picture has left in the memory.
{
  const request = { file: 'x', width: 20, height: 10, rgba: new Uint8Array(800), mask: null, skeleton: null, skeletonFile: '', plan, figure: 1, draft: false };
  for (const [changed, sentence] of [
    [{ rgba: new Uint8Array(0) }, 'x: rgba has 0 bytes, 20x10 px of 4 bytes need 800'],
    [{ rgba: new Uint8Array(799) }, 'x: rgba has 799 bytes, 20x10 px of 4 bytes need 800'],
    [{ rgba: new Uint8Array(801) }, 'x: rgba has 801 bytes, 20x10 px of 4 bytes need 800'],
    [{ rgba: new Uint8ClampedArray(600) }, 'x: rgba has 600 bytes, 20x10 px of 4 bytes need 800; RGB needs a fourth byte a pixel, alpha'],
    [{ mask: new Uint8Array(199) }, 'x: mask has 199 bytes, 20x10 px of 1 byte need 200'],
    [{ mask: new Uint8Array(800) }, 'x: mask has 800 bytes, 20x10 px of 1 byte need 200'],
    [{ width: 0, rgba: new Uint8Array(0) }, 'x: has no pixels: 0x10'],
    [{ width: -20, height: -10 }, 'x: has no pixels: -20x-10'],
    [{ width: 40000, height: 1, rgba: new Uint8Array(160000) }, 'x: is too large: 40000x1 px; make it smaller'],
    [{ figure: 0 }, 'x: figure: must be 1 or more'],
  ]) {
    const { error } = core.rig({ ...request, ...changed });
    if (error !== sentence) fail('a request that cannot be', `"${error}", not "${sentence}"`);
  }
}
times.sort((a, b) => a - b);
console.log(`${plan}: ${files.length} drawings, joints at most ${worst.toFixed(3)} px apart, ${sameGlb} GLB files the same byte for byte, ` +
  `median ${times[times.length >> 1]?.toFixed(0)} ms`);
process.exit(failed ? 1 : 0);
